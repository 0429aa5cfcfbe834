//! Closed surfaces, and the closed loops in which planes cut them.
use super::weld::key;
use crate::extent::{BoxTree, Extent};
use crate::plane::{Plane, bits};
use crate::scene::patch::Patch;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// A closed surface of triangles that are turned out, so that a plane cuts each in one segment at most.
#[derive(Debug)]
pub(super) struct ClosedSurface {
    /// The number of the body of which it is the surface.
    pub(super) body: usize,
    triangles: Vec<[DVec3; 3]>,
    pub(super) boxes: BoxTree,
    pub(super) extent: Extent,
}

impl ClosedSurface {
    pub(super) fn new(body: usize, triangles: Vec<[DVec3; 3]>) -> ClosedSurface {
        ClosedSurface {
            body,
            boxes: BoxTree::new(triangles.iter().map(Extent::holding)),
            extent: Extent::holding(triangles.iter().flatten()),
            triangles,
        }
    }

    /// Its outlines in a plane, at a small height before the plane or behind it: what is nearer to the plane is on the other side of it.
    pub(super) fn section(&self, plane: &Plane, height: f64) -> Vec<Vec<DVec2>> {
        let mut segments: BTreeMap<[u64; 2], Vec<DVec2>> = BTreeMap::new();
        for index in self.boxes.crossed_by(plane, height.abs()) {
            if let Some([start, end]) = self.segment(index, plane, height) {
                segments.entry(bits(start)).or_default().push(end);
            }
        }
        rings(segments).into_iter().map(|ring| straight(ring, height.abs())).collect()
    }

    /// Whether it comes through a patch of its own from the front, and not along the patch's edges alone.
    pub(super) fn reaches_before(&self, patch: &Patch, plane: &Plane, near: f64) -> bool {
        let region = plane.region(&patch.polygon);
        let is_on_edge =
            |point: &DVec2, [a, b]: [DVec2; 2]| (b - a).perp_dot(*point - a).abs() <= near * a.distance(b);
        let is_along = |segment: [DVec2; 2]| {
            let edges = region.rings().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
            edges.map(|(a, b)| [*a, *b]).any(|edge| segment.iter().all(|point| is_on_edge(point, edge)))
        };
        let near_by = self.boxes.meeting(&Extent::of(patch).grown(near)).into_iter();
        near_by.filter_map(|index| self.segment(index, plane, near)).any(|segment| !is_along(segment))
    }

    /// Where a triangle passes through a plane, at a small height.
    fn segment(&self, index: usize, plane: &Plane, height: f64) -> Option<[DVec2; 2]> {
        let [a, b, c] = self.triangles[index];
        let (mut start, mut end) = (None, None);
        for [from, to] in [[a, b], [b, c], [c, a]] {
            match [from, to].map(|point| plane.height(point) > height) {
                [true, false] => start = Some(crossing(plane, [from, to])),
                [false, true] => end = Some(crossing(plane, [from, to])),
                _ => {}
            }
        }
        Some([start?, end?])
    }
}

/// Where an edge passes through the plane, or its end that is nearest to it, in the plane: the same for both directions of the edge.
fn crossing(plane: &Plane, ends: [DVec3; 2]) -> DVec2 {
    let [a, b] = if key(ends[0]) < key(ends[1]) { ends } else { [ends[1], ends[0]] };
    let [above, below] = [a, b].map(|point| plane.height(point));
    let share = (above / (above - below)).clamp(0.0, 1.0);
    plane.flatten(a + share * (b - a))
}

/// The closed walks over segments, each of which is used once.
fn rings(mut segments: BTreeMap<[u64; 2], Vec<DVec2>>) -> Vec<Vec<DVec2>> {
    let mut rings = Vec::new();
    while let Some((start, mut ends)) = segments.pop_first() {
        let mut ring = Vec::new();
        let mut next = ends.pop();
        if !ends.is_empty() {
            segments.insert(start, ends);
        }
        while let Some(point) = next {
            ring.push(point);
            let Some(ends) = segments.get_mut(&bits(point)) else { break };
            next = ends.pop();
            if ends.is_empty() {
                segments.remove(&bits(point));
            }
        }
        rings.push(ring);
    }
    rings
}

/// A ring without the points within its sides, where edges of triangles pass through the plane. Of two that rounding keeps apart one stays: so
/// each is held against the points that are left beside it.
fn straight(mut ring: Vec<DVec2>, near: f64) -> Vec<DVec2> {
    let mut at = 0;
    while at < ring.len() && ring.len() > 2 {
        let count = ring.len();
        let [before, point, after] = [at, at + 1, at + 2].map(|index| ring[index % count]);
        let (side, arm) = (after - before, point - before);
        if side.perp_dot(arm).abs() <= near * side.length() && arm.dot(side - arm) > 0.0 {
            ring.remove((at + 1) % count);
        } else {
            at += 1;
        }
    }
    ring
}
