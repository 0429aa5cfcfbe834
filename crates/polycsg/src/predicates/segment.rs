//! What predicates are asked about, and what they answer.

use glam::DVec2;
use std::cmp::Ordering;

/// A directed straight edge, from `[0]` to `[1]`.
pub(crate) type Segment = [DVec2; 2];

/// Where a point lies seen along a directed line, or where a second direction points seen along a first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    On,
    Right,
}

impl Side {
    /// The side seen from the reversed line.
    pub(crate) fn reversed(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::On => Side::On,
            Side::Right => Side::Left,
        }
    }
}

impl From<Ordering> for Side {
    fn from(order: Ordering) -> Side {
        match order {
            Ordering::Greater => Side::Left,
            Ordering::Equal => Side::On,
            Ordering::Less => Side::Right,
        }
    }
}
