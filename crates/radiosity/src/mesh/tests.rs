//! Laws of the mesh.
use super::{plan::Plan, subdivide::Subdivision, tree::Node};
use crate::scene::{Scene, patch::Patch};
use formfactor::PlanarPolygon;
use glam::{DQuat, DVec3, EulerRot};

/// A scene cut in about so many elements.
fn even(scene: &Scene, elements: usize) -> Subdivision {
    Subdivision::new(scene, &Plan::even(scene, elements)).unwrap()
}

/// A scene of one patch with the given loops.
fn scene(loops: &[Vec<[f64; 3]>]) -> Scene {
    let loops: Vec<Vec<DVec3>> =
        loops.iter().map(|points| points.iter().map(|&p| p.into()).collect()).collect();
    let patch = Patch::new("patch", PlanarPolygon::new(&loops).unwrap(), vec![0.5], vec![0.0]);
    Scene { patches: vec![patch], bands: 1, ..Scene::default() }
}

/// A rectangle of 3 × 2 in general position.
fn rectangle() -> Vec<[f64; 3]> {
    let (x, y) = (DVec3::new(2.0, 1.0, 2.0) / 3.0, DVec3::new(1.0, 2.0, -2.0) / 3.0);
    let corner = |a: f64, b: f64| (DVec3::new(0.1, 0.2, 0.3) + 3.0 * a * x + 2.0 * b * y).to_array();
    vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]
}

fn l_with_hole() -> Vec<Vec<[f64; 3]>> {
    let outer = [[0., 0.], [4., 0.], [4., 1.5], [1.7, 1.5], [1.7, 3.1], [0., 3.1]];
    let hole = [[0.4, 0.3], [0.5, 1.2], [1.1, 0.9]];
    [&outer[..], &hole[..]].iter().map(|points| points.iter().map(|&[x, y]| [x, y, 2.0]).collect()).collect()
}

#[test]
fn a_rectangle_is_a_regular_grid_of_triangles() {
    let subdivision = even(&scene(&[rectangle()]), 2 * 6 * 4);
    let mesh = &subdivision.mesh;
    assert_eq!(mesh.elements.len(), 48);
    assert_eq!(mesh.vertices.len(), 35);
    for element in 0..48 {
        assert!((mesh.area(element) - 0.125).abs() < 1e-14);
    }
}

#[test]
fn the_polygon_s_own_vertices_stay_bit_for_bit() {
    for loops in [vec![rectangle()], l_with_hole()] {
        let mesh = even(&scene(&loops), 200).mesh;
        for vertex in loops.concat() {
            assert!(mesh.vertices.contains(&vertex.into()), "{vertex:?}");
        }
    }
}

#[test]
fn elements_cover_every_patch_once_and_face_its_front() {
    for loops in [vec![rectangle()], l_with_hole(), vec![l_with_hole()[0].clone()]] {
        for target in [1, 30, 1000] {
            let scene = scene(&loops);
            let mesh = even(&scene, target).mesh;
            let polygon = &scene.patches[0].polygon;
            let signed: f64 = (0..mesh.elements.len())
                .map(|element| {
                    let [a, b, c] = mesh.triangle(element);
                    (b - a).cross(c - a).dot(polygon.normal()) / 2.0
                })
                .inspect(|&area| assert!(area > 0.0))
                .sum();
            assert!((signed / polygon.area() - 1.0).abs() < 1e-13);
        }
    }
}

#[test]
fn outlines_of_the_pieces_tile_the_patch() {
    for loops in [vec![rectangle()], l_with_hole()] {
        let Subdivision { mesh, nodes, flat, .. } = even(&scene(&loops), 300);
        let area = |node: usize| {
            let elements = &mesh.elements[nodes[node].elements.clone()];
            flat.outline(&mesh, elements).unwrap().area()
        };
        for (index, node) in nodes.iter().enumerate() {
            let triangles: f64 = node.elements.clone().map(|element| mesh.area(element)).sum();
            assert!((area(index) - triangles).abs() < 1e-13);
            if let Some([a, b]) = node.halves {
                assert_eq!(nodes[a].elements.start, node.elements.start);
                assert_eq!(nodes[a].elements.end, nodes[b].elements.start);
                assert_eq!(nodes[b].elements.end, node.elements.end);
                assert!(!nodes[a].elements.is_empty() && !nodes[b].elements.is_empty());
            }
        }
    }
}

