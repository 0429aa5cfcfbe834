//! Input that is no polygon: a typed error, or the set that it stands for; never a panic, never a hang.
use glam::DVec2;
use polycsg::{Csg, Error, FillRule, Location, Region, classify};
use tests::against::check;
use tests::generators::Pair;
use tests::oracle::{Arrangement, Operand, Operation, Rule};
use tests::random::Random;

const RULES: [FillRule; 3] = [FillRule::EvenOdd, FillRule::NonZero, FillRule::Positive];

fn square() -> Vec<DVec2> {
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from).to_vec()
}

#[test]
fn not_a_number_and_infinity_are_errors_that_name_the_vertex() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for vertex in 0..4 {
            for axis in 0..2 {
                let mut ring = square();
                ring[vertex][axis] = bad;
                for rule in RULES {
                    let rings = [square(), ring.clone()];
                    let expected = Error::NonFinite { ring: 1, vertex };
                    assert_eq!(Region::from_rings(&rings, rule), Err(expected));
                    assert_eq!(Csg::from_rings(&rings, rule).err(), Some(expected));
                    assert!(expected.to_string().contains(&format!("ring 1, vertex {vertex}")));
                }
            }
        }
    }
}

#[test]
fn a_segment_must_be_finite() {
    let region = Region::from_rings([square()], FillRule::NonZero).expect("a square");
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(classify([DVec2::new(bad, 0.0), DVec2::ONE], &region).is_err());
        assert!(classify([DVec2::ONE, DVec2::new(0.0, bad)], &region).is_err());
    }
}

#[test]
fn points_that_are_nowhere_lie_outside() {
    let region = Region::from_rings([square()], FillRule::NonZero).expect("a square");
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for other in [bad, 0.0, 0.5, 1.0] {
            assert_eq!(region.locate(DVec2::new(bad, other)), Location::Outside);
            assert_eq!(region.locate(DVec2::new(other, bad)), Location::Outside);
        }
    }
}

#[test]
fn what_bounds_nothing_is_the_empty_set() {
    let line = |n: i32| (0..n).map(|i| DVec2::new(f64::from(i), 2.0 * f64::from(i))).collect::<Vec<_>>();
    let there_and_back: Vec<DVec2> = line(9).into_iter().chain(line(9).into_iter().rev()).collect();
    let flat = [vec![], vec![DVec2::ONE], line(2), line(3), line(9), there_and_back, vec![DVec2::ONE; 5]];
    for rule in RULES {
        for ring in &flat {
            let region = Region::from_rings([ring], rule).expect("finite points");
            assert!(region.is_empty() && region.area() == 0.0 && region.polygons().count() == 0, "{ring:?}");
        }
        assert!(Region::from_rings(&flat, rule).expect("finite points").is_empty());
        assert!(Region::from_rings(Vec::<Vec<DVec2>>::new(), rule).expect("no points").is_empty());
    }
}

#[test]
fn operands_that_bound_nothing_change_nothing() {
    let region = Region::from_rings([square()], FillRule::NonZero).expect("a square");
    let flat = vec![DVec2::new(-1.0, 0.5), DVec2::new(2.0, 0.5)];
    for rule in RULES {
        let line = || Csg::from_rings([&flat], rule).expect("finite points");
        assert_eq!((Csg::from(&region) | line()).evaluate(), region);
        assert_eq!((Csg::from(&region) - line()).evaluate(), region);
        assert!((Csg::from(&region) & line()).evaluate().is_empty());
    }
}

#[test]
fn repeated_points_change_nothing() {
    let region = Region::from_rings([square()], FillRule::NonZero).expect("a square");
    let doubled: Vec<DVec2> = square().into_iter().flat_map(|p| [p, p, p]).chain([DVec2::ZERO]).collect();
    for rule in RULES {
        assert_eq!(Region::from_rings([&doubled], rule), Ok(region.clone()));
    }
}

#[test]
fn negative_zero_reads_as_zero() {
    let signed: Vec<DVec2> = square().iter().map(|p| p.map(|v| if v == 0.0 { -0.0 } else { v })).collect();
    let region = Region::from_rings([&signed], FillRule::NonZero).expect("a square");
    assert!(region.rings().flatten().all(|p| p.x.is_sign_positive() && p.y.is_sign_positive()));
}

#[test]
fn many_copies_of_one_ring_wind_many_times() {
    let copies = 100_000;
    for (count, is_even_odd_empty) in [(copies, true), (copies + 1, false)] {
        let rings = vec![square(); count];
        let expected = Region::from_rings([square()], FillRule::NonZero).expect("a square");
        assert_eq!(Region::from_rings(&rings, FillRule::NonZero), Ok(expected.clone()));
        let even_odd = Region::from_rings(&rings, FillRule::EvenOdd).expect("finite points");
        assert_eq!(even_odd.is_empty(), is_even_odd_empty);
    }
}

#[test]
fn the_whole_range_of_doubles() {
    for side in [5e-324, f64::MIN_POSITIVE, 1e-200, 1.0, 1e200, f64::MAX] {
        let large: Vec<DVec2> = square().iter().map(|p| *p * side).collect();
        let half: Vec<DVec2> = large.iter().map(|p| p.min(DVec2::new(side, side / 2.0))).collect();
        let [large, half] =
            [large, half].map(|r| Region::from_rings([r], FillRule::NonZero).expect("finite points"));
        assert_eq!(large.intersection(&half), half);
        assert_eq!(large.difference(&half).union(&half).difference(&large), Region::default());
    }
}

#[test]
fn opposite_corners_of_the_range() {
    let max = f64::MAX;
    let ring = [[-max, -max], [max, -max], [max, max], [-max, max]].map(DVec2::from);
    let tiny = [[-5e-324, 0.0], [5e-324, -5e-324], [0.0, 5e-324]].map(DVec2::from);
    let (all, dot) = (
        Region::from_rings([ring], FillRule::NonZero).expect("finite points"),
        Region::from_rings([tiny], FillRule::NonZero).expect("finite points"),
    );
    assert_eq!(all.intersection(&dot), dot);
    assert_eq!(all.difference(&dot).polygons().map(|p| p.holes().count()).sum::<usize>(), 1);
    assert_eq!(all.area(), f64::INFINITY);
}

/// Edges wider than the largest double: their widths overflow, and nothing may be read off an overflow.
#[test]
fn edges_wider_than_the_range() {
    let point = |x: i32, y: i32| DVec2::new(f64::from(x) / 8.0 * f64::MAX, f64::from(y));
    let operand = |rings: &[&[(i32, i32)]]| Operand {
        rings: rings.iter().map(|ring| ring.iter().map(|&(x, y)| point(x, y)).collect()).collect(),
        rule: Rule::EvenOdd,
    };
    // Found at random: the nesting never came to an end.
    let a = operand(&[&[(7, 0), (-1, 10), (-3, 28)], &[(7, 25), (0, 10), (1, 32)]]);
    let b = operand(&[&[(5, 19), (-8, 23), (1, 2), (6, 4)]]);
    let mut random = Random::new(5);
    let mut triangle = || [(); 3].map(|()| (random.between(-8, 8), random.between(0, 40)));
    let pairs = (0..100).map(|_| (operand(&[&triangle(), &triangle()]), operand(&[&triangle()])));
    for (a, b) in std::iter::once((a, b)).chain(pairs) {
        let pair = Pair { name: "wide".into(), a, b };
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        for operation in Operation::ALL {
            check(&pair, operation, &arrangement).unwrap_or_else(|e| panic!("{operation:?}: {e}\n{pair:?}"));
        }
    }
}
