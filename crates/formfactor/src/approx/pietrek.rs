//! Far parts as disks, near parts by the contour sum.
use super::gather::{as_contour, as_disk, by_parts, row_of_targets};
use super::{method::Method, parts::Division};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// Does as [`Wallace`](super::Wallace) does, but takes the contour sum (2.4) over the corners of parts that are too near for a
/// disk [Pietrek 1993].
///
/// It converges as 1/n, also for targets that touch dA. With `near` = 0 every part takes the sum, and only visibility is
/// approximate: one ray goes to the part's centre or, when that is below the horizon, to the middle of what is above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pietrek {
    /// How the target is divided.
    pub division: Division,
    /// A part is near when its diameter is more than this times its distance.
    pub near: f64,
}

impl Method for Pietrek {
    fn name(&self) -> String {
        format!("Pietrek, {}, near {}", self.division, self.near)
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        row_of_targets(enclosure, from, targets, |target| {
            by_parts(from, target, self.division, |part| {
                if part.is_large(from.position(), self.near) {
                    as_contour(from, part)
                } else {
                    as_disk(from, target, part)
                }
            })
        })
    }
}
