//! What a polygon accepts, refuses, and says of itself.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DQuat;
use formfactor::{DVec3, DifferentialArea, Error, PlanarPolygon, form_factor, unoccluded, visible_part};

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];

fn square(low: f64, high: f64, z: f64) -> Vec<[f64; 3]> {
    vec![[low, low, z], [high, low, z], [high, high, z], [low, high, z]]
}

fn area_at(position: [f64; 3], normal: [f64; 3]) -> DifferentialArea {
    DifferentialArea::new(position.into(), normal.into()).unwrap()
}

#[test]
fn the_front_is_where_loop_0_is_counter_clockwise() {
    assert_eq!(PlanarPolygon::new([SQUARE]).unwrap().normal(), DVec3::Z);
    let reversed: Vec<_> = SQUARE.iter().rev().copied().collect();
    assert_eq!(PlanarPolygon::new([reversed]).unwrap().normal(), -DVec3::Z);
}

#[test]
fn areas_count_odd_insides() {
    let area = |loops: &[Vec<[f64; 3]>]| PlanarPolygon::new(loops).unwrap().area();
    assert_eq!(area(&[square(0.0, 4.0, 1.0)]), 16.0);
    let mut hole = square(1.0, 3.0, 1.0);
    assert_eq!(area(&[square(0.0, 4.0, 1.0), hole.clone()]), 12.0);
    hole.reverse();
    assert_eq!(area(&[square(0.0, 4.0, 1.0), hole.clone()]), 12.0);
    assert_eq!(area(&[square(0.0, 4.0, 1.0), hole, square(1.5, 2.5, 1.0)]), 13.0);
    let sloping =
        PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 3.0, 4.0], [0.0, 3.0, 4.0]]]).unwrap();
    assert!((sloping.area() - 5.0).abs() < 1e-14);
}

