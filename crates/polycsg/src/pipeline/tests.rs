//! Boxes and slabs are two ways to one result.
use super::scratch::Scratch;
use crate::contacts::budget::WorkBudget;
use crate::error::Error;
use crate::expression::csg::{Csg, FillRule};
use crate::predicates::{Side, side};
use crate::region::Region;
use glam::DVec2;
use proptest::prelude::*;

fn by_slabs() -> Scratch {
    Scratch { budget: WorkBudget::NONE, ..Scratch::default() }
}

fn rings(points: impl Strategy<Value = DVec2>) -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    prop::collection::vec(prop::collection::vec(points, 3..9), 5..14)
}

fn whole() -> impl Strategy<Value = DVec2> {
    (-6..7_i8, -6..7_i8).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)))
}

fn check(rings: &[Vec<DVec2>], rule: FillRule) {
    let (a, b) = rings.split_at(rings.len() / 2);
    let operand = |rings: &[Vec<DVec2>]| Csg::from_rings(rings, rule).expect("finite");
    for csg in
        [operand(a) | operand(b), operand(a) & operand(b), operand(a) - operand(b), operand(a) ^ operand(b)]
    {
        let (region, pieces): (Region, usize) =
            (csg.evaluate(), csg.boundary(&mut Scratch::default()).edges().count());
        assert_eq!(csg.evaluate_with(&mut by_slabs()), region);
        assert_eq!(csg.boundary(&mut by_slabs()).edges().count(), pieces);
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

    /// Lattice points an ulp or two beside one another: ends beside ends, and beside edges of all slopes.
    #[test]
    fn agree_beside_a_lattice(rings in rings(((0..5_u32, 0..4_u64), (0..5_u32, 0..4_u64)).prop_map(|(x, y)| {
        let near = |(i, ulps)| f64::from_bits((0.1 + 0.37 * f64::from(i)).to_bits() + ulps);
        DVec2::new(near(x), near(y))
    }))) {
        check(&rings, FillRule::EvenOdd);
    }

    #[test]
    fn agree_over_the_whole_range(rings in rings([prop::num::f64::NORMAL, prop::num::f64::NORMAL].prop_map(DVec2::from))) {
        check(&rings, FillRule::NonZero);
    }
}

/// Of many operands, those that are simple rings share counters; with a point as a second ring they do not.
fn check_sharing(rings: &[Vec<DVec2>], rule: FillRule) {
    let alone = |ring: &Vec<DVec2>| Csg::from_rings([ring], rule).expect("finite");
    let accompanied = |ring: &Vec<DVec2>| Csg::from_rings([&ring[..], &ring[..1]], rule).expect("finite");
    let (a, b) = rings.split_at(rings.len() / 2);
    let shared = |rings: &[Vec<DVec2>]| rings.iter().map(alone).collect::<Vec<_>>();
    let apart = |rings: &[Vec<DVec2>]| rings.iter().map(accompanied).collect::<Vec<_>>();
    for [shared, apart] in [
        [Csg::union(shared(rings)), Csg::union(apart(rings))],
        [Csg::union(shared(a)) - Csg::union(shared(b)), Csg::union(apart(a)) - Csg::union(apart(b))],
        [Csg::symmetric_difference(shared(rings)), Csg::symmetric_difference(apart(rings))],
        [
            Csg::union(shared(a)) & Csg::intersection(shared(&b[..2])),
            Csg::union(apart(a)) & Csg::intersection(apart(&b[..2])),
        ],
    ] {
        assert_eq!(shared.evaluate(), apart.evaluate());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn simple_rings_agree_with_others(
        lattice in prop::collection::vec(prop::collection::vec(whole(), 3..6), 13..24),
        square in prop::collection::vec(prop::collection::vec((0.0..1.0, 0.0..1.0).prop_map(DVec2::from), 3..6), 13..18),
    ) {
        for rule in [FillRule::EvenOdd, FillRule::NonZero, FillRule::Positive] {
            check_sharing(&lattice, rule);
        }
        check_sharing(&square, FillRule::NonZero);
    }

    /// Corners of several rings in one point, a rounding away from an edge that cuts them off, and an edge through it.
    #[test]
    fn agree_on_corners_beside_an_edge(
        (ends, part) in (prop::array::uniform2(whole()), 1..10_u8),
        corners in prop::collection::vec(prop::array::uniform2(whole()), 2..6),
        through in any::<bool>(),
    ) {
        let corner = (ends[0] * f64::from(10 - part) + ends[1] * f64::from(part)) / 10.0;
        let mut rings = vec![vec![ends[0], ends[1], DVec2::new(0.0, 7.0)]];
        rings.extend(corners.iter().map(|&[p, q]| vec![corner, p, q]));
        let beside = |x: f64| corner + DVec2::new(x, 0.0);
        rings.extend(through.then(|| vec![beside(-3.0), beside(3.0), DVec2::new(0.4, -5.0)]));
        let half = rings.len() / 2;
        rings.rotate_left(half);
        for rule in [FillRule::NonZero, FillRule::EvenOdd] {
            check(&rings, rule);
        }
    }

    /// Tips a few ulps beside an edge that others cross, so that rounding moves it: at all slopes, and at its end.
    #[test]
    fn agree_on_tips_beside_an_edge(
        (x, run) in (0.3..0.7, -30.0..-1.0_f64),
        tips in prop::collection::vec((0.0..1.01, -3..4_i8, -0.2..0.2_f64), 1..6),
        crossings in prop::collection::vec((0.05..0.95, -0.1..0.1_f64), 1..4),
        turned in any::<bool>(),
    ) {
        let along = |t: f64| DVec2::new(x + t * run.exp2(), 0.1 + 0.8 * t);
        let mut rings = vec![vec![along(0.0), along(1.0), DVec2::new(0.0, 0.45)]];
        rings.extend(tips.iter().map(|&(t, ulps, rise)| {
            let side = if ulps < 0 { -0.25 } else { 0.25 };
            let tip = along(t) + DVec2::new(f64::from(ulps) * f64::EPSILON / 4.0, 0.0);
            vec![tip, tip + DVec2::new(side, rise), tip + DVec2::new(side, rise - 0.01)]
        }));
        rings.extend(crossings.iter().map(|&(t, rise)| {
            let p = along(t);
            vec![p - DVec2::new(0.2, rise), p + DVec2::new(0.2, rise), p + DVec2::new(0.2, rise - 0.01)]
        }));
        let turn = |p: &DVec2| if turned { p.perp() } else { *p };
        let rings: Vec<Vec<DVec2>> = rings.iter().map(|ring| ring.iter().map(turn).collect()).collect();
        check(&rings, FillRule::EvenOdd);
        check(&rings, FillRule::NonZero);
    }
}

/// Without the boxes' shortcut.
fn boundless() -> Scratch {
    let mut scratch = Scratch::default();
    scratch.expression.bounds.off = true;
    scratch
}

/// Operands spread over the plane, by a stack of operators: each takes what stands below it.
fn expression<'a>(leaves: &'a [Region], operators: &[u8]) -> Csg<'a> {
    let mut rest = leaves.iter().map(Csg::from).collect::<Vec<_>>();
    for operator in operators {
        let (Some(b), Some(a)) = (rest.pop(), rest.pop()) else { break };
        rest.insert(
            usize::from(*operator) % (rest.len() + 1),
            match operator % 4 {
                0 => a | b,
                1 => a & b,
                2 => a - b,
                _ => a ^ b,
            },
        );
    }
    Csg::union(rest)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Rings that miss the result's bounds change nothing, not even by a vertex.
    #[test]
    fn bounds_change_nothing(
        leaves in prop::collection::vec((0..12_i32, 0..12_i32, prop::collection::vec((0..6_i32, 0..6_i32), 3..9)), 2..9),
        operators in prop::collection::vec(any::<u8>(), 8),
    ) {
        let region = |(x, y, ring): &(i32, i32, Vec<(i32, i32)>)| {
            let points: Vec<DVec2> = ring.iter().map(|(a, b)| DVec2::new(f64::from(x + a), f64::from(y + b))).collect();
            Region::from_rings([points.as_slice(), &points[..3]], FillRule::NonZero).expect("finite")
        };
        let leaves: Vec<Region> = leaves.iter().map(region).collect();
        let csg = expression(&leaves, &operators);
        prop_assert_eq!(csg.evaluate(), csg.evaluate_with(&mut boundless()));
        let edges = |scratch: &mut Scratch| csg.boundary(scratch).edges().collect::<Vec<_>>();
        prop_assert_eq!(edges(&mut Scratch::default()), edges(&mut boundless()));
    }
}

