//! Parts, split where rays disagree.
use super::gather::{aim, as_contour, as_disk, row_of_targets};
use super::parts::{Tile, pieces};
use super::{method::Method, ray::RayTarget};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// Does as [`Pietrek`](super::Pietrek) does, and quarters a part while its *visibility index*, the fraction of sample rays that
/// reach it, is neither 0 nor 1 [Wang; Lee & Chuang 2004].
///
/// The rays go to the middles of `samples` x `samples` congruent pieces of the part, those below the horizon left out.
/// At the limit of depth a part counts by its index. An occluder, or a corner that a shadow cuts off, is missed when it lies
/// between the rays to a part. More depth does not remove that error; more rays make it smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisibilityIndex {
    /// A part takes the contour sum when its diameter is more than this times its distance, and is a disk otherwise.
    pub near: f64,
    /// The side of the grid of sample rays to each part; 0 is taken as 1.
    pub samples: u32,
    /// How often a part may be quartered.
    pub depth: u32,
}

impl Method for VisibilityIndex {
    fn name(&self) -> String {
        let Self { near, samples, depth } = self;
        format!("visibility index, {samples} x {samples} rays, depth {depth}, near {near}")
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        row_of_targets(enclosure, from, targets, |target| self.factor(from, target))
    }
}

impl VisibilityIndex {
    fn factor(&self, from: &DifferentialArea, target: &RayTarget) -> f64 {
        let mut sum = 0.0;
        let mut open: Vec<(Tile, u32)> =
            pieces(target.item.polygon).into_iter().map(|piece| (piece, self.depth)).collect();
        while let Some((part, left)) = open.pop() {
            let index = self.index(from, target, &part);
            if index > 0.0 && index < 1.0 && left > 0 {
                open.extend(part.grid(2).into_iter().map(|quarter| (quarter, left - 1)));
            } else if index > 0.0 {
                sum += index * self.part(from, target, &part);
            }
        }
        sum
    }

    /// The fraction of the sample rays that reach a part; 0 when it is below the horizon.
    fn index(&self, from: &DifferentialArea, target: &RayTarget, part: &Tile) -> f64 {
        let (mut all, mut reached) = (0_u32, 0_u32);
        for point in part.grid(self.samples).iter().filter_map(|piece| aim(from, piece)) {
            all += 1;
            reached += u32::from(target.is_reached(point));
        }
        if all == 0 { 0.0 } else { f64::from(reached) / f64::from(all) }
    }

    fn part(&self, from: &DifferentialArea, target: &RayTarget, part: &Tile) -> f64 {
        if part.is_large(from.position(), self.near) {
            as_contour(from, part)
        } else {
            as_disk(from, target, part)
        }
    }
}
