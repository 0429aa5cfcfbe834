//! The tables of the sources, measured anew.
//!
//! Barreto (2008), tables 4.1 to 4.5: progressive radiosity with exact form factors against the visibility index. Here
//! both solve the same elements, shooting from whole patches, and the error is that of the light against the exact one.
//! Gomes (2010), tables 5.1 and 5.2: time and memory; here exact factors against hemicubes, errors by
//! [`compare`].
use super::test_scene::TestScene;
use crate::clock::{Job, interleaved};
use crate::plan::{Plan, Rounds};
use crate::rows::Published;
use formfactor::approx::{Exact, Method, VisibilityIndex};
use radiosity::compare::{Difference, compare};
use radiosity::{Element, Error, Method as Solver, Options, Record, Scene, State, scenes, solve_from};
use rayon::prelude::*;
use std::{f64::consts::PI, ops::ControlFlow};

/// Number of the table, scene, elements, and what was printed of the exact method and of the visibility index.
pub(crate) const BARRETO: [(&str, &str, usize, [&str; 2]); 5] = [
    ("4.1", "emission", 4770, ["4770 elements, 5040 vertices, 62.203 s", "4767, 5037, 64.75 s"]),
    ("4.2", "obstruction", 3035, ["3035 elements, 3295 vertices, 147.235 s", "3656, 3988, 338.047 s"]),
    ("4.3", "beams", 18_716, ["18716 elements, 19977 vertices, 99.145 s", "18644, 19929, 197.047 s"]),
    ("4.4", "small-occluders", 3684, ["3684 elements, 3959 vertices, 42.235 s", "3711, 3968, 150.391 s"]),
    ("4.5", "perforated-cut", 3684, ["repeats 4.4: a slip", "repeats 4.4: a slip"]),
];
/// Scene, elements, and what was printed: time and memory with lists of factors, and with a map.
const GOMES: [(&str, usize, &str); 3] = [
    ("wall", 4098, "4098 elements; list 3.7 min, 216 MB; map 157.1 min, 137 MB"),
    ("chessboard", 2130, "2130 elements; list 1.18 min, 28 MB; map 4.2 min, 24 MB"),
    ("cornell-3842", 3842, "3842 elements; list 7.4 min, 325 MB; map 264.9 min, 198 MB"),
];
/// How many of the elements a quick report has: one in so many, and no more than these.
const QUICK: [usize; 2] = [16, 300];

/// The rows of all tables whose scene is asked for.
pub(crate) fn measure(plan: &Plan, mut say: impl FnMut(&str)) -> Result<Vec<Published>, Error> {
    let asked = |name: &str| plan.scenes.iter().any(|(asked, _)| asked == name);
    let mut rows = Vec::new();
    for (table, name, elements, printed) in BARRETO.into_iter().filter(|(_, name, ..)| asked(name)) {
        say(&format!("table {table}: {name}"));
        let scene = scenes::scene(name).expect("a built-in scene");
        rows.extend(barreto(table, name, &scene, elements_of(plan, elements), printed)?);
    }
    for (name, elements, printed) in GOMES.into_iter().filter(|(name, ..)| asked(name)) {
        let scene = scenes::scene(name).expect("a built-in scene");
        if plan.quick && scene.patches.len() > elements_of(plan, elements) {
            // What comes as thousands of patches cannot be solved with fewer elements.
            continue;
        }
        say(&format!("tables 5.1 and 5.2: {name}"));
        rows.extend(gomes(plan, name, &scene, elements_of(plan, elements), printed)?);
    }
    Ok(rows)
}

/// All elements of a table, or those of a quick report.
fn elements_of(plan: &Plan, printed: usize) -> usize {
    let [share, most] = QUICK;
    if plan.quick { (printed / share).min(most) } else { printed }
}

