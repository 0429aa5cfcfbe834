//! Where on a cell the view of the target changes its shape: planes along which a form factor from a point has kinks.
//!
//! There a vertex of the target lies behind an edge of an occluder's silhouette, or an edge of the target behind a vertex of one,
//! or a vertex of one occluder behind or before an edge of another; or an occluder's face that the target reaches across is
//! seen edge-on. Kinks that three edges make together are curved, and weaker: they are left to the cubature.
use super::contour::to_segment;
use super::patch::{MOST_CORNERS, Patch};
use super::point::Near;
use crate::numeric::rounding::rounding_of;
use crate::scene::occluder::{Face, Occluder, Ridge};
use crate::scene::surfaces::Surface;
use glam::DVec3;

/// More candidates than this are not looked at: halving cells does better.
const MOST: usize = 1 << 14;

/// At most so many pieces of one patch.
const MOST_CUTS: usize = 64;

/// Chords that differ by less than this share of the cell are one, and an edge is this much longer: what stands on the source's plane
/// meets edges at their ends.
const CLOSE: f64 = 1e-9;

/// A plane through a vertex and an edge, or one of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    on: DVec3,
    normal: DVec3,
    /// The vertex and the edge.
    line: Option<(DVec3, [DVec3; 2])>,
    /// How far what moves there is away from the patch at least.
    away: f64,
}

impl Event {
    fn through(vertex: DVec3, [a, b]: [DVec3; 2]) -> Self {
        Self { on: vertex, normal: (a - vertex).cross(b - vertex), line: Some((vertex, [a, b])), away: 0.0 }
    }

    fn of_face([on, normal]: Face) -> Self {
        Self { on, normal, line: None, away: 0.0 }
    }

    fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.on)
    }

    /// The ends of its line through a polygon.
    fn chord(&self, polygon: &Patch) -> Option<[DVec3; 2]> {
        let mut heights = [0.0; MOST_CORNERS];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (height, corner) in heights.iter_mut().zip(polygon.corners()) {
            *height = self.height(*corner);
            low = if *height < low { *height } else { low };
            high = if *height > high { *height } else { high };
        }
        // A plane that nearly is the polygon's own, or is but for roundings, makes no line.
        let [at, opposite] = [polygon.at[0], polygon.at[polygon.count / 2]];
        let is_flat =
            || high - low <= self.normal.length() * (CLOSE * at.distance(opposite) + rounding_of([at]));
        if low >= 0.0 || high <= 0.0 || is_flat() {
            return None;
        }
        let mut ends = [DVec3::ZERO; 2];
        for i in 0..polygon.count {
            let j = if i + 1 == polygon.count { 0 } else { i + 1 };
            if (heights[i] < 0.0) != (heights[j] < 0.0) {
                let share = heights[i] / (heights[i] - heights[j]);
                ends[usize::from(heights[j] < 0.0)] = polygon.at[i] + (polygon.at[j] - polygon.at[i]) * share;
            }
        }
        Some(ends)
    }

    fn crosses(&self, piece: &[DVec3]) -> bool {
        let mut heights = piece.iter().map(|p| self.height(*p));
        heights.clone().any(|h| h > 0.0) && heights.any(|h| h < 0.0)
    }

    /// Whether the vertex is seen to meet the edge from somewhere on a chord.
    fn is_met(&self, chord: [DVec3; 2]) -> bool {
        let Some((vertex, [a, b])) = self.line else { return true };
        // Where on the edge's line the vertex is seen, as quotients.
        let [first, last] = chord.map(|from| {
            let way = vertex - from;
            let across = |v: DVec3| v.cross(way).dot(self.normal);
            [-across(a - from), across(b - a)]
        });
        let is_out = |[part, whole]: [f64; 2]| {
            let (part, whole) = if whole < 0.0 { (-part, -whole) } else { (part, whole) };
            (part < -CLOSE * whole, part > (1.0 + CLOSE) * whole)
        };
        let ((before, after), (before_too, after_too)) = (is_out(first), is_out(last));
        first[1].signum() != last[1].signum() || !((before && before_too) || (after && after_too))
    }
}

