//! The plane of a polygon: its normal, three vertices that span it, and how far off the others are.
use crate::error::Error;
use crate::numeric::rounding::{ROUNDING, SMALLEST};
use crate::numeric::{offset::Offset, predicates::Plane};
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::cmp::Ordering;

/// How many roundings of its largest coordinate a polygon's vertex may lie off the polygon's plane.
pub(super) const PLANARITY: f64 = 64.0;
/// And the vertex of a part: it stands between vertices that may lie so far off, and was rounded by whoever put it there.
pub(super) const OF_PARTS: f64 = 4.0 * PLANARITY;

/// The unit normal of a loop by Newell's sum, in double-double arithmetic.
pub(super) fn newell(outer: &[DVec3]) -> Result<DVec3, Error> {
    let spokes = outer[1..].windows(2);
    let sum = spokes.fold(Offset([DoubleDouble::ZERO; 3]), |sum, pair| {
        let (part, _) = Offset::between(outer[0], pair[0]).cross(Offset::between(outer[0], pair[1]));
        Offset([0, 1, 2].map(|i| sum.0[i] + part.0[i]))
    });
    let sum = sum.round();
    let largest = sum.abs().max_element();
    if largest < SMALLEST * SMALLEST {
        // Products of extents below 2^-200 may underflow: only integers tell whether there is an area.
        let is_near = outer.iter().all(|p| (*p - outer[0]).abs().max_element() < SMALLEST);
        let spans = |pair: &[DVec3]| Plane::through([outer[0], pair[0], pair[1]]).is_some();
        let has_area = largest > 0.0 || is_near && outer[1..].windows(2).any(spans);
        return Err(if has_area { Error::TooSmall } else { Error::ZeroArea });
    }
    Ok((sum / largest).normalize())
}

/// The plane through three vertices that lie far apart, its normal on the side of `normal`.
pub(super) fn plane_of(outer: &[DVec3], normal: DVec3) -> Result<Plane, Error> {
    let a = outer[0];
    let b = farthest(outer, |p| (p - a).length_squared());
    let c = farthest(outer, |p| (b - a).cross(p - a).length_squared());
    let corners = if outer.len() == 3 { [a, outer[1], outer[2]] } else { [a, b, c] };
    let plane = Plane::through(corners).ok_or(Error::ZeroArea)?;
    if plane.normal.round().dot(normal) > 0.0 {
        return Ok(plane);
    }
    Plane::through([corners[0], corners[2], corners[1]]).ok_or(Error::ZeroArea)
}

fn farthest(points: &[DVec3], distance: impl Fn(DVec3) -> f64) -> DVec3 {
    points.iter().copied().fold(points[0], |best, p| if distance(p) > distance(best) { p } else { best })
}

/// Drops the axis along which the normal is longest.
pub(super) fn kept_axes(normal: DVec3) -> [usize; 3] {
    let size = normal.abs();
    let dropped = if size.z >= size.x && size.z >= size.y {
        2
    } else if size.y >= size.x {
        1
    } else {
        0
    };
    let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
    if normal[dropped] > 0.0 { [u, v, dropped] } else { [v, u, dropped] }
}

/// A bound on the way from a vertex moved along the Newell normal to the same vertex moved along the dropped axis onto
/// the plane of the three corners; zero when all vertices lie on that plane exactly.
pub(super) fn deviation(
    points: &[DVec3],
    ends: &[usize],
    plane: &Plane,
    normal: DVec3,
    planarity: f64,
) -> Result<f64, Error> {
    if points.iter().all(|p| plane.side(*p).sign == Ordering::Equal) {
        return Ok(0.0);
    }
    // A small part near the origin was rounded where its whole is.
    let all = points.iter().chain(&plane.corners);
    let allowed = planarity * ROUNDING * all.map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let length = plane.normal.round().length();
    let mut worst = 0.0_f64;
    for (index, point) in points.iter().enumerate() {
        let off = [plane.side(*point).value.hi.abs() / length, (*point - points[0]).dot(normal).abs()];
        let distance = off[0].max(off[1]);
        if distance > allowed {
            let loop_index = ends.partition_point(|end| *end <= index);
            let start = if loop_index == 0 { 0 } else { ends[loop_index - 1] };
            return Err(Error::NotPlanar { loop_index, vertex: index - start, distance, allowed });
        }
        worst = worst.max(off[0] + off[1]);
    }
    // The dropped axis meets the plane at no more than acos(1/sqrt 3): moving along it is at most sqrt 3 times as far.
    Ok(3.0 * worst)
}
