//! Points in a few places, some ulps apart: an expression in any order of its operands and rings, from any start and in any
//! direction that the rule does not read, evaluates to the same bits.
#![no_main]
use arbitrary::{Arbitrary, Unstructured};
use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use tests::oracle::{Operand, Rule};
use tests::retelling::Telling;
use tests::trees::Tree;

#[derive(Arbitrary, Debug)]
struct Input {
    scale: i8,
    places: [[i8; 2]; 4],
    rules: u8,
    rings: Vec<(u8, Vec<Corner>)>,
    choices: Vec<u8>,
}

#[derive(Arbitrary, Debug, Clone, Copy)]
struct Corner {
    place: u8,
    /// Moves by so many ulps.
    ulps: [i8; 2],
}

const OPERANDS: usize = 3;
const MOST_RINGS: usize = 8;
const MOST_CORNERS: usize = 6;
const DEPTH: usize = 3;

fuzz_target!(|input: Input| {
    let mut choices = Unstructured::new(&input.choices);
    // Without choices left, every one is 0.
    let mut choose = |n: usize| choices.int_in_range(0..=n - 1).unwrap_or(0);
    let operands: Vec<Operand> = (0..OPERANDS).map(|i| operand(&input, i)).collect();
    let tree = Tree::grow(&mut choose, operands.len(), DEPTH);
    let all = || (0..operands.len()).map(Tree::Operand).collect();
    for tree in [tree, Tree::Union(all()), Tree::SymmetricDifference(all())] {
        let telling = Telling { tree, operands: operands.clone() };
        let other = telling.retold(&mut choose);
        let difference = telling.answer().difference(&other.answer());
        assert_eq!(difference, None, "\n{telling:?}\n{other:?}");
    }
});

fn operand(input: &Input, index: usize) -> Operand {
    let rule = if input.rules >> index & 1 == 0 { Rule::EvenOdd } else { Rule::NonZero };
    let own = input.rings.iter().take(MOST_RINGS).filter(|ring| usize::from(ring.0) % OPERANDS == index);
    let ring =
        |ring: &(u8, Vec<Corner>)| ring.1.iter().take(MOST_CORNERS).map(|c| point(*c, input)).collect();
    Operand { rings: own.map(ring).collect(), rule }
}

fn point(corner: Corner, input: &Input) -> DVec2 {
    let place = input.places[usize::from(corner.place % 4)];
    let coordinate = |axis: usize| {
        let at = f64::from(place[axis]) / 3.0 * 2.0_f64.powi(i32::from(input.scale) * 8);
        let moved = at.to_bits().saturating_add_signed(i64::from(corner.ulps[axis]));
        if at == 0.0 { f64::from(corner.ulps[axis]) * 5e-324 } else { f64::from_bits(moved) }
    };
    DVec2::new(coordinate(0), coordinate(1))
}
