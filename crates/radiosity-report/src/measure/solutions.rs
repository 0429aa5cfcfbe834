//! Whole solutions of scenes against what their faces truly receive: every method on finer and finer meshes, every quality,
//! and path tracing beside them: our own, and Mitsuba's where Python has it.
use super::mitsuba::{self, Traced};
use super::path_tracer::PathTracer;
use super::truth::Truth;
use crate::clock::{Job, interleaved, once};
use crate::plan::{Plan, Rounds};
use crate::rows::{Chapter, Deviation, Measured, Time};
use radiosity::{Error, Method, Options, Quality, Scene, Solution, Transfers, solve};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// The name of the series of path tracing.
const PATHS: &str = "path tracing";
/// The name of the series of Mitsuba's path tracer.
const MITSUBA: &str = "Mitsuba";
/// The name of the series of qualities.
const QUALITIES: &str = "qualities";
/// The name of the series of levels.
const LEVELS: &str = "levels";

/// What is solved, and how it is called.
struct Task {
    series: &'static str,
    setting: String,
    options: Options,
}

/// The names of all series, in their order.
#[cfg(test)]
pub(crate) fn series(plan: &Plan) -> Vec<&'static str> {
    let mut series: Vec<&str> = tasks(plan).iter().map(|task| task.series).chain([PATHS, MITSUBA]).collect();
    series.dedup();
    series
}

/// A row without figures.
#[cfg(test)]
pub(crate) fn blank(subject: &str, series: &str) -> Measured {
    row(subject, series, String::new(), Deviation { max: 0.1, mean: 0.01, beyond: 1.0 })
}

/// Of all scenes that are asked for and whose truth is known.
pub(crate) fn measure(plan: &Plan, mut say: impl FnMut(&str)) -> Result<Vec<Measured>, Error> {
    let mut rows = Vec::new();
    let has_mitsuba = mitsuba::is_present();
    for (name, scene, truth) in known(plan) {
        say(&format!("whole solutions: {name}"));
        let subject = Subject { name, scene, truth };
        for task in tasks(plan) {
            rows.push(subject.solved(&task)?);
        }
        rows.extend(paths(plan).map(|paths| subject.traced(paths)));
        if has_mitsuba {
            rows.extend(subject.traced_by_mitsuba(paths(plan).collect()));
        }
    }
    Ok(rows)
}

/// How uncertain the truth of each scene is, as an error.
pub(crate) fn noise(plan: &Plan) -> Vec<(String, Deviation)> {
    known(plan).map(|(name, _, truth)| (name.to_owned(), Deviation::of(&truth.noise()))).collect()
}

fn known(plan: &Plan) -> impl Iterator<Item = (&str, &Scene, Truth)> {
    plan.scenes.iter().filter_map(|(name, scene)| Some((name.as_str(), scene, Truth::of(name, scene)?)))
}

/// Every method on every mesh, and every quality.
fn tasks(plan: &Plan) -> Vec<Task> {
    let first = if plan.quick { 200 } else { 400 };
    let meshes = |count: u32| (0..count).map(move |step| first << step);
    let [fine, coarse] = if plan.quick { [3, 3] } else { [5, 4] };
    let on = |series, method, elements: usize| {
        let options = Options { method, elements, ..Options::default() };
        Task { series, setting: format!("{elements} elements"), options }
    };
    let hemicube = |elements| {
        let Task { series, setting, options } = on("hemicubes, 64 × 64 cells", Method::Shoot, elements);
        Task { series, setting, options: Options { hemicube: Some(64), ..options } }
    };
    let mut tasks: Vec<Task> = Vec::new();
    tasks.extend(meshes(fine).map(|elements| on("shooting", Method::Shoot, elements)));
    tasks.extend(meshes(fine).map(|elements| on("conjugate gradients", Method::Cg, elements)));
    tasks.extend(meshes(fine).map(|elements| on("GMRES", Method::Gmres, elements)));
    tasks.extend(meshes(coarse).map(|elements| on("full matrix", Method::Matrix, elements)));
    tasks.extend(meshes(coarse).map(hemicube));
    tasks.extend(levels(plan));
    tasks.extend(qualities(plan));
    tasks
}

/// Half a decade finer from step to step; the last takes a minute.
fn levels(plan: &Plan) -> impl Iterator<Item = Task> {
    let errors = [("10 %", 0.1), ("3 %", 0.03), ("1 %", 0.01), ("0.3 %", 0.003)];
    let task = |(name, error): (&str, f64)| Task {
        series: LEVELS,
        setting: format!("--error {name}"),
        options: Options { method: Method::Hierarchical, error, ..Options::default() },
    };
    errors.into_iter().take(if plan.quick { 3 } else { 4 }).map(task)
}

/// Meshes as `--quality` names them; high takes minutes.
fn qualities(plan: &Plan) -> impl Iterator<Item = Task> {
    let all = [("draft", Quality::Draft), ("normal", Quality::Normal), ("high", Quality::High)];
    let task = |(name, quality): (&str, Quality)| Task {
        series: QUALITIES,
        setting: name.to_owned(),
        options: Options { method: Method::Mesh, ..quality.options() },
    };
    all.into_iter().take(if plan.quick { 2 } else { 3 }).map(task)
}

/// Four times as many paths a face from step to step.
fn paths(plan: &Plan) -> impl Iterator<Item = u32> {
    (4..=if plan.quick { 7 } else { 10 }).map(|power| 4_u32.pow(power))
}