#[test]
fn bad_polygons_are_named() {
    let refused = |loops: &[Vec<[f64; 3]>]| PlanarPolygon::new(loops).unwrap_err();
    assert_eq!(refused(&[]), Error::NoLoops);
    assert_eq!(refused(&[SQUARE[..2].to_vec()]), Error::TooFewVertices { loop_index: 0, count: 2 });
    let mut bad = square(1.0, 2.0, 0.0);
    for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        bad[2][1] = number;
        assert_eq!(refused(&[SQUARE.to_vec(), bad.clone()]), Error::BadVertex { loop_index: 1, vertex: 2 });
    }
    assert_eq!(refused(&[vec![[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [3.0, 3.0, 3.0]]]), Error::ZeroArea);
    assert_eq!(refused(&[vec![[1.0; 3]; 5]]), Error::ZeroArea);
    let bow_tie = vec![[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(refused(&[bow_tie]), Error::ZeroArea);
    for small in [1e-61, 1e-100, 1e-200, 1e-300] {
        assert_eq!(refused(&[square(-small, small, 1.0)]), Error::TooSmall, "{small:e}");
        assert_eq!(refused(&[vec![[0.0; 3], [small; 3], [2.0 * small; 3]]]), Error::ZeroArea, "{small:e}");
    }
    let mut bent = SQUARE.to_vec();
    bent[1][2] = 1e-9;
    let error = refused(&[bent]);
    assert!(matches!(error, Error::NotPlanar { loop_index: 0, .. }), "{error}");
}

#[test]
fn bad_areas_are_named() {
    let nan = DifferentialArea::new(DVec3::new(0.0, f64::NAN, 0.0), DVec3::Z);
    assert_eq!(nan.unwrap_err(), Error::BadPoint);
    for normal in [DVec3::ZERO, DVec3::new(f64::NAN, 0.0, 1.0), DVec3::new(0.0, f64::INFINITY, 0.0)] {
        assert_eq!(DifferentialArea::new(DVec3::ZERO, normal).unwrap_err(), Error::BadNormal);
    }
}

#[test]
fn a_vertex_given_twice_changes_nothing() {
    // Its first corner is reflex: repeated there, or anywhere, the polygon is what it was.
    let dart = [[0.0, -2.0, 4.0], [1.0, -5.0, 4.0], [-3.0, 3.0, 4.0], [1.0, 3.0, 4.0]];
    let from = area_at([0.0, 0.5, 0.0], [0.0, 0.0, 1.0]);
    let (to, occluders) =
        (PlanarPolygon::new([dart]).unwrap(), [PlanarPolygon::new([square(-0.1, 0.4, 1.0)]).unwrap()]);
    let (free, seen) = (unoccluded(&from, &to), form_factor(&from, &to, &occluders));
    assert!(seen.value > 0.01 && seen.value < free.value);
    for i in 0..4 {
        let mut twice = dart.to_vec();
        twice.insert(i, dart[i]);
        let to = PlanarPolygon::new([twice]).unwrap();
        for (found, expected) in [(unoccluded(&from, &to), free), (form_factor(&from, &to, &occluders), seen)]
        {
            let allowed = found.error_bound + expected.error_bound;
            assert!((found.value - expected.value).abs() <= allowed, "{i}: {found:?} is not {expected:?}");
        }
    }
}

#[test]
fn thin_triangles_are_exact_as_given() {
    let thin = PlanarPolygon::new([[[0.1, 0.1, 0.1], [0.7, 0.7, 0.7], [0.3, 0.3, 0.300_000_000_000_000_04]]]);
    assert!(thin.is_ok() && thin.unwrap().area() > 0.0);
}

#[test]
fn whoever_stands_on_or_behind_a_plane_sees_none_of_it() {
    let to = PlanarPolygon::new([SQUARE]).unwrap();
    for (z, seen) in [(1.0, true), (5e-324, true), (0.0, false), (-1.0, false)] {
        let from = area_at([1.0, 1.0, z], [0.0, 0.0, -1.0]);
        let factor = unoccluded(&from, &to);
        assert_eq!(factor.value > 0.0, seen, "at {z:e}: {factor:?}");
        assert!(seen || factor.error_bound == 0.0);
    }
}

#[test]
fn the_visible_part_keeps_the_vertices_of_the_target() {
    let to = PlanarPolygon::new([[[-1.0, 1.0, 2.1], [1.0, 1.0, 1.9], [1.0, -1.0, 1.7], [-1.0, -1.0, 1.9]]])
        .unwrap();
    let from = area_at([0.0; 3], [0.0, 0.0, 1.0]);
    let occluder = PlanarPolygon::new([square(-0.25, 0.25, 1.0)]).unwrap();
    let part = visible_part(&from, &to, &[occluder]);
    let rings: Vec<Vec<DVec3>> = part.rings().collect();
    assert_eq!(rings.len(), 2);
    assert!(to.loops().flatten().all(|corner| rings[0].contains(corner)));
    assert!(rings[1].iter().all(|p| (*p / p.z * 4.0).truncate().abs() == glam_one()), "{rings:?}");
    assert!(part.area() < to.area());
}

fn glam_one() -> formfactor::glam::DVec2 {
    formfactor::glam::DVec2::ONE
}

#[test]
fn extreme_coordinates_neither_panic_nor_leave_the_unit_interval() {
    let numbers = [0.0, 1.0, -1.0, 1e60, -1e60, 1e-60, 5e-324, -5e-324, 1e-160, 3.0];
    let pick = |i: usize| numbers[(i * 7 + i / 10) % numbers.len()];
    let point = |i: usize| DVec3::new(pick(3 * i), pick(3 * i + 1), pick(3 * i + 2));
    let triangles: Vec<PlanarPolygon> = (0..400)
        .filter_map(|i| PlanarPolygon::new([[point(i), point(i + 11), point(i + 47)]]).ok())
        .collect();
    assert!(triangles.len() > 50);
    for (i, to) in triangles.iter().enumerate() {
        let Ok(from) = DifferentialArea::new(point(i + 5), point(i + 90)) else { continue };
        let factor = form_factor(&from, to, &triangles[..20]);
        assert!((0.0..=1.0).contains(&factor.value) && factor.error_bound >= 0.0, "{factor:?}");
    }
}

#[test]
fn what_lies_in_a_plane_of_the_question_blocks_nothing() {
    let to = PlanarPolygon::new([square(-1.0, 1.0, 2.0)]).unwrap();
    let from = area_at([0.25, 0.5, 3.0], [0.0, 0.0, -1.0]);
    let at = |z: f64| [PlanarPolygon::new([square(-9.0, 9.0, z)]).unwrap()];
    let free = unoccluded(&from, &to);
    assert!(free.value > 0.2);
    // In the target's plane or in the point's, and one ulp beyond either: nothing is hidden. One ulp between: all is.
    for z in [2.0, 2.0_f64.next_down(), 3.0, 3.0_f64.next_up()] {
        assert_eq!(form_factor(&from, &to, &at(z)).value, free.value, "at {z}");
    }
    for z in [2.0_f64.next_up(), 3.0_f64.next_down()] {
        assert_eq!(form_factor(&from, &to, &at(z)).value, 0.0, "at {z}");
    }
}

/// A triangle of three corners nearly on a line, which the target's plane cuts to one edge there and back.
#[test]
fn a_needle_given_twice_hides_nothing() {
    let triangle = |corners: [[f64; 3]; 3]| {
        PlanarPolygon::new([corners.map(|c| DVec3::from(c) * 0.1).to_vec()]).unwrap()
    };
    let from = area_at((DVec3::new(-3.0, -3.0, 2.0) * 0.1).to_array(), [5.0, 0.0, 7.0]);
    let to = triangle([[0.0, 3.0, 0.0], [-2.0, 3.0, 0.0], [4.0, -3.0, -2.0]]);
    let needle = triangle([[-1.0, 0.0, -2.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -5.0]]);
    let free = unoccluded(&from, &to);
    for copies in 1..5 {
        let found = form_factor(&from, &to, &vec![needle.clone(); copies]);
        let off = (found.value - free.value).abs();
        assert!(off <= found.error_bound + free.error_bound, "{copies} copies: {found:?}, {free:?} without");
    }
}

/// Of the target only a rounding is above the horizon, and the occluder lies elsewhere.
#[test]
fn nothing_covers_what_is_hardly_above_the_horizon() {
    let triangle = |corners: [[f64; 3]; 3]| {
        PlanarPolygon::new([corners.map(|c| DVec3::from(c) * 0.1).to_vec()]).unwrap()
    };
    let from = area_at((DVec3::new(0.0, 0.0, -4.0) * 0.1).to_array(), [1.0, -3.0, 0.0]);
    let to = triangle([[-2.0, 4.0, 4.0], [3.0, 1.0, 1.0], [-5.0, 1.0, 1.0]]);
    let aside = triangle([[1.0, -1.0, -6.0], [3.0, -2.0, -7.0], [1.0, -2.0, -7.0]]);
    let (free, found) = (unoccluded(&from, &to), form_factor(&from, &to, &[aside]));
    assert!(free.value > 0.0);
    assert!((found.value - free.value).abs() <= found.error_bound + free.error_bound, "{found:?}, {free:?}");
}

/// A square of side 2 about the origin, and one of side 1 on it, in a plane whose numbers are no doubles.
fn on_a_sloping_plane() -> [PlanarPolygon; 2] {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    [1.0, 0.5].map(|half: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        PlanarPolygon::new([corners.map(|[x, y]| turn * DVec3::new(x, y, 0.0) + DVec3::splat(0.1))]).unwrap()
    })
}

/// Coplanar but for rounding is coplanar: it hides nothing, and the bound counts what it would hide.
#[test]
fn what_is_coplanar_but_for_rounding_hides_nothing_and_is_in_the_bound() {
    let [whole, middle] = on_a_sloping_plane();
    for position in [[0.3, 0.2, 3.0], [1.0, 2.0, 2.0], [-2.0, 0.1, 4.0]].map(DVec3::from) {
        let from = DifferentialArea::new(position, -position).unwrap();
        let (all, found) =
            (unoccluded(&from, &whole), form_factor(&from, &whole, std::slice::from_ref(&middle)));
        let hidden = unoccluded(&from, &middle);
        assert!((all.value - found.value).abs() <= all.error_bound + found.error_bound);
        let may_hide = found.error_bound >= hidden.value;
        assert!(may_hide || found.value >= all.value - 1e-12, "{found:?} of {all:?}");
    }
}

/// A sloping board before the whole target, one of whose corners rounding put off the plane of the others.
#[test]
fn a_cover_with_a_corner_off_its_plane_hides_everything() {
    let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])
        .unwrap();
    let floor = area_at([0.0; 3], [0.0, 0.0, 1.0]);
    for slope in (1..30).map(|i| 0.01 * f64::from(i)) {
        let corner = |x: f64, y: f64| [x, y, 1.1 + slope * x + 0.07 * y];
        let board = [corner(-2.3, -2.1), corner(2.2, -2.4), corner(2.6, 2.1), corner(-2.3, 2.2)];
        let found = form_factor(&floor, &lamp, &[PlanarPolygon::new([board]).unwrap()]);
        assert!(found.value <= found.error_bound && found.error_bound < 1e-12, "{slope}: {found:?}");
    }
}

