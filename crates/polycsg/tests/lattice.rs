//! Laws of set algebra on small lattices, where degenerate contacts are the rule.

use polycsg::{Csg, DVec2, FillRule, Region, Scratch};
use proptest::prelude::*;

fn ring(size: i32) -> impl Strategy<Value = Vec<DVec2>> {
    proptest::collection::vec((0..size, 0..size), 3..9)
        .prop_map(|points| points.into_iter().map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))).collect())
}

fn rings() -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    (2..9).prop_flat_map(|size| proptest::collection::vec(ring(size), 1..4))
}

fn rule() -> impl Strategy<Value = FillRule> {
    prop_oneof![Just(FillRule::EvenOdd), Just(FillRule::NonZero), Just(FillRule::Positive)]
}

fn region() -> impl Strategy<Value = Region> {
    (rings(), rule()).prop_map(|(rings, rule)| Region::from_rings(rings, rule).expect("finite"))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn results_are_valid_and_areas_add_up(a in region(), b in region()) {
        let (union, common) = (a.union(&b), a.intersection(&b));
        let (rest, either) = (a.difference(&b), a.symmetric_difference(&b));
        for r in [&a, &b, &union, &common, &rest, &either] {
            prop_assert_eq!(r.validate(), Ok(()));
        }
        let close = |x: f64, y: f64| (x - y).abs() < 1e-11;
        prop_assert!(close(union.area() + common.area(), a.area() + b.area()));
        prop_assert!(close(rest.area(), a.area() - common.area()));
        prop_assert!(close(either.area(), union.area() - common.area()));
        prop_assert_eq!(&b.union(&a), &union);
        prop_assert_eq!(&b.intersection(&a), &common);
        prop_assert_eq!(&a.union(&a), &a);
        prop_assert!(a.difference(&a).is_empty());
    }

    #[test]
    fn boundary_and_region_enclose_the_same(a in rings(), b in rings(), rule in rule()) {
        let csg = Csg::from_rings(&a, rule).expect("finite") - Csg::from_rings(&b, rule).expect("finite");
        let mut scratch = Scratch::default();
        let area = csg.boundary(&mut scratch).area();
        prop_assert!((csg.evaluate().area() - area).abs() < 1e-11);
    }
}
