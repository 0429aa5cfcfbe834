//! From a scene to its light.
//!
//! ```text
//! check      refuse what has no solution: negative emission, reflectance above 1
//! overlap    refuse patches that lie on each other
//! mesh       patches into elements; each patch with a binary tree of pieces
//! surfaces   patches that continue each other hide as one polygon
//! factors    column of exact form factors from every element's centroid to one piece; kept in the state
//! rooms      which patches light reaches, and which of them close a room
//! shooters   which pieces shoot, how much each has shot, when one is split
//! shoot      progressive refinement: the piece with most to shoot shoots, again and again
//! relax      all pieces at once: exchange, balance, and cg, gmres or gauss; then gather
//! light      radiosity and irradiance of every element
//! ledger     where the power went, and how far the light is from the solution
//! ```
//!
//! The discrete system is B = E + ρ F P B: elements i receive at their centroids, F_ij is the exact form factor
//! from element i to piece j, and P takes the mean of B over each piece (Barreto, Equations 2.5 and A.15). Conjugate
//! gradients solve the symmetric system of the pieces' mean factors instead, in which the power adds up in both
//! directions.
use crate::{
    Error, Mesh, Scene,
    interpolate::Direct,
    mesh::{LEVELS, Plan, Subdivision, shadows},
};
use factors::Factors;
use light::Light;
use run::Run;
use std::{ops::ControlFlow, time::Instant};

mod balance;
mod cg;
mod check;
mod direct;
mod estimate;
mod exchange;
mod factors;
mod fingerprint;
mod gather;
mod gauss;
mod gmres;
mod hemicube;
mod ledger;
mod light;
mod overlap;
mod quality;
mod relax;
mod rooms;
mod run;
mod shoot;
mod shooters;
mod state;
mod surfaces;
mod workers;

pub use estimate::Norm;
pub use ledger::Ledger;
pub use quality::Quality;
pub use state::{State, StateError};
pub(crate) use surfaces::Surfaces;

/// How the light is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// [`Method::Cg`] where a closed room reflects at least 0.9 of its light, else [`Method::Shoot`].
    #[default]
    Auto,
    /// Progressive refinement: the piece with most light to shoot shoots it, again and again. Soon there is something to see;
    /// needs about 1 / (1 − ρ) rounds.
    Shoot,
    /// The full matrix, every piece as small as the mesh's cells, by Gaussian elimination: cubic in the pieces.
    Matrix,
    /// Conjugate gradients on symmetric exchange areas, scaled to close: power adds up, and some tens of
    /// matrix-vector products do at any reflectance below 1.
    Cg,
    /// GMRES on the factors as they are, one-sided.
    Gmres,
}

/// How fine, how far, how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How the light is found.
    pub method: Method,
    /// About how many elements to cut the scene into.
    pub elements: usize,
    /// How often to solve, look where the light is not resolved, and cut the scene anew, finer there.
    pub passes: usize,
    /// What tells where the light is not resolved.
    pub norm: Norm,
    /// Of so many of the strongest lamps the edges of shadows become edges of elements.
    pub shadows: usize,
    /// Take form factors from hemicubes of so many cells across, instead of exact ones: to see what that costs and brings.
    pub hemicube: Option<u32>,
    /// In the end, find the light straight from the lamps exactly at every vertex.
    pub gather: bool,
    /// Stop when the bound on the error of every radiosity is at most this share of the reflected light's brightness,
    /// ΣAR² / ΣAR with R = B − E, in every band, and what is unshot at most this share of the emitted power.
    pub tolerance: f64,
    /// Split a shooter while its power deviates from that of a uniform piece by more than this share of the power that
    /// all send.
    pub spread: f64,
    /// Stop after so many shots.
    pub max_shots: usize,
    /// Stop after so many seconds.
    pub max_seconds: Option<f64>,
}

impl Default for Options {
    /// About 6000 elements; what is left unshot or unresolved is far below what a mesh of that size resolves.
    fn default() -> Options {
        Options {
            method: Method::Auto,
            elements: 6000,
            passes: 0,
            norm: Norm::L2,
            shadows: 0,
            hemicube: None,
            gather: false,
            tolerance: 1e-3,
            spread: 2e-4,
            max_shots: 1_000_000,
            max_seconds: None,
        }
    }
}

/// How far the solver has come.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'p> {
    /// Shots so far.
    pub shots: usize,
    /// Matrix-vector products so far.
    pub products: usize,
    /// Unshot power over emitted power, the worst band.
    pub unshot: f64,
    /// See [`Solution::bound`].
    pub bound: &'p [f64],
    /// Where the emitted power is.
    pub ledger: &'p Ledger,
    /// Time since the start.
    pub seconds: f64,
    light: &'p Light,
    scaling: Option<f64>,
    factors: &'p Factors<'p>,
    welds: &'p [usize],
}

impl Progress<'_> {
    /// The light as it is now.
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

    /// What can be gone on from.
    #[must_use]
    pub fn state(&self) -> &State {
        self.factors.state
    }
}

