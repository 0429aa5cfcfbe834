//! Form factors from area to area: closed forms, references with a blocker, reciprocity and closure.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DMat3;
use formfactor::{
    AreaFormFactor, DVec3, DifferentialArea, Enclosure, Error, Limits, PlanarPolygon, Tolerance, unoccluded,
    unoccluded_area,
};

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> PlanarPolygon {
    PlanarPolygon::new([[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]]).unwrap()
}

fn turned(polygon: &PlanarPolygon) -> PlanarPolygon {
    let loops = polygon.loops().map(|l| l.iter().rev().copied().collect::<Vec<DVec3>>());
    PlanarPolygon::new(loops.collect::<Vec<_>>()).unwrap()
}

const UNIT: [f64; 2] = [0.0, 1.0];

/// Unit squares, one above the other, and a blocker in between.
fn squares(blocker: Option<PlanarPolygon>) -> Enclosure {
    let ceiling = turned(&rectangle(UNIT, UNIT, 1.0));
    Enclosure::new([rectangle(UNIT, UNIT, 0.0), ceiling].into_iter().chain(blocker).collect())
}

#[test]
fn blockers_between_squares() {
    let blockers = [
        (None, 0.199_824_895_698_387_4),
        (Some(rectangle([0.0, 0.5], [0.0, 0.5], 0.5)), 0.149_868_671_773_790),
        (Some(rectangle([0.25, 0.75], [0.25, 0.75], 0.5)), 0.099_506_294_598_984_8),
        (Some(rectangle([0.3, 0.7], [0.2, 0.9], 0.35)), 0.101_200_016_253_138),
    ];
    for (blocker, expected) in blockers {
        let found = squares(blocker).area_form_factor(0, 1, 1e-12, &Limits::default()).unwrap().unwrap();
        println!("{found:?} off by {:.1e}", found.value - expected);
        assert!((found.value - expected).abs() <= 1e-12, "{found:?} is not {expected}");
        assert!(found.error_estimate <= 1e-12 && found.evaluations < 2000, "{found:?}");
    }
}

/// A source, a receiver, and an obstructor that shares a vertex with the source: View3D answers 1.31.
fn three_triangles() -> Enclosure {
    let (v1, v2) = ([2_217.833_008, 1_853.818_848, 0.0], [2_217.506_348, 1_853.365_601, 0.0]);
    let v3 = [2_217.833_008, 1_853.818_848, 66.900_002];
    let v4 = [2_218.230_957, 1_854.916_382, 0.0];
    let v5 = [2_218.230_957, 1_854.916_382, 66.900_002];
    let v6 = [2_201.107_910, 1_845.251_709, 66.900_002];
    let v7 = [2_217.864_990, 1_854.129_883, 0.0];
    let v9 = [2_217.864_990, 1_854.129_883, 66.900_002];
    let triangle = |corners: [[f64; 3]; 3]| PlanarPolygon::new([corners]).unwrap();
    Enclosure::new(vec![triangle([v1, v2, v3]), triangle([v4, v5, v6]), triangle([v7, v1, v9])])
}

#[test]
fn three_triangles_are_seen_as_by_rays() {
    let found = three_triangles().area_form_factor(0, 1, 1e-9, &Limits::default()).unwrap().unwrap();
    println!("{found:?}");
    // 40 million rays: 0.753721 +- 0.000068.
    assert!((found.value - 0.753_721).abs() <= 3.0 * 0.000_068 && found.error_estimate <= 1e-9, "{found:?}");
}

