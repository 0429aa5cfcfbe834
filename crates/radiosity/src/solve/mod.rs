//! From a scene to its light: progressive refinement with substructuring.
//!
//! ```text
//! check      refuse what has no solution: reflectance 1, negative emission
//! mesh       patches into elements; each patch with a binary tree of pieces
//! factors    column of exact form factors from every element's centroid to one piece, kept for the next shot
//! shooters   which pieces shoot, how much each has shot, when one is split
//! light      radiosity and irradiance of every element
//! ledger     where the power went, and how far the light is from the solution
//! ```
//!
//! The discrete system is B = E + ρ F P B: elements i receive at their centroids, F_ij is the exact form factor
//! from element i to piece j, and P takes the mean of B over each piece (Barreto, Equations 2.5 and A.15). A piece
//! shoots what its mean is ahead of what it has shot. A piece over which B varies too much is split in two, which
//! inherit what it has shot; their next shots, of either sign, mend what the coarser piece had got wrong.
use crate::{Error, Mesh, Scene, mesh::Subdivision};
use factors::Factors;
use light::Light;
use shooters::Shooters;
use std::{ops::ControlFlow, time::Instant};

mod check;
mod factors;
mod ledger;
mod light;
mod shooters;

pub use ledger::Ledger;

/// How fine, how far, how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// About how many elements to cut the scene into.
    pub elements: usize,
    /// Stop when the unshot power is at most this share of the emitted power, in every band.
    pub tolerance: f64,
    /// Split a shooter while its power deviates from that of a uniform piece by more than this share of the
    /// emitted power.
    pub spread: f64,
    /// Stop after so many shots.
    pub max_shots: usize,
    /// Stop after so many seconds.
    pub max_seconds: Option<f64>,
}

impl Default for Options {
    /// About 6000 elements; what is left unshot or unresolved is far below what a mesh of that size resolves.
    fn default() -> Options {
        Options { elements: 6000, tolerance: 1e-4, spread: 3e-4, max_shots: 200_000, max_seconds: None }
    }
}

/// How far the solver has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Shots so far.
    pub shots: usize,
    /// Unshot power over emitted power, the worst band.
    pub unshot: f64,
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
    /// Per band, a bound on the algebraic error of every element's radiosity, W/m²: ‖r‖∞ / (1 − max ρ ΣF) with the
    /// residual r of the discrete system and ΣF <= 1. It says nothing of the discretisation.
    pub bound: Vec<f64>,
    /// The largest |ΣF − 1| over the elements: rounding in a closed scene, the widest opening in another. Nothing
    /// when the solution was stopped early.
    pub closure: Option<f64>,
    /// How many shots were made.
    pub shots: usize,
    /// Whether the tolerance was reached.
    pub converged: bool,
    /// Wall time of the solution.
    pub seconds: f64,
}

impl Solution {
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

/// Solves the scene by progressive refinement; `watch` is called before every shot and may end it early.
///
/// A scene without emission is solved at once: it is dark. The result does not depend on the number of threads.
/// Time: (shooting pieces) × (elements) form factors, and O(elements) for each shot.
///
/// # Errors
/// A reflectance outside [0, 1), negative emission, a polygon that cannot be cut into triangles: see [`Error`].
pub fn solve(
    scene: &Scene,
    options: &Options,
    watch: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<Solution, Error> {
    let start = Instant::now();
    check::check(scene)?;
    let subdivision = Subdivision::new(scene, options.elements)?;
    let mut factors = Factors::new(scene, &subdivision)?;
    let mut light = Light::new(scene, &subdivision.mesh);
    let mut shooters = Shooters::new(scene.patches.len(), &subdivision, &light);
    let converged = refine(options, start, &mut factors, &mut light, &mut shooters, watch)?;
    let closure = if converged { Some(factors.closure(shooters.front())?) } else { None };
    let ledger = Ledger::new(&light, &shooters);
    let bound = ledger::bound(&light, &shooters);
    let shots = shooters.shots;
    Ok(Solution {
        bands: scene.bands,
        radiosity: light.radiosity,
        irradiance: light.irradiance,
        ledger,
        bound,
        closure,
        shots,
        converged,
        mesh: subdivision.mesh,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// Shoots until the unshot power is within the tolerance (true), or a limit is met (false).
fn refine(
    options: &Options,
    start: Instant,
    factors: &mut Factors<'_>,
    light: &mut Light,
    shooters: &mut Shooters<'_>,
    mut watch: impl FnMut(Progress) -> ControlFlow<()>,
) -> Result<bool, Error> {
    loop {
        let unshot = shooters.weigh(light);
        if unshot <= options.tolerance {
            return Ok(true);
        }
        let progress = Progress { shots: shooters.shots, unshot };
        let late = options.max_seconds.is_some_and(|limit| start.elapsed().as_secs_f64() > limit);
        if watch(progress).is_break() || late || progress.shots >= options.max_shots {
            return Ok(false);
        }
        let brightest = shooters.brightest();
        if !shooters.split(brightest, light, options.spread) {
            let column = factors.column(shooters.node(brightest))?;
            light.receive(&column, &shooters.shoot(brightest));
        }
    }
}

#[cfg(test)]
mod tests;