/// The light of a scene.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The elements.
    pub mesh: Mesh,
    /// Number of bands.
    pub bands: usize,
    /// Radiosity of every element, elements × bands, W/m².
    pub radiosity: Vec<f64>,
    /// Irradiance of every element, elements × bands, W/m².
    pub irradiance: Vec<f64>,
    /// Where the emitted power went.
    pub ledger: Ledger,
    /// Per band, a bound on the algebraic error of every piece's radiosity, and so of every element's, W/m²:
    /// ‖r‖∞ / (1 − max ρ ΣF). It is of the discrete system: what the mesh does not resolve is not in it. Infinite where
    /// there is none: a patch reflects all light.
    pub bound: Vec<f64>,
    /// The largest |ΣF − 1| over the elements: 0 but for rounding in a closed scene. Not known for a run that was
    /// stopped, or where finding it would take longer than the solution.
    pub closure: Option<f64>,
    /// The largest relative change of a form factor that closure scaling made; none where nothing was scaled.
    pub scaling: Option<f64>,
    /// How many shots were made.
    pub shots: usize,
    /// How many matrix-vector products were made.
    pub products: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// [`Error::Defect`] where that ended the run early: all else is as far as it had come.
    pub fault: Option<Error>,
    /// How long it took.
    pub seconds: f64,
    /// Reflectance of every element, elements × bands.
    pub(crate) reflectance: Vec<f64>,
    /// Light straight from the lamps, where it was gathered.
    pub(crate) direct: Option<Direct>,
    /// For each vertex the first one that it shares its light with.
    pub(crate) welds: Vec<usize>,
}

impl Solution {
    /// The irradiance that is still missing everywhere, if what is unshot spread evenly, per band: for the display of a
    /// run that was stopped, whose dark places are not meant to be dark.
    ///
    /// ΣAΔB / ΣA / (1 − ρ̄), ρ̄ the mean reflectance: all its reflections to come (Cohen, Chen, Wallace and Greenberg 1988).
    #[must_use]
    pub fn ambient(&self) -> Vec<f64> {
        let areas: Vec<f64> = (0..self.mesh.elements.len()).map(|element| self.mesh.area(element)).collect();
        let in_band = |band: usize| {
            let kept = self.reflectance.iter().skip(band).step_by(self.bands).map(|rho| 1.0 - rho);
            let absorbed: f64 = kept.zip(&areas).map(|(kept, area)| kept * area).sum();
            let unshot = self.ledger.unshot[band].max(0.0);
            if unshot == 0.0 || absorbed == 0.0 { 0.0 } else { unshot / absorbed }
        };
        (0..self.bands).map(in_band).collect()
    }

    /// The solution with the ambient irradiance added to every element: to be looked at, not to be measured.
    #[must_use]
    pub fn with_ambient(&self) -> Solution {
        let ambient = self.ambient();
        let mut lit = self.clone();
        for (at, h) in lit.irradiance.iter_mut().enumerate() {
            *h += ambient[at % self.bands];
            lit.radiosity[at] += self.reflectance[at] * ambient[at % self.bands];
        }
        lit
    }

    /// Area-weighted means of element values over every patch of the scene, `patches` × bands.
    #[must_use]
    pub fn patch_means(&self, values: &[f64], patches: usize) -> Vec<Vec<f64>> {
        let mut sums = vec![vec![0.0; self.bands]; patches];
        let mut areas = vec![0.0; patches];
        for (index, element) in self.mesh.elements.iter().enumerate() {
            let area = self.mesh.area(index);
            areas[element.patch] += area;
            for (sum, value) in sums[element.patch].iter_mut().zip(&values[index * self.bands..]) {
                *sum += area * value;
            }
        }
        sums.iter().zip(&areas).map(|(sums, area)| sums.iter().map(|sum| sum / area).collect()).collect()
    }
}

/// Solves the scene; `watch` is called before every step and may end the run early.
///
/// A scene without emission is solved at once: it is dark. The result does not depend on the number of threads.
/// Time: (pieces) × (elements) form factors, and O(elements) for each shot or O(pieces²) for each product.
///
/// # Errors
/// A reflectance outside [0, 1], one of 1 in a closed lit room, negative emission, a polygon that cannot be cut into
/// triangles: see [`Error`]. A defect of this program ends the run early instead, and stands in the solution.
pub fn solve(
    scene: &Scene,
    options: &Options,
    watch: impl FnMut(&Progress<'_>) -> ControlFlow<()>,
) -> Result<Solution, Error> {
    solve_from(scene, options, &mut State::default(), watch)
}

/// [`solve()`] that finds in `state` the form factors of an earlier run of the same scene, and leaves there all it knows.
///
/// The result has the same bits whatever `state` holds.
///
/// # Errors
/// As [`solve()`], and [`Error::Foreign`] when `state` is of another scene or another number of elements.
pub fn solve_from(
    scene: &Scene,
    options: &Options,
    state: &mut State,
    mut watch: impl FnMut(&Progress<'_>) -> ControlFlow<()>,
) -> Result<Solution, Error> {
    let start = Instant::now();
    check::check(scene)?;
    overlap::check(scene)?;
    // Each pass has twice the elements of the one before.
    let mut plan = Plan::even(scene, options.elements >> options.passes.min(LEVELS.into()));
    if options.shadows > 0 {
        plan.shadows = shadows(scene, options.shadows);
    }
    let mut passes_left = options.passes;
    loop {
        let subdivision = Subdivision::new(scene, &plan)?;
        let mut run = Run::new(scene, options, start, &subdivision, state, &mut watch)?;
        if passes_left == options.passes {
            run.recognise()?;
        }
        let converged = run.advance(scene)?;
        let solution = run.finish(scene, converged, passes_left == 0)?;
        if !solution.converged || passes_left == 0 {
            return Ok(solution);
        }
        passes_left -= 1;
        plan =
            estimate::refine(&plan, &subdivision, &solution, options.norm, options.elements >> passes_left);
    }
}

#[cfg(test)]
mod tests;
