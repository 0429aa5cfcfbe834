//! Walls and a roof hide what the closed house hides, and something inside a body sees what is inside.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{AreaFormFactor, Enclosure, Limits, PlanarPolygon};

fn polygon(corners: &[[f64; 3]]) -> PlanarPolygon {
    PlanarPolygon::new([corners]).unwrap()
}

/// The sides of a box, fronts outward: four walls, each in two triangles, the roof, and the floor.
fn sides([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3]) -> Vec<PlanarPolygon> {
    let ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    let wall = |i: usize| {
        let ([a, b], [c, d]) = (ring[i], ring[(i + 1) % 4]);
        [polygon(&[[a, b, z0], [c, d, z0], [c, d, z1]]), polygon(&[[a, b, z0], [c, d, z1], [a, b, z1]])]
    };
    let roof = polygon(&ring.map(|[x, y]| [x, y, z1]));
    let floor = polygon(&[ring[3], ring[2], ring[1], ring[0]].map(|[x, y]| [x, y, z0]));
    (0..4).flat_map(wall).chain([roof, floor]).collect()
}

/// The ground around and below two houses, a tilted board above, and what stands on the ground.
fn street(houses: impl IntoIterator<Item = PlanarPolygon>) -> Enclosure {
    let ground = |x: f64, y: f64| {
        polygon(&[[x, y, 0.0], [x + 3.0, y, 0.0], [x + 3.0, y + 3.0, 0.0], [x, y + 3.0, 0.0]])
    };
    let tiles = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [3.0, 3.0]].map(|[x, y]| ground(x, y));
    let board = polygon(&[[0.0, 0.0, 5.0], [0.0, 6.0, 4.0], [6.0, 6.0, 4.0], [6.0, 0.0, 5.0]]);
    Enclosure::new(tiles.into_iter().chain([board]).chain(houses).collect())
}

fn houses() -> Vec<PlanarPolygon> {
    [sides([1.0, 1.0, 0.0], [2.5, 2.0, 2.0]), sides([3.5, 2.5, 0.0], [4.5, 4.0, 1.0])].concat()
}

/// The same polygons with a vertex more each, so that they share no edges and make no solids.
fn one_by_one(polygons: &[PlanarPolygon]) -> Vec<PlanarPolygon> {
    let split = |(i, polygon): (usize, &PlanarPolygon)| {
        let mut ring = polygon.loops().next().unwrap().to_vec();
        let at = (0..ring.len()).map(|k| (ring[k] + ring[(k + 1) % ring.len()]) / 2.0);
        let with: Vec<_> = ring.iter().copied().zip(at).flat_map(|(a, b)| [a, b]).collect();
        ring = if i % 2 == 0 { with } else { ring };
        PlanarPolygon::new([ring]).unwrap()
    };
    polygons.iter().enumerate().map(split).collect()
}

fn all(scene: &Enclosure, count: usize, tolerance: f64) -> Vec<AreaFormFactor> {
    let pairs = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
    let limits = Limits { per_pair: 50_000, ..Limits::default() };
    let found = |i, j| scene.area_form_factor(i, j, tolerance, &limits).unwrap().unwrap();
    pairs.map(|(i, j)| found(i, j)).collect()
}

#[test]
fn a_house_without_a_floor_hides_what_its_walls_and_its_roof_hide() {
    let open: Vec<PlanarPolygon> = houses().chunks(10).flat_map(|sides| sides[..9].iter().cloned()).collect();
    let count = 5 + open.len();
    let capped = all(&street(open.clone()), count, 1e-6);
    let walled = all(&street(one_by_one(&open)), count, 1e-6);
    let seen = capped.iter().filter(|factor| factor.value > 1e-3).count();
    assert!(seen > 60, "only {seen} factors");
    for (pair, (capped, walled)) in capped.iter().zip(&walled).enumerate() {
        let most = capped.error_estimate + walled.error_estimate + 1e-9;
        assert!((capped.value - walled.value).abs() <= most, "{pair}: {capped:?} {walled:?}");
    }
}

