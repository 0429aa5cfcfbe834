//! Where other patches touch a patch: lines across which its light jumps.
use crate::extent::{BoxTree, Extent};
use crate::scene::Scene;
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

    /// Pieces of other patches' edges that lie on the plane of patch `patch`, each once, sorted. O(log n) for each patch that is near.
    ///
    /// Near enough is nearer than a thousandth of the mesh's finest spacing: a line too many costs a few elements, and one too
    /// few only a blurred shadow at the foot of what stands there.
    pub(crate) fn contacts(&self, patch: usize, spacing: f64) -> Vec<[DVec3; 2]> {
        let polygon = &self.scene.patches[patch].polygon;
        let Some(&origin) = polygon.loops().flatten().next() else { return Vec::new() };
        let reach = spacing * 1e-3;
        let near = |place: DVec3| (place - origin).dot(polygon.normal()).abs() < reach;
        // Twice as far, so that no rounding leaves one out.
        let around = self.boxes.meeting(&self.extents[patch].grown(2.0 * reach)).into_iter();
        let others = around
            .filter(|&other| other != patch && self.extents[other].is_near(&self.extents[patch], reach));
        let mut lines: Vec<_> = others
            .flat_map(|other| self.scene.patches[other].polygon.loops())
            .flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)))
            .filter(|(start, end)| near(**start) && near(**end))
            .map(
                |(start, end)| {
                    if start.to_array() < end.to_array() { [*start, *end] } else { [*end, *start] }
                },
            )
            .collect();
        lines.sort_by(|a, b| {
            a.map(|p| p.to_array()).partial_cmp(&b.map(|p| p.to_array())).unwrap_or(std::cmp::Ordering::Equal)
        });
        lines.dedup();
        lines
    }
}
