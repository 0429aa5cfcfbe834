//! The kinds of input on which polygon libraries fail: no panic, a valid region, the right area, for every operation.
use glam::DVec2;
use num_bigint::BigInt;
use num_rational::BigRational;
use polycsg::{FillRule, Region};
use tests::against::{self, Verdict, check_classify, check_locate, leaf};
use tests::exact::{nearest, ratio};
use tests::generators::{KINDS, Pair, nasty};
use tests::oracle::{Arrangement, Operand, Operation, Rule};
use tests::random::Random;
use tests::survey::survey;

/// Inputs of each kind: 24 kinds of 30 are 720 inputs.
const INPUTS: u64 = 30;

/// Inputs of each kind for which the area between the result and the exact set is found also where each vertex is known
/// to be right. The example `nasty_table` does so for all.
const SURVEYED: u64 = 5;

/// All failures of a kind, each with its input.
fn failures(kind: usize) -> Vec<String> {
    let row = survey(kind, SURVEYED);
    assert_eq!(row.evaluations, 20);
    let mut failures = row.failures;
    for pair in (SURVEYED..INPUTS).map(|seed| nasty(kind, seed)) {
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        for operation in Operation::ALL {
            let checked = against::check(&pair, operation, &arrangement);
            failures.extend(checked.err().map(|e| format!("{} {operation:?}: {e}", pair.name)));
        }
    }
    failures
}

fn assert_kinds(kinds: impl Iterator<Item = usize>) {
    let failures: Vec<String> = kinds.flat_map(failures).collect();
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

/// Repair is rare where coordinates are ordinary: were everything "repaired", the bits would never be looked at.
#[test]
fn most_results_need_no_repair() {
    let kind = KINDS.iter().position(|k| k.0 == "general position").expect("a kind of that name");
    for seed in 0..INPUTS {
        let pair = nasty(kind, seed);
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        for operation in Operation::ALL {
            assert_eq!(against::check(&pair, operation, &arrangement), Ok(Verdict::Exact), "{}", pair.name);
        }
    }
}

// Two tests, so that two cores share the work.
#[test]
fn even_kinds_are_valid_and_right() {
    assert_kinds((0..KINDS.len()).step_by(2));
}

#[test]
fn odd_kinds_are_valid_and_right() {
    assert_kinds((1..KINDS.len()).step_by(2));
}

/// Needles in all directions through a box of some ulps: on each edge all crossings lie nearly in one place, and
/// hardly one keeps its place where it is rounded.
#[test]
fn needles_through_a_few_ulps_are_right() {
    let mut random = Random::new(11);
    for seed in 0..8 {
        let mut needle = || {
            let along = DVec2::from_angle(random.angle());
            let middle = DVec2::ONE + along.perp() * random.range(-5e-15, 5e-15);
            vec![middle - along, middle + along, middle + along + along.perp() * 4e-15]
        };
        let [a, b] =
            [0, 1].map(|_| Operand { rings: (0..3).map(|_| needle()).collect(), rule: Rule::NonZero });
        let pair = Pair { name: format!("needles through a few ulps {seed}"), a, b };
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        for operation in Operation::ALL {
            against::check(&pair, operation, &arrangement).expect(&pair.name);
        }
    }
}

fn all() -> impl Iterator<Item = Pair> {
    (0..KINDS.len()).flat_map(|kind| (0..INPUTS).map(move |seed| nasty(kind, seed)))
}

/// A vertex of a result is an input vertex, or one of the arrangement's crossings rounded once, unless it was repaired.
#[test]
fn vertices_are_input_bits_or_rounded_crossings() {
    for pair in all() {
        let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
        let outline = arrangement.operation(Operation::SymmetricDifference);
        if !tests::validity::is_bounding(&outline.merged()) {
            continue;
        }
        let result = (leaf(&pair.a) ^ leaf(&pair.b)).evaluate();
        for point in result.rings().flatten() {
            assert!(arrangement.vertices.iter().any(|v| v.point == *point), "{}: {point} is new", pair.name);
        }
    }
}

/// The area in doubles is the exact area of the rounded rings within the rounding of a sum of products.
#[test]
fn areas_in_doubles_are_the_rings_areas() {
    for pair in all() {
        let result = (leaf(&pair.a) | leaf(&pair.b)).evaluate();
        let exact = against::twice_area(&result) / BigInt::from(2);
        let bound = sum_bound(&result);
        let (low, high) = (nearest(&(&exact - &bound)), nearest(&(&exact + &bound)));
        let area = result.area();
        assert!(low <= area && area <= high, "{}: {area} is not in {low} ..= {high}", pair.name);
    }
}

/// Where the terms of the sum cancel but for less than a double holds of them, the area still is right to two ulps: needles
/// whose third vertex is the rounded middle of the others', moved by at most an ulp.
#[test]
fn areas_of_needles_are_right_to_two_ulps() {
    let mut random = Random::new(7);
    let mut seen = 0;
    for _ in 0..2_000 {
        let mut number = || random.range(-1.0, 1.0) * 2.0_f64.powi(random.between(-60, 2));
        let (a, b) = (DVec2::new(number(), number()), DVec2::new(number(), number()));
        let middle = a.midpoint(b);
        for c in
            [middle, DVec2::new(middle.x.next_up(), middle.y), DVec2::new(middle.x, middle.y.next_down())]
        {
            let needle = Region::from_rings([[a, b, c]], FillRule::EvenOdd).expect("finite points");
            let exact = nearest(&(against::twice_area(&needle) / BigInt::from(2)));
            let area = needle.area();
            assert!((area - exact).abs() <= 2.0 * f64::EPSILON * exact, "{a} {b} {c}: {area}, not {exact}");
            seen += usize::from(area > 0.0 && area < 1e-16 * ((b - a).x * (b - a).y).abs());
        }
    }
    assert!(seen > 1_000, "only {seen} were needles");
}

/// Four roundings for each vertex, each of a number no larger than the box around the region; and one of the sum.
fn sum_bound(region: &Region) -> BigRational {
    let points = || region.rings().flatten();
    let extent = |axis: usize| {
        let values = || points().map(|p| p[axis]);
        ratio(values().fold(f64::NEG_INFINITY, f64::max)) - ratio(values().fold(f64::INFINITY, f64::min))
    };
    if region.is_empty() {
        return ratio(0.0);
    }
    let roundings = BigInt::from(4 * points().count() + 1);
    extent(0) * extent(1) * ratio(f64::EPSILON) * &roundings + ratio(5e-324) * &roundings
}

#[test]
fn segments_are_classified_as_the_oracle_does() {
    let mut failures = Vec::new();
    for pair in all() {
        let region = against::region(&pair.a);
        for segment in pair.b.rings[0].windows(2) {
            if segment[0] == segment[1] {
                continue;
            }
            let checked = check_classify([segment[0], segment[1]], &region);
            failures.extend(checked.err().map(|e| format!("{}: {e}", pair.name)));
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}

/// The vertices of the other operand, the region's own, and the middles of its edges, which rounding puts near them.
#[test]
fn points_are_located_as_the_oracle_does() {
    let mut failures = Vec::new();
    for pair in all() {
        let region = against::region(&pair.a);
        let own = region.rings().flat_map(tests::exact::edges).flat_map(|(p, q)| [p, p / 2.0 + q / 2.0]);
        for point in own.chain(pair.b.rings.iter().flatten().copied()) {
            let checked = check_locate(point, &region);
            failures.extend(checked.err().map(|e| format!("{}: {e}", pair.name)));
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures.join("\n"));
}
