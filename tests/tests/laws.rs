//! Laws of set algebra and of symmetry, bit for bit wherever they hold in exact arithmetic.
use glam::DVec2;
use num_traits::Zero;
use polycsg::{Csg, Region, Scratch};
use tests::Ring;
use tests::against::{csg, leaf, operate, region, sorted_edges, twice_area};
use tests::exact::twice_signed_area;
use tests::generators::{KINDS, Pair, lattice, nasty};
use tests::oracle::{Operand, Operation, Rule};

/// Lattices, and nasty input whose coordinates are ordinary numbers.
fn inputs() -> impl Iterator<Item = Pair> {
    let is_ordinary = |name: &str| !["exponents", "1e", "subnormals"].iter().any(|part| name.contains(part));
    let kinds = (0..KINDS.len()).filter(move |&k| is_ordinary(KINDS[k].0));
    let nasty_pairs = kinds.flat_map(|kind| (0..10).map(move |seed| nasty(kind, seed)));
    (0..400).map(lattice).chain(nasty_pairs)
}

fn all_inputs() -> impl Iterator<Item = Pair> {
    (0..400).map(lattice).chain((0..KINDS.len()).flat_map(|kind| (0..10).map(move |seed| nasty(kind, seed))))
}

fn mapped(operand: &Operand, map: impl Fn(DVec2) -> DVec2) -> Operand {
    Operand {
        rings: operand.rings.iter().map(|r| r.iter().map(|p| map(*p)).collect()).collect(),
        rule: operand.rule,
    }
}

fn mapped_edges(region: &Region, map: impl Fn(DVec2) -> DVec2, reverses: bool) -> Vec<[DVec2; 2]> {
    let mut edges = sorted_edges(region);
    for edge in &mut edges {
        *edge = edge.map(&map);
        if reverses {
            edge.reverse();
        }
    }
    tests::oracle::sort(&mut edges);
    edges
}

fn evaluate(operation: Operation, pair: &Pair) -> Region {
    csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate()
}

#[test]
fn union_intersection_and_symmetric_difference_commute_bit_for_bit() {
    for pair in all_inputs() {
        for operation in [Operation::Union, Operation::Intersection, Operation::SymmetricDifference] {
            let swapped = csg(operation, leaf(&pair.b), leaf(&pair.a)).evaluate();
            assert_eq!(evaluate(operation, &pair), swapped, "{} {operation:?}", pair.name);
        }
    }
}

#[test]
fn a_region_combined_with_itself() {
    for pair in all_inputs() {
        let a = region(&pair.a);
        assert_eq!(a.union(&a), a, "{}: A ∪ A", pair.name);
        assert_eq!(a.intersection(&a), a, "{}: A ∩ A", pair.name);
        assert!(a.difference(&a).is_empty(), "{}: A \\ A", pair.name);
        assert!(a.symmetric_difference(&a).is_empty(), "{}: A ⊕ A", pair.name);
    }
}

#[test]
fn the_empty_set_is_neutral() {
    let empty = Region::default();
    for pair in all_inputs() {
        let a = region(&pair.a);
        assert_eq!(a.union(&empty), a, "{}", pair.name);
        assert_eq!(a.difference(&empty), a, "{}", pair.name);
        assert_eq!(a.symmetric_difference(&empty), a, "{}", pair.name);
        assert!(a.intersection(&empty).is_empty(), "{}", pair.name);
        assert!(empty.difference(&a).is_empty(), "{}", pair.name);
    }
}

/// Straight vertices go but where rings touch, and the set stays, exactly.
#[test]
fn straight_vertices_can_be_left_out() {
    let (mut left_out, mut kept) = (0, 0);
    for pair in all_inputs() {
        let result = evaluate(Operation::Union, &pair);
        let lean = result.without_collinear_vertices();
        assert_eq!(lean.validate(), Ok(()), "{}", pair.name);
        let differ = (Csg::from(&lean) ^ Csg::from(&result)).boundary(&mut Scratch::default()).is_empty();
        assert!(differ && twice_area(&lean) == twice_area(&result), "{}", pair.name);
        let vertices: Vec<DVec2> = result.rings().flatten().copied().collect();
        for ring in lean.rings() {
            for i in 0..ring.len() {
                let [p, q, r] = [0, 1, 2].map(|k| ring[(i + k) % ring.len()]);
                let is_common = vertices.iter().filter(|&&other| other == q).count() > 1;
                let is_straight = twice_signed_area([&[p, q, r][..]]).is_zero();
                assert!(is_common || !is_straight, "{}: {q} is left", pair.name);
                kept += usize::from(is_common && is_straight);
            }
        }
        left_out += vertices.len() - lean.rings().flatten().count();
    }
    assert!(left_out > 300 && kept > 0, "{left_out} left out, {kept} kept");
}

#[test]
fn a_result_read_again_is_itself() {
    for pair in all_inputs() {
        for operation in Operation::ALL {
            let result = evaluate(operation, &pair);
            for rule in [Rule::EvenOdd, Rule::NonZero, Rule::Positive] {
                let again = Region::from_rings(result.rings(), tests::against::fill_rule(rule))
                    .expect("finite rings");
                assert_eq!(again, result, "{} {operation:?} {rule:?}", pair.name);
            }
        }
    }
}

