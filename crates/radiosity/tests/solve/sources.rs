//! What the scenes of Barreto (2008) and Gomes (2010) are there to show.
use crate::build::solved;
use radiosity::formfactor::{DifferentialArea, unoccluded};
use radiosity::glam::DVec3;
use radiosity::{Method, Options, Scene, Solution, scenes};
use std::f64::consts::PI;

fn scene(name: &str) -> Scene {
    scenes::scene(name).expect("a built-in scene")
}

/// The same scene, its patches black, so that all light is straight from the lamps.
fn black(name: &str) -> Scene {
    let mut scene = scene(name);
    scene.patches.iter_mut().for_each(|patch| patch.reflectance.fill(0.0));
    scene
}

/// Exact direct irradiance, first band, at the vertices of a patch that lie inside it.
fn direct(scene: &Scene, patch: usize, elements: usize) -> Vec<(DVec3, f64)> {
    let solution = solved(scene, &Options { gather: true, tolerance: 1e-9, ..Options::mesh(elements) });
    let light = solution.vertex_irradiance();
    let inside = |place: DVec3| place.x.abs() < 4.99 && place.y.abs() < 4.99;
    let elements = solution.mesh.elements.iter().filter(|element| element.patch == patch);
    let mut vertices: Vec<usize> = elements.flat_map(|element| element.corners).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let places = vertices.iter().map(|&v| (solution.mesh.vertices[v], light[v * solution.bands]));
    places.filter(|(place, _)| inside(*place)).collect()
}

/// The light at the mirror image of every place in the plane x = 0.
fn mirrored(light: &[(DVec3, f64)]) -> Vec<(f64, f64)> {
    let image = |place: DVec3| {
        let found =
            light.iter().find(|(other, _)| (*other - place * DVec3::new(-1.0, 1.0, 1.0)).length() < 1e-9);
        found.map(|(_, light)| *light)
    };
    light.iter().filter_map(|&(place, here)| Some((here, image(place)?))).collect()
}

#[test]
fn a_lamp_gives_the_same_light_in_one_piece_and_in_a_hundred() {
    let pairs = mirrored(&direct(&black("emission"), 0, 600));
    assert!(pairs.len() > 60);
    for (here, there) in pairs {
        assert!((here - there).abs() <= 1e-12 * here, "{here} {there}");
    }
}

#[test]
fn two_obstructed_lamps_cast_two_mirrored_shadows() {
    let light = direct(&black("obstruction"), 0, 600);
    let pairs = mirrored(&light);
    assert!(pairs.len() > 60);
    for (here, there) in pairs {
        assert!((here - there).abs() <= 1e-12 * here, "{here} {there}");
    }
    let open = direct(&black("emission"), 0, 600);
    let hidden = |(place, here): &&(DVec3, f64)| {
        open.iter().any(|(other, free)| other.distance(*place) < 1e-9 && *here < 0.8 * free)
    };
    let shadows: Vec<_> = light.iter().filter(hidden).collect();
    assert!(
        shadows.iter().any(|(place, _)| place.x < -2.0) && shadows.iter().any(|(place, _)| place.x > 2.0)
    );
    assert!(shadows.iter().all(|(place, _)| place.x.abs() > 0.5), "and nothing between them");
}

#[test]
fn under_a_beam_that_rises_the_umbra_shrinks_and_the_penumbra_grows() {
    let light = direct(&black("beams"), 0, 3000);
    // Across the lower beam at y = 1, between the upper beams at x = -3 and x = 3 and beyond them.
    let profile = |x: f64| -> Vec<f64> {
        let near = light.iter().filter(|(p, _)| (p.x - x).abs() < 0.15 && (p.y - 1.0).abs() < 1.0);
        near.map(|(_, light)| *light).collect()
    };
    let contrast = |x: f64| {
        let profile = profile(x);
        let (low, high) = profile.iter().fold((f64::INFINITY, 0.0f64), |(l, h), v| (l.min(*v), h.max(*v)));
        low / high
    };
    assert!(contrast(-4.2) < 0.4, "dark under the low end: {}", contrast(-4.2));
    assert!(contrast(4.2) > contrast(-4.2) + 0.2, "brighter under the high end: {}", contrast(4.2));
}

#[test]
fn small_occluders_cast_mostly_penumbra() {
    let light = direct(&black("small-occluders"), 0, 1000);
    let lamp = scene("small-occluders").patches.into_iter().find(radiosity::Patch::emits).expect("a lamp");
    let free = |place: DVec3| {
        let from = DifferentialArea::new(place, DVec3::Z).expect("a point");
        PI * lamp.emission[0] * unoccluded(&from, &lamp.polygon).value
    };
    let shares: Vec<f64> = light.iter().map(|(place, light)| light / free(*place)).collect();
    assert!(shares.len() > 100);
    let partly = shares.iter().filter(|share| (0.02..0.98).contains(*share)).count();
    assert!(partly as f64 > 0.95 * shares.len() as f64, "{partly} of {}", shares.len());
}

