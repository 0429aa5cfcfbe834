//! Scenes of few polygons.
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Options, Patch, Scene, Solution, glam::DVec3, solve};
use std::{f64::consts::PI, ops::ControlFlow};

/// A polygon of one loop.
pub(crate) fn polygon(corners: &[[f64; 3]]) -> PlanarPolygon {
    PlanarPolygon::new([corners.iter().map(|&corner| DVec3::from(corner)).collect::<Vec<_>>()])
        .expect("planar")
}

/// A patch of one band; `emittance` is E, in W/m².
pub(crate) fn patch(
    name: impl Into<String>,
    corners: &[[f64; 3]],
    reflectance: f64,
    emittance: f64,
) -> Patch {
    Patch::new(name, polygon(corners), vec![reflectance], vec![emittance / PI])
}

/// A scene of one band.
pub(crate) fn scene(patches: Vec<Patch>) -> Scene {
    Scene { patches, bands: 1, ..Scene::default() }
}

/// The faces of a box, seen from inside, each cut in `n` × `n` patches.
pub(crate) fn room(low: [f64; 3], high: [f64; 3], n: usize, reflectance: f64, emittance: f64) -> Vec<Patch> {
    let mut patches = Vec::new();
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for upper in [false, true] {
            let place = |i: usize, j: usize| {
                let mut corner = [0.0; 3];
                corner[axis] = if upper { high[axis] } else { low[axis] };
                corner[u] = low[u] + (high[u] - low[u]) * (i as f64 / n as f64);
                corner[v] = low[v] + (high[v] - low[v]) * (j as f64 / n as f64);
                corner
            };
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let mut corners = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
                if upper {
                    corners.reverse();
                }
                let name = format!("{}{axis}-{i}-{j}", if upper { "upper" } else { "lower" });
                patches.push(patch(name, &corners, reflectance, emittance));
            }
        }
    }
    patches
}

/// A cube of side 1.
pub(crate) fn cube(n: usize, reflectance: f64, emittance: f64) -> Scene {
    scene(room([0.0; 3], [1.0; 3], n, reflectance, emittance))
}

/// Solved to the end.
pub(crate) fn solved(scene: &Scene, options: &Options) -> Solution {
    solve(scene, options, |_| ControlFlow::Continue(())).expect("a solution")
}
