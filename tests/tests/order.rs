//! One answer, bit for bit, in whatever order it is asked: operands and rings in any order, rings from any point and in
//! any direction that the rule does not read. Inputs are small and of the kinds that rounding breaks.
use std::path::Path;
use tests::corpus::read_inputs;
use tests::generators::{FAMILIES, Small, small};
use tests::oracle::Operand;
use tests::random::Random;
use tests::retelling::Telling;
use tests::trees::Tree;

/// What a few operands are asked: each operation of all of them, and one expression of any shape.
fn questions(operands: &[Operand], random: &mut Random) -> Vec<Telling> {
    let leaves = |range: std::ops::Range<usize>| range.map(Tree::Operand).collect::<Vec<_>>();
    let all = || leaves(0..operands.len());
    let trees = [
        Tree::Union(all()),
        Tree::Intersection(all()),
        Tree::SymmetricDifference(all()),
        Tree::Difference(Box::new([Tree::Operand(0), Tree::Union(leaves(1..operands.len()))])),
        Tree::grow(&mut |n| random.below(n), operands.len(), 3),
    ];
    trees.into_iter().map(|tree| Telling { tree, operands: operands.to_vec() }).collect()
}

/// Every question whose answer changes when it is told in so many other words.
fn failures(name: &str, operands: &[Operand], tellings: usize) -> Vec<String> {
    let mut random = Random::new(1);
    let mut failures = Vec::new();
    for telling in questions(operands, &mut random) {
        let answer = telling.answer();
        for _ in 0..tellings {
            let other = telling.retold(&mut |n| random.below(n));
            if let Some(difference) = answer.difference(&other.answer()) {
                failures.push(format!("{name}: {difference} differs\n{telling:?}\n{other:?}"));
            }
        }
    }
    failures
}

/// So many inputs of all families together are asked for, or few.
fn inputs() -> usize {
    std::env::var("ORDER_INPUTS").map_or(1600, |count| count.parse().expect("a number"))
}

#[test]
fn small_inputs_that_rounding_breaks() {
    let inputs =
        (0..inputs()).map(|i| small(i % FAMILIES, u64::try_from(i / FAMILIES).expect("a small number")));
    let failures: Vec<String> =
        inputs.flat_map(|Small { name, operands }| failures(&name, &operands, 3)).collect();
    assert!(failures.is_empty(), "{} of them, the first {}", failures.len(), failures[0]);
}

/// Inputs whose answers once depended on the order.
#[test]
fn named_cases() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/order.json");
    let cases = read_inputs(&file).unwrap_or_else(|e| panic!("{e}"));
    assert!(cases.len() > 10, "only {} cases", cases.len());
    for (name, operands) in cases {
        assert_eq!(failures(&name, &operands, 40), Vec::<String>::new());
    }
}