#[test]
fn spots_lie_under_the_holes_and_the_panel_may_be_cut_in_rectangles() {
    let [whole, cut] = ["perforated", "perforated-cut"].map(|name| direct(&black(name), 0, 1600));
    assert!(whole.len() == cut.len() && whole.len() > 200);
    for ((place, here), (other, there)) in whole.iter().zip(&cut) {
        assert!(place.distance(*other) < 1e-9);
        assert!((here - there).abs() <= 1e-11 * here, "{here} {there} at {place}");
    }
    let at = |x: f64, y: f64| {
        let nearest = whole.iter().min_by(|a, b| {
            let far = |p: DVec3| (p - DVec3::new(x, y, 0.0)).length();
            far(a.0).total_cmp(&far(b.0))
        });
        nearest.map_or(0.0, |(_, light)| *light)
    };
    for hole in [(-2.2, -2.2), (0.0, 0.0), (2.2, 0.0)] {
        assert!(
            at(hole.0, hole.1)
                > 1.3 * at(hole.0 + 1.1, hole.1 + 1.1 * (1.0 - hole.1.abs() / 2.2) - 1.1 * hole.1 / 2.2)
        );
    }
}

/// Mean irradiance per band of a patch's elements that a condition picks.
fn mean(solution: &Solution, picked: impl Fn(usize, DVec3) -> bool) -> Vec<f64> {
    let (mut sum, mut area) = (vec![0.0; solution.bands], 0.0);
    for (index, element) in solution.mesh.elements.iter().enumerate() {
        if picked(element.patch, solution.mesh.centroid(index)) {
            area += solution.mesh.area(index);
            let light = &solution.irradiance[index * solution.bands..][..solution.bands];
            sum.iter_mut().zip(light).for_each(|(sum, h)| *sum += solution.mesh.area(index) * h);
        }
    }
    sum.iter().map(|sum| sum / area).collect()
}

#[test]
fn no_light_passes_the_separating_wall() {
    for method in [Method::Mesh, Method::Hierarchical] {
        assert_dark_behind_the_wall(&Options { elements: 800, method, ..Options::default() });
    }
}

fn assert_dark_behind_the_wall(options: &Options) {
    let scene = scene("separating-wall");
    let solution = solved(&scene, options);
    let light = solution.vertex_irradiance();
    let lit = light.iter().copied().fold(0.0, f64::max);
    let wall = scene.patches.iter().position(|patch| patch.name == "wall-east").expect("the wall");
    for (index, element) in solution.mesh.elements.iter().enumerate() {
        if solution.mesh.centroid(index).x > 2.0 || element.patch == wall {
            assert!(solution.irradiance[index * 3..][..3].iter().all(|h| *h == 0.0));
            assert!(element.corners.iter().all(|&corner| light[corner * 3] <= 1e-12 * lit));
        }
    }
    let dark = |patch: usize, _: DVec3| patch == wall;
    assert_eq!(mean(&solution, dark), [0.0; 3]);
}

#[test]
fn colours_bleed_on_the_white_floor() {
    let scene = scene("colour-bleeding");
    let coloured = |green: bool| {
        let wall = scene.patches.iter().find(|patch| {
            (patch.reflectance[1] > patch.reflectance[0]) == green
                && patch.reflectance[0] != patch.reflectance[1]
        });
        let corner = wall.and_then(|patch| patch.polygon.loops().flatten().next().copied());
        corner.expect("a coloured wall")
    };
    let solution = solved(&scene, &Options::mesh(800));
    let near = |wall: DVec3| {
        let x_wall = (wall.x - 1.0).abs() > (wall.y - 1.0).abs() || coloured(true).x != coloured(false).x;
        mean(&solution, |_, p| {
            p.z < 1e-9 && if x_wall { (p.x - wall.x).abs() < 0.4 } else { (p.y - wall.y).abs() < 0.4 }
        })
    };
    let (red, green) = (near(coloured(false)), near(coloured(true)));
    assert!(red[0] > 1.1 * red[1], "{red:?}");
    assert!(green[1] > 1.1 * green[0], "{green:?}");
}

#[test]
fn a_round_lamp_leaves_no_rings_on_the_plane() {
    let light = direct(&scene("sphere-lamp"), 0, 1500);
    let mut rings: Vec<(f64, f64)> = light.iter().map(|(p, light)| (p.x.hypot(p.y), *light)).collect();
    rings.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Away from under the lamp its light only falls: nothing brighter lies further out, but for the facets of the lamp.
    for window in rings.windows(12).filter(|window| window[0].0 + 0.05 < window[11].0) {
        assert!(window[11].1 < 1.01 * window[0].1, "{window:?}");
    }
}
