//! How much light two tiles exchange, and how well that is known.
use super::tile::SQUARE;
use serde::{Deserialize, Serialize};

/// The exchange of linear light between two tiles: G_ab is the integral over both of function a of the first, the kernel, and function b
/// of the second.
///
/// Each end is looked at from five points of the other, exactly: past all that stands in between, with the centroid of what is seen, so
/// that the integral over that end of a linear function has no error. What five points of one end miss the other end's see.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Transfer {
    /// Of light from the second at the first, 3 × 3. Its transpose is that of light from the first at the second.
    pub(crate) exchange: [f64; 9],
    /// For each end and each of its axes: the curvature of what it sees of the other end, times its area; where the outer points see more, above zero; or of what turns
    /// between its points, see [`Parabola`](super::parabola::Parabola).
    pub(crate) bend: [[f64; 2]; 2],
    /// The estimated error of G_00.
    pub(crate) error: f64,
    /// What the points of one end miss of the other, or see too much.
    pub(crate) gap: f64,
    /// Which end's points it is from.
    pub(crate) from_second: bool,
    /// G_00 without what stands in between, where no point sees anything past it; else 0.
    pub(crate) open: f64,
    /// ΣF to the other end from the five points of each.
    pub(crate) seen: [[f64; 5]; 2],
}

impl Transfer {
    /// Of tiles that do not see each other.
    pub(super) const NONE: Transfer = Transfer {
        exchange: [0.0; 9],
        bend: [[0.0; 2]; 2],
        error: 0.0,
        gap: 0.0,
        from_second: false,
        open: 0.0,
        seen: [[0.0; 5]; 2],
    };

    /// The curvature of what one end sees, with what its points miss: past occluders that may be much in a small place.
    pub(crate) fn curvature(&self, end: usize, is_past_others: bool) -> f64 {
        let bend = self.bend[end][0].abs() + self.bend[end][1].abs();
        let is_worse = usize::from(self.from_second) != end;
        let missed =
            if is_past_others { (self.gap * self.exchange[0].max(self.gap)).sqrt() } else { self.gap };
        if is_worse { bend + missed } else { bend }
    }

    /// From 0 to 1, whether each place of one end sees another place of the other.
    pub(crate) fn locality(&self) -> f64 {
        let [whole, _, _, _, a, b, _, c, d] = self.exchange;
        if whole > 0.0 { ((a * a + b * b + c * c + d * d) / 2.0).sqrt() / (SQUARE * whole) } else { 0.0 }
    }

    /// How many numbers it has.
    pub(crate) const SIZE: usize = 26;

    /// Whether all is as measuring makes it.
    pub(crate) fn is_lawful(&self) -> bool {
        let Transfer { exchange, bend, error, gap, open, seen, .. } = self;
        let numbers = exchange
            .iter()
            .chain(bend.iter().flatten())
            .chain(seen.iter().flatten())
            .chain([error, gap, open]);
        numbers.into_iter().all(|number| number.is_finite())
            && exchange[0] >= 0.0
            && *error >= 0.0
            && *gap >= 0.0
    }
}
