//! The same bits whatever the order: of operands, of rings, of threads; and for inputs scaled by powers of two the
//! scaled bits. Inputs are large enough that every stage takes its general path.
use glam::DVec2;
use polycsg::{Csg, FillRule, Region};
use tests::Ring;
use tests::against::leaf;
use tests::generators::{KINDS, crowd, nasty};
use tests::oracle::Operand;
use tests::random::Random;

/// Jagged polygons that all contain the middle of the crowd.
fn around_the_middle(seed: u64) -> [Ring; 6] {
    let mut random = Random::new(seed);
    let mut corner = |i: i32| {
        DVec2::splat(10.0)
            + DVec2::from_angle(f64::from(i) / 20.0 * std::f64::consts::TAU) * random.range(4.0, 9.0)
    };
    [(); 6].map(|()| (0..20).map(&mut corner).collect())
}

fn shuffled<T: Clone>(items: &[T], random: &mut Random) -> Vec<T> {
    let mut items = items.to_vec();
    for i in (1..items.len()).rev() {
        items.swap(i, random.below(i + 1));
    }
    items
}

/// Started elsewhere; where asked for, run the other way.
fn rewritten(ring: &Ring, reverses: bool, random: &mut Random) -> Ring {
    let mut ring = ring.clone();
    let start = random.below(ring.len());
    ring.rotate_left(start);
    if reverses {
        ring.reverse();
    }
    ring
}

fn read(rings: &[Ring], rule: FillRule) -> Region {
    Region::from_rings(rings, rule).expect("finite rings")
}

#[test]
fn rings_in_any_order_from_any_vertex() {
    for (seed, rule) in [(1, FillRule::EvenOdd), (2, FillRule::NonZero), (3, FillRule::Positive)] {
        let rings = crowd(seed, 600);
        let expected = read(&rings, rule);
        assert!(expected.rings().map(<[DVec2]>::len).sum::<usize>() > 500, "a small result tells little");
        let mut random = Random::new(seed);
        for _ in 0..4 {
            // Under the even-odd rule each ring may run either way; otherwise they keep their directions.
            let mut rewrite = |ring: &Ring| {
                let reverses = rule == FillRule::EvenOdd && random.one_in(2);
                rewritten(ring, reverses, &mut random)
            };
            let other: Vec<Ring> = rings.iter().map(&mut rewrite).collect();
            assert_eq!(read(&shuffled(&other, &mut random), rule), expected, "{rule:?}");
        }
    }
}

#[test]
fn operands_in_any_order() {
    let rings = crowd(4, 300);
    let regions: Vec<Region> =
        rings.iter().map(|ring| read(std::slice::from_ref(ring), FillRule::NonZero)).collect();
    let large = around_the_middle(5).map(|ring| read(&[ring], FillRule::NonZero));
    let results = |small: &[Region], large: &[Region]| {
        [
            Csg::union(small).evaluate(),
            Csg::symmetric_difference(small).evaluate(),
            Csg::intersection(large).evaluate(),
            (Csg::union(large) - Csg::union(small)).evaluate(),
        ]
    };
    let expected = results(&regions, &large);
    assert!(expected.iter().all(|region| !region.is_empty()));
    let mut random = Random::new(6);
    for _ in 0..3 {
        let (small, large) = (shuffled(&regions, &mut random), shuffled(&large, &mut random));
        assert_eq!(results(&small, &large), expected);
    }
}

#[test]
fn nasty_operands_in_any_order() {
    for (kind, (name, _)) in KINDS.iter().enumerate() {
        let pairs = (0..3).map(|seed| nasty(kind, seed));
        let operands: Vec<Operand> = pairs.flat_map(|pair| [pair.a, pair.b]).collect();
        let results = |operands: &[Operand]| {
            let leaves = || operands.iter().map(leaf);
            [Csg::union(leaves()), Csg::intersection(leaves()), Csg::symmetric_difference(leaves())]
                .map(|expression| expression.evaluate())
        };
        let expected = results(&operands);
        let mut random = Random::new(7);
        for _ in 0..3 {
            assert_eq!(results(&shuffled(&operands, &mut random)), expected, "{name}");
        }
    }
}

#[test]
fn powers_of_two_scale_large_results() {
    let rings = crowd(8, 400);
    let points = |region: &Region| region.rings().map(<[DVec2]>::to_vec).collect::<Vec<_>>();
    let scaled = |rings: &[Ring], power: f64| -> Vec<Ring> {
        rings.iter().map(|ring| ring.iter().map(|&p| p * power).collect()).collect()
    };
    for rule in [FillRule::EvenOdd, FillRule::NonZero] {
        let expected = points(&read(&rings, rule));
        for exponent in [-960, -500, -200, -1, 1, 100, 400, 1000] {
            let power = 2.0_f64.powi(exponent);
            let found = points(&read(&scaled(&rings, power), rule));
            assert_eq!(found, scaled(&expected, power), "2^{exponent}, {rule:?}");
        }
    }
}

#[test]
fn any_number_of_threads() {
    let pairs: Vec<_> = (0..KINDS.len()).flat_map(|kind| (0..6).map(move |seed| nasty(kind, seed))).collect();
    let jobs: Vec<Csg<'_>> = pairs
        .iter()
        .flat_map(|pair| [leaf(&pair.a) | leaf(&pair.b), leaf(&pair.a) ^ leaf(&pair.b)])
        .chain(
            (10..14).map(|seed| Csg::from_rings(crowd(seed, 300), FillRule::NonZero).expect("finite rings")),
        )
        .collect();
    let serial: Vec<Region> = jobs.iter().map(Csg::evaluate).collect();
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        assert_eq!(pool.install(|| Csg::evaluate_all(&jobs)), serial, "{threads} threads");
    }
}