#[test]
fn bounds_hold_before_a_house_without_a_floor() {
    let open: Vec<PlanarPolygon> = houses().chunks(10).flat_map(|sides| sides[..9].iter().cloned()).collect();
    let scene = street(open);
    for (i, j) in [(0, 4), (1, 4), (2, 4), (3, 4), (0, 3), (5, 16), (13, 4)] {
        let estimate = scene.area_form_factor(i, j, 1e-7, &Limits::default()).unwrap().unwrap();
        let limits = Limits { per_pair: 20_000, ..Limits::default() };
        let bounded = scene.bounded_area_form_factor(i, j, 1e-3, &limits).unwrap().unwrap();
        let most = bounded.error_bound + estimate.error_estimate;
        assert!((bounded.value - estimate.value).abs() <= most, "{i} {j}: {bounded:?} {estimate:?}");
    }
}

#[test]
fn what_is_inside_of_a_body_sees_what_is_inside() {
    let level = |z: f64, up: bool| {
        let ring = [[0.2, 0.2, z], [0.8, 0.2, z], [0.8, 0.8, z], [0.2, 0.8, z]];
        let turned = [ring[3], ring[2], ring[1], ring[0]];
        polygon(if up { &ring } else { &turned })
    };
    let (lower, upper) = (level(0.2, true), level(0.8, false));
    let free = Enclosure::new(vec![lower.clone(), upper.clone()]);
    let expected = free.area_form_factor(0, 1, 1e-9, &Limits::default()).unwrap().unwrap().value;
    for sides in [sides([0.0; 3], [1.0; 3]), sides([0.0; 3], [1.0; 3])[..9].to_vec()] {
        let outside = polygon(&[[0.0, 0.0, 3.0], [0.0, 1.0, 3.0], [1.0, 1.0, 3.0], [1.0, 0.0, 3.0]]);
        let scene = Enclosure::new([vec![lower.clone(), upper.clone(), outside], sides].concat());
        let found = |to| scene.area_form_factor(0, to, 1e-9, &Limits::default()).unwrap().unwrap().value;
        assert!((found(1) - expected).abs() < 1e-9 && expected > 0.1, "{}", found(1));
        assert_eq!(found(2), 0.0);
    }
}

#[test]
fn what_lies_on_a_bodys_faces_and_looks_inward_sees_what_does() {
    let ring = [[0.2, 0.2, 0.0], [0.8, 0.2, 0.0], [0.8, 0.8, 0.0], [0.2, 0.8, 0.0]];
    let lower = polygon(&ring);
    let upper = polygon(&[ring[3], ring[2], ring[1], ring[0]].map(|[x, y, _]| [x, y, 1.0]));
    let free = Enclosure::new(vec![lower.clone(), upper.clone()]);
    let expected = free.area_form_factor(0, 1, 1e-9, &Limits::default()).unwrap().unwrap().value;
    for sides in [sides([0.0; 3], [1.0; 3]), sides([0.0; 3], [1.0; 3])[..9].to_vec()] {
        let scene = Enclosure::new([vec![lower.clone(), upper.clone()], sides].concat());
        let found = scene.area_form_factor(0, 1, 1e-9, &Limits::default()).unwrap().unwrap().value;
        assert!((found - expected).abs() < 1e-9 && expected > 0.05, "{found}");
    }
}

/// A room of 4 x 3 x 2: floor, ceiling, and four walls, fronts inward.
fn room() -> Vec<PlanarPolygon> {
    let turned = |polygon: &PlanarPolygon| {
        let ring: Vec<_> = polygon.loops().next().unwrap().iter().rev().copied().collect();
        PlanarPolygon::new([ring]).unwrap()
    };
    sides([0.0; 3], [4.0, 3.0, 2.0]).iter().map(turned).collect()
}