#[test]
fn pieces_of_a_rectangle_are_rectangles() {
    let Subdivision { mesh, nodes, flat, .. } = even(&scene(&[rectangle()]), 48);
    for node in &nodes {
        let outline = flat.outline(&mesh, &mesh.elements[node.elements.clone()]).unwrap();
        assert_eq!(outline.loops().map(<[DVec3]>::len).collect::<Vec<_>>(), [4]);
    }
}

#[test]
fn patches_that_share_an_edge_share_its_points() {
    let first = vec![vec![[0.3, 0., 0.], [5.1, 0.7, 0.], [5.1, 3., 0.], [0.3, 3., 0.]]];
    let second = vec![vec![[5.1, 0.7, 0.], [0.3, 0., 0.], [0.3, 0., -3.], [5.1, 0.7, -3.]]];
    let mut both = scene(&first);
    both.patches.extend(scene(&second).patches);
    let mesh = even(&both, 200).mesh;
    let on_edge = |patch: usize| {
        let elements = mesh.elements.iter().filter(|element| element.patch == patch);
        let points = elements.flat_map(|element| element.corners).map(|corner| mesh.vertices[corner]);
        let line = DVec3::new(4.8, 0.7, 0.0);
        let near = |p: &DVec3| (*p - DVec3::new(0.3, 0., 0.)).cross(line).length() < 1e-12;
        let mut points: Vec<_> = points.filter(near).map(|p| p.to_array()).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points.dedup();
        points
    };
    assert!(on_edge(0).len() > 5);
    assert_eq!(on_edge(0), on_edge(1));
}

/// A floor of 4 × 4 and what stands on it: walls of height 1 on the given lines.
fn floor_under(lines: &[[[f64; 2]; 2]]) -> Scene {
    let mut all = scene(&[vec![[0., 0., 0.], [4., 0., 0.], [4., 4., 0.], [0., 4., 0.]]]);
    for [[ax, ay], [bx, by]] in lines {
        let wall = vec![[*ax, *ay, 0.], [*bx, *by, 0.], [*bx, *by, 1.], [*ax, *ay, 1.]];
        all.patches.extend(scene(&[wall]).patches);
    }
    all
}

