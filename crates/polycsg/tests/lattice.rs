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

/// A field of a board of 8 by 8, and which way its ring runs.
type Field = (u32, bool);

fn square((field, clockwise): Field) -> Vec<DVec2> {
    let low = DVec2::new(f64::from(field % 8), f64::from(field / 8));
    let mut ring: Vec<DVec2> = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| low + p).into();
    if clockwise {
        ring.reverse();
    }
    ring
}

/// All fields of a set run one way; a few more lie on others, or run the other way.
fn fields() -> impl Strategy<Value = Vec<Field>> {
    let more = proptest::collection::vec((0_u32..64, any::<bool>()), 0..2);
    (any::<u64>(), any::<bool>(), more).prop_map(|(set, clockwise, more)| {
        (0..64).filter(|field| set >> field & 1 == 1).map(|field| (field, clockwise)).chain(more).collect()
    })
}

fn holds(fields: &[Field], rule: FillRule, at: u32) -> bool {
    let here = fields.iter().filter(|(field, _)| *field == at);
    let winding: i32 = here.map(|&(_, clockwise)| if clockwise { -1 } else { 1 }).sum();
    match rule {
        FillRule::EvenOdd => winding % 2 != 0,
        FillRule::NonZero => winding != 0,
        FillRule::Positive => winding > 0,
    }
}

fn count(holds: impl Fn(u32) -> bool) -> f64 {
    (0..64).map(|at| f64::from(u8::from(holds(at)))).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Fields that lie apart share a counter, others do not.
    #[test]
    fn fields_add_up(a in fields(), b in fields(), rules in [rule(), rule()]) {
        let raw = |fields: &[Field], rule| Csg::from_rings(fields.iter().map(|&f| square(f)), rule).expect("finite");
        let [in_a, in_b] = [(&a, rules[0]), (&b, rules[1])].map(|(fields, rule)| move |at| holds(fields, rule, at));
        let either = raw(&a, rules[0]) ^ raw(&b, rules[1]);
        prop_assert_eq!(either.evaluate().area(), count(|at| in_a(at) != in_b(at)));
        let union = raw(&a, rules[0]) | raw(&b, rules[1]);
        prop_assert_eq!(union.evaluate().area(), count(|at| in_a(at) || in_b(at)));
        let regions = [&a, &b].map(|fields| -> Vec<Region> {
            let region = |&f: &Field| Region::from_rings([square(f)], FillRule::NonZero).expect("finite");
            fields.iter().map(region).collect()
        });
        let covers = |fields: &[Field], at| fields.iter().any(|(field, _)| *field == at);
        let either = Csg::union(&regions[0]) ^ Csg::union(&regions[1]);
        prop_assert_eq!(either.evaluate().area(), count(|at| covers(&a, at) != covers(&b, at)));
    }

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