/// The exact method and the visibility index on one mesh.
fn barreto(
    table: &'static str,
    name: &'static str,
    scene: &Scene,
    elements: usize,
    printed: [&'static str; 2],
) -> Result<[Published; 2], Error> {
    let test_scene = TestScene::new(name, scene, elements)?;
    let methods: [&(dyn Method + Sync); 2] = [&Exact, &VisibilityIndex { near: 0.5, samples: 4, depth: 6 }];
    let on = &test_scene;
    let job = |method| -> Job<'_, Vec<f64>> { Box::new(move || shot(on, method)) };
    let found = interleaved(&methods.map(job), Rounds::ONCE);
    let exact = found[0].0.clone();
    let row = |side: usize| Published {
        table,
        scene: name,
        method: methods[side].name(),
        published: printed[side],
        elements: test_scene.mesh.elements.len(),
        vertices: test_scene.mesh.vertices.len(),
        seconds: found[side].1.cpu.median,
        bytes: None,
        errors: deviations(&found[side].0, &exact, &test_scene),
    };
    Ok([row(0), row(1)])
}

/// Reflected light of every element, first band: patches shoot, the brightest first, elements receive.
fn shot(test_scene: &TestScene<'_>, method: &(dyn Method + Sync)) -> Vec<f64> {
    let patches = &test_scene.scene.patches;
    let targets: Vec<usize> = (0..patches.len()).collect();
    let rows: Vec<Vec<f64>> =
        test_scene.points.par_iter().map(|from| method.row(&test_scene.enclosure, from, &targets)).collect();
    let areas: Vec<f64> = patches.iter().map(|patch| patch.polygon.area()).collect();
    let mut sent = vec![0.0; patches.len()];
    let mut unshot: Vec<f64> = patches.iter().map(|patch| PI * patch.emission[0]).collect();
    let emitted: f64 = unshot.iter().zip(&areas).map(|(light, area)| light * area).sum();
    let brightest = |unshot: &[f64]| {
        let power = |patch: &usize| unshot[*patch] * areas[*patch];
        (0..unshot.len()).max_by(|a, b| power(a).total_cmp(&power(b))).unwrap_or(0)
    };
    let mut shooter = brightest(&unshot);
    while unshot[shooter] * areas[shooter] > 1e-6 * emitted {
        let light = std::mem::take(&mut unshot[shooter]);
        sent[shooter] += light;
        for (index, row) in rows.iter().enumerate() {
            let patch = test_scene.mesh.elements[index].patch;
            let share = test_scene.mesh.area(index) / areas[patch];
            unshot[patch] += share * patches[patch].reflectance[0] * row[shooter] * light;
        }
        shooter = brightest(&unshot);
    }
    let reflected = |(row, element): (&Vec<f64>, &Element)| {
        let falls: f64 = row.iter().zip(&sent).map(|(factor, light)| factor * light).sum();
        patches[element.patch].reflectance[0] * falls
    };
    rows.iter().zip(&test_scene.mesh.elements).map(reflected).collect()
}

/// The largest and the mean deviation, both in shares of the largest and of the mean light.
fn deviations(light: &[f64], exact: &[f64], test_scene: &TestScene<'_>) -> [f64; 2] {
    let areas = || (0..exact.len()).map(|element| test_scene.mesh.area(element));
    let off: Vec<f64> = light.iter().zip(exact).map(|(a, b)| (a - b).abs()).collect();
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let mean = |values: &[f64]| values.iter().zip(areas()).map(|(value, area)| value * area).sum::<f64>();
    [largest(&off) / largest(exact), mean(&off) / mean(exact)]
}

/// Exact factors and hemicubes of one mesh, by the solver.
fn gomes(
    plan: &Plan,
    name: &'static str,
    scene: &Scene,
    elements: usize,
    printed: &'static str,
) -> Result<[Published; 2], Error> {
    let cells = if plan.quick { 64 } else { 512 };
    // What comes in that many patches is not cut.
    let elements = if scene.patches.len() < elements { elements } else { 1 };
    let exact = Options { method: Solver::Shoot, elements, ..Options::default() };
    let all = [exact.clone(), Options { hemicube: Some(cells), ..exact }];
    let job = |options: Options| -> Job<'_, Result<_, Error>> {
        Box::new(move || {
            let mut state = State::default();
            let solution = solve_from(scene, &options, &mut state, |_| ControlFlow::Continue(()))?;
            Ok((solution, state.to_bytes().len()))
        })
    };
    let [one, other]: [_; 2] = all.map(|options| interleaved(&[job(options)], Rounds::ONCE).remove(0));
    let (solved, approximate) = (one.0?, other.0?);
    let [reference, hemicubes] =
        [&solved.0, &approximate.0].map(|solution| Record::new(name, scene, solution));
    let off = compare(&hemicubes, &reference).expect("two solutions of one scene");
    let most = |norm: fn(&Difference) -> f64| off.bands.iter().map(norm).fold(0.0, f64::max);
    let row = |method: String, bytes, seconds, errors| Published {
        table: "5.1, 5.2",
        scene: name,
        method,
        published: printed,
        elements: reference.elements.len(),
        vertices: reference.vertices.len(),
        seconds,
        bytes: Some(bytes),
        errors,
    };
    let errors = [most(|band| band.max), most(|band| band.l1)];
    Ok([
        row("exact".to_owned(), solved.1, one.1.cpu.median, [0.0; 2]),
        row(format!("hemicube, {cells} × {cells} cells"), approximate.1, other.1.cpu.median, errors),
    ])
}