/// Each pair, with solids and with their faces one by one.
fn assert_alike(solids: &[PlanarPolygon], least: usize) {
    let capped = all(&Enclosure::new(solids.to_vec()), solids.len(), 1e-4);
    let walled = all(&Enclosure::new(one_by_one(solids)), solids.len(), 1e-4);
    let seen = capped.iter().filter(|factor| factor.value > 1e-3).count();
    assert!(seen >= least, "only {seen} factors");
    for (pair, (capped, walled)) in capped.iter().zip(&walled).enumerate() {
        let most = capped.error_estimate + walled.error_estimate + 1e-9;
        let [i, j] = [pair / solids.len(), pair % solids.len()];
        assert!((capped.value - walled.value).abs() <= most, "{i} {j}: {capped:?} {walled:?}");
    }
    let evaluations = |all: &[AreaFormFactor]| all.iter().map(|factor| factor.evaluations).sum::<u64>();
    assert!(evaluations(&capped) < evaluations(&walled), "no solid was found");
}

/// The floor inside of the column sees the ceiling inside of it.
#[test]
fn a_column_from_floor_to_ceiling_is_a_solid_whose_inside_counts() {
    let column = sides([1.5, 1.0, 0.0], [2.25, 1.5, 2.0])[..8].to_vec();
    let scene = [room(), column].concat();
    assert_alike(&scene, 100);
    let enclosure = Enclosure::new(scene);
    for (i, j) in [(8, 9), (0, 4), (9, 2)] {
        let estimate = enclosure.area_form_factor(i, j, 1e-7, &Limits::default()).unwrap().unwrap();
        let limits = Limits { per_pair: 20_000, ..Limits::default() };
        let bounded = enclosure.bounded_area_form_factor(i, j, 1e-3, &limits).unwrap().unwrap();
        let most = bounded.error_bound + estimate.error_estimate;
        assert!((bounded.value - estimate.value).abs() <= most, "{i} {j}: {bounded:?} {estimate:?}");
        assert!(bounded.error_bound < 1e-3, "{i} {j}: {bounded:?}");
    }
}

/// Three faces of a wall's end, from floor to ceiling; it begins in another wall.
#[test]
fn a_wall_that_ends_in_the_room_is_a_solid() {
    let quad = |corners: [[f64; 3]; 4]| polygon(&corners);
    let wall = vec![
        quad([[1.5, 1.0, 0.0], [1.5, 1.0, 2.0], [1.75, 1.0, 2.0], [1.75, 1.0, 0.0]]),
        quad([[1.5, 0.0, 0.0], [1.5, 0.0, 2.0], [1.5, 1.0, 2.0], [1.5, 1.0, 0.0]]),
        quad([[1.75, 0.0, 0.0], [1.75, 1.0, 0.0], [1.75, 1.0, 2.0], [1.75, 0.0, 2.0]]),
    ];
    assert_alike(&[room(), wall].concat(), 60);
}

/// The floor of an open box sees the ceiling, though no more than one side of the box is missing.
#[test]
fn a_lining_sees_out_of_an_open_box() {
    let open = |sides: Vec<PlanarPolygon>| [&sides[..8], &sides[9..]].concat();
    let lining = polygon(&[[1.5, 1.0, 0.5], [2.25, 1.0, 0.5], [2.25, 1.5, 0.5], [1.5, 1.5, 0.5]]);
    let scene = [room(), open(sides([1.5, 1.0, 0.5], [2.25, 1.5, 1.0])), vec![lining]].concat();
    let last = scene.len() - 1;
    let found = all(&Enclosure::new(scene.clone()), last + 1, 1e-3);
    let walled = all(&Enclosure::new(one_by_one(&scene)), last + 1, 1e-3);
    assert!(found[last * (last + 1) + 8].value > 0.1, "{:?}", found[last * (last + 1) + 8]);
    for (found, walled) in found.iter().zip(&walled) {
        assert!((found.value - walled.value).abs() <= found.error_estimate + walled.error_estimate + 1e-9);
    }
}

