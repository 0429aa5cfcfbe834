//! Boxes whose faces are cut into tiles, each face in its own way: what edges share, and what light they have then.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod random;

use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::{DQuat, DVec3};
use radiosity::inspect::{Kind, inspect};
use radiosity::{Method, Options, Patch, Quality, Scene, repair, solve};
use random::Random;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Rectangles that cover the unit square: it is cut in two at a random place, and each part again.
fn tiles(random: &mut Random, [x0, y0, x1, y1]: [f64; 4], depth: usize) -> Vec<[f64; 4]> {
    if depth == 0 {
        return vec![[x0, y0, x1, y1]];
    }
    let share = random.within(0.2, 0.8);
    let parts = if random.next() < 0.5 {
        let x = x0 + share * (x1 - x0);
        [[x0, y0, x, y1], [x, y0, x1, y1]]
    } else {
        let y = y0 + share * (y1 - y0);
        [[x0, y0, x1, y], [x0, y, x1, y1]]
    };
    parts.into_iter().flat_map(|part| tiles(random, part, depth - 1)).collect()
}

/// A turned box with its faces turned in, of 48 tiles.
fn tiled_room(random: &mut Random) -> Scene {
    let turn = DQuat::from_scaled_axis(DVec3::new(random.next(), random.next(), random.next()));
    let size = DVec3::new(random.within(1.0, 4.0), random.within(1.0, 4.0), random.within(1.0, 4.0));
    let mut patches = Vec::new();
    for side in 0..6 {
        let axis = side / 2;
        for (number, [x0, y0, x1, y1]) in tiles(random, [0.0, 0.0, 1.0, 1.0], 3).into_iter().enumerate() {
            let place = |x: f64, y: f64| {
                let mut place = DVec3::ZERO;
                (place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]) =
                    (f64::from(u8::from(side % 2 == 1)), x, y);
                turn * (place * size)
            };
            let mut corners = [place(x0, y0), place(x1, y0), place(x1, y1), place(x0, y1)];
            if side % 2 == 1 {
                corners.reverse();
            }
            let polygon = PlanarPolygon::new([corners]).unwrap();
            patches.push(Patch::new(format!("{side}.{number}"), polygon, vec![0.5], vec![0.5]));
        }
    }
    Scene { patches, bands: 1, ..Scene::default() }
}

fn edges(patch: &Patch) -> Vec<[DVec3; 2]> {
    let rings = patch.polygon.loops();
    rings.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1))).map(|(a, b)| [*a, *b]).collect()
}

/// The edges that are not run along once each way.
fn open_edges(scene: &Scene) -> usize {
    let mut uses: BTreeMap<[[u64; 3]; 2], [usize; 2]> = BTreeMap::new();
    for [a, b] in scene.patches.iter().flat_map(edges) {
        let [a, b] = [a, b].map(|place| place.to_array().map(|number| (number + 0.0).to_bits()));
        uses.entry([a.min(b), a.max(b)]).or_default()[usize::from(a < b)] += 1;
    }
    uses.values().filter(|uses| **uses != [1, 1]).count()
}

/// The vertices that lie within an edge.
fn junctions(scene: &Scene) -> usize {
    let vertices = || scene.patches.iter().flat_map(|patch| patch.polygon.loops().flatten());
    let is_within = |[a, b]: [DVec3; 2], vertex: DVec3| {
        let length = a.distance(b);
        let detour = a.distance(vertex) + vertex.distance(b) - length;
        detour < 1e-12 && a.distance(vertex).min(b.distance(vertex)) > 1e-6
    };
    let edges = scene.patches.iter().flat_map(edges);
    edges.map(|edge| vertices().filter(|vertex| is_within(edge, **vertex)).count()).sum()
}

#[test]
fn neighbours_share_all_edges() {
    for seed in 0..50 {
        let room = tiled_room(&mut Random(seed));
        assert!(open_edges(&room) > 0 && junctions(&room) > 0, "{seed}");
        let repaired = repair(&room);
        let found = |kind| repaired.repairs.iter().filter(|finding| finding.kind == kind).count();
        assert_eq!(found(Kind::TJunction), repaired.repairs.len(), "{seed}: {:?}", repaired.repairs);
        assert!(found(Kind::TJunction) > 0, "{seed}");
        assert_eq!([open_edges(&repaired.scene), junctions(&repaired.scene)], [0, 0], "{seed}");
        for (before, after) in room.patches.iter().zip(&repaired.scene.patches) {
            assert_eq!(before.name, after.name);
            let [before, after] = [before, after].map(|patch| patch.polygon.area());
            assert!((after / before - 1.0).abs() < 1e-12, "{seed}: {before} {after}");
        }
        let again = repair(&repaired.scene);
        assert!(again.repairs.is_empty() && inspect(&repaired.scene).findings.is_empty(), "{seed}");
        for (once, twice) in repaired.scene.patches.iter().zip(&again.scene.patches) {
            assert!(once.polygon.loops().eq(twice.polygon.loops()), "{seed}: {}", once.name);
        }
    }
}

/// In a furnace every patch, which emits and reflects a half, receives π: its vertices within edges cost no accuracy and, but for a third, no work.
#[test]
fn shared_edges_change_no_light() {
    let room = tiled_room(&mut Random(1));
    let repaired = repair(&room).scene;
    let elements = [room, repaired].map(|scene| {
        let options = Options { method: Method::Hierarchical, ..Quality::Draft.options() };
        let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap();
        for (patch, mean) in
            solution.patch_means(&solution.irradiance, scene.patches.len()).iter().enumerate()
        {
            assert!((mean[0] / PI - 1.0).abs() < 0.03, "{patch}: {mean:?}");
        }
        solution.mesh.elements.len()
    });
    assert!(elements[1] <= elements[0] * 4 / 3, "{elements:?}");
}

/// A turned rectangle with a hole of nearly its width, whose corners lie beside its own by a hundred thousandth.
const FRAME: [[[f64; 3]; 4]; 2] = [
    [
        [-204.80046486854843, 76.25516088549293, -169.97675287341366],
        [-184.33515896923922, 113.48914154560686, -237.12391952332388],
        [-259.47043360484764, 108.89629885842155, -262.57065510852857],
        [-279.93573950415686, 71.66231819830762, -195.42348845861835],
    ],
    [
        [-262.24815469473526, 103.84150739762524, -253.45464737468876],
        [-187.11411620796648, 108.43427452193833, -228.00833044706957],
        [-204.80091459218855, 76.25542939655534, -169.97751456521132],
        [-279.9349530789573, 71.66266227224224, -195.42383149283046],
    ],
];

/// Repair cuts patches in convex parts to see whether they can be divided: rounding made corners of cuts that were to be cut again, without
/// an end.
#[test]
fn a_hole_beside_the_rim_is_cut_in_convex_parts() {
    let polygon = PlanarPolygon::new(FRAME.map(|ring| ring.map(DVec3::from))).unwrap();
    let area = polygon.area();
    let patches = vec![Patch::new("frame", polygon, vec![0.5], vec![0.5])];
    let repaired = repair(&Scene { patches, bands: 1, ..Scene::default() });
    assert!(repaired.repairs.is_empty(), "{:?}", repaired.repairs);
    let left: f64 = repaired.scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    assert!((left / area - 1.0).abs() < 1e-12, "{left} {area}");
}
