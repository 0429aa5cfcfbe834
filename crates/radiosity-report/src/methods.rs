//! The methods, each over the range of its settings.
use crate::plan::Plan;
use formfactor::approx::{
    Baum, Disk, Division, Exact, Hemicube, Method, MonteCarlo, Paraboloid, Pietrek, Sampling, SinglePlane,
    VisibilityIndex, Wallace,
};

/// A method at one setting.
pub(crate) struct Step {
    pub(crate) series: &'static str,
    pub(crate) setting: String,
    pub(crate) amount: f64,
    pub(crate) method: Box<dyn Method + Sync>,
}

/// The name of the exact method's series.
pub(crate) const EXACT: &str = "exact";
/// Where a part counts as near, for those methods that have such a limit: at its own diameter twice over.
const NEAR: f64 = 0.5;
/// Half the width of the single plane: what passes below its rim is at most 1 / 1601 of the view.
const WIDE: f64 = 40.0;

/// All settings of all methods: four steps and more of each, from cheap to dear.
pub(crate) fn steps(plan: &Plan) -> Vec<Step> {
    let up_to = |quick: u32, full: u32| if plan.quick { quick } else { full };
    let mut steps = vec![step(EXACT, "", 1.0, Exact), step("disk", "", 1.0, Disk)];
    for n in doubled(1, up_to(16, 32)) {
        let division = Division::Uniform(n);
        steps.push(step("Wallace", &format!("{n} × {n} parts"), n, Wallace { division }));
        steps.push(step("Pietrek", &format!("{n} × {n} parts"), n, Pietrek { division, near: NEAR }));
    }
    for depth in 0..=up_to(6, 8) {
        let index = |samples| VisibilityIndex { near: NEAR, samples, depth };
        steps.push(step("visibility index, 4 × 4 rays", &format!("depth {depth}"), depth, index(4)));
        steps.push(step("visibility index, 8 × 8 rays", &format!("depth {depth}"), depth, index(8)));
    }
    for cells in doubled(16, up_to(256, 1024)) {
        let hemicube = Hemicube::new(cells);
        let divisions = cells / 8;
        let baum = Baum { hemicube: hemicube.clone(), near: NEAR, divisions };
        steps.push(step("hemicube", &format!("{cells} × {cells} cells"), cells, hemicube));
        steps.push(step("Baum", &format!("{cells} cells, {divisions} × {divisions} parts"), cells, baum));
    }
    for cells in doubled(16, up_to(128, 512)) {
        let name = format!("{cells} × {cells} cells");
        steps.push(step("paraboloid", &name, cells, Paraboloid::new(cells)));
    }
    for digits in 1..=up_to(4, 6) {
        let smallest = 0.1_f64.powf(f64::from(digits));
        let plane = SinglePlane { half_width: WIDE, smallest };
        steps.push(step("single plane", &format!("cells to {smallest:.0e}"), digits, plane));
    }
    for power in 3..=up_to(6, 8) {
        let rays = 4_u32.pow(power);
        for (series, sampling) in
            [("rays, random", Sampling::Random), ("rays, stratified", Sampling::Stratified)]
        {
            steps.push(step(series, &format!("{rays} rays"), rays, MonteCarlo { rays, sampling, seed: 1 }));
        }
    }
    steps
}

/// One step of each method, for the axes of stress: what costs about a millisecond a point.
pub(crate) fn middle(plan: &Plan) -> Vec<Step> {
    let cells = if plan.quick { 64 } else { 256 };
    let division = Division::Uniform(16);
    let index = VisibilityIndex { near: NEAR, samples: 4, depth: 6 };
    let rays = MonteCarlo { rays: 4096, sampling: Sampling::Stratified, seed: 1 };
    let plane = SinglePlane { half_width: WIDE, smallest: 1e-4 };
    vec![
        step(EXACT, "", 1.0, Exact),
        step("Pietrek", "16 × 16 parts", 16, Pietrek { division, near: NEAR }),
        step("visibility index, 4 × 4 rays", "depth 6", 6, index),
        step("hemicube", &format!("{cells} × {cells} cells"), cells, Hemicube::new(cells)),
        step("single plane", "cells to 1e-4", 4, plane),
        step("rays, stratified", "4096 rays", 4096, rays),
    ]
}

fn step(
    series: &'static str,
    setting: &str,
    amount: impl Into<f64>,
    method: impl Method + Sync + 'static,
) -> Step {
    Step { series, setting: setting.to_owned(), amount: amount.into(), method: Box::new(method) }
}

/// `low`, 2 `low`, … `high`.
fn doubled(low: u32, high: u32) -> impl Iterator<Item = u32> {
    std::iter::successors(Some(low), |n| Some(2 * n)).take_while(move |n| *n <= high)
}