/// What is subtracted elsewhere costs nothing but a look at its boxes: no edge of it is arranged.
#[test]
fn what_lies_elsewhere_is_not_arranged() {
    let square =
        |x: f64| [DVec2::new(x, 0.0), DVec2::new(x + 1.0, 0.0), DVec2::new(x + 1.0, 1.0), DVec2::new(x, 1.0)];
    let region = |rings: Vec<[DVec2; 4]>| Region::from_rings(rings, FillRule::NonZero).expect("finite");
    let (a, far) =
        (region(vec![square(0.0)]), region((2..100).map(|i| square(2.0 * f64::from(i))).collect()));
    let mut scratch = Scratch::default();
    assert_eq!((Csg::from(&a) - Csg::from(&far)).evaluate_with(&mut scratch), a);
    assert_eq!(scratch.edges.edges.rings().len(), 1);
    assert!((Csg::from(&a) & Csg::from(&far)).evaluate_with(&mut scratch).is_empty());
    assert_eq!(scratch.edges.edges.rings().len(), 0);
    let near = region((0..100).map(|i| square(0.5 + 2.0 * f64::from(i))).collect());
    assert_eq!((Csg::from(&a) - Csg::from(&near)).evaluate_with(&mut scratch).area(), 0.5);
    assert_eq!(scratch.edges.edges.rings().len(), 2);
}

