//! Inputs for the suites, each a function of its seed alone.
mod crowd;
mod lattice;
mod layers;
mod nasty;
mod small;

pub use crowd::crowd;
pub use lattice::lattice;
pub use layers::{LAYERS, layer};
pub use nasty::{KINDS, nasty};
pub use small::{FAMILIES, Small, small};

use crate::Ring;
use crate::oracle::Operand;
use glam::DVec2;

/// An operand of one ring, read even-odd.
fn ring_of(points: impl IntoIterator<Item = DVec2>) -> Vec<Ring> {
    vec![points.into_iter().collect()]
}

/// Two operands with a name for messages.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Kind and seed.
    pub name: String,
    /// First operand.
    pub a: Operand,
    /// Second operand.
    pub b: Operand,
}