/// The Cornell box, closed by a front wall, the blocks' footprints cut out of the floor and the lamp out of the ceiling.
fn cornell_box() -> Enclosure {
    let lamp = [[343.0, 548.8, 227.0], [343.0, 548.8, 332.0], [213.0, 548.8, 332.0], [213.0, 548.8, 227.0]];
    let short = [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]];
    let tall = [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]];
    let at = |[x, z]: [f64; 2], y: f64| [x, y, z];
    let level = |corners: [[f64; 2]; 4], y: f64| corners.map(|c| at(c, y)).to_vec();
    let floor = [[552.8, 0.0], [0.0, 0.0], [0.0, 559.2], [549.6, 559.2]];
    let ceiling = [[556.0, 0.0], [556.0, 559.2], [0.0, 559.2], [0.0, 0.0]];
    let wall = |i: usize, j: usize| {
        vec![vec![
            at(floor[i], 0.0),
            at(floor[j], 0.0),
            at(ceiling[(4 - j) % 4], 548.8),
            at(ceiling[(4 - i) % 4], 548.8),
        ]]
    };
    let mut loops = vec![
        vec![level(floor, 0.0), level(short, 0.0), level(tall, 0.0)],
        vec![level(ceiling, 548.8), lamp.to_vec()],
        vec![lamp.to_vec()],
        wall(1, 0),
        wall(2, 1),
        wall(3, 2),
        // Not planar: in two triangles.
        vec![vec![at(floor[0], 0.0), at(floor[3], 0.0), at(ceiling[1], 548.8)]],
        vec![vec![at(floor[0], 0.0), at(ceiling[1], 548.8), at(ceiling[0], 548.8)]],
    ];
    for (base, height) in [(short, 165.0), (tall, 330.0)] {
        loops.push(vec![level(base, height)]);
        for i in 0..4 {
            let j = (i + 1) % 4;
            loops.push(vec![vec![
                at(base[j], 0.0),
                at(base[j], height),
                at(base[i], height),
                at(base[i], 0.0),
            ]]);
        }
    }
    Enclosure::new(loops.into_iter().map(|l| PlanarPolygon::new(l).unwrap()).collect())
}

/// `CORNELL_TOLERANCE` sets what is asked for: 1e-4 takes seconds, 1e-8 minutes.
#[test]
fn the_cornell_box_closes_within_the_tolerance() {
    let asked = std::env::var("CORNELL_TOLERANCE").ok();
    let tolerance = asked.map_or(1e-3, |t| t.parse().expect("CORNELL_TOLERANCE is a number"));
    let rows = cornell_box().area_matrix(tolerance, &Limits::default()).unwrap().unwrap();
    for (id, row) in rows.iter().enumerate() {
        let sum: f64 = row.iter().map(|(_, factor)| factor.value).sum();
        assert!((sum - 1.0).abs() <= tolerance, "row {id} adds to {sum}");
    }
}

#[test]
fn from_the_cornell_boxs_lamp_all_is_seen_once() {
    let (room, tolerance) = (cornell_box(), 1e-5);
    let sum: f64 = room
        .area_row(2, tolerance, &Limits::default())
        .unwrap()
        .unwrap()
        .iter()
        .map(|(_, factor)| factor.value)
        .sum();
    assert!((sum - 1.0).abs() <= tolerance, "{sum}");
}

/// A room with a block on its floor, cut out there, turned out of the axes: its edges stand on the floor, and shadows of
/// what is nearly parallel go far.
#[test]
fn a_block_that_stands_in_a_turned_room_sees_all_once() {
    let turn = DMat3::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 0.7);
    let at = |x: f64, y: f64, z: f64| turn * DVec3::new(x, y, z);
    let [x, y, z] = [2.7, 1.9, 1.6];
    let [low, high] = [[0.4, 0.5], [1.1, 0.8]];
    let base = [[low[0], low[1]], [high[0], low[1]], high, [low[0], high[1]]];
    let floor = [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
    let level = |corners: [[f64; 2]; 4], z: f64| corners.map(|[x, y]| at(x, y, z)).to_vec();
    let side = |[a, b]: [[f64; 2]; 2], z: f64| {
        vec![at(b[0], b[1], 0.0), at(b[0], b[1], z), at(a[0], a[1], z), at(a[0], a[1], 0.0)]
    };
    let reversed = |mut corners: Vec<DVec3>| {
        corners.reverse();
        corners
    };
    let mut loops = vec![
        vec![level(base, 0.7)],
        vec![level(floor, 0.0), level(base, 0.0)],
        vec![reversed(level(floor, z))],
    ];
    for i in 0..4 {
        let j = (i + 1) % 4;
        loops.push(vec![side([base[i], base[j]], 0.7)]);
        loops.push(vec![reversed(side([floor[i], floor[j]], z))]);
    }
    let room = Enclosure::new(loops.into_iter().map(|l| PlanarPolygon::new(l).unwrap()).collect());
    for (from, tolerance) in [(0, 1e-7), (3, 1e-5), (5, 1e-5), (1, 1e-4)] {
        let row = room.area_row(from, tolerance, &Limits::default()).unwrap().unwrap();
        let sum: f64 = row.iter().map(|(_, factor)| factor.value).sum();
        assert!((sum - 1.0).abs() <= tolerance, "row {from} adds to {sum}");
    }
}

