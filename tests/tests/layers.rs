//! One answer, bit for bit, for layers of many rings: as one set, as operands, as two parts, told in other words and on
//! other numbers of threads. `order.rs` asks the same of small inputs.
use polycsg::Region;
use tests::against::leaf;
use tests::generators::{LAYERS, layer};
use tests::oracle::{Operand, Rule};
use tests::random::Random;
use tests::retelling::Telling;
use tests::trees::Tree;

/// So many rings a layer are asked for, or few.
fn rings() -> usize {
    std::env::var("LAYER_RINGS").map_or(400, |count| count.parse().expect("a number"))
}

/// The layer as one set of rings, ring by ring, and as two parts of which one is taken from the other or both.
fn questions(kind: usize, rule: Rule) -> [Telling; 4] {
    let rings = layer(kind, 1, rings());
    let operand = |rings: &[_]| Operand { rings: rings.to_vec(), rule };
    let (first, second) = rings.split_at(rings.len() / 3);
    let parts = vec![operand(first), operand(second)];
    let leaves = |count| (0..count).map(Tree::Operand).collect::<Vec<_>>();
    [
        Telling { tree: Tree::Operand(0), operands: vec![operand(&rings)] },
        Telling { tree: Tree::Union(leaves(rings.len())), operands: rings.chunks(1).map(operand).collect() },
        Telling { tree: Tree::SymmetricDifference(leaves(2)), operands: parts.clone() },
        Telling { tree: Tree::Difference(Box::new([Tree::Operand(1), Tree::Operand(0)])), operands: parts },
    ]
}

fn answer(telling: &Telling) -> Region {
    telling.tree.of(&|operand| leaf(&telling.operands[operand])).evaluate()
}

#[test]
fn layers_in_other_words_on_other_numbers_of_threads() {
    let mut random = Random::new(1);
    let pools = [1, 2, 3].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads"));
    for (kind, (name, _)) in LAYERS.iter().enumerate() {
        for rule in [Rule::EvenOdd, Rule::NonZero] {
            for (number, question) in questions(kind, rule).iter().enumerate() {
                let expected = answer(question);
                expected.validate().unwrap_or_else(|e| panic!("{name}, {rule:?}, question {number}: {e}"));
                assert!(!expected.is_empty(), "{name}, {rule:?}, question {number}");
                for pool in &pools {
                    let other = question.retold(&mut |n| random.below(n));
                    let found = pool.install(|| answer(&other));
                    assert_eq!(found, expected, "{name}, {rule:?}, question {number}");
                }
            }
        }
    }
}
