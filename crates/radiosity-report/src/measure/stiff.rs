//! The solvers against each other: rooms that reflect more and more of their light, and light of any scale.
use crate::clock::{Job, interleaved};
use crate::plan::{Plan, Rounds};
use crate::rows::{Chapter, Deviation, Measured, Time};
use radiosity::{Error, Method, Options, Scene, Solution, State, scenes, solve_from};
use std::{cell::RefCell, ops::ControlFlow};

/// The methods that solve, with their names.
const METHODS: [(&str, Method); 4] = [
    ("shooting", Method::Shoot),
    ("full matrix", Method::Matrix),
    ("conjugate gradients", Method::Cg),
    ("GMRES", Method::Gmres),
];
/// When a solver stops: see [`Options::tolerance`].
const TOLERANCE: f64 = 1e-8;
/// A room whose solution is known, one with one emitter, and one whose emitter is of any brightness.
const AXES: [&str; 3] = [
    "furnace: 1 / (1 − reflectance)",
    "cube with one emitter: 1 / (1 − reflectance)",
    "cube with one emitter: scale of its emission",
];

/// All solvers along all axes.
pub(crate) fn measure(plan: &Plan) -> Result<Vec<Measured>, Error> {
    let shots = if plan.quick { 20_000 } else { 400_000 };
    let absorbed = [0.5, 0.1, 1e-2, 1e-3, 1e-6, 1e-9, 1e-12];
    let scales = [1e-30, 1e-20, 1e-10, 1.0, 1e10, 1e20, 1e30];
    along(&absorbed, &scales, shots, plan.rounds())
}

/// All solvers at these shares of light that rooms absorb, and at these scales of emission.
fn along(absorbed: &[f64], scales: &[f64], shots: usize, rounds: Rounds) -> Result<Vec<Measured>, Error> {
    let mut rows = Vec::new();
    let (in_furnace, known) = (&RefCell::default(), &RefCell::default());
    for absorbed in absorbed {
        let scene = &scenes::scene(&format!("furnace-{}", 1.0 - absorbed)).expect("reflectance below 1");
        let room = Room { axis: AXES[0], at: 1.0 / absorbed, scene, shots, known: in_furnace };
        rows.extend(room.measure(rounds, |_| Ok(None))?);
        let scene = &cube(1.0 - absorbed, 1.0);
        let room = Room { axis: AXES[1], at: 1.0 / absorbed, scene, shots, known };
        rows.extend(room.measure(rounds, |method| converged(scene, method, known).map(Some))?);
    }
    let plain = cube(0.5, 1.0);
    for &scale in scales {
        let scaled = |method| {
            let light = converged(&plain, method, known)?;
            Ok(Some(light.iter().map(|b| b * scale).collect()))
        };
        let room = Room { axis: AXES[2], at: scale, scene: &cube(0.5, scale), shots, known };
        rows.extend(room.measure(rounds, scaled)?);
    }
    Ok(rows)
}

/// The cube of 216 patches, one of them an emitter.
fn cube(reflectance: f64, scale: f64) -> Scene {
    let mut cube = scenes::scene("cube").expect("a built-in scene");
    for patch in &mut cube.patches {
        patch.reflectance.fill(reflectance);
        patch.emission.iter_mut().for_each(|radiance| *radiance *= scale);
    }
    cube
}

/// What the system of a method has as its solution: the full matrix for one-sided factors, conjugate gradients to the
/// end for those that are scaled to close.
fn converged(scene: &Scene, method: Method, known: &RefCell<State>) -> Result<Vec<f64>, Error> {
    let method = if method == Method::Cg { Method::Cg } else { Method::Matrix };
    let options = Options { tolerance: 1e-14, ..options(method, 100_000) };
    Ok(solved(scene, &options, known)?.radiosity)
}

/// Whole patches: what is compared is the solver, not the mesh.
fn options(method: Method, max_shots: usize) -> Options {
    Options {
        method,
        elements: 1,
        tolerance: TOLERANCE,
        spread: f64::INFINITY,
        max_shots,
        ..Options::default()
    }
}

fn solved(scene: &Scene, options: &Options, known: &RefCell<State>) -> Result<Solution, Error> {
    solve_from(scene, options, &mut known.borrow_mut(), |_| ControlFlow::Continue(()))
}

/// A place on an axis.
struct Room<'r> {
    axis: &'static str,
    at: f64,
    scene: &'r Scene,
    /// When shooting gives up.
    shots: usize,
    /// The form factors, which depend on nothing but where things are: what is timed is the solver.
    known: &'r RefCell<State>,
}

impl Room<'_> {
    /// All solvers; the reference is 1 where none is given.
    fn measure(
        &self,
        rounds: Rounds,
        reference: impl Fn(Method) -> Result<Option<Vec<f64>>, Error>,
    ) -> Result<Vec<Measured>, Error> {
        let job = |k: usize| -> Job<'_, Result<Solution, Error>> {
            let options = options(METHODS[k].1, self.shots);
            Box::new(move || solved(self.scene, &options, self.known))
        };
        let jobs: Vec<Job<'_, Result<Solution, Error>>> = (0..METHODS.len()).map(job).collect();
        // What is not known yet is found first.
        solved(self.scene, &options(Method::Matrix, 1), self.known)?;
        let found = interleaved(&jobs, rounds).into_iter().zip(METHODS);
        let row = |((solution, time), (name, method)): ((Result<Solution, Error>, Time), _)| {
            Ok(self.row(name, &solution?, reference(method)?, time))
        };
        found.map(row).collect()
    }

    fn row(&self, name: &str, solution: &Solution, truth: Option<Vec<f64>>, time: Time) -> Measured {
        let truth = truth.unwrap_or_else(|| vec![1.0; solution.radiosity.len()]);
        let largest = truth.iter().copied().fold(0.0, f64::max);
        let off = solution.radiosity.iter().zip(&truth).map(|(b, exact)| (b - exact).abs() / largest);
        Measured {
            chapter: Chapter::Solvers,
            subject: self.axis.to_owned(),
            series: name.to_owned(),
            setting: format!("{} shots, {} products", solution.shots, solution.products),
            amount: self.at,
            error: Deviation::of(&off.collect::<Vec<_>>()),
            certified: false,
            bound: solution.bound.first().map(|bound| bound / largest).filter(|bound| bound.is_finite()),
            defect: None,
            points: None,
            in_part: None,
            valid: Some(solution.converged),
            time,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_solvers_that_converge_meet_their_references() {
        let rows = along(&[0.5, 1e-6], &[1e20], 20_000, Rounds::ONCE).unwrap();
        assert_eq!(rows.len(), 5 * METHODS.len());
        for row in rows {
            let (axis, name, error) = (&row.subject, &row.series, row.error.max);
            let converges = name != "shooting" || row.amount == 2.0;
            assert!(row.valid == Some(true) || !converges, "{axis} {name}");
            assert!(error < 1e-8 || !converges, "{axis} {name}: {error}");
        }
    }
}