/// A point on a plane whose numbers are no doubles may be on either side of it: beside the polygon it sees next to nothing,
/// and in it the bound says that anything is possible.
#[test]
fn on_a_plane_of_rounded_numbers_the_bound_knows_both_sides() {
    let [whole, middle] = on_a_sloping_plane();
    let corners: Vec<DVec3> = middle.loops().next().unwrap().to_vec();
    let outer: Vec<DVec3> = whole.loops().next().unwrap().to_vec();
    let mut open_bounds = 0;
    for (inside, corner) in corners.iter().zip(&outer) {
        let looking = |at: DVec3| DifferentialArea::new(at, whole.normal().cross(corner - inside)).unwrap();
        for toward in [1.0, -1.0] {
            let found = unoccluded(&looking(inside + toward * 1e-3 * (corner - inside)), &whole);
            assert!(found.value <= 0.5 + found.error_bound);
            open_bounds += usize::from(found.error_bound >= 0.5);
            let beside = unoccluded(&looking(corner + toward.abs() * 3.0 * (corner - inside)), &whole);
            assert!(beside.value <= 1e-12 && beside.error_bound <= 1e-12, "{beside:?}");
        }
    }
    assert!(open_bounds > 0, "no bound left a value open");
}

#[test]
fn messages_say_where_and_what_to_do() {
    let messages = [
        (
            Error::BadPoint,
            "the point has a coordinate that is NaN, infinite or beyond 2^200; give finite numbers",
        ),
        (
            Error::BadNormal,
            "the normal is zero, not finite, or shorter than 2^-200 or longer than 2^200; give it a length near 1, as only its direction counts",
        ),
        (Error::BadTolerance, "the tolerance is not positive; give a number like 1e-6"),
        (Error::NoLoops, "the polygon has no loops; give at least its outer loop"),
        (
            Error::TooFewVertices { loop_index: 1, count: 2 },
            "loop 1 has 2 vertices; a loop needs at least three",
        ),
        (
            Error::BadVertex { loop_index: 1, vertex: 3 },
            "loop 1, vertex 3: a coordinate is NaN, infinite or beyond 2^200; give finite numbers",
        ),
        (Error::ZeroArea, "the first loop encloses no area, so that the polygon has no front; drop it"),
        (
            Error::TooSmall,
            "the first loop is too small: it encloses less than a square of side 2^-200; scale all coordinates up, as form factors have no unit, or drop it",
        ),
        (
            Error::NotPlanar { loop_index: 0, vertex: 3, distance: 0.25, allowed: 1e-15 },
            "loop 0, vertex 3: 2.5e-1 off the polygon's plane where 1e-15 is allowed; split the polygon into triangles",
        ),
    ];
    for (error, message) in messages {
        assert_eq!(error.to_string(), message);
    }
}
