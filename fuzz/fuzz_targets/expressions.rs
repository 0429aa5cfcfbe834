//! Expressions of any shape over lattice operands, raw and as regions, against Table 3.1 over exact rationals.
#![no_main]
use arbitrary::{Arbitrary, Unstructured};
use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use polycsg::Region;
use tests::against::{check_set, region, shapes};
use tests::oracle::{Operand, Rule};
use tests::trees::Tree;
use tests::validity;

#[derive(Arbitrary, Debug)]
struct Input {
    size: u8,
    rules: [u8; 4],
    rings: [Vec<[u8; 2]>; 4],
    choices: Vec<u8>,
}

const MOST_CORNERS: usize = 8;
const DEPTH: usize = 4;

fuzz_target!(|input: Input| {
    let operands: Vec<Operand> = (0..4).map(|i| operand(&input, i)).collect();
    let regions: Vec<Region> = operands.iter().map(region).collect();
    let mut choices = Unstructured::new(&input.choices);
    // Without choices left, every one is 0: an operand.
    let mut choose = |n: usize| choices.int_in_range(0..=n - 1).unwrap_or(0);
    let tree = Tree::grow(&mut choose, operands.len(), DEPTH);
    let found = tree.csg(&operands, &regions).evaluate();
    let checked = validity::check(&shapes(&found))
        .and_then(|()| check_set(&found, &operands, |classes| tree.class(classes)));
    checked.unwrap_or_else(|e| panic!("{tree:?}: {e}\n{operands:?}"));
});

/// Those that enter as regions are rectilinear, so that making regions of them rounds nothing.
fn operand(input: &Input, index: usize) -> Operand {
    let size = input.size % 6 + 2;
    let corners = input.rings[index].iter().take(MOST_CORNERS);
    let corner = |c: &[u8; 2]| DVec2::new(f64::from(c[0] % size), f64::from(c[1] % size));
    let ring: Vec<DVec2> = corners.map(corner).collect();
    let stairs = |ring: &[DVec2]| {
        tests::exact::edges(ring).flat_map(|(p, q)| [p, DVec2::new(q.x, p.y)]).collect::<Vec<_>>()
    };
    let ring = if index % 2 == 1 { stairs(&ring) } else { ring };
    Operand { rings: vec![ring], rule: Rule::ALL[usize::from(input.rules[index] % 3)] }
}
