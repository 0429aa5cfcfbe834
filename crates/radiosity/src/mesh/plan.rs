//! How fine to cut what.
use super::spacing::spacings;
use crate::scene::Scene;
use glam::DVec3;

/// How fine to cut what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Side of a cell of each patch, in the scene's unit.
    pub(crate) spacings: Vec<f64>,
    /// For each patch and each cell of its lattice, how often to halve it; empty where nothing is halved.
    pub(crate) levels: Vec<Vec<u8>>,
    /// For each patch the lines where shadows begin and end; empty where none are wanted.
    pub(crate) shadows: Vec<Vec<[DVec3; 2]>>,
}

impl Plan {
    /// A plan for about so many triangles of about equal size; see [`super::spacing`].
    pub(crate) fn even(scene: &Scene, elements: usize) -> Plan {
        Plan { spacings: spacings(scene, elements), ..Plan::default() }
    }
}