/// The events on a cell, and whether they are all.
pub(super) fn events(patch: &Patch, pieces: &[Vec<DVec3>], occluders: &[Near]) -> (Vec<Event>, bool) {
    let cell = patch.corners();
    let seen: Vec<Silhouette> =
        occluders.iter().map(|occluder| Silhouette::from_some(occluder, cell)).collect();
    let mut found = Found::on(patch);
    for (occluder, silhouette) in occluders.iter().zip(&seen) {
        for piece in pieces {
            let edges = piece.iter().zip(piece.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
            found.add_all(&silhouette.vertices, edges);
            found.add_all(piece, silhouette.edges.iter().copied());
            found.add_faces(occluder, piece);
        }
    }
    let vertices: usize = seen.iter().map(|silhouette| silhouette.vertices.len()).sum();
    let are_all = vertices * vertices <= MOST;
    let pairs = (0..seen.len()).flat_map(|i| (0..i).map(move |j| [i, j])).filter(|_| are_all);
    for [i, j] in pairs.filter(|[i, j]| may_overlap(cell, &occluders[*i], &occluders[*j])) {
        found.add_all(&seen[i].vertices, seen[j].edges.iter().copied());
        found.add_all(&seen[j].vertices, seen[i].edges.iter().copied());
    }
    (found.events.into_iter().map(|(event, _)| event).collect(), are_all)
}

/// Events that meet a patch, each with the ends of its line there.
struct Found<'p> {
    patch: &'p Patch,
    middle: DVec3,
    radius: f64,
    /// Ends that are nearer to each other are one.
    near: f64,
    events: Vec<(Event, [DVec3; 2])>,
}

impl<'p> Found<'p> {
    fn on(patch: &'p Patch) -> Self {
        let cell = patch.corners();
        let (middle, radius) = ball_of(cell);
        let near = CLOSE * cell[0].distance(cell[cell.len() / 2]);
        Self { patch, middle, radius, near, events: Vec::new() }
    }

    /// Vertices behind or before edges.
    fn add_all(&mut self, vertices: &[DVec3], edges: impl Iterator<Item = [DVec3; 2]>) {
        for edge in edges {
            vertices.iter().for_each(|vertex| self.add(Event::through(*vertex, edge), 0.0));
        }
    }

    /// Faces that a piece reaches across.
    fn add_faces(&mut self, occluder: &Occluder, piece: &[DVec3]) {
        let nearest = self.middle.distance(occluder.middle) - occluder.radius;
        let faces = occluder.faces.iter().map(|face| Event::of_face(*face));
        faces.filter(|face| face.crosses(piece)).for_each(|face| self.add(face, nearest));
    }

    fn add(&mut self, mut event: Event, nearest: f64) {
        let Some(chord) = event.chord(self.patch).filter(|chord| event.is_met(*chord)) else { return };
        let to_line =
            |(vertex, edge): (DVec3, _)| self.middle.distance(vertex).min(to_segment(self.middle, edge));
        event.away = (event.line.map_or(nearest, to_line) - self.radius).max(0.0);
        let near = self.near;
        let alike = |[a, b]: [DVec3; 2]| a.abs_diff_eq(chord[0], near) && b.abs_diff_eq(chord[1], near);
        match self.events.iter_mut().find(|(_, [a, b])| alike([*a, *b]) || alike([*b, *a])) {
            // Each may meet its edge elsewhere on the common line.
            Some((known, _)) => (known.line, known.away) = (None, known.away.min(event.away)),
            None => self.events.push((event, chord)),
        }
    }
}

/// A ball around the corners of a cell.
fn ball_of(cell: &[DVec3]) -> (DVec3, f64) {
    let middle = cell.iter().sum::<DVec3>() / cell.len() as f64;
    (middle, cell.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max).sqrt())
}

