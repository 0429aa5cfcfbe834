//! Faces with holes, as a table's underside has where its legs stand.
use super::loops::is_convex;
use super::polygon::PlanarPolygon;
use crate::numeric::rounding::rounding_of;
use glam::DVec3;

/// Each point of a polygon's first loop with the next.
pub(crate) fn outline(polygon: &PlanarPolygon) -> impl Iterator<Item = (DVec3, DVec3)> {
    let corners = polygon.loops().next().unwrap_or_default();
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied()).filter(|(a, b)| a != b)
}

/// The holes of a polygon with a convex outline, facing as it does, if they are convex and but for roundings within the outline.
pub(crate) fn holes(polygon: &PlanarPolygon) -> Option<Vec<PlanarPolygon>> {
    if polygon.is_convex() {
        return Some(Vec::new());
    }
    let (normal, corners) = (polygon.normal(), polygon.points());
    let rounding = rounding_of(corners.iter().copied()) + polygon.deviation();
    let is_inside = |p: &DVec3| {
        outline(polygon).all(|(a, b)| normal.cross(b - a).dot(*p - a) >= -rounding * a.distance(b))
    };
    let is_within = polygon.loops().count() > 1
        && polygon.flat_loops().first().is_some_and(|outline| is_convex(outline))
        && corners.iter().all(is_inside);
    let holes = polygon.loops().skip(1).map(|corners| hole(corners, normal));
    if is_within { holes.collect() } else { None }
}

fn hole(corners: &[DVec3], normal: DVec3) -> Option<PlanarPolygon> {
    let forward = PlanarPolygon::new([corners]).ok()?;
    let hole = if forward.normal().dot(normal) > 0.0 {
        forward
    } else {
        PlanarPolygon::new([corners.iter().rev().copied().collect::<Vec<_>>()]).ok()?
    };
    hole.is_convex().then_some(hole)
}
