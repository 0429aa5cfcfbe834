//! Polygons of one plane as convex occluders.
use super::occluder::Occluder;
use crate::numeric::rounding::rounding_of;
use crate::shapes::loops::{is_convex, leaf};
use crate::shapes::pieces::{pieces, trapezoids};
use crate::shapes::polygon::PlanarPolygon;
use glam::{DVec2, DVec3};

/// Points that lie behind a plane by no more than this of their distance, and roundings, count as on it.
const SLIGHT: f64 = 1e-13;

/// Whether no point is behind a polygon's plane, or none before it: then the polygon hides nothing from anything, as a
/// segment between such points meets its plane at an end.
pub(super) fn supports(polygon: &PlanarPolygon, points: &[DVec3]) -> bool {
    let (on, normal) = (polygon.points()[0], polygon.normal());
    let mut sides = [false; 2];
    // In strides, so that points far from each other come soon.
    let stride = (1..).map(|i| i * 2 + 1).find(|stride| stride * stride > points.len()).unwrap_or(1);
    for point in (0..stride).flat_map(|start| points.iter().skip(start).step_by(stride)) {
        let (way, height) = (*point - on, normal.dot(*point - on));
        if height.abs() > SLIGHT * way.length() + rounding_of([on, *point]) {
            sides[usize::from(height > 0.0)] = true;
        }
        if sides == [true; 2] {
            return false;
        }
    }
    true
}

/// Polygons of one plane as convex plates: their union where that takes fewer, else their own pieces.
pub(super) fn plates(polygons: &[PlanarPolygon], ids: &[usize]) -> Vec<Occluder> {
    let areas = ids.iter().map(|id| polygons[*id].area());
    let largest = ids.iter().zip(areas).max_by(|a, b| a.1.total_cmp(&b.1));
    let plane = &polygons[largest.map_or(ids[0], |(id, _)| *id)];
    let own: Vec<Vec<DVec3>> = ids.iter().flat_map(|id| pieces(&polygons[*id])).collect();
    let united = if own.len() > 1 { united(plane, polygons, ids) } else { None };
    let corners = united.filter(|united| united.len() < own.len()).unwrap_or(own);
    let deviation = ids.iter().map(|id| polygons[*id].deviation()).fold(0.0, f64::max);
    // Those of polygons that face the other way run clockwise.
    let plate = |corners: &Vec<DVec3>| {
        let spokes = corners[1..].windows(2);
        let normal: DVec3 = spokes.map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0])).sum();
        let upward = if normal.dot(plane.normal()) < 0.0 { -plane.normal() } else { plane.normal() };
        Occluder::plate(corners, upward, deviation)
    };
    corners.iter().map(plate).collect()
}

/// The union of polygons in the plane of one of them, in convex pieces.
fn united(plane: &PlanarPolygon, polygons: &[PlanarPolygon], ids: &[usize]) -> Option<Vec<Vec<DVec3>>> {
    let flat = |id: &usize| -> Vec<Vec<DVec2>> {
        polygons[*id].loops().map(|l| l.iter().map(|p| plane.flat(*p)).collect()).collect()
    };
    let loops: Vec<Vec<Vec<DVec2>>> = ids.iter().map(flat).collect();
    let union = loops.iter().map(|l| leaf(l)).reduce(|all, next| all | next)?;
    let region = union.evaluate().without_collinear_vertices();
    let mut found = Vec::new();
    for polygon in region.polygons() {
        let outer = polygon.outer();
        if polygon.holes().next().is_none() && is_convex(outer) {
            found.push(outer.iter().map(|p| plane.raise(*p)).collect());
        } else {
            let rings: Vec<Vec<DVec2>> =
                std::iter::once(outer).chain(polygon.holes()).map(<[_]>::to_vec).collect();
            let parts = trapezoids(&leaf(&rings).evaluate());
            found.extend(parts.iter().map(|part| part.iter().map(|p| plane.raise(*p)).collect::<Vec<_>>()));
        }
    }
    Some(found)
}