/// |A| + |B| = |A ∪ B| + |A ∩ B| exactly where crossings are doubles: on lattices of axis-parallel rings.
#[test]
fn areas_add_up_exactly_on_rectilinear_lattices() {
    for seed in 0..400 {
        let rectilinear = |o: &Operand| Operand { rings: o.rings.iter().map(stairs).collect(), rule: o.rule };
        let pair = lattice(seed);
        let (a, b) = (region(&rectilinear(&pair.a)), region(&rectilinear(&pair.b)));
        let [union, intersection, difference, symmetric] =
            Operation::ALL.map(|o| twice_area(&operate(o, &a, &b)));
        assert_eq!(twice_area(&a) + twice_area(&b), &union + &intersection, "lattice {seed}");
        assert_eq!(difference, twice_area(&a) - &intersection, "lattice {seed}");
        assert_eq!(symmetric, union - intersection, "lattice {seed}");
    }
}

/// Each edge replaced by one along x and one along y.
fn stairs(ring: &Ring) -> Ring {
    tests::exact::edges(ring).flat_map(|(p, q)| [p, DVec2::new(q.x, p.y)]).collect()
}

#[test]
fn de_morgan_within_a_frame() {
    for pair in inputs() {
        let frame = [[-1e16, -1e16], [1e16, -1e16], [1e16, 1e16], [-1e16, 1e16]];
        let frame = || Csg::from_rings([frame], polycsg::FillRule::NonZero).expect("a finite frame");
        let [a, b] = [&pair.a, &pair.b];
        let left = (frame() - (leaf(a) | leaf(b))).evaluate();
        let right = ((frame() - leaf(a)) & (frame() - leaf(b))).evaluate();
        assert_eq!(left, right, "{}", pair.name);
    }
}

#[test]
fn a_ring_may_start_anywhere_and_rings_come_in_any_order() {
    for pair in all_inputs() {
        let turned = |o: &Operand| {
            let turn = |(i, r): (usize, &Ring)| {
                let mut ring = r.clone();
                ring.rotate_left((i + 1) % r.len());
                ring
            };
            Operand { rings: o.rings.iter().enumerate().map(turn).rev().collect(), rule: o.rule }
        };
        for operation in Operation::ALL {
            let other = csg(operation, leaf(&turned(&pair.a)), leaf(&turned(&pair.b))).evaluate();
            assert_eq!(evaluate(operation, &pair), other, "{} {operation:?}", pair.name);
        }
    }
}

#[test]
fn direction_does_not_matter_to_even_odd_and_non_zero() {
    for pair in all_inputs() {
        for rule in [Rule::EvenOdd, Rule::NonZero] {
            let forward = |o: &Operand| Operand { rings: o.rings.clone(), rule };
            let backward = |o: &Operand| Operand {
                rings: o.rings.iter().map(|r| r.iter().rev().copied().collect()).collect(),
                rule,
            };
            for operation in Operation::ALL {
                let found = csg(operation, leaf(&forward(&pair.a)), leaf(&forward(&pair.b))).evaluate();
                let other = csg(operation, leaf(&backward(&pair.a)), leaf(&backward(&pair.b))).evaluate();
                assert_eq!(found, other, "{} {operation:?} {rule:?}", pair.name);
            }
        }
    }
}

#[test]
fn scaling_by_a_power_of_two_scales_the_result() {
    let powers = [0.5, 1024.0, 2.0_f64.powi(-300), 2.0_f64.powi(300), 2.0_f64.powi(-900), 2.0_f64.powi(900)];
    for pair in inputs() {
        for power in powers {
            let scale = |p: DVec2| p * power;
            for operation in Operation::ALL {
                let scaled =
                    csg(operation, leaf(&mapped(&pair.a, scale)), leaf(&mapped(&pair.b, scale))).evaluate();
                let expected = mapped_edges(&evaluate(operation, &pair), scale, false);
                assert_eq!(sorted_edges(&scaled), expected, "{} {operation:?} {power:e}", pair.name);
            }
        }
    }
}

/// Quarter turns and mirrors map doubles to doubles and rounding to rounding. Mirrors reverse directions, so the
/// positive rule, which tells them apart, is left out.
#[test]
fn quarter_turns_and_mirrors_map_results_to_results() {
    type Map = fn(DVec2) -> DVec2;
    let maps: [(Map, bool); 3] = [
        (|p| DVec2::new(-p.y, p.x), false),
        (|p| DVec2::new(-p.x, p.y), true),
        (|p| DVec2::new(p.y, p.x), true),
    ];
    for pair in all_inputs().filter(needs_no_repair) {
        for (map, reverses) in maps {
            if reverses && [&pair.a, &pair.b].iter().any(|o| o.rule == Rule::Positive) {
                continue;
            }
            for operation in Operation::ALL {
                let found =
                    csg(operation, leaf(&mapped(&pair.a, map)), leaf(&mapped(&pair.b, map))).evaluate();
                let expected = mapped_edges(&evaluate(operation, &pair), map, reverses);
                assert_eq!(sorted_edges(&found), expected, "{} {operation:?}", pair.name);
            }
        }
    }
}

/// Repair may prefer one axis; what needs none has no preference.
fn needs_no_repair(pair: &Pair) -> bool {
    let arrangement = tests::oracle::Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    let merged = |o| arrangement.operation(o).merged();
    Operation::ALL.iter().all(|&o| tests::validity::is_bounding(&merged(o)))
}

#[test]
fn a_scratch_remembers_nothing() {
    let mut scratch = polycsg::Scratch::default();
    for pair in all_inputs() {
        for operation in Operation::ALL {
            let reused = csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate_with(&mut scratch);
            assert_eq!(reused, evaluate(operation, &pair), "{} {operation:?}", pair.name);
        }
    }
}
