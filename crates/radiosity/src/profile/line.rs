//! The elements that a line crosses.
use super::error::ProfileError;
use crate::plane::slack;
use crate::record::Record;
use glam::DVec3;

/// Ends may be off a patch's plane by this share of the scene's size: people round what they type.
const OFF: f64 = 1e-6;
/// A line crosses no element in less than this share of its length.
const SHORT: f64 = 1e-12;
/// Patches that face the same way: their normals differ by less.
const TURNED: f64 = 1e-9;
/// Surfaces that carry equal parts of the line, up to this share of it.
const EQUAL: f64 = 1e-9;

/// A part of the line, within one element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) element: usize,
    /// Where it begins and ends, in shares of the line's length.
    pub(super) shares: [f64; 2],
}

/// Patches in whose plane the line lies, which face the same way, and what they carry of it.
struct Carrier {
    patch: usize,
    normal: DVec3,
    stretches: Vec<Stretch>,
}

impl Carrier {
    fn covers(&self) -> f64 {
        self.stretches.iter().map(|stretch| stretch.shares[1] - stretch.shares[0]).sum()
    }
}

/// On the patch of a name.
pub(super) fn on_patch(record: &Record, ends: [DVec3; 2], name: &str) -> Result<Vec<Stretch>, ProfileError> {
    let found = record.patches.iter().position(|patch| patch.name == name);
    let patch = found.ok_or_else(|| ProfileError::Patch { name: name.to_owned() })?;
    let elements = || record.elements.iter().enumerate().filter(|(_, element)| element[0] == patch);
    let beside = || ProfileError::Beside { on: name.to_owned() };
    let normal = normal(record, elements()).ok_or_else(beside)?;
    let off = elements().next().map_or(0.0, |(_, element)| off(record, element, normal, ends));
    if off > OFF * size(record) {
        return Err(ProfileError::Off { patch: name.to_owned(), distance: off });
    }
    let stretches = in_turn(crossed(record, elements(), normal, ends).collect());
    if stretches.is_empty() { Err(beside()) } else { Ok(stretches) }
}

/// On the surface that carries most of the line.
pub(super) fn on_any(record: &Record, ends: [DVec3; 2]) -> Result<Vec<Stretch>, ProfileError> {
    let mut carriers = carriers(record, ends);
    carriers.sort_by(|a, b| b.covers().total_cmp(&a.covers()).then(a.patch.cmp(&b.patch)));
    match carriers.as_slice() {
        [] => Err(ProfileError::Beside { on: "any patch".to_owned() }),
        [first, second, ..] if first.covers() - second.covers() < EQUAL => {
            let name = |carrier: &Carrier| record.patches[carrier.patch].name.clone();
            Err(ProfileError::Two { first: name(first), second: name(second) })
        }
        [first, ..] => Ok(first.stretches.clone()),
    }
}

/// All surfaces that carry some of the line.
fn carriers(record: &Record, ends: [DVec3; 2]) -> Vec<Carrier> {
    let most = OFF * size(record);
    let mut carriers: Vec<Carrier> = Vec::new();
    let all: Vec<(usize, &[usize; 4])> = record.elements.iter().enumerate().collect();
    for elements in all.chunk_by(|(_, a), (_, b)| a[0] == b[0]) {
        let each = || elements.iter().copied();
        let Some(normal) = normal(record, each()) else { continue };
        let (_, first) = elements[0];
        if off(record, first, normal, ends) > most {
            continue;
        }
        let stretches: Vec<Stretch> = crossed(record, each(), normal, ends).collect();
        if stretches.is_empty() {
            continue;
        }
        match carriers.iter_mut().find(|known| known.normal.distance(normal) < TURNED) {
            Some(known) => known.stretches.extend(stretches),
            None => carriers.push(Carrier { patch: first[0], normal, stretches }),
        }
    }
    for carrier in &mut carriers {
        carrier.stretches = in_turn(std::mem::take(&mut carrier.stretches));
    }
    carriers
}

