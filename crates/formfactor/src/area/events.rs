//! Where on a cell the view of the target changes its shape: planes along which a form factor from a point has kinks.
//!
//! There a vertex of the target lies behind an edge of an occluder's silhouette, or an edge of the target behind a vertex of one,
//! or a vertex of one occluder behind or before an edge of another; or an occluder's face that the target reaches across is
//! seen edge-on. Kinks that three edges make together are curved, and weaker: they are left to the cubature.
use crate::scene::occluder::Occluder;
use glam::DVec3;

/// More candidates than this are not looked at: halving cells does better.
const MOST: usize = 1 << 14;

/// A plane through a vertex and an edge, or one of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Event {
    on: DVec3,
    normal: DVec3,
    /// The vertex and the edge.
    line: Option<(DVec3, [DVec3; 2])>,
}

impl Event {
    fn through(vertex: DVec3, [a, b]: [DVec3; 2]) -> Self {
        Self { on: vertex, normal: (a - vertex).cross(b - vertex), line: Some((vertex, [a, b])) }
    }

    pub(super) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.on)
    }

    /// Whether it passes through a convex polygon, and there the vertex is seen to meet the edge.
    pub(super) fn passes(&self, polygon: &[DVec3]) -> bool {
        let Some(chord) = self.chord(polygon) else { return false };
        let Some((vertex, [a, b])) = self.line else { return true };
        // Where on the edge's line the vertex is seen, as quotients.
        let [first, last] = chord.map(|from| {
            let way = vertex - from;
            let across = |v: DVec3| v.cross(way).dot(self.normal);
            [-across(a - from), across(b - a)]
        });
        let is_out = |[part, whole]: [f64; 2]| {
            let (part, whole) = if whole < 0.0 { (-part, -whole) } else { (part, whole) };
            (part < 0.0, part > whole)
        };
        let ((before, after), (before_too, after_too)) = (is_out(first), is_out(last));
        first[1].signum() != last[1].signum() || !((before && before_too) || (after && after_too))
    }

    /// The ends of its line through a convex polygon.
    fn chord(&self, polygon: &[DVec3]) -> Option<[DVec3; 2]> {
        let mut ends = [None; 2];
        let mut a = *polygon.last()?;
        let mut there = self.height(a);
        for &b in polygon {
            let here = self.height(b);
            if (there < 0.0 && here >= 0.0) || (there >= 0.0 && here < 0.0) {
                ends[usize::from(here < 0.0)] = Some(a + (b - a) * (there / (there - here)));
            }
            (a, there) = (b, here);
        }
        Some([ends[0]?, ends[1]?])
    }
}

/// The events on a cell, and whether they are all.
pub(super) fn events(cell: &[DVec3], pieces: &[Vec<DVec3>], occluders: &[Occluder]) -> (Vec<Event>, bool) {
    let seen: Vec<Silhouette> = occluders.iter().map(|occluder| Silhouette::from_any(occluder, cell)).collect();
    let mut found = Vec::new();
    let mut add = |event: Event| {
        if event.passes(cell) {
            found.push(event);
        }
    };
    for (occluder, silhouette) in occluders.iter().zip(&seen) {
        for piece in pieces {
            let edges = piece.iter().zip(piece.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
            edges.for_each(|edge| silhouette.vertices.iter().for_each(|v| add(Event::through(*v, edge))));
            piece.iter().for_each(|v| silhouette.edges.iter().for_each(|edge| add(Event::through(*v, *edge))));
            if !occluder.is_plate {
                let faces = occluder.faces.iter().map(|[on, normal]| Event { on: *on, normal: *normal, line: None });
                faces.filter(|face| face.chord(piece).is_some()).for_each(&mut add);
            }
        }
    }
    let vertices: usize = seen.iter().map(|silhouette| silhouette.vertices.len()).sum();
    let are_all = vertices * vertices <= MOST;
    if are_all {
        for (i, one) in seen.iter().enumerate() {
            for other in &seen[..i] {
                for (corners, edges) in [(&one.vertices, &other.edges), (&other.vertices, &one.edges)] {
                    corners.iter().for_each(|v| edges.iter().for_each(|edge| add(Event::through(*v, *edge))));
                }
            }
        }
    }
    (found, are_all)
}

/// The edges of an occluder that are part of its silhouette from some corner of a cell, and their ends.
struct Silhouette {
    edges: Vec<[DVec3; 2]>,
    vertices: Vec<DVec3>,
}

impl Silhouette {
    fn from_any(occluder: &Occluder, cell: &[DVec3]) -> Self {
        let mut facing = Vec::new();
        let (mut edges, mut vertices): (Vec<[DVec3; 2]>, Vec<DVec3>) = (Vec::new(), Vec::new());
        for corner in cell {
            occluder.facing(*corner, &mut facing);
            for [a, b] in occluder.silhouette(&facing) {
                if !edges.iter().any(|edge| *edge == [a, b] || *edge == [b, a]) {
                    edges.push([a, b]);
                }
            }
        }
        for vertex in edges.iter().flatten() {
            if !vertices.contains(vertex) {
                vertices.push(*vertex);
            }
        }
        Self { edges, vertices }
    }
}

/// A convex polygon cut along events where they pass through it and cut off pieces that are `worth` it, each by its share of
/// the polygon's area.
pub(super) fn cut(polygon: Vec<DVec3>, events: &[Event], most: usize, worth: impl Fn(f64) -> bool) -> Option<Vec<Vec<DVec3>>> {
    let mut pieces = vec![polygon];
    for event in events {
        let mut next = Vec::with_capacity(pieces.len() + 1);
        for piece in pieces {
            match event.passes(&piece).then(|| split(&piece, event)) {
                Some([left, right]) if worth(size(&left)) && worth(size(&right)) => next.extend([left, right]),
                _ => next.push(piece),
            }
        }
        pieces = next;
        if pieces.len() > most {
            return None;
        }
    }
    Some(pieces)
}

fn size(polygon: &[DVec3]) -> f64 {
    if polygon.len() < 3 { 0.0 } else { crate::scene::surfaces::area(polygon) }
}

fn split(polygon: &[DVec3], event: &Event) -> [Vec<DVec3>; 2] {
    let mut parts = [Vec::with_capacity(polygon.len() + 1), Vec::with_capacity(polygon.len() + 1)];
    let Some(mut a) = polygon.last().copied() else { return parts };
    let mut there = event.height(a);
    for &b in polygon {
        let here = event.height(b);
        if (there < 0.0 && here > 0.0) || (there > 0.0 && here < 0.0) {
            let at = a + (b - a) * (there / (there - here));
            parts.iter_mut().for_each(|part| part.push(at));
        }
        if here >= 0.0 {
            parts[0].push(b);
        }
        if here <= 0.0 {
            parts[1].push(b);
        }
        (a, there) = (b, here);
    }
    parts
}
