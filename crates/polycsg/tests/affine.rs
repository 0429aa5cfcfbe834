//! Affine maps of regions: exact where nothing rounds, valid everywhere.

use polycsg::glam::{DAffine2, DMat2};
use polycsg::{DVec2, Error, FillRule, Region};
use proptest::prelude::*;

fn lattice_rings() -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let point = (0..7i32, 0..7i32).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)));
    proptest::collection::vec(proptest::collection::vec(point, 3..9), 1..5)
}

fn region() -> impl Strategy<Value = Region> {
    lattice_rings().prop_map(|rings| Region::from_rings(rings, FillRule::EvenOdd).expect("finite"))
}

/// Edges along x and y in turn, so that all crossings are lattice points.
fn rectilinear() -> impl Strategy<Value = Region> {
    lattice_rings().prop_map(|rings| {
        let stairs = |ring: Vec<DVec2>| -> Vec<DVec2> {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).flat_map(|(&p, q)| [p, DVec2::new(q.x, p.y)]).collect()
        };
        Region::from_rings(rings.into_iter().map(stairs), FillRule::EvenOdd).expect("finite")
    })
}

fn matrix(columns: [f64; 4]) -> DAffine2 {
    DAffine2::from_mat2(DMat2::from_cols_array(&columns))
}

fn map(region: &Region, by: DAffine2) -> Region {
    region.map_affine(by).expect("finite")
}

const QUARTER_TURN: [f64; 4] = [0.0, 1.0, -1.0, 0.0];
const MIRROR: [f64; 4] = [0.0, 1.0, 1.0, 0.0];
const SHEAR: [f64; 4] = [1.0, 0.0, 3.0, 1.0];

proptest! {
    #[test]
    fn powers_of_two_scale_every_vertex(region in region(), exponent in -1000..1000i32) {
        let power = 2f64.powi(exponent);
        let scaled = map(&region, DAffine2::from_scale(DVec2::splat(power)));
        let rings: Vec<Vec<DVec2>> = region.rings().map(|r| r.iter().map(|&p| p * power).collect()).collect();
        prop_assert_eq!(scaled.rings().map(<[DVec2]>::to_vec).collect::<Vec<_>>(), rings);
    }

    #[test]
    fn symmetries_return_to_the_start(region in region()) {
        let turned = |r: &Region| map(r, matrix(QUARTER_TURN));
        prop_assert_eq!(&turned(&turned(&turned(&turned(&region)))), &region);
        prop_assert_eq!(&map(&map(&region, matrix(MIRROR)), matrix(MIRROR)), &region);
        // The sum starts elsewhere: its rounding may fall on the other side.
        for image in [turned(&region), map(&region, matrix(MIRROR))] {
            prop_assert!((image.area() - region.area()).abs() <= f64::EPSILON * region.area());
        }
    }

    #[test]
    fn maps_that_round_nothing_commute_with_booleans(a in rectilinear(), b in rectilinear(), by in prop_oneof![
        Just(matrix(QUARTER_TURN)), Just(matrix(MIRROR)), Just(matrix(SHEAR)),
        Just(DAffine2::from_translation(DVec2::new(-3.0, 1024.0)))
    ]) {
        prop_assert_eq!(map(&a.union(&b), by), map(&a, by).union(&map(&b, by)));
        prop_assert_eq!(map(&a.intersection(&b), by), map(&a, by).intersection(&map(&b, by)));
        prop_assert_eq!(map(&a.difference(&b), by), map(&a, by).difference(&map(&b, by)));
        prop_assert_eq!(map(&a, by).area(), a.area()); // an integer, and all have determinant ±1
    }

    #[test]
    fn what_rounds_stays_valid(region in region(), angle in 0.0..6.3f64, shrink in prop_oneof![Just(1.0), Just(1e-16)]) {
        let by = DAffine2::from_scale_angle_translation(DVec2::new(1.0, shrink), angle, DVec2::new(0.1, 1e3));
        let mapped = map(&region, by);
        prop_assert_eq!(mapped.validate(), Ok(()));
        // Each of at most 100 edges, of length 10, moves by an ulp of 1e3.
        prop_assert!((mapped.area() - region.area() * shrink).abs() < 100.0 * 10.0 * 2.3e-13);
    }
}

#[test]
fn a_singular_map_leaves_nothing() {
    let square = Region::from_rings([[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]], FillRule::NonZero)
        .expect("finite");
    for columns in [[0.0; 4], [1.0, 0.0, 0.0, 0.0], [1.0, 2.0, 1.0, 2.0]] {
        assert!(map(&square, matrix(columns)).is_empty(), "{columns:?}");
    }
}

#[test]
fn what_leaves_the_range_is_named() {
    let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]];
    let region = Region::from_rings([square(0.0), square(3.0)], FillRule::NonZero).expect("finite");
    let too_large = DAffine2::from_scale(DVec2::splat(f64::MAX / 2.0));
    assert_eq!(region.map_affine(too_large), Err(Error::NonFinite { ring: 1, vertex: 0 }));
    let nan = DAffine2::from_translation(DVec2::new(f64::NAN, 0.0));
    assert_eq!(region.map_affine(nan), Err(Error::NonFinite { ring: 0, vertex: 0 }));
}
