//! From a scene to its light.
//!
//! ```text
//! refine         where the light is not resolved, and a plan for a finer mesh
//! drive          one mesh from the first step to its solution: which method, the steps, closure, direct light
//! levels         light between parts of patches of any size; the mesh follows
//! final_gather   what vertices receive, exactly past what stands in between
//! receivers      where the light of vertices is gathered
//! lights         lamps, the sun and the sky: what points and polygons receive of them
//! relax          all pieces at once: exchange, balance, and cg, gmres or gauss; then gather
//! shoot          progressive refinement: the piece with most to shoot shoots, again and again
//! follow         the light followed through the rooms
//! batches        form factors and light of many points; the watcher is asked in between
//! pace           how much is done before the watcher is asked
//! run            what the steps of a run share
//! progress       the progress of a run, as its caller sees it
//! factors        columns of form factors from every element's centroid to one piece; kept in the state
//! rough          which of them are so small that they may be taken roughly; who sees a cluster sees its patches
//! patch_clusters patches near each other that look one way
//! hemicube       form factors by hemicubes, to compare with
//! workers        many form factors at once, by all threads
//! occluders      patches that continue each other hide as one polygon
//! ball           bounds on what is seen of polygons
//! interpolate    from elements to vertices
//! solution       what comes out
//! ledger         where the power went, and how far the light is from the solution
//! shooters       which pieces shoot, how much each has shot, when one is split
//! rooms          which patches light reaches, and which of them close a room
//! light          radiosity and irradiance of every element
//! state          the form factors found so far, as bytes; fingerprint tells meshes apart
//! magnitude      how large many numbers are
//! check          refuse what has no solution: negative emission, reflectance above 1
//! overlap        refuse patches that lie on each other
//! quality        options by one word
//! options        the options, with norm
//! ```
//!
//! The discrete system is B = E + ρ F P B: elements i receive at their centroids, F_ij is the exact form factor
//! from element i to piece j, but for those that [`rough`] says may be taken roughly, and P takes the mean of B over
//! each piece (Barreto, Equations 2.5 and A.15). Conjugate gradients solve the symmetric system of the pieces' mean
//! factors instead, in which the power adds up in both directions.
mod ball;
mod batches;
mod check;
mod drive;
mod factors;
mod final_gather;
mod fingerprint;
mod follow;
mod hemicube;
mod interpolate;
pub(crate) mod ledger;
mod levels;
mod light;
mod lights;
mod magnitude;
pub(crate) mod norm;
pub(crate) mod occluders;
pub(crate) mod options;
mod overlap;
mod pace;
mod patch_clusters;
pub(crate) mod progress;
pub(crate) mod quality;
mod receivers;
mod refine;
mod relax;
mod rooms;
mod rough;
mod run;
mod shoot;
mod shooters;
pub(crate) mod solution;
pub(crate) mod state;
mod workers;

use crate::error::Error;
use crate::mesh::{lattice::LEVELS, plan::Plan, shadows::Shadows, subdivide::Subdivision};
use crate::scene::Scene;
use levels::plates::Plates;
use options::{Method, Options};
use progress::Progress;
use run::Run;
use solution::Solution;
use state::State;
use std::{ops::ControlFlow, time::Instant};

/// What is done with so few patches before the first step takes less than a second, and is done whatever the time.
const FEW_PATCHES: usize = 10_000;
/// With more plates than these there is light on a mesh before all clusters are linked.
const FEW_PLATES: usize = 1000;

/// Solves for the light of a scene. `watch` is called before every step and may end the run early.
///
/// A scene without emission is solved at once: it is dark. The result does not depend on the number of threads.
/// Time: (pieces) × (elements) form factors, and O(elements) for each shot or O(pieces²) for each product.
///
/// # Errors
/// A reflectance outside [0, 1], one of 1 in a closed lit room, negative emission, a polygon that cannot be cut into
/// triangles, a time that is up before the first step among very many patches: see [`Error`]. A panic in a form factor ends the run early
/// instead; see [`Solution::fault`].
pub fn solve(
    scene: &Scene,
    options: &Options,
    watch: impl FnMut(&Progress<'_>) -> ControlFlow<()>,
) -> Result<Solution, Error> {
    solve_from(scene, options, &mut State::default(), watch)
}

/// Solves like [`solve()`], with the form factors that an earlier run of the same scene left in `state`; adds its own to them.
///
/// An empty state starts from nothing. The result has the same bits whatever `state` holds.
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
    let in_time = || check_time(scene, options, start);
    check::check(scene)?;
    overlap::check(scene)?;
    in_time()?;
    if let Some(plates) = in_plates(scene, options) {
        return levels::rounds::solve(&plates, options, start, state, &mut watch);
    }
    let method = if options.method == Method::Auto { Method::Mesh } else { options.method };
    let options = &Options { method, ..options.clone() };
    // Each pass has twice the elements of the one before.
    let mut plan = Plan::even(scene, options.elements >> options.passes.min(LEVELS.into()));
    if options.shadows > 0 {
        let shadows = Shadows::new(scene, options.shadows);
        plan.shadows = (0..scene.patches.len()).map(|patch| shadows.on(patch)).collect();
    }
    let mut passes_left = options.passes;
    loop {
        in_time()?;
        let subdivision = Subdivision::new(scene, &plan)?;
        in_time()?;
        let mut run = Run::new(scene, options, start, &subdivision, state, &mut watch)?;
        if passes_left == options.passes {
            run.recognise()?;
        }
        let converged = run.advance(scene)?;
        let last = passes_left == 0 || !run.has_time();
        let solution = run.finish(scene, converged, last)?;
        if !solution.converged || last {
            return Ok(Solution { converged: solution.converged && passes_left == 0, ..solution });
        }
        passes_left -= 1;
        plan = refine::refine(&plan, &subdivision, &solution, options.norm, options.elements >> passes_left);
    }
}

/// The plates of a scene that is to be solved by levels.
fn in_plates<'s>(scene: &'s Scene, options: &Options) -> Option<Plates<'s>> {
    let is_asked_for = options.method == Method::Hierarchical;
    let may_be = options.method == Method::Auto && options.hemicube.is_none();
    let plates = (is_asked_for || may_be).then(|| Plates::of(scene))?;
    let is_quicker = is_asked_for || options.for_camera.is_some() || plates.count() <= FEW_PLATES;
    is_quicker.then_some(plates)
}

/// Refuses to go on with very many patches when the time is up: nothing is found yet that could be shown.
fn check_time(scene: &Scene, options: &Options, start: Instant) -> Result<(), Error> {
    let is_up = options.max_seconds.is_some_and(|limit| start.elapsed().as_secs_f64() > limit);
    if is_up && scene.patches.len() > FEW_PATCHES { Err(Error::Time) } else { Ok(()) }
}

#[cfg(test)]
mod tests;