/// Boxes that stand on a line and hang from it, wherever it leads: their edges on it overlap in part.
fn on_a_line(count: u32, along: DVec2, seed: u32) -> Vec<Vec<DVec2>> {
    let mut state = seed;
    let mut next = |most: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from((state >> 16) % most)
    };
    let boxes = (0..count).map(|_| {
        let (low, width, height) = (next(400), 1.0 + next(60), next(9) - 4.5);
        let [a, b] = [low, low + width].map(|t| along * t);
        let up = along.perp() * height;
        vec![a, b, b + up, a + up]
    });
    boxes.collect()
}

/// Edges that overlap in part are cut where they are many: what stands far away, so that they are a small share, changes nothing.
#[test]
fn overlapping_edges_are_one() {
    let far: Vec<Vec<DVec2>> = (0..40_000)
        .map(|i| {
            let low = DVec2::new(1e4 + 4.0 * f64::from(i % 200), f64::from(4 * (i / 200)));
            [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|corner| low + corner).to_vec()
        })
        .collect();
    for (along, seed) in [(DVec2::X, 1), (DVec2::Y, 2), (DVec2::new(3.0, 2.0), 3), (DVec2::new(-1.0, 4.0), 4)]
    {
        let (a, b) = (on_a_line(150, along, seed), on_a_line(150, along, seed + 10));
        for rule in [FillRule::EvenOdd, FillRule::NonZero, FillRule::Positive] {
            let (mut cut, mut not) = (Scratch::default(), Scratch::default());
            let operand = |rings: &[Vec<DVec2>]| Csg::from_rings(rings, rule).expect("finite");
            let both = |a: &[Vec<DVec2>]| {
                [operand(a) ^ operand(&b), operand(a) - operand(&b), operand(a) & operand(&b)]
            };
            for (alone, beside) in both(&a).into_iter().zip(both(&[&a[..], &far[..]].concat())) {
                let alone = alone.evaluate_with(&mut cut);
                let beside = (beside - operand(&far)).evaluate_with(&mut not);
                assert_eq!(alone, beside);
                assert_eq!(alone.validate(), Ok(()));
                assert!(cut.edges.edges.rings().iter().any(|ring| ring.is_open));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// What one of many operands covers is left out, and changes no bit, nor a vertex where it touches the border from inside:
    /// as one operand, the same rings are all arranged.
    #[test]
    fn covered_rings_change_nothing(
        corners in prop::collection::vec(prop::array::uniform3((0..12_u8, 0..12_u8)), 80..160),
        large in prop::collection::vec(((0..6_u8, 0..6_u8), (6..13_u8, 6..13_u8)), 12..20),
        backward in any::<u64>(),
    ) {
        let point = |&(x, y): &(u8, u8)| DVec2::new(f64::from(x), f64::from(y));
        let boxes = large.iter().map(|((x, y), (z, w))| vec![(*x, *y), (*z, *y), (*z, *w), (*x, *w)]);
        let rings: Vec<Vec<DVec2>> = corners
            .iter()
            .map(|corners| corners.to_vec())
            .chain(boxes)
            .map(|ring| ring.iter().map(point).collect())
            .filter(|ring: &Vec<DVec2>| side(ring[0], ring[1], ring[2]) == Side::Left)
            .collect();
        let turned = rings.iter().enumerate().map(|(i, ring)| {
            let ring = ring.iter().copied();
            if backward >> (i % 64) & 1 == 1 { ring.rev().collect::<Vec<_>>() } else { ring.collect() }
        });
        let operand = |ring: Vec<DVec2>| Csg::from_rings([ring], FillRule::NonZero).expect("finite");
        let apart = Csg::union(turned.map(operand));
        let together = Csg::from_rings(&rings, FillRule::NonZero).expect("finite");
        let square = || operand(vec![DVec2::splat(2.5), DVec2::new(8.5, 3.0), DVec2::new(7.0, 9.0)]);
        let not_a_union = Csg::symmetric_difference([together.clone()]).evaluate();
        prop_assert_eq!(&apart.evaluate(), &not_a_union);
        prop_assert_eq!(&together.evaluate(), &not_a_union);
        prop_assert_eq!((square() - apart.clone()).evaluate(), (square() - together.clone()).evaluate());
        prop_assert_eq!((square() ^ apart).evaluate(), (square() ^ together).evaluate());
    }
}

/// Uprights across levels, some of them slanted so that slabs have work: 4 n² crossings.
fn comb(n: u32, slant: f64) -> Csg<'static> {
    let bars = || (0..n).map(|i| 2.0 * f64::from(i));
    let end = 2.0 * f64::from(n);
    let upright = bars().map(|x| [[x, -1.0], [x + 1.0, -1.0], [x + slant + 1.0, end], [x + slant, end]]);
    let level = bars().map(|y| [[-1.0, y], [end + slant, y], [end + slant, y + 1.0], [-1.0, y + 1.0]]);
    Csg::from_rings(upright, FillRule::NonZero).expect("finite")
        & Csg::from_rings(level, FillRule::NonZero).expect("finite")
}

/// Each of 4 n² crossings is a contact of two edges: by boxes and by slabs, one less than that is too little, and what is
/// refused leaves the scratch as good as new.
#[test]
fn contacts_are_counted() {
    for (n, slant) in [(30, 0.0), (30, 7.3), (3, 0.0)] {
        let csg = comb(n, slant);
        let needed = 8 * n as usize * n as usize;
        for mut scratch in [Scratch::default(), by_slabs()] {
            let refused = csg.try_evaluate_with(&mut scratch, needed - 1);
            assert_eq!(refused, Err(Error::TooManyContacts { limit: needed - 1 }));
            let small = comb(2, 0.5);
            assert_eq!(small.evaluate_with(&mut scratch), small.evaluate());
            assert_eq!(csg.try_evaluate_with(&mut scratch, needed), Ok(csg.evaluate()));
            assert_eq!(csg.evaluate_with(&mut scratch), csg.evaluate());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50))]

    /// Any limit refuses or changes nothing, and a higher one refuses no more.
    #[test]
    fn a_limit_changes_no_result(
        rings in rings((0.0..1.0, 0.0..1.0).prop_map(DVec2::from)),
        limit in 0_usize..200,
    ) {
        let csg = Csg::from_rings(&rings, FillRule::EvenOdd).expect("finite");
        for mut scratch in [Scratch::default(), by_slabs()] {
            match csg.try_evaluate_with(&mut scratch, limit) {
                Ok(region) => {
                    prop_assert_eq!(&region, &csg.evaluate());
                    prop_assert_eq!(csg.try_evaluate_with(&mut scratch, limit + 1), Ok(region));
                }
                Err(refused) => prop_assert_eq!(refused, Error::TooManyContacts { limit }),
            }
        }
    }
}

/// Found with 800 rings: what is near the last cuts was no longer asked for halfway through the fragments, and a class of
/// which half was known was cut elsewhere.
#[test]
fn where_boxes_do_not_prune_a_repair_is_the_same_in_any_order() {
    let mut seed = 1_u32;
    let mut below = |n: u32| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from((seed >> 8) % n)
    };
    let sheared = |x: f64, y: f64| DVec2::new(x + y * f64::EPSILON, y + x * 2.0 * f64::EPSILON);
    let mut shape = || {
        let (x, y, w, h) = (below(12), below(12), 1.0 + below(9), 1.0 + below(9));
        match below(3) {
            0.0 => vec![sheared(x, y), sheared(x + w, y), sheared(x + w, y + h), sheared(x, y + h)],
            1.0 => vec![sheared(x, y), sheared(x + w, y), sheared(x, y + h)],
            _ => vec![sheared(x, y), sheared(x + w, y + h), sheared(x + 2.0 * w, y), sheared(x + w, y - h)],
        }
    };
    for _ in 0..20 {
        let mut rings: Vec<Vec<DVec2>> = (0..60).map(|_| shape()).collect();
        let region =
            |rings: &[Vec<DVec2>]| Csg::from_rings(rings, FillRule::EvenOdd).expect("finite").evaluate();
        let first = region(&rings);
        rings.reverse();
        assert_eq!(region(&rings), first);
        rings.rotate_left(60 / 3);
        assert_eq!(region(&rings), first);
    }
}
