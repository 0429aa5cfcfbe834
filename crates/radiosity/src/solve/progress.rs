//! The progress of a run, as its caller sees it.
use super::{factors::Factors, ledger::Ledger, light::Light, solution::Solution, state::State};

/// The progress of the solver.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'p> {
    /// Shots so far.
    pub shots: usize,
    /// Matrix-vector products so far.
    pub products: usize,
    /// Unshot power over emitted power, in the worst band.
    pub unshot: f64,
    /// See [`Solution::bound`].
    pub bound: &'p [f64],
    /// Where the emitted power is now.
    pub ledger: &'p Ledger,
    /// Seconds since the start.
    pub seconds: f64,
    pub(super) light: &'p Light,
    pub(super) scaling: Option<f64>,
    pub(super) factors: &'p Factors<'p>,
    pub(super) welds: &'p [usize],
}

impl Progress<'_> {
    /// The light so far.
    #[must_use]
    pub fn solution(&self) -> Solution {
        Solution {
            bands: self.light.bands,
            radiosity: self.light.radiosity.clone(),
            irradiance: self.light.irradiance.clone(),
            reflectance: self.light.reflectance.clone(),
            direct: None,
            welds: self.welds.to_vec(),
            ledger: self.ledger.clone(),
            bound: self.bound.to_vec(),
            closure: None,
            scaling: self.scaling,
            shots: self.shots,
            products: self.products,
            converged: false,
            fault: None,
            mesh: self.factors.subdivision.mesh.clone(),
            seconds: self.seconds,
        }
    }

    /// The state from which the run can be resumed.
    #[must_use]
    pub fn state(&self) -> &State {
        self.factors.state
    }
}