#[test]
fn reciprocity_holds() {
    let room = cornell_box();
    let areas: Vec<f64> = room.polygons().iter().map(PlanarPolygon::area).collect();
    for (i, j) in [(0, 3), (1, 9), (2, 12), (8, 4)] {
        let [forth, back] = [(i, j), (j, i)]
            .map(|(i, j)| room.area_form_factor(i, j, 1e-3, &Limits::default()).unwrap().unwrap().value);
        assert!((areas[i] * forth - areas[j] * back).abs() <= 1e-14 * areas[i] * forth, "{i} and {j}");
    }
}

/// What a closed form of the file gives.
fn closed_form(id: &str) -> f64 {
    let data: serde_json::Value = serde_json::from_str(include_str!("data/closed_forms.json")).unwrap();
    let forms = data["closed_forms"].as_array().unwrap();
    let form = forms.iter().find(|f| f["id"] == id).unwrap_or_else(|| panic!("no closed form {id}"));
    let value: f64 = form["value"].as_str().unwrap().parse().unwrap();
    if form["gives"] == "complement" { 1.0 - value } else { value }
}

fn above(x: [f64; 2], y: [f64; 2], z: f64) -> Enclosure {
    Enclosure::new(vec![rectangle(UNIT, UNIT, 0.0), turned(&rectangle(x, y, z))])
}

#[test]
fn closed_forms_hold() {
    let standing = |width: f64, height: f64| {
        let wall = [[0.0, 0.0, 0.0], [width, 0.0, 0.0], [width, 0.0, height], [0.0, 0.0, height]];
        let wall = PlanarPolygon::new([wall]).unwrap();
        let wall = if wall.normal().y > 0.0 { wall } else { turned(&wall) };
        Enclosure::new(vec![rectangle([0.0, width], UNIT, 0.0), wall])
    };
    // C-11 and C-14 are given for sides relative to the gap and to the common edge.
    let parallel = Enclosure::new(vec![
        rectangle([0.0, 2.0], [0.0, 3.0], 0.0),
        turned(&rectangle([0.0, 2.0], [0.0, 3.0], 1.0)),
    ]);
    let cases = [
        ("AA-par-1-1", above(UNIT, UNIT, 1.0)),
        ("AA-par-2-3", parallel),
        ("AA-par-gap-1e-1", above(UNIT, UNIT, 0.1)),
        ("AA-par-gap-1e-3", above(UNIT, UNIT, 1e-3)),
        ("AA-par-gap-1e-6", above(UNIT, UNIT, 1e-6)),
        ("AA-par-gap-1e1", above(UNIT, UNIT, 10.0)),
        ("AA-perp-1-1", standing(1.0, 1.0)),
        ("AA-C13 offset", above([2.0, 3.0], [1.0, 3.0], 1.0)),
    ];
    for (id, enclosure) in cases {
        let found = enclosure.area_form_factor(0, 1, 1e-12, &Limits::default()).unwrap().unwrap();
        assert!((found.value - closed_form(id)).abs() <= 1e-12, "{id}: {found:?}");
    }
}