#[test]
fn no_element_lies_on_both_sides_of_a_block_s_foot() {
    let feet = [[1.13, 1.02], [2.71, 1.33], [2.6, 2.9], [1.3, 2.4]];
    let lines: Vec<_> = (0..4).map(|k| [feet[k], feet[(k + 1) % 4]]).collect();
    let Subdivision { mesh, nodes, flat, .. } = even(&floor_under(&lines), 800);
    let beyond =
        |p: DVec3, [[ax, ay], [bx, by]]: [[f64; 2]; 2]| (bx - ax) * (p.y - ay) - (by - ay) * (p.x - ax);
    let depth = |p: DVec3| lines.iter().map(|&line| beyond(p, line)).fold(f64::INFINITY, f64::min);
    let mut shadow = 0.0;
    let mut sides = vec![None; mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate().filter(|(_, element)| element.patch == 0) {
        let inside = depth(mesh.centroid(index)) > 0.0;
        shadow += if inside { mesh.area(index) } else { 0.0 };
        for corner in element.corners {
            let side = depth(mesh.vertices[corner]);
            assert!(if inside { side > -1e-12 } else { side < 1e-12 });
            assert_eq!(*sides[corner].get_or_insert(inside), inside, "a vertex is shared across the foot");
        }
    }
    let foot =
        (0..4).map(|k| feet[k][0] * feet[(k + 1) % 4][1] - feet[k][1] * feet[(k + 1) % 4][0]).sum::<f64>()
            / 2.0;
    assert!((shadow - foot).abs() < 1e-12, "{shadow} {foot}");
    let whole = flat.outline(&mesh, &mesh.elements[nodes[0].elements.clone()]).unwrap();
    assert_eq!(whole.loops().map(<[DVec3]>::len).collect::<Vec<_>>(), [4], "an outline has no slits");
}

#[test]
fn a_thin_wall_parts_the_vertices_along_its_foot_but_not_at_its_end() {
    let mesh = even(&floor_under(&[[[0., 2.], [2.1, 2.]]]), 200).mesh;
    let floor: Vec<_> =
        mesh.elements.iter().filter(|element| element.patch == 0).flat_map(|e| e.corners).collect();
    let at = |x: f64| {
        let here = |corner: &usize| mesh.vertices[*corner].distance(DVec3::new(x, 2., 0.)) < 1e-9;
        let mut vertices: Vec<_> = floor.iter().copied().filter(here).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.len()
    };
    assert_eq!(at(2.1), 1);
    let inner: Vec<_> = (1..5).map(|k| at(2.1 * f64::from(k) / 5.0)).collect();
    assert_eq!(inner, [2, 2, 2, 2]);
}

#[test]
fn halved_cells_are_finer_and_still_cover_the_patch_once() {
    for loops in [vec![rectangle()], l_with_hole()] {
        let scene = scene(&loops);
        let mut plan = Plan::even(&scene, 100);
        let cells = even(&scene, 100).cell_counts[0];
        plan.levels = vec![(0..cells).map(|cell| [0, 3, 0, 1, 2][cell % 5]).collect()];
        let Subdivision { mesh, cells, .. } = Subdivision::new(&scene, &plan).unwrap();
        let area: f64 = (0..mesh.elements.len()).map(|element| mesh.area(element)).sum();
        assert!((area / scene.patches[0].polygon.area() - 1.0).abs() < 1e-13);
        let largest = |level: usize| {
            let within =
                (0..mesh.elements.len()).filter(|element| [0, 3, 0, 1, 2][cells[*element] % 5] == level);
            within.map(|element| mesh.area(element)).fold(0.0, f64::max)
        };
        assert!(largest(3) < largest(0) / 8.0, "{} {}", largest(3), largest(0));
    }
}

#[test]
fn the_ground_around_a_lit_floor_leaves_it_its_elements() {
    let level =
        |side: f64, z: f64| vec![[-side, -side, z], [side, -side, z], [side, side, z], [-side, side, z]];
    let counts = |ground: f64| {
        let mut scene = scene(&[level(2.0, 0.0)]);
        scene.patches.extend(self::scene(&[level(ground, -1.0)]).patches);
        let lamp = level(0.5, 2.0).into_iter().rev().collect();
        scene.patches.extend(self::scene(&[lamp]).patches);
        scene.patches[2].emission.fill(1.0);
        let mesh = even(&scene, 1000).mesh;
        [0, 1, 2].map(|patch| mesh.elements.iter().filter(|element| element.patch == patch).count())
    };
    for side in [1e2, 1e5, 1e9] {
        let [floor, ground, lamp] = counts(side);
        assert!(floor > 200 && ground > 500 && lamp > 2, "{side}: {floor} {ground} {lamp}");
    }
}

#[test]
fn elements_are_shared_out_by_area_where_the_largest_patch_is_lit() {
    let level =
        |side: f64, z: f64| vec![[-side, -side, z], [side, -side, z], [side, side, z], [-side, side, z]];
    let mut scene = scene(&[level(4.0, 0.0)]);
    let lamp = level(0.5, 2.0).into_iter().rev().collect();
    scene.patches.extend(self::scene(&[lamp]).patches);
    scene.patches[1].emission.fill(1.0);
    let spacings = Plan::even(&scene, 1000).spacings;
    assert!(spacings.iter().all(|spacing| *spacing == spacings[0]));
    let total: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    assert!((spacings[0] * spacings[0] * 500.0 / total - 1.0).abs() < 1e-12);
}

#[test]
fn edges_of_shadows_are_edges_of_elements() {
    let scene = scene(&[rectangle()]);
    let mut plan = Plan::even(&scene, 400);
    let [a, b] = [0.31, 0.83].map(|t| {
        let corners: Vec<DVec3> = rectangle().into_iter().map(DVec3::from).collect();
        corners[0].lerp(corners[1], t).midpoint(corners[3].lerp(corners[2], 1.0 - t))
    });
    let line = [a + (a - b) * 9.0, b + (b - a) * 9.0];
    plan.shadows = vec![vec![line]];
    let mesh = Subdivision::new(&scene, &plan).unwrap().mesh;
    let normal = scene.patches[0].polygon.normal();
    let side = |p: DVec3| (line[1] - line[0]).cross(p - line[0]).dot(normal) / (line[1] - line[0]).length();
    let across = (0..mesh.elements.len()).filter(|element| {
        let sides = mesh.triangle(*element).map(side);
        sides.iter().any(|s| *s > 1e-9) && sides.iter().any(|s| *s < -1e-9)
    });
    let crossed: f64 = across.map(|element| mesh.area(element)).sum();
    assert!(
        crossed < 0.01 * scene.patches[0].polygon.area(),
        "but for the ends nothing lies across: {crossed}"
    );
}

/// A level square at a height, its front up, turned about the vertical axis.
fn square(size: f64, height: f64, turn: f64) -> Patch {
    let corner = |k: u32| {
        let (y, x) = (turn + f64::from(k) * std::f64::consts::FRAC_PI_2).sin_cos();
        DVec3::new(size * x, size * y, height)
    };
    Patch::new("square", PlanarPolygon::new([[0, 1, 2, 3].map(corner)]).unwrap(), vec![0.5], vec![0.0])
}

/// An upright sheet over a line between two points of the plane, from one height to another.
fn upright([from, to]: [DVec3; 2], [low, high]: [f64; 2]) -> Patch {
    let (down, up) = (low * DVec3::Z, high * DVec3::Z);
    let polygon = PlanarPolygon::new([[from + down, to + down, to + up, from + up]]).unwrap();
    Patch::new("sheet", polygon, vec![0.5], vec![0.0])
}

/// Where a sheet passes through a floor, stands on it, or leaves it, elements end: on each side of the line they have vertices of their own.
#[test]
fn elements_end_where_others_pass_through() {
    let ends = [DVec3::new(-0.31, -0.4, 0.0), DVec3::new(0.27, 0.5, 0.0)];
    let floor = square(1.0, 0.0, 0.3);
    for (heights, is_cut) in
        [([-0.2, 0.7], true), ([0.0, 0.7], true), ([1e-5, 0.7], true), ([0.1, 0.7], false)]
    {
        let scene =
            Scene { patches: vec![floor.clone(), upright(ends, heights)], bands: 1, ..Scene::default() };
        let mesh = even(&scene, 60).mesh;
        let side = |place: DVec3| (ends[1] - ends[0]).cross(place - ends[0]).z;
        let along =
            |place: DVec3| (place - ends[0]).dot(ends[1] - ends[0]) / (ends[1] - ends[0]).length_squared();
        let straddles = |element: &usize| {
            let corners = mesh.triangle(*element);
            let is_beside = corners.iter().all(|corner| (0.1..0.9).contains(&along(*corner)));
            let sides = corners.map(side);
            is_beside && sides.iter().any(|side| *side > 1e-9) && sides.iter().any(|side| *side < -1e-9)
        };
        let on_floor = (0..mesh.elements.len()).filter(|element| mesh.elements[*element].patch == 0);
        assert_eq!(on_floor.filter(straddles).count() == 0, is_cut, "{heights:?}");
    }
}

/// What passes through the plane of a patch beside it, and what crosses it in rounding alone, cuts nothing.
#[test]
fn what_passes_beside_or_touches_by_rounding_cuts_nothing() {
    let floor = square(1.0, 0.0, 0.3);
    let beside = upright([DVec3::new(2.0, -1.0, 0.0), DVec3::new(2.0, 1.0, 0.0)], [-0.5, 0.5]);
    let corners: Vec<DVec3> =
        square(3.0, 0.0, 0.8).polygon.loops().flatten().map(|p| *p + 1e-9 * p.x * DVec3::Z).collect();
    let tilted = Patch { polygon: PlanarPolygon::new([corners]).unwrap(), ..floor.clone() };
    let count = |patches: Vec<Patch>| {
        let scene = Scene { patches, bands: 1, ..Scene::default() };
        let mesh =
            Subdivision::new(&scene, &Plan { spacings: vec![0.3; scene.patches.len()], ..Plan::default() });
        mesh.unwrap().mesh.elements.iter().filter(|element| element.patch == 0).count()
    };
    let alone = count(vec![floor.clone()]);
    assert_eq!(count(vec![floor.clone(), beside]), alone);
    assert_eq!(count(vec![floor, tilted]), alone);
}

/// Polygons with and without holes, of very different sizes, stuck into each other at random.
fn thicket(seed: u64, count: usize) -> Vec<Patch> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut patch = |index: usize| {
        let loops = if index % 3 == 0 { l_with_hole() } else { vec![rectangle()] };
        let turn = DQuat::from_euler(EulerRot::XYZ, 7.0 * random(), 7.0 * random(), 7.0 * random());
        let (size, at) = (0.02f64.powf(random()), 3.0 * DVec3::new(random(), random(), random()));
        let place = |point: &[f64; 3]| at + size * (turn * DVec3::from(*point));
        let loops = loops.iter().map(|points| points.iter().map(place).collect::<Vec<_>>());
        Patch::new("patch", PlanarPolygon::new(loops).unwrap(), vec![0.5], vec![0.0])
    };
    (0..count).map(&mut patch).collect()
}

