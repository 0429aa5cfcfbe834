//! Both triangulations against the laws of a cover: no predicate but the orientation of one triangle.

use super::indexed::IndexedRegion;
use super::{delaunay, sweep};
use crate::expression::csg::FillRule;
use crate::predicates::{Side, side};
use crate::region::Region;
use glam::DVec2;
use proptest::prelude::*;

/// Counter-clockwise triangles whose edges cancel but for the region's own: so each point is covered once inside, and
/// nowhere else, for the winding number of a sum of boundaries is the sum of the winding numbers.
fn assert_covers(outline: &IndexedRegion, triangles: &[[u32; 3]]) {
    let point = |id: u32| outline.points[id as usize];
    let mut open: Vec<[u32; 2]> = Vec::new();
    for &[a, b, c] in triangles {
        assert_eq!(side(point(a), point(b), point(c)), Side::Left);
        open.extend([[a, b], [b, c], [c, a]]);
    }
    open.sort_unstable();
    assert!(open.windows(2).all(|pair| pair[0] != pair[1]), "two triangles on one side of an edge");
    let all = open.clone();
    open.retain(|&[a, b]| all.binary_search(&[b, a]).is_err());
    assert_eq!(open, outline.edges);
}

fn check(region: &Region) {
    let outline = IndexedRegion::of(region);
    let swept = sweep::triangles(&outline);
    assert_covers(&outline, &swept);
    if let Some(triangles) = delaunay::triangles(&outline) {
        assert_covers(&outline, &triangles);
        assert_eq!(triangles.len(), swept.len());
    }
}

fn rings(size: i32, step: f64) -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let point = (0..size, 0..size).prop_map(move |(x, y)| DVec2::new(f64::from(x), f64::from(y)) * step);
    proptest::collection::vec(proptest::collection::vec(point, 3..12), 1..6)
}

/// Coordinates with exponents of their own, so that many regions fit no range.
fn spread() -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let number = (-2.0..2.0f64, -1000..1000i32).prop_map(|(m, e)| m * 2f64.powi(e));
    let point = (number.clone(), number).prop_map(|(x, y)| DVec2::new(x, y));
    proptest::collection::vec(proptest::collection::vec(point, 3..7), 1..4)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn lattices((rings, step) in (2..12).prop_flat_map(|size| (rings(size, 1.0), prop_oneof![Just(1.0), Just(0.1)]))) {
        let scaled: Vec<Vec<DVec2>> = rings.iter().map(|r| r.iter().map(|&p| p * step).collect()).collect();
        check(&Region::from_rings(scaled, FillRule::EvenOdd).expect("finite"));
    }

    #[test]
    fn the_whole_range(rings in spread()) {
        check(&Region::from_rings(rings, FillRule::EvenOdd).expect("finite"));
    }
}

#[test]
fn scales_reach_both_ends_of_the_range() {
    for size in [5e-324, f64::MIN_POSITIVE, 1e-200, 1.0, 1e200, f64::MAX] {
        let square = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]];
        let outline = IndexedRegion::of(&Region::from_rings([square], FillRule::NonZero).expect("finite"));
        assert!(delaunay::triangles(&outline).is_some(), "{size:e}");
        let tall = square.map(|[x, y]| [x, if y > 0.0 { 5e-324 } else { 0.0 }]);
        let outline = IndexedRegion::of(&Region::from_rings([tall], FillRule::NonZero).expect("finite"));
        assert!(delaunay::triangles(&outline).is_some(), "{size:e} x 5e-324");
    }
}

#[test]
fn what_fits_no_range_is_swept() {
    let (tiny, huge) = (5e-324, f64::MAX);
    let square = |s: f64| [[0.0, 0.0], [s, 0.0], [s, s], [0.0, s]];
    let region = Region::from_rings([square(tiny), square(huge)], FillRule::EvenOdd).expect("finite");
    let outline = IndexedRegion::of(&region);
    assert!(delaunay::triangles(&outline).is_none());
    assert_covers(&outline, &sweep::triangles(&outline));
}