/// Tiles of two walls that meet, of two that face each other, and far apart.
#[test]
fn two_polygons_alone_see_what_they_do_in_a_scene() {
    for (x, y) in [(0.0, 1.0), (0.0, 0.1), (0.5, 3.0), (-2.0, 0.7), (30.0, 1.0)] {
        let wall =
            [[0.0, 0.0, 0.0], [0.0, y, 0.0], [0.0, y, 1.0], [0.0, 0.0, 1.0]].map(|[_, y, z]| [x, y, z]);
        for wall in [PlanarPolygon::new([wall]).unwrap(), turned(&rectangle([x, x + 1.0], [0.0, y], 1.5))] {
            let floor = rectangle([x.max(0.0), x.max(0.0) + 1.0], UNIT, 0.0);
            let alone = unoccluded_area(&floor, &wall, 1e-10).unwrap().unwrap();
            let room = Enclosure::new(vec![floor, wall]);
            let found = room.area_form_factor(0, 1, 1e-10, &Limits::default()).unwrap().unwrap();
            assert!((alone.value - found.value).abs() < 1e-10 && found.value > 0.0, "{alone:?} {found:?}");
        }
    }
}

/// A part of the floor is behind the wall: no closed form knows how much.
#[test]
fn a_polygon_that_reaches_behind_another_is_not_told_alone() {
    let wall =
        PlanarPolygon::new([[[0.5, 0.0, 0.0], [0.5, 1.0, 0.0], [0.5, 1.0, 1.0], [0.5, 0.0, 1.0]]]).unwrap();
    assert_eq!(unoccluded_area(&rectangle(UNIT, UNIT, 0.0), &wall, 1e-6), Ok(None));
    assert!(unoccluded_area(&rectangle(UNIT, UNIT, 0.0), &wall, 0.0).is_err());
}

#[test]
fn far_squares_keep_their_digits() {
    let cases = [
        ("AA-par-gap-1e3", above(UNIT, UNIT, 1e3)),
        ("AA-par-gap-1e6", above(UNIT, UNIT, 1e6)),
        ("AA-C13 far offset 1e3", above([1000.0, 1001.0], [1000.0, 1001.0], 1.0)),
    ];
    for (id, enclosure) in cases {
        let expected = closed_form(id);
        let found = enclosure.area_form_factor(0, 1, 1e-10 * expected, &Limits::default()).unwrap().unwrap();
        assert!((found.value - expected).abs() <= 1e-10 * expected, "{id}: {found:?} is not {expected:e}");
    }
}

#[test]
fn what_turns_its_back_is_not_seen() {
    let back = Enclosure::new(vec![rectangle(UNIT, UNIT, 0.0), rectangle(UNIT, UNIT, 1.0)]);
    assert_eq!(
        back.area_form_factor(0, 1, 1e-6, &Limits::default()).unwrap().unwrap(),
        AreaFormFactor::default()
    );
    assert_eq!(
        back.area_form_factor(0, 0, 1e-6, &Limits::default()).unwrap().unwrap(),
        AreaFormFactor::default()
    );
    assert!(back.area_row(0, 1e-6, &Limits::default()).unwrap().unwrap().is_empty());
}

#[test]
fn a_bad_tolerance_is_refused_and_a_cancelled_matrix_is_none() {
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert_eq!(
            squares(None).area_form_factor(0, 1, tolerance, &Limits::default()),
            Err(Error::BadTolerance)
        );
    }
    let room = squares(Some(rectangle([0.3, 0.7], [0.2, 0.9], 0.35)));
    let stopped = Limits { stop: &|| true, ..Limits::default() };
    assert_eq!(room.area_matrix(1e-9, &stopped), Ok(None));
    assert_eq!(room.area_row(0, 1e-9, &stopped), Ok(None));
    assert_eq!(room.area_form_factor(0, 1, 1e-9, &stopped), Ok(None));
}

