//! The target's parts as disks.
use super::gather::{as_disk, by_parts, row_of_targets};
use super::{method::Method, parts::Division};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// Divides the target into parts, takes each for a disk, and casts a ray to each part's centre [Wallace 1989; Barreto 2008,
/// (2.3)]:
///
/// F = sum over k of V_k A_k cos(theta_k) cos(theta'_k) / (pi r_k^2 + A_k), where A_k = A/n for equal parts.
///
/// It converges as 1/n without occlusion, and slower across shadow edges, where a part is seen or not as its centre is. It does
/// not converge in a part that touches dA's plane: divide adaptively, or use [`Pietrek`](super::Pietrek).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wallace {
    /// How the target is divided.
    pub division: Division,
}

impl Method for Wallace {
    fn name(&self) -> String {
        format!("Wallace, {}", self.division)
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        row_of_targets(enclosure, from, targets, |target| {
            by_parts(from, target, self.division, |part| as_disk(from, target, part))
        })
    }
}
