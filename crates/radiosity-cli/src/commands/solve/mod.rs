//! `radiosity solve`
//!
//! ```text
//! interrupt      Ctrl-C, snapshots, and the state that a run goes on from
//! solve_outputs  every output of a solution
//! progress       the bar on a terminal
//! steps          bound and ledger of every step, as CSV
//! lights         lights that the command line adds to a scene
//! options        what may be asked, and what the solver is asked
//! ```
mod interrupt;
mod lights;
pub(crate) mod options;
mod progress;
mod solve_outputs;
mod steps;

use crate::clashes;
use crate::failure::Failure;
use crate::input;
use crate::messages::say;
use crate::outputs::{Output, is_stream, print};
use interrupt::{Follower, resume};
use lights::{light, warn_of_darkness};
use options::{Solve, options};
use radiosity::{Scene, Solution};
use solve_outputs::SolveOutputs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Solves a scene and writes every output asked for; nothing is solved when an output cannot be written.
///
/// Ctrl-C stops the run: what was found so far is written, and the state. A second Ctrl-C ends the program at once.
pub(crate) fn run(arguments: &Solve) -> Result<ExitCode, Failure> {
    if arguments.output.is_empty() && !arguments.json {
        return Err(Failure::usage("there is no output; give -o FILE or --json"));
    }
    if arguments.snapshot_every.is_some() && arguments.output.iter().any(|path| is_stream(path)) {
        return Err(Failure::usage("stdout takes one result; give --snapshot-every with -o FILE"));
    }
    if arguments.json && arguments.output.iter().any(|path| is_stream(path)) {
        return Err(Failure::usage("--json and -o - both write to stdout; leave out one of them"));
    }
    refuse_clashes(arguments)?;
    let (start, mut options) = (Instant::now(), options(arguments)?);
    let outputs = Output::all(&arguments.output, &arguments.format)?;
    let lights = arguments.lights.clone();
    let lit = move |scene: &mut Scene| light(scene, &lights);
    let is_late = || arguments.seconds().is_some_and(|limit| start.elapsed().as_secs_f64() > limit);
    let input = input::read_repaired(&arguments.scene, arguments.reading, lit, is_late)?;
    let (scene, read) = (&input.scene, start.elapsed());
    clashes::refuse_pictures(scene, results(arguments))?;
    options.for_camera = arguments.for_camera.then(|| arguments.view.camera_of(scene)).transpose()?;
    let mut state = resume(arguments.resume.as_deref())?;
    let writer = SolveOutputs { arguments, outputs: &outputs, input: &input };
    let mut follower = Follower::new(&writer, options.tolerance)?;
    options.max_seconds = options.max_seconds.map(|limit| left(limit, read.as_secs_f64()));
    let solution = radiosity::solve_from(scene, &options, &mut state, |progress| follower.follow(progress));
    let ended = follower.end(&state, solution.as_ref().ok());
    let solution = solution?;
    // What was found is not lost for a state that cannot be written.
    let (figures, shown) = writer.write(&solution, follower.recording(&solution))?;
    ended?;
    follower.remove_states(&solution)?;
    if arguments.json {
        print(&figures)?;
    }
    report(scene, &solution, shown);
    warn_of_darkness(scene, &solution);
    Ok(follower.code(&solution))
}

/// The state that a run goes on from may be the one that it writes; all else that is read stays.
fn refuse_clashes(arguments: &Solve) -> Result<(), Failure> {
    let (state, resume) = (arguments.state(), arguments.resume.as_deref());
    clashes::refuse(resume, results(arguments))?;
    let read = std::iter::once(arguments.scene.as_path()).chain(arguments.lights.files());
    clashes::refuse(read, results(arguments).chain(state.as_deref()))
}

fn results(arguments: &Solve) -> impl Iterator<Item = &Path> {
    arguments.output.iter().chain(&arguments.steps).map(PathBuf::as_path)
}

/// What is left of the time after reading and repair. Writing takes half as long as these. It may end late, by a second or a tenth of
/// the time: half of that is counted on.
fn left(limit: f64, read: f64) -> f64 {
    let (writing, late) = (read / 2.0, (limit / 10.0).max(1.0));
    (limit - read - (writing - late / 2.0).max(0.0)).max(0.0)
}

/// One line for people.
fn report(scene: &Scene, solution: &Solution, shown: usize) {
    let (elements, seconds) = (solution.mesh.elements.len(), solution.seconds);
    // Cut further for what is shown: pages and files hold, and count, the pieces.
    let pieces = if shown == elements { String::new() } else { format!(" shown as {shown}") };
    let (shots, products) = (solution.shots, solution.products);
    let estimate = worst_estimate(scene, solution);
    let estimate = estimate.map_or_else(String::new, |(share, patch)| {
        let of = if solution.in_view.is_some() { " of what the camera sees" } else { "" };
        format!(", light{of} within {:.2} % (patch {patch}; an estimate)", 100.0 * share)
    });
    say!("{elements} elements{pieces}, {shots} shots, {products} products, {seconds:.1} s{estimate}");
}

/// The largest estimated error of a patch, of those in view where the light was found for a camera, as a share of its mean irradiance or of
/// 1 % of the scene's, and the patch's name.
fn worst_estimate<'s>(scene: &'s Scene, solution: &Solution) -> Option<(f64, &'s str)> {
    solution.estimate.as_ref()?;
    let means = solution.patch_means(&solution.irradiance, scene.patches.len());
    let areas: Vec<f64> = scene.patches.iter().map(|patch| patch.polygon.area()).collect();
    let whole = |band: usize| {
        means.iter().zip(&areas).map(|(mean, area)| mean[band] * area).sum::<f64>()
            / areas.iter().sum::<f64>()
    };
    let wholes: Vec<f64> = (0..solution.bands).map(whole).collect();
    let is_seen = |index: &usize| solution.in_view.as_ref().is_none_or(|in_view| in_view[*index]);
    let shares = (0..scene.patches.len()).filter(is_seen).flat_map(|index| {
        let patch = &scene.patches[index];
        let of = means[index].iter().zip(&wholes).map(|(mean, whole)| mean.max(0.01 * whole));
        let shares = solution.patch_estimate(index).iter().zip(of).filter(|(_, of)| *of > 0.0);
        shares.map(|(estimate, of)| (estimate / of, patch.name.as_str())).collect::<Vec<_>>()
    });
    shares.reduce(|a, b| if b.0 > a.0 { b } else { a })
}

#[cfg(test)]
mod tests {
    use super::left;

    #[test]
    fn reading_is_taken_off_once() {
        assert!(
            [(3.0, 1.0), (3.0, 0.5), (60.0, 6.0)]
                .iter()
                .all(|(limit, read)| left(*limit, *read) == limit - read)
        );
    }

    #[test]
    fn long_writing_is_begun_in_time_and_no_time_is_below_zero() {
        for (limit, read) in [(3.0, 2.0), (10.0, 6.0), (100.0, 50.0), (100.0, 99.0), (1.0, 40.0)] {
            let ended: f64 = read + left(limit, read) + read / 2.0;
            assert!(left(limit, read) >= 0.0);
            assert!(left(limit, read) == 0.0 || ended <= limit + (limit / 10.0).max(1.0), "{limit} {read}");
        }
    }
}