#[test]
fn a_stop_holds_for_pairs_that_take_no_evaluation() {
    let room = squares(None);
    assert_eq!(room.area_form_factor(0, 1, 1e-9, &Limits::default()).unwrap().unwrap().evaluations, 0);
    let stopped = Limits { stop: &|| true, ..Limits::default() };
    assert_eq!(room.area_form_factor(0, 1, 1e-9, &stopped), Ok(None));
    assert_eq!(room.exchange_row(0, 1e-9, &stopped), Ok(None));
}

#[test]
fn many_points_see_what_each_sees() {
    // With one thing in between, and with many.
    let lidded = squares(Some(rectangle([0.3, 0.7], [0.2, 0.9], 0.35)));
    let points: Vec<DifferentialArea> = (1..6u32)
        .map(|i| {
            DifferentialArea::new(DVec3::new(0.1 * f64::from(i), 0.5, 0.0), DVec3::Z).unwrap().owned_by(0)
        })
        .collect();
    for (from, found) in points.iter().zip(lidded.form_factors(&points, 1)) {
        let open = unoccluded(from, &lidded.polygons()[1]).value;
        assert!(found.value < open - 1e-3, "the lid hides nothing from {from:?}");
        let alone = lidded.form_factor(from, 1);
        assert!((found.value - alone.value).abs() <= alone.error_bound + found.error_bound, "{from:?}");
    }
    let room = cornell_box();
    let points: Vec<DifferentialArea> = (0..25u32)
        .map(|i| DVec3::new(250.0 + f64::from(i % 5), 0.0, 30.0 + 4.0 * f64::from(i / 5)))
        .map(|p| DifferentialArea::new(p, DVec3::Y).unwrap().owned_by(0))
        .collect();
    for id in 0..room.polygons().len() {
        for (from, found) in points.iter().zip(room.form_factors(&points, id)) {
            let alone = room.form_factor(from, id);
            let allowed = alone.error_bound + found.error_bound;
            assert!((found.value - alone.value).abs() <= allowed, "{id}: {found:?} is not {alone:?}");
        }
    }
}

/// With the feature `rayon` pairs go to threads in any order: each is a function of its own input alone.
#[test]
fn a_matrix_is_its_pairs_bit_for_bit() {
    let room = squares(Some(rectangle([0.3, 0.7], [0.2, 0.9], 0.35)));
    let tolerance = Tolerance { absolute: 1e-4, relative: 0.0, row: f64::INFINITY };
    let rows = room.area_matrix(tolerance, &Limits::default()).unwrap().unwrap();
    for (from, row) in rows.iter().enumerate() {
        assert_eq!(*row, room.area_row(from, tolerance, &Limits::default()).unwrap().unwrap());
        for (to, factor) in row {
            assert_eq!(*factor, room.area_form_factor(from, *to, 1e-4, &Limits::default()).unwrap().unwrap());
        }
    }
}

/// A hundred boards at all places and angles. A row knows what of each is before its polygon, a pair only what is near both.
#[test]
fn a_pair_is_what_it_is_in_a_row_past_any_number_of_boards() {
    let board = |k: u32| {
        let turn = f64::from(k) * 2.4;
        let at = DVec3::new(turn.sin() * 2.0, (turn * 1.7).cos() * 2.0, 0.03 * f64::from(k));
        let along = DVec3::new(turn.cos(), turn.sin(), 0.3) * 0.4;
        let across = along.cross(DVec3::new(0.2, turn.cos(), 1.0)).normalize() * 0.3;
        PlanarPolygon::new([[at, at + along, at + along + across, at + across]]).unwrap()
    };
    let room = Enclosure::new((0..100).map(board).collect());
    let tolerance = Tolerance { absolute: 1e-3, relative: 0.0, row: f64::INFINITY };
    let mut seen = 0;
    for from in 0..100 {
        for (to, in_row) in room.area_row(from, tolerance, &Limits::default()).unwrap().unwrap() {
            let alone = room.area_form_factor(from, to, tolerance, &Limits::default()).unwrap().unwrap();
            assert_eq!(alone, in_row, "{from} {to}");
            seen += 1;
        }
    }
    assert!(seen > 500, "{seen} pairs");
}