/// A scene with what its faces receive.
struct Subject<'s> {
    name: &'s str,
    scene: &'s Scene,
    truth: Truth,
}

impl Subject<'_> {
    fn solved(&self, task: &Task) -> Result<Measured, Error> {
        let job: Job<'_, Result<Solution, Error>> =
            Box::new(|| solve(self.scene, &task.options, |_| ControlFlow::Continue(())));
        let (solution, time) = interleaved(&[job], Rounds::ONCE).remove(0);
        let solution = solution?;
        let (series, elements) = (task.series, solution.mesh.elements.len());
        let setting = if [QUALITIES, LEVELS].contains(&series) {
            format!("{}, {elements} elements{}", task.setting, counts(&solution))
        } else {
            task.setting.clone()
        };
        let error = Deviation::of(&self.truth.deviations(&self.truth.received(self.scene, &solution)));
        let valid = Some(solution.converged);
        Ok(Measured { amount: elements as f64, valid, time, ..row(self.name, series, setting, error) })
    }

    /// So many paths from every face, each face with a sequence of its own.
    fn traced(&self, paths: u32) -> Measured {
        let tracer = PathTracer::new(self.scene);
        let faces: Vec<&[usize]> = self.truth.faces().collect();
        let job: Job<'_, Vec<[f64; 3]>> = Box::new(|| {
            let face = |(index, patches): (usize, &&[usize])| tracer.irradiance(patches, paths, index as u64);
            faces.par_iter().enumerate().map(face).collect()
        });
        let (found, time) = interleaved(&[job], Rounds::ONCE).remove(0);
        let error = Deviation::of(&self.truth.deviations(&found));
        Measured {
            amount: f64::from(paths),
            time,
            ..row(self.name, PATHS, format!("{paths} paths a face"), error)
        }
    }

    /// So many paths from every face in each run, by Mitsuba; no rows where that fails.
    fn traced_by_mitsuba(&self, paths: Vec<u32>) -> Vec<Measured> {
        let faces: Vec<&[usize]> = self.truth.faces().collect();
        let traced = mitsuba::trace(self.scene, &faces, paths.clone()).unwrap_or_default();
        let row = |(paths, traced): (u32, Traced)| Measured {
            amount: f64::from(paths),
            time: once([traced.cpu, traced.wall]),
            ..row(
                self.name,
                MITSUBA,
                format!("{paths} paths a face"),
                Deviation::of(&self.truth.deviations(&traced.irradiance)),
            )
        };
        paths.into_iter().zip(traced).map(row).collect()
    }
}

/// How light was taken between parts of patches, by levels.
fn counts(solution: &Solution) -> String {
    solution.transfers.map_or_else(String::new, |Transfers { none, clusters, open, occluded, totals }| {
        format!(
            "; {open} links with nothing in between, {occluded} past others, {clusters} pairs by clusters, \
             {none} with nothing to exchange, {totals} known in all"
        )
    })
}

fn row(subject: &str, series: &str, setting: String, error: Deviation) -> Measured {
    Measured {
        chapter: Chapter::Solutions,
        subject: subject.to_owned(),
        series: series.to_owned(),
        setting,
        amount: 0.0,
        error,
        certified: false,
        bound: None,
        defect: None,
        points: None,
        in_part: None,
        valid: None,
        time: Time::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity::scenes;

    #[test]
    fn more_elements_and_more_paths_come_nearer_to_the_truth() {
        for name in ["cornell-box", "separating-wall"] {
            let scene = &scenes::scene(name).unwrap();
            let subject = Subject { name, scene, truth: Truth::of(name, scene).unwrap() };
            let task = |elements: usize| Task {
                series: "shooting",
                setting: String::new(),
                options: Options::mesh(elements),
            };
            let [coarse, fine] = [150, 1200].map(|elements| subject.solved(&task(elements)).unwrap());
            let [few, many] = [64, 16_384].map(|paths| subject.traced(paths));
            for [worse, better] in [[&coarse, &fine], [&few, &many]] {
                assert!(better.error.mean < worse.error.mean / 1.5, "{worse:?} {better:?}");
            }
            assert!(fine.error.mean < 0.03 && many.error.mean < 0.01, "{fine:?} {many:?}");
            assert_eq!((fine.valid, fine.certified), (Some(true), false));
        }
    }

    /// Where Python has Mitsuba: it knows nothing of this project, and finds the light of the references.
    #[test]
    fn mitsuba_comes_nearer_to_the_truth_with_more_paths() {
        if !mitsuba::is_present() {
            return;
        }
        for name in ["cornell-box", "separating-wall"] {
            let scene = &scenes::scene(name).unwrap();
            let subject = Subject { name, scene, truth: Truth::of(name, scene).unwrap() };
            let rows = subject.traced_by_mitsuba(vec![4096, 65_536]);
            let [few, many] = rows.as_slice() else { panic!("{name}: Mitsuba failed") };
            assert!(
                many.error.mean < few.error.mean / 2.0 && many.error.mean < 0.04,
                "{name}: {few:?} {many:?}"
            );
        }
    }

    #[test]
    fn nothing_is_measured_where_no_truth_is_known() {
        let furnace = ("furnace".to_owned(), scenes::scene("furnace").unwrap());
        let plan = Plan { scenes: vec![furnace], quick: true, general: false };
        assert!(measure(&plan, |_| ()).unwrap().is_empty() && noise(&plan).is_empty());
    }
}
