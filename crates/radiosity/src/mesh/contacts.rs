//! Where other patches touch a patch: lines across which its light jumps.
use crate::extent::Extent;
use crate::scene::Scene;
use glam::DVec3;

/// Pieces of other patches' edges that lie on the plane of patch `patch`, each once, sorted.
///
/// Near enough is nearer than a thousandth of the mesh's finest spacing: a line too many costs a few elements, and one too
/// few only a blurred shadow at the foot of what stands there.
pub(crate) fn contacts(scene: &Scene, extents: &[Extent], patch: usize, spacing: f64) -> Vec<[DVec3; 2]> {
    let polygon = &scene.patches[patch].polygon;
    let Some(&origin) = polygon.loops().flatten().next() else { return Vec::new() };
    let near = |place: DVec3| (place - origin).dot(polygon.normal()).abs() < spacing * 1e-3;
    let others = scene
        .patches
        .iter()
        .enumerate()
        .filter(|(index, _)| *index != patch && extents[*index].is_near(&extents[patch], spacing * 1e-3));
    let mut lines: Vec<_> = others
        .flat_map(|(_, other)| other.polygon.loops())
        .flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)))
        .filter(|(start, end)| near(**start) && near(**end))
        .map(|(start, end)| if start.to_array() < end.to_array() { [*start, *end] } else { [*end, *start] })
        .collect();
    lines.sort_by(|a, b| {
        a.map(|p| p.to_array()).partial_cmp(&b.map(|p| p.to_array())).unwrap_or(std::cmp::Ordering::Equal)
    });
    lines.dedup();
    lines
}
