//! From elements to vertices: what is shared, what is not, and the final gather.
use crate::build::{cube, patch, scene, solved};
use radiosity::formfactor::{DifferentialArea, Enclosure};
use radiosity::glam::DVec3;
use radiosity::{Options, Scene};
use std::f64::consts::PI;

/// A floor with a lamp above it and a board between, at some height.
fn soft_shadow(height: f64) -> Scene {
    let square = |x: f64, side: f64, z: f64| {
        [[x - side, side, z], [x + side, side, z], [x + side, -side, z], [x - side, -side, z]]
    };
    let mut floor = square(0.0, 2.0, 0.0);
    floor.reverse();
    scene(vec![
        patch("floor", &floor, 0.5, 0.0),
        patch("lamp", &square(0.1, 0.4, 2.0), 0.0, 10.0),
        patch("board", &square(0.3, 0.3, height), 0.0, 0.0),
    ])
}

#[test]
fn gathered_light_is_exact_at_the_vertices() {
    let scene = soft_shadow(0.9);
    // Nothing but the lamp sends light to the floor, so that all its light is direct.
    let options = Options { gather: true, ..Options::mesh(300) };
    let solution = solved(&scene, &options);
    let [irradiance, radiosity] = [solution.vertex_irradiance(), solution.vertex_radiosity()];
    let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
    let mut worst = 0.0f64;
    for (vertex, place) in solution.mesh.vertices.iter().enumerate().filter(|(_, place)| place.z == 0.0) {
        let from = DifferentialArea::new(*place, DVec3::Z).expect("a point").owned_by(0);
        let exact = 10.0 * enclosure.form_factor(&from, 1).value;
        worst = worst.max((irradiance[vertex] - exact).abs());
        assert!((radiosity[vertex] - 0.5 * irradiance[vertex]).abs() < 1e-12);
    }
    // Vertices are moved inwards by a thousandth of a step.
    assert!(worst < 1e-3, "{worst}");
    let mean = solved(&scene, &Options { gather: false, ..options }).vertex_irradiance();
    let coarse = mean.iter().zip(&irradiance).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(coarse > 10.0 * worst, "means over elements are further off: {coarse}");
}

/// A ridge of two slopes under a lamp; the slopes share an edge along y.
fn ridge() -> Scene {
    scene(vec![
        patch("west", &[[-1., 0., 0.], [0., 0., 0.3], [0., 2., 0.3], [-1., 2., 0.]], 0.5, 0.0),
        patch("east", &[[0., 0., 0.3], [1., 0., 0.], [1., 2., 0.], [0., 2., 0.3]], 0.5, 0.0),
        patch("lamp", &[[-3., 2., 2.], [-2., 2., 2.], [-2., 0., 2.], [-3., 0., 2.]], 0.0, 10.0),
    ])
}

/// The irradiances at the vertices on the ridge, of each slope, by y.
fn on_ridge(scene: &Scene) -> [Vec<f64>; 2] {
    let solution = solved(scene, &Options::mesh(400));
    let light = solution.vertex_irradiance();
    [0, 1].map(|slope| {
        let elements = solution.mesh.elements.iter().filter(|element| element.patch == slope);
        let mut found: Vec<_> = elements
            .flat_map(|element| element.corners)
            .filter(|&corner| solution.mesh.vertices[corner].x.abs() < 1e-9)
            .map(|corner| (solution.mesh.vertices[corner].y, light[corner]))
            .collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.dedup();
        found.into_iter().map(|(_, light)| light).collect()
    })
}

#[test]
fn facets_share_light_only_within_one_object_and_smoothing_group() {
    let [west, east] = on_ridge(&ridge());
    assert!(west.len() > 3 && west.len() == east.len());
    assert!(west.iter().zip(&east).all(|(w, e)| *w > 1.2 * *e), "flat facets keep their own light");
    let smooth = |instances: [usize; 2], groups: [Option<usize>; 2]| {
        let mut scene = ridge();
        for facet in 0..2 {
            scene.patches[facet].smoothing = groups[facet];
            scene.patches[facet].origin.instance = instances[facet];
        }
        on_ridge(&scene)
    };
    let [west_smooth, east_smooth] = smooth([1, 1], [Some(0), Some(0)]);
    assert_eq!(west_smooth, east_smooth);
    for ((smooth, w), e) in west_smooth.iter().zip(&west).zip(&east) {
        assert!((e..=w).contains(&smooth));
    }
    assert_eq!(
        smooth([1, 2], [Some(0), Some(0)]),
        [west.clone(), east.clone()],
        "other objects do not share"
    );
    assert_eq!(smooth([1, 1], [Some(0), Some(1)]), [west, east], "nor do other groups");
}

#[test]
fn the_estimate_is_zero_where_light_is_even_and_falls_with_the_mesh() {
    use radiosity::Norm;
    for norm in [Norm::Gradient, Norm::L1, Norm::L2, Norm::LInfinity] {
        let worst = |scene: &Scene, elements: usize| {
            let options = Options { tolerance: 1e-9, ..Options::mesh(elements) };
            solved(scene, &options).error_estimate(norm).into_iter().fold(0.0, f64::max)
        };
        assert!(worst(&cube(1, 0.5, 0.5 * PI), 200) < 1e-6, "{norm:?}");
        let [coarse, fine] = [200, 3200].map(|elements| worst(&soft_shadow(0.9), elements));
        assert!(fine < coarse, "{norm:?}: {coarse} {fine}");
    }
}

#[test]
fn finer_cells_go_where_the_shadow_is() {
    let scene = soft_shadow(0.1);
    let options = Options { passes: 2, ..Options::mesh(1500) };
    let even = solved(&scene, &Options { passes: 0, ..options.clone() });
    let adapted = solved(&scene, &options);
    assert!(
        (0.6..1.6).contains(&(adapted.mesh.elements.len() as f64 / 1500.0)),
        "{}",
        adapted.mesh.elements.len()
    );
    let error = |solution: &radiosity::Solution| {
        let squares = solution.error_estimate(radiosity::Norm::L2).into_iter().map(|e| e * e);
        squares.sum::<f64>().sqrt()
    };
    assert!(error(&adapted) < 0.7 * error(&even), "{} {}", error(&adapted), error(&even));
}