/// A thing in an open box sees the ceiling, and others see the box as a solid.
#[test]
fn a_thing_in_an_open_box_sees_out() {
    let open = sides([1.5, 1.0, 0.5], [2.25, 1.5, 1.0]);
    let thing = sides([1.8, 1.2, 0.5], [1.9, 1.3, 0.75]);
    assert_alike(&[room(), [&open[..8], &open[9..]].concat(), thing[8..9].to_vec()].concat(), 100);
}

/// A wall of two sides without thickness parts a room into two: each closes, and sees nothing of the other one.
#[test]
fn a_sheet_of_two_sides_is_no_solid() {
    let ring = [[1.5, 0.0, 0.0], [1.5, 3.0, 0.0], [1.5, 3.0, 2.0], [1.5, 0.0, 2.0]];
    let side = |corners: &[usize]| polygon(&corners.iter().map(|k| ring[*k]).collect::<Vec<_>>());
    let quads = vec![side(&[0, 1, 2, 3]), side(&[3, 2, 1, 0])];
    let triangles = vec![side(&[0, 1, 2]), side(&[0, 2, 3]), side(&[2, 1, 0]), side(&[3, 2, 0])];
    let crossed = vec![side(&[0, 1, 2]), side(&[0, 2, 3]), side(&[1, 0, 3]), side(&[3, 2, 1])];
    for sheet in [quads, triangles, crossed] {
        let polygons = [room(), sheet].concat();
        let scene = Enclosure::new(polygons.clone());
        let factor = |i, j| scene.area_form_factor(i, j, 1e-6, &Limits::default()).unwrap().unwrap();
        for i in 0..polygons.len() {
            let row: Vec<AreaFormFactor> = (0..polygons.len()).map(|j| factor(i, j)).collect();
            let sum: f64 = row.iter().map(|factor| factor.value).sum();
            assert!((sum - 1.0).abs() < 1e-4, "row {i}: {sum}");
        }
        let [west, east] = [0.0, 4.0].map(|x| {
            let at = |i: &usize| polygons[*i].loops().flatten().all(|p| p.x == x);
            (0..polygons.len()).find(at).expect("a wall")
        });
        assert_eq!(factor(west, east).value, 0.0);
    }
}

/// Sheets of two sides that float in a room, upright, level and tilted, hide what sheets of one polygon each do.
#[test]
fn floating_sheets_of_two_sides_hide_what_their_sides_hide_one_by_one() {
    let sheet = |ring: [[f64; 3]; 4]| [polygon(&ring), polygon(&[ring[3], ring[2], ring[1], ring[0]])];
    let sheets = [
        sheet([[1.0, 0.5, 0.5], [1.0, 2.5, 0.5], [1.0, 2.5, 1.5], [1.0, 0.5, 1.5]]),
        sheet([[2.0, 1.0, 1.0], [3.0, 1.0, 1.0], [3.0, 2.0, 1.0], [2.0, 2.0, 1.0]]),
        sheet([[3.25, 0.5, 0.25], [3.75, 0.5, 1.25], [3.75, 2.5, 1.25], [3.25, 2.5, 0.25]]),
    ];
    let scene = [room(), sheets.concat()].concat();
    let count = scene.len();
    let [joined, split] = [scene.clone(), one_by_one(&scene)].map(|it| all(&Enclosure::new(it), count, 1e-4));
    for (pair, (joined, split)) in joined.iter().zip(&split).enumerate() {
        let most = joined.error_estimate + split.error_estimate + 1e-9;
        let [i, j] = [pair / count, pair % count];
        assert!((joined.value - split.value).abs() <= most, "{i} {j}: {joined:?} {split:?}");
    }
}
