//! What a ray from a point meets.
use crate::extent::{BoxTree, Extent};
use crate::plane::Plane;
use crate::predicates::ray_crosses;
use crate::scene::{Scene, patch::Patch};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// The patches of a scene in a tree.
#[derive(Debug)]
pub(super) struct SightLines<'s> {
    scene: &'s Scene,
    boxes: BoxTree,
    extent: Extent,
}

impl<'s> SightLines<'s> {
    pub(super) fn of(scene: &'s Scene) -> SightLines<'s> {
        let [low, high] = scene.extent();
        let boxes = BoxTree::new(scene.patches.iter().map(Extent::of));
        SightLines { scene, boxes, extent: Extent { low, high } }
    }

    /// The bodies that wind around a point: a ray along x leaves them more often than it enters them, or the other way round.
    /// Edges and vertices on the ray count for one of the faces that share them.
    pub(super) fn around(&self, place: DVec3, of_patch: &[usize]) -> Vec<usize> {
        let ray = Extent { low: place, high: place.with_x(self.extent.high.x.max(place.x)) };
        let mut turns: BTreeMap<usize, i32> = BTreeMap::new();
        for index in self.boxes.meeting(&ray) {
            let patch = &self.scene.patches[index];
            let flat = |point: DVec3| DVec2::new(point.y, point.z);
            if !patch.is_back && holds(patch, flat(place), flat) && lies_beyond(patch, place) {
                *turns.entry(of_patch[index]).or_default() +=
                    if patch.polygon.normal().x > 0.0 { 1 } else { -1 };
            }
        }
        turns.into_iter().filter(|(_, turns)| *turns != 0).map(|(body, _)| body).collect()
    }

    /// Whether nothing but the given patches crosses the way from one point to another.
    pub(super) fn is_free(&self, [start, end]: [DVec3; 2], but: [usize; 2]) -> bool {
        let crosses = |index: &usize| {
            let patch = &self.scene.patches[*index];
            let plane = Plane::of(&patch.polygon);
            let heights = [start, end].map(|point| plane.height(point));
            let share = heights[0] / (heights[0] - heights[1]);
            let place = start + share * (end - start);
            (0.0..=1.0).contains(&share) && holds(patch, plane.flatten(place), |point| plane.flatten(point))
        };
        let near = self.boxes.meeting(&Extent::holding(&[start, end]));
        !near.iter().filter(|index| !but.contains(index)).any(crosses)
    }
}

/// Whether a patch, as seen flat, holds a point.
fn holds(patch: &Patch, place: DVec2, flat: impl Fn(DVec3) -> DVec2) -> bool {
    let edges = patch.polygon.loops().flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)));
    edges.filter(|(a, b)| ray_crosses(place, [flat(**a), flat(**b)])).count() % 2 == 1
}

/// Whether the plane of a patch is met further along x.
fn lies_beyond(patch: &Patch, place: DVec3) -> bool {
    let plane = Plane::of(&patch.polygon);
    plane.height(place) * plane.normal.x < 0.0
}