/// Whether some point of a cell may see one occluder before another one, by the balls around them.
fn may_overlap(cell: &[DVec3], one: &Occluder, other: &Occluder) -> bool {
    let (middle, radius) = ball_of(cell);
    let [to_one, to_other] = [one, other].map(|occluder| occluder.middle - middle);
    let sine = |occluder: &Occluder, way: DVec3| (occluder.radius + radius) / way.length();
    let [wide, wide_too] = [sine(one, to_one), sine(other, to_other)];
    wide >= 1.0 || wide_too >= 1.0 || to_one.angle_between(to_other) <= wide.asin() + wide_too.asin()
}

/// The edges of an occluder that may be part of its silhouette from some point of a cell, and their ends.
struct Silhouette {
    edges: Vec<[DVec3; 2]>,
    vertices: Vec<DVec3>,
}

impl Silhouette {
    /// Those with a face that some of the cell may see and one that some may not.
    fn from_some(occluder: &Occluder, cell: &[DVec3]) -> Self {
        let mut sides = Vec::with_capacity(occluder.faces.len());
        occluder.sides(cell, &mut sides);
        let of = |side: usize| sides.get(side).copied().unwrap_or([false, true]);
        let may_turn = |ridge: &&Ridge| {
            let [[left, not_left], [right, not_right]] = ridge.sides.map(of);
            (left && not_right) || (right && not_left)
        };
        let edges: Vec<[DVec3; 2]> =
            occluder.ridges.iter().filter(may_turn).map(|ridge| ridge.ends).collect();
        let mut vertices: Vec<DVec3> = Vec::new();
        for vertex in edges.iter().flatten() {
            if !vertices.contains(vertex) {
                vertices.push(*vertex);
            }
        }
        Self { edges, vertices }
    }
}

/// A patch cut along events, and for each part what the cuts that were not made may change its integral by, at most `least` each;
/// `None` when there are too many parts.
///
/// Where the integrand has a kink its sides go on in two ways. At a distance w from it they differ by no more than w / a, a how
/// far what moves there is away: a straight edge's apparent length is pi at most, each of its points moves by w / a, and
/// factors weigh directions by cos / pi. They never differ by more than the largest factor, `most`.
pub(super) fn cut(patch: Patch, events: &[Event], most: f64, least: f64) -> Option<Vec<(Patch, f64)>> {
    let mut parts = vec![(patch, 0.0)];
    for event in events {
        for i in 0..parts.len() {
            let (part, left_out) = &parts[i];
            let Some(chord) = event.chord(part).filter(|chord| event.is_met(*chord)) else { continue };
            let [left, right] = part.split(|p| event.height(p));
            let small = left.area().min(right.area());
            let width = 2.0 * small / chord[0].distance(chord[1]);
            let change = small * if width < most * event.away { width / event.away } else { most };
            if part.count == MOST_CORNERS || change <= least {
                parts[i].1 = left_out + change;
            } else {
                let left_out = *left_out;
                parts[i] = (left, left_out);
                parts.push((right, left_out));
            }
        }
        if parts.len() > MOST_CUTS {
            return None;
        }
    }
    Some(parts)
}

/// Whether edges run in three directions or more, with three convex shapes at least to have them.
///
/// What is seen begins as a point where a vertex meets an edge, or where edges of three shapes meet, or all along edges in one plane,
/// where vertices meet edges too.
pub(super) fn are_skew(to: &Surface, occluders: &[Near]) -> bool {
    let mut known: Vec<(DVec3, f64)> = Vec::new();
    let of_occluders = occluders.iter().flat_map(|o| o.ridges.iter().map(|ridge| ridge.ends));
    for [a, b] in of_occluders.chain(to.edges.iter().copied()) {
        let (way, length) = ((b - a).normalize_or_zero(), a.distance(b));
        // Roundings turn short edges far from the origin.
        let turn = PARALLEL + rounding_of([a, b]) / length;
        if known.iter().all(|(other, more)| other.cross(way).length() > turn + more) {
            known.push((way, turn));
        }
    }
    occluders.len() > 1 && known.len() > 2
}

/// Edges count as parallel up to this sine of their angle.
const PARALLEL: f64 = 5e-10;
