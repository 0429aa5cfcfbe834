//! The Cornell box against path tracing, at every quality.

use radiosity::glam::DVec2;
use radiosity::{Method, Options, Quality, Solution, io::collada::Collada, solve};
use std::ops::ControlFlow;
use std::path::Path;

/// Mean irradiance in RGB by path tracing that samples the emitter at each vertex, 3 million paths a face in red, 1.5 million in green and
/// blue, and one standard error of each.
const REFERENCE: [(&str, [f64; 3], [f64; 3]); 15] = [
    ("floor", [0.48287, 0.32786, 0.09268], [0.00026, 0.00026, 0.00008]),
    ("back", [0.73276, 0.49069, 0.13809], [0.00029, 0.00028, 0.00008]),
    ("right", [0.78971, 0.53321, 0.15855], [0.00028, 0.00026, 0.00008]),
    ("left", [0.70241, 0.45387, 0.13563], [0.00032, 0.00030, 0.00009]),
    ("short-top", [1.37391, 0.98230, 0.30093], [0.00025, 0.00023, 0.00007]),
    ("short-1", [0.46506, 0.23902, 0.07111], [0.00019, 0.00017, 0.00005]),
    ("short-2", [0.05936, 0.02634, 0.00741], [0.00010, 0.00007, 0.00002]),
    ("short-3", [0.07767, 0.14030, 0.01184], [0.00007, 0.00011, 0.00002]),
    ("short-4", [0.42589, 0.36797, 0.08115], [0.00019, 0.00016, 0.00005]),
    ("tall-top", [3.15256, 2.12575, 0.69089], [0.00065, 0.00065, 0.00021]),
    ("tall-1", [0.36537, 0.03617, 0.00929], [0.00020, 0.00006, 0.00002]),
    ("tall-2", [0.42927, 0.21125, 0.05765], [0.00021, 0.00019, 0.00005]),
    ("tall-3", [0.40027, 0.36476, 0.07567], [0.00020, 0.00017, 0.00006]),
    ("tall-4", [0.34399, 0.21801, 0.06113], [0.00021, 0.00019, 0.00006]),
    ("ceiling", [0.43989, 0.26831, 0.06567], [0.00035, 0.00033, 0.00010]),
];

fn cornell(options: &Options) -> (radiosity::Scene, Solution) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/cornell-box.dae");
    let scene = Collada::open(&path).and_then(|file| file.scene()).expect("the committed scene");
    let solution = solve(&scene, options, |_| ControlFlow::Continue(())).expect("a solution");
    (scene, solution)
}

/// Mean irradiance of a face: of the patch of that name, or of its pieces `name.k`.
fn irradiance(scene: &radiosity::Scene, solution: &Solution, face: &str) -> [f64; 3] {
    let means = solution.patch_means(&solution.irradiance, scene.patches.len());
    let (mut sum, mut area) = ([0.0; 3], 0.0);
    for (patch, mean) in scene.patches.iter().zip(means) {
        if patch.name == face || patch.name.starts_with(&format!("{face}.")) {
            let a = patch.polygon.area();
            area += a;
            (0..3).for_each(|band| sum[band] += a * mean[band]);
        }
    }
    sum.map(|s| s / area)
}

/// The largest deviation of a face's mean irradiance from the reference beyond three of its standard errors, as a share;
/// and the root of the mean square deviation.
fn deviation(scene: &radiosity::Scene, solution: &Solution) -> (f64, f64) {
    let (mut worst, mut squares) = (0.0f64, 0.0);
    for (face, reference, errors) in REFERENCE {
        let found = irradiance(scene, solution, face);
        for band in 0..3 {
            let noise = errors[band] / reference[band];
            let off = (found[band] / reference[band] - 1.0).abs();
            worst = worst.max(off - 3.0 * noise);
            squares += off * off / (3 * REFERENCE.len()) as f64;
        }
    }
    (worst, squares.sqrt())
}

#[test]
fn on_a_mesh_every_face_receives_about_what_path_tracing_finds() {
    let [draft, normal] = [Quality::Draft, Quality::Normal]
        .map(|quality| cornell(&Options { method: Method::Mesh, ..quality.options() }));
    let (worst_draft, draft_error) = deviation(&draft.0, &draft.1);
    let (worst, error) = deviation(&normal.0, &normal.1);
    // The dark front of the short block, which elements next to the floor see too coarsely.
    assert!(worst_draft < 0.25, "{worst_draft}");
    assert!(worst < 0.09, "{worst}");
    assert!(error < draft_error, "{error} {draft_error}");
    assert!(draft.1.converged && normal.1.converged);
    let ledger = &normal.1.ledger;
    for band in 0..3 {
        assert!(ledger.defect[band].abs() < 1e-9 * ledger.emitted[band]);
    }
}

#[test]
fn by_levels_every_face_is_within_1_percent_by_default() {
    let by_levels = |error| cornell(&Options { error, ..Options::default() });
    // At 3 % the dark side of the short block is further off than was asked for.
    let [draft, normal] = [(3e-2, 7e-2), (1e-2, 1e-2)].map(|(error, most)| {
        let (scene, solution) = by_levels(error);
        let (worst, root_mean_square) = deviation(&scene, &solution);
        assert!(solution.converged && worst < most, "{worst} at {error}");
        root_mean_square
    });
    assert!(normal < 5e-3 && normal < draft, "{normal} {draft}");
}

#[test]
#[ignore = "takes minutes: cargo test --release -p radiosity --test cornell -- --ignored"]
fn on_a_mesh_of_high_quality_every_face_is_within_half_a_percent() {
    let [normal, high] = [Quality::Normal, Quality::High]
        .map(|quality| cornell(&Options { method: Method::Mesh, ..quality.options() }));
    let (_, normal) = deviation(&normal.0, &normal.1);
    let (worst, error) = deviation(&high.0, &high.1);
    println!("normal {normal:.5}, high {error:.5}, worst beyond the noise {worst:.5}");
    assert!(worst < 0.005, "{worst}");
    assert!(error < normal + 1e-3, "what is left is the reference's noise: {error} {normal}");
}

#[test]
fn nothing_shines_under_the_blocks() {
    let [mesh, levels] = [Options::mesh(1500), Options { error: 3e-2, ..Options::default() }];
    for options in [mesh, levels] {
        assert_dark_under_the_short_block(&options);
    }
}

fn assert_dark_under_the_short_block(options: &Options) {
    let (scene, solution) = cornell(options);
    // The short block's footprint, in x and z, turning left.
    let footprint = [[130.0, 65.0], [290.0, 114.0], [240.0, 272.0], [82.0, 225.0]].map(DVec2::from);
    let dark = (0..solution.mesh.elements.len()).filter(|&element| {
        let c = solution.mesh.centroid(element);
        let is_left = |k: usize| {
            let (start, end) = (footprint[k], footprint[(k + 1) % 4]);
            (end - start).perp_dot(DVec2::new(c.x, c.z) - start) > 0.0
        };
        scene.patches[solution.mesh.elements[element].patch].name == "floor" && (0..4).all(is_left)
    });
    let mut count = 0;
    for element in dark {
        count += 1;
        assert!(solution.irradiance[element * 3..][..3].iter().all(|&h| h < 1e-12));
    }
    assert!(count > 0);
}
