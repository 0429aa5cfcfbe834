//! Boxes and slabs are two ways to one result.
use crate::contacts::Patience;
use crate::{Csg, FillRule, Region, Scratch};
use glam::DVec2;
use proptest::prelude::*;

fn hasty() -> Scratch {
    Scratch { patience: Patience::NONE, ..Scratch::default() }
}

fn rings(points: impl Strategy<Value = DVec2>) -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    prop::collection::vec(prop::collection::vec(points, 3..9), 5..14)
}

fn check(rings: &[Vec<DVec2>], rule: FillRule) {
    let (a, b) = rings.split_at(rings.len() / 2);
    let operand = |rings: &[Vec<DVec2>]| Csg::rings(rings, rule).expect("finite");
    for csg in
        [operand(a) | operand(b), operand(a) & operand(b), operand(a) - operand(b), operand(a) ^ operand(b)]
    {
        let (region, pieces): (Region, usize) =
            (csg.evaluate(), csg.boundary(&mut Scratch::default()).edges().count());
        assert_eq!(csg.evaluate_in(&mut hasty()), region);
        assert_eq!(csg.boundary(&mut hasty()).edges().count(), pieces);
        assert_eq!(region.validate(), Ok(()));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    #[test]
    fn agree_on_lattices(rings in (2..9).prop_flat_map(|size| {
        rings((0..size, 0..size).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))))
    })) {
        check(&rings, FillRule::EvenOdd);
        check(&rings, FillRule::NonZero);
    }

    #[test]
    fn agree_in_the_square(rings in rings((0.0..1.0, 0.0..1.0).prop_map(DVec2::from))) {
        check(&rings, FillRule::EvenOdd);
    }

    #[test]
    fn agree_within_a_few_ulps(rings in rings((0_u64..6, 0_u64..40).prop_map(|(x, y)| {
        DVec2::new(f64::from_bits(1.5_f64.to_bits() + x), f64::from_bits(2.5_f64.to_bits() + y))
    }))) {
        check(&rings, FillRule::EvenOdd);
    }

    #[test]
    fn agree_over_the_whole_range(rings in rings([prop::num::f64::NORMAL, prop::num::f64::NORMAL].prop_map(DVec2::from))) {
        check(&rings, FillRule::NonZero);
    }
}
