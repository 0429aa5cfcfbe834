//! RayTarget after target, part after part: what the methods by parts share.
use super::contour::{above, contour};
use super::disk::disk;
use super::parts::{Division, Tile, divide};
use super::ray::{RayTarget, items};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;
use glam::DVec3;

/// A row by a method that takes one target after the other; 0 for those that cannot be seen.
pub(super) fn row_of_targets(
    enclosure: &Enclosure,
    from: &DifferentialArea,
    targets: &[usize],
    factor: impl Fn(&RayTarget) -> f64,
) -> Vec<f64> {
    let items = items(enclosure, from);
    let target = |id: &usize| RayTarget::new(enclosure, &items, from.position(), *id);
    targets.iter().map(|id| target(id).map_or(0.0, |target| factor(&target))).collect()
}

/// The sum over the parts whose centres a ray reaches.
pub(super) fn by_parts(
    from: &DifferentialArea,
    target: &RayTarget,
    division: Division,
    factor: impl Fn(&Tile) -> f64,
) -> f64 {
    let parts = divide(target.item.polygon, from.position(), division);
    let reached = |part: &&Tile| aim(from, part).is_some_and(|point| target.is_reached(point));
    parts.iter().filter(reached).map(factor).fold(0.0, |sum, part| sum + part)
}

/// The point of a part to which a ray goes: its centre relative to dA, or the middle of what is above the horizon.
pub(super) fn aim(from: &DifferentialArea, part: &Tile) -> Option<DVec3> {
    let centre = part.centre() - from.position();
    if from.normal().dot(centre) > 0.0 {
        return Some(centre);
    }
    let corners: Vec<DVec3> = part.corners().iter().map(|p| *p - from.position()).collect();
    let above = above(from.normal(), &corners);
    let count = u32::try_from(above.len()).ok().filter(|count| *count > 2)?;
    Some(above.into_iter().sum::<DVec3>() / f64::from(count))
}

/// A part as a disk.
pub(super) fn as_disk(from: &DifferentialArea, target: &RayTarget, part: &Tile) -> f64 {
    disk(from.normal(), part.centre() - from.position(), target.item.polygon.normal(), part.area())
}

/// A part by the contour sum (2.4).
pub(super) fn as_contour(from: &DifferentialArea, part: &Tile) -> f64 {
    let corners: Vec<DVec3> = part.corners().iter().map(|p| *p - from.position()).collect();
    contour(from.normal(), &corners)
}