/// However others pass through a patch, its elements and the outlines of its pieces cover it once. In the opposite order of patches, and
/// where all is four times as large, it has as many.
#[test]
fn what_others_pass_through_is_covered_once() {
    for seed in 0..60 {
        let patches = thicket(seed, 24);
        let counts = |patches: &[Patch]| {
            let scene = Scene { patches: patches.to_vec(), bands: 1, ..Scene::default() };
            let Subdivision { mesh, nodes, flat, .. } = even(&scene, 40 << (seed % 6));
            let count = |(patch, node): (&Patch, &Node)| {
                let whole = patch.polygon.area();
                let areas: Vec<f64> = node.elements.clone().map(|element| mesh.area(element)).collect();
                assert!(areas.iter().all(|area| *area > 0.0), "seed {seed}");
                let outlined = flat.outline(&mesh, &mesh.elements[node.elements.clone()]).unwrap().area();
                for area in [areas.iter().sum(), outlined] {
                    assert!((area / whole - 1.0).abs() < 1e-10, "seed {seed}: {area} of {whole}");
                }
                areas.len()
            };
            patches.iter().zip(&nodes).map(count).collect::<Vec<_>>()
        };
        let known = counts(&patches);
        let reversed: Vec<Patch> = patches.iter().rev().cloned().collect();
        assert!(counts(&reversed).iter().eq(known.iter().rev()), "seed {seed}");
        let larger = |patch: &Patch| {
            let loops =
                patch.polygon.loops().map(|points| points.iter().map(|p| 4.0 * *p).collect::<Vec<_>>());
            Patch { polygon: PlanarPolygon::new(loops).unwrap(), ..patch.clone() }
        };
        assert_eq!(counts(&patches.iter().map(larger).collect::<Vec<_>>()), known, "seed {seed}");
    }
}
