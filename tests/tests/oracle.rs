//! The oracle against known values and against itself: who guards the guard.
use glam::DVec2;
use num_rational::BigRational;
use tests::Ring;
use tests::exact::{nearest, ratio};
use tests::generators::{KINDS, Pair, lattice, nasty};
use tests::oracle::{Arrangement, Class, Operand, Operation, Rule};

fn ring(points: &[[f64; 2]]) -> Ring {
    points.iter().copied().map(DVec2::from).collect()
}

fn square(x: f64, y: f64, side: f64) -> Ring {
    ring(&[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
}

fn operand(rings: Vec<Ring>, rule: Rule) -> Operand {
    Operand { rings, rule }
}

/// Areas of the four operations.
fn areas(a: &Operand, b: &Operand) -> [BigRational; 4] {
    let arrangement = Arrangement::of(&[a.clone(), b.clone()]);
    Operation::ALL.map(|o| arrangement.operation(o).area())
}

fn area(operand: &Operand) -> BigRational {
    Arrangement::of(std::slice::from_ref(operand)).outline(|c| c[0]).area()
}

#[test]
fn overlapping_squares() {
    let (a, b) = (square(0.0, 0.0, 2.0), square(1.0, 1.0, 2.0));
    let found = areas(&operand(vec![a], Rule::NonZero), &operand(vec![b], Rule::NonZero));
    assert_eq!(found.map(|v| nearest(&v)), [7.0, 1.0, 3.0, 6.0]);
}

#[test]
fn squares_side_by_side_lose_their_common_edge() {
    let arrangement = Arrangement::of(
        &[square(0.0, 0.0, 1.0), square(1.0, 0.0, 1.0)].map(|r| operand(vec![r], Rule::EvenOdd)),
    );
    let union = arrangement.operation(Operation::Union);
    assert_eq!(union.merged().len(), 6);
    assert_eq!(arrangement.operation(Operation::Intersection).pieces.len(), 0);
    let difference = arrangement.operation(Operation::Difference);
    assert_eq!((difference.pieces.len(), nearest(&difference.area())), (4, 1.0));
}

#[test]
fn fill_rules_read_windings_differently() {
    // Two nested squares, the inner one wound the same way, then against.
    let (outer, inner) = (square(0.0, 0.0, 3.0), square(1.0, 1.0, 1.0));
    let against: Ring = inner.iter().rev().copied().collect();
    let by_rule = |rings: &[Ring]| Rule::ALL.map(|rule| nearest(&area(&operand(rings.to_vec(), rule))));
    assert_eq!(by_rule(&[outer.clone(), inner]), [8.0, 9.0, 9.0]);
    assert_eq!(by_rule(&[outer.clone(), against.clone()]), [8.0, 8.0, 8.0]);
    assert_eq!(by_rule(&[against]), [1.0, 1.0, 0.0]);
    assert_eq!(by_rule(&[outer.clone(), outer]), [0.0, 9.0, 9.0]);
}

#[test]
fn a_bow_tie_has_a_positive_and_a_negative_lobe() {
    let tie = ring(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
    let by_rule = Rule::ALL.map(|rule| nearest(&area(&operand(vec![tie.clone()], rule))));
    assert_eq!(by_rule, [2.0, 2.0, 1.0]);
}

#[test]
fn a_pentagram_on_integers() {
    // Corners (0,5) (3,-4) (-5,2) (5,2) (-3,-4), in star order: the pentagon in the middle is wound twice.
    let star = ring(&[[0.0, 5.0], [-3.0, -4.0], [5.0, 2.0], [-5.0, 2.0], [3.0, -4.0]]);
    let non_zero = area(&operand(vec![star.clone()], Rule::NonZero));
    let even_odd = area(&operand(vec![star], Rule::EvenOdd));
    // The sides x = ±(y − 5)/3, y = ±3x/4 − 7/4 and y = 2 meet in (±1, 2), (±9/5, −2/5) and (0, −7/4).
    let middle = |points: &[[BigRational; 2]]| {
        let n = points.len();
        let cross = |i: usize| {
            let (p, q) = (&points[i], &points[(i + 1) % n]);
            &p[0] * &q[1] - &p[1] * &q[0]
        };
        (0..n).map(cross).sum::<BigRational>() / ratio(2.0)
    };
    let at = |x: (f64, f64), y: (f64, f64)| [ratio(x.0) / ratio(x.1), ratio(y.0) / ratio(y.1)];
    let pentagon = middle(&[
        at((-1.0, 1.0), (2.0, 1.0)),
        at((-9.0, 5.0), (-2.0, 5.0)),
        at((0.0, 1.0), (-7.0, 4.0)),
        at((9.0, 5.0), (-2.0, 5.0)),
        at((1.0, 1.0), (2.0, 1.0)),
    ]);
    assert_eq!(&non_zero - &even_odd, pentagon);
}

#[test]
fn on_pieces_carry_the_side_of_the_interior() {
    let (a, b) = (square(0.0, 0.0, 1.0), square(0.0, 0.0, 1.0).into_iter().rev().collect::<Ring>());
    let arrangement = Arrangement::of(&[operand(vec![a], Rule::NonZero), operand(vec![b], Rule::NonZero)]);
    for piece in &arrangement.sub_edges {
        let expected = if piece.operand == 0 { Class::OnPlus } else { Class::OnMinus };
        assert_eq!(piece.classes, [expected; 2]);
        assert_eq!(piece.representative, piece.operand == 0);
    }
}

#[test]
fn crossings_round_to_nearest() {
    // y = x/3 meets x = 1 in (1, 1/3).
    let a = operand(vec![ring(&[[0.0, 0.0], [3.0, 1.0], [0.0, 4.0]])], Rule::NonZero);
    let b = operand(vec![ring(&[[1.0, -1.0], [9.0, -1.0], [1.0, 2.0]])], Rule::NonZero);
    let arrangement = Arrangement::of(&[a, b]);
    assert!(arrangement.vertices.iter().any(|v| v.point == DVec2::new(1.0, 1.0 / 3.0) && !v.is_input));
}

/// |A| + |B| = |A ∪ B| + |A ∩ B|, |A \ B| = |A| − |A ∩ B|, |A ⊕ B| = |A ∪ B| − |A ∩ B|, exactly.
fn assert_inclusion_exclusion(pair: &Pair) {
    let [union, intersection, difference, symmetric] = areas(&pair.a, &pair.b);
    let (a, b) = (area(&pair.a), area(&pair.b));
    assert_eq!(&a + &b, &union + &intersection, "{}", pair.name);
    assert_eq!(difference, a - &intersection, "{}", pair.name);
    assert_eq!(symmetric, union - intersection, "{}", pair.name);
}

/// As many boundary pieces start in a vertex as end there.
fn assert_closed(pair: &Pair) {
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    for operation in Operation::ALL {
        let mut balance = vec![0; arrangement.vertices.len()];
        for piece in arrangement.operation(operation).pieces {
            balance[piece.ends[0]] += 1;
            balance[piece.ends[1]] -= 1;
        }
        assert!(balance.iter().all(|&b| b == 0), "{}: {operation:?} is not closed", pair.name);
    }
}

#[test]
fn areas_obey_inclusion_and_exclusion_on_lattices() {
    for seed in 0..500 {
        assert_inclusion_exclusion(&lattice(seed));
        assert_closed(&lattice(seed));
    }
}

#[test]
fn areas_obey_inclusion_and_exclusion_on_nasty_input() {
    for kind in 0..KINDS.len() {
        for seed in 0..4 {
            assert_inclusion_exclusion(&nasty(kind, seed));
            assert_closed(&nasty(kind, seed));
        }
    }
}

#[test]
fn both_integers_give_the_same_arrangement() {
    // 65 537 times as large, a lattice no longer fits the small integer.
    let factor = 65_537.0;
    for seed in 0..200 {
        let pair = lattice(seed);
        let large = |o: &Operand| {
            let rings = o.rings.iter().map(|r| r.iter().map(|p| *p * factor).collect()).collect();
            Operand { rings, rule: o.rule }
        };
        let (a, b) = (large(&pair.a), large(&pair.b));
        let expected = areas(&pair.a, &pair.b).map(|v| v * ratio(factor) * ratio(factor));
        assert_eq!(areas(&a, &b), expected, "{}", pair.name);
    }
}
