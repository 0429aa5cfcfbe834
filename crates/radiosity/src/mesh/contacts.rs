//! Where other patches touch a patch or pass through it: lines across which its light jumps.
//!
//! ```text
//!   stands on the plane      passes through it
//!        +----+                   /
//!   -----+====+-----         ----x----     seen from the side, the planes of both edge on:
//!                               /          x is a piece of the line that the planes share
//! ```
use crate::extent::{BoxTree, Extent};
use crate::plane::Plane;
use crate::scene::Scene;
use formfactor::PlanarPolygon;
use glam::DVec3;

/// The patches of a scene, to be found by where they are.
#[derive(Debug)]
pub(crate) struct Neighbourhood<'s> {
    scene: &'s Scene,
    extents: Vec<Extent>,
    boxes: BoxTree,
}

impl<'s> Neighbourhood<'s> {
    /// O(n log n).
    pub(crate) fn of(scene: &'s Scene) -> Neighbourhood<'s> {
        let extents: Vec<Extent> = scene.patches.iter().map(Extent::of).collect();
        Neighbourhood { scene, boxes: BoxTree::new(extents.iter().copied()), extents }
    }

    /// Pieces of other patches' edges that lie on the plane of patch `patch`, and where other patches pass through it, each once, sorted.
    /// O(log n) for each patch that is near.
    ///
    /// Near enough is nearer than a thousandth of the mesh's finest spacing: a line too many costs a few elements, and one too
    /// few only a blurred shadow at the foot of what stands there.
    pub(crate) fn contacts(&self, patch: usize, spacing: f64) -> Vec<[DVec3; 2]> {
        let (polygon, reach) = (&self.scene.patches[patch].polygon, spacing * 1e-3);
        let plane = Plane::of(polygon);
        // Twice as far, so that no rounding leaves one out.
        let around = self.boxes.meeting(&self.extents[patch].grown(2.0 * reach)).into_iter();
        let mut lines: Vec<_> = around
            .filter(|&other| other != patch && self.extents[other].is_near(&self.extents[patch], reach))
            .map(|other| &self.scene.patches[other].polygon)
            .flat_map(|other| touching(&plane, other, reach).chain(crossing((polygon, &plane), other, reach)))
            .map(|[start, end]| if start.to_array() < end.to_array() { [start, end] } else { [end, start] })
            .collect();
        lines.sort_by(|a, b| {
            a.map(|p| p.to_array()).partial_cmp(&b.map(|p| p.to_array())).unwrap_or(std::cmp::Ordering::Equal)
        });
        lines.dedup();
        lines
    }
}

/// The edges of a polygon that lie on a plane.
fn touching(plane: &Plane, polygon: &PlanarPolygon, reach: f64) -> impl Iterator<Item = [DVec3; 2]> {
    edges(polygon).filter(move |ends| ends.iter().all(|end| plane.height(*end).abs() < reach))
}

/// Where two polygons pass through each other: pieces of the line that their planes share. What is no farther than near beyond the other's
/// plane does not pass through it, it touches it.
fn crossing(
    (polygon, own_plane): (&PlanarPolygon, &Plane),
    other: &PlanarPolygon,
    reach: f64,
) -> Vec<[DVec3; 2]> {
    let other_plane = Plane::of(other);
    if !is_on_both_sides(other, own_plane, reach) || !is_on_both_sides(polygon, &other_plane, reach) {
        return Vec::new();
    }
    let along = own_plane.normal.cross(other_plane.normal);
    let (own, others) = (passages(polygon, &other_plane, along), passages(other, own_plane, along));
    let shared = |(own, other): (&[DVec3], &[DVec3])| {
        let later = |a: DVec3, b: DVec3| if a.dot(along) > b.dot(along) { a } else { b };
        let earlier = |a: DVec3, b: DVec3| if a.dot(along) < b.dot(along) { a } else { b };
        let (from, to) = (later(own[0], other[0]), earlier(own[1], other[1]));
        (from.dot(along) < to.dot(along)).then_some([from, to])
    };
    let pairs = own.chunks_exact(2).flat_map(|own| others.chunks_exact(2).map(move |other| (own, other)));
    pairs.filter_map(shared).collect()
}

/// Whether a polygon has vertices farther than `reach` from a plane on both sides.
fn is_on_both_sides(polygon: &PlanarPolygon, plane: &Plane, reach: f64) -> bool {
    let heights = || polygon.loops().flatten().map(|&vertex| plane.height(vertex));
    heights().any(|height| height > reach) && heights().any(|height| height < -reach)
}

/// Where the edges of a polygon pass through a plane, in the order along the plane's line: inside of the polygon from the first to the second,
/// from the third to the fourth, and so on.
fn passages(polygon: &PlanarPolygon, plane: &Plane, along: DVec3) -> Vec<DVec3> {
    let passage = |[start, end]: [DVec3; 2]| {
        let (from, to) = (plane.height(start), plane.height(end));
        ((from >= 0.0) != (to >= 0.0)).then(|| start.lerp(end, from / (from - to)))
    };
    let mut passages: Vec<DVec3> = edges(polygon).filter_map(passage).collect();
    passages.sort_by(|a, b| a.dot(along).total_cmp(&b.dot(along)));
    passages
}

/// The edges of all loops.
fn edges(polygon: &PlanarPolygon) -> impl Iterator<Item = [DVec3; 2]> {
    polygon.loops().flat_map(|points| {
        points.iter().zip(points.iter().cycle().skip(1)).map(|(start, end)| [*start, *end])
    })
}