/// The unit normal of a patch's elements.
fn normal<'r>(record: &Record, elements: impl Iterator<Item = (usize, &'r [usize; 4])>) -> Option<DVec3> {
    let cross = |element: &[usize; 4]| {
        let [a, b, c] = triangle(record, element);
        (b - a).cross(c - a)
    };
    elements.map(|(_, element)| cross(element)).sum::<DVec3>().try_normalize()
}

fn triangle(record: &Record, &[_, a, b, c]: &[usize; 4]) -> [DVec3; 3] {
    [a, b, c].map(|corner| record.vertices[corner])
}

/// How far the line is off the plane of an element.
fn off(record: &Record, element: &[usize; 4], normal: DVec3, ends: [DVec3; 2]) -> f64 {
    let [origin, ..] = triangle(record, element);
    ends.map(|end| (end - origin).dot(normal).abs()).into_iter().fold(0.0, f64::max)
}

/// The longest side of the box around all vertices.
fn size(record: &Record) -> f64 {
    let boxes = record.vertices.iter().map(|point| [*point, *point]);
    let around = boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    around.map_or(0.0, |[low, high]| (high - low).max_element())
}

/// What each element has of the line.
fn crossed<'r>(
    record: &'r Record,
    elements: impl Iterator<Item = (usize, &'r [usize; 4])>,
    normal: DVec3,
    ends: [DVec3; 2],
) -> impl Iterator<Item = Stretch> {
    elements.filter_map(move |(index, element)| {
        let shares = within(triangle(record, element), normal, ends)?;
        (shares[1] - shares[0] > SHORT).then_some(Stretch { element: index, shares })
    })
}

/// The part of the line on the inner side of all three edges, in shares of its length.
///
/// ```text
///        c
///       ╱ ╲          an end is so far inside of an edge as it is to the left of it;
///   ───╱───╲───▶     where one end is inside and the other is not, the line crosses
///     a ─── b        the edge at a share that both distances tell
/// ```
fn within(corners: [DVec3; 3], normal: DVec3, ends: [DVec3; 2]) -> Option<[f64; 2]> {
    let [a, b, c] = corners;
    let near = slack(&[a, b, c, ends[0], ends[1]]);
    let [mut from, mut to] = [0.0_f64, 1.0_f64];
    for [p, q] in [[a, b], [b, c], [c, a]] {
        let inward = normal.cross(q - p).try_normalize()?;
        // A line along an edge is inside of both elements there; the first of them gets it.
        let [start, end] = ends.map(|end| (end - p).dot(inward) + near);
        let crossing = start / (start - end);
        match (start >= 0.0, end >= 0.0) {
            (true, true) => {}
            (false, false) => return None,
            (false, true) => from = from.max(crossing),
            (true, false) => to = to.min(crossing),
        }
    }
    (from < to).then_some([from, to])
}

/// One stretch after the other, each place once.
fn in_turn(mut stretches: Vec<Stretch>) -> Vec<Stretch> {
    stretches.sort_by(|a, b| a.shares[0].total_cmp(&b.shares[0]).then(a.element.cmp(&b.element)));
    let mut done = 0.0_f64;
    stretches.retain_mut(|stretch| {
        let [from, to] = stretch.shares;
        stretch.shares[0] = from.max(done);
        let is_new = to - stretch.shares[0] > SHORT;
        if is_new {
            done = to;
        }
        is_new
    });
    stretches
}

/// The shares of a triangle's corners in a place within it.
pub(super) fn weights([a, b, c]: [DVec3; 3], place: DVec3) -> [f64; 3] {
    let normal = (b - a).cross(c - a);
    let area = |p: DVec3, q: DVec3| (p - place).cross(q - place).dot(normal).max(0.0);
    let areas = [area(b, c), area(c, a), area(a, b)];
    let whole: f64 = areas.iter().sum();
    areas.map(|area| area / whole)
}
