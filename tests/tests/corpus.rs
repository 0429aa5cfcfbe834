//! Every named case, by every path, under every order of its operands, turned, mirrored and scaled.
use glam::DVec2;
use polycsg::{Csg, FillRule, Region};
use tests::against::{self, Verdict, csg, leaf, shapes};
use tests::company::{Company, without_company};
use tests::corpus::{Case, read};
use tests::exact::{nearest, power_of_two};
use tests::generators::Pair;
use tests::oracle::{Arrangement, Operand, Operation, Rule};

fn cases() -> Vec<Case> {
    let cases = read().unwrap_or_else(|e| panic!("{e}"));
    assert!(!cases.is_empty(), "the corpus is empty");
    cases
}

#[test]
fn stated_areas_are_the_exact_ones() {
    for case in cases() {
        let arrangement = Arrangement::of(&[case.pair.a.clone(), case.pair.b.clone()]);
        let exact = Operation::ALL.map(|o| nearest(&arrangement.operation(o).area()));
        assert_eq!(exact, case.areas, "{} ({})", case.pair.name, case.source);
    }
}

/// A symmetry, its name, whether it reverses directions, and what it multiplies areas by (as a power of two).
type Symmetry = (&'static str, fn(DVec2) -> DVec2, bool, i64);

const SYMMETRIES: [Symmetry; 6] = [
    ("as it is", |p| p, false, 0),
    ("turned by 90°", |p| DVec2::new(-p.y, p.x), false, 0),
    ("turned by 180°", |p| -p, false, 0),
    ("mirrored", |p| DVec2::new(-p.x, p.y), true, 0),
    ("doubled", |p| p * 2.0, false, 2),
    ("2^-40 as large", |p| p * 2.0_f64.powi(-40), false, -80),
];

#[test]
fn every_case_in_every_pose_and_order() {
    let mut failures = Vec::new();
    for case in cases() {
        for symmetry in SYMMETRIES {
            for is_swapped in [false, true] {
                failures.extend(replay(&case, symmetry, is_swapped));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn replay(case: &Case, (name, map, reverses, power): Symmetry, is_swapped: bool) -> Vec<String> {
    let pose = |o: &Operand| posed(o, map, reverses);
    let (mut a, mut b) = (pose(&case.pair.a), pose(&case.pair.b));
    if is_swapped {
        std::mem::swap(&mut a, &mut b);
    }
    let pair = Pair { name: format!("{}, {name}", case.pair.name), a, b };
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    let mut failures = Vec::new();
    for operation in Operation::ALL {
        let area = arrangement.operation(operation).area();
        let stated =
            case.areas[Operation::ALL.iter().position(|&o| o == operation).expect("one of the four")];
        let is_asymmetric = operation == Operation::Difference && is_swapped;
        if !is_asymmetric && nearest(&(&area / power_of_two(power))) != stated {
            failures.push(format!("{} {operation:?}: the oracle's area changed", pair.name));
        }
        match against::check(&pair, operation, &arrangement) {
            Ok(Verdict::Exact | Verdict::Repaired) => {}
            Err(e) => failures.push(format!("{} {operation:?} (swapped: {is_swapped}): {e}", pair.name)),
        }
        for company in Company::ALL {
            if !is_alike_in(company, &pair, operation) {
                failures.push(format!("{} {operation:?}: another region beside {company:?}", pair.name));
            }
        }
    }
    failures
}

/// Whether a result is the same, bit for bit, where far rings make every stage take its other path; a case that leaves no
/// room for them is as it is.
fn is_alike_in(company: Company, pair: &Pair, operation: Operation) -> bool {
    let size = size(pair);
    let expression = csg(operation, leaf(&pair.a), leaf(&pair.b));
    let Some(rings) = company.rings(size) else { return true };
    let others = Csg::from_rings(&rings, FillRule::NonZero).expect("finite");
    let together: Region = (expression.clone() | others).evaluate();
    let alone = expression.evaluate();
    together.polygons().count() == alone.polygons().count() + rings.len()
        && without_company(&together, size) == shapes(&alone)
}

fn size(pair: &Pair) -> f64 {
    let points = pair.a.rings.iter().chain(&pair.b.rings).flatten();
    points.map(|p| p.abs().max_element()).fold(0.0, f64::max)
}

/// On many threads as on one.
#[test]
fn all_cases_at_once() {
    let cases = cases();
    let all = || cases.iter().flat_map(|case| Operation::ALL.map(|operation| (case, operation)));
    let expressions: Vec<Csg> =
        all().map(|(case, operation)| csg(operation, leaf(&case.pair.a), leaf(&case.pair.b))).collect();
    let one_by_one: Vec<Region> = expressions.iter().map(Csg::evaluate).collect();
    assert_eq!(Csg::evaluate_all(&expressions), one_by_one);
}

#[test]
fn most_cases_leave_room_for_company() {
    let cases = cases();
    let crowded = cases.iter().filter(|case| Company::ALL[0].rings(size(&case.pair)).is_none()).count();
    assert!(10 * crowded <= cases.len(), "{crowded} of {}", cases.len());
}

/// The operand mapped; where the map reverses directions, rings are reversed, so that every rule reads them alike.
fn posed(operand: &Operand, map: fn(DVec2) -> DVec2, reverses: bool) -> Operand {
    let ring = |ring: &Vec<DVec2>| {
        let points = ring.iter().map(|p| map(*p));
        if reverses { points.rev().collect() } else { points.collect() }
    };
    Operand { rings: operand.rings.iter().map(ring).collect(), rule: operand.rule }
}

#[test]
fn the_corpus_uses_every_rule() {
    let cases = cases();
    for rule in Rule::ALL {
        assert!(cases.iter().any(|c| c.pair.a.rule == rule), "no case with {rule:?}");
    }
}
