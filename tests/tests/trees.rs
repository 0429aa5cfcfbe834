//! Random expressions of any shape against the oracle, which applies them to the classes of each piece of an edge.
use glam::DVec2;
use polycsg::{Csg, Region, Scratch};
use tests::against::{self, check_set, shapes};
use tests::exact::edges;
use tests::generators::lattice;
use tests::oracle::Operand;
use tests::random::Random;
use tests::trees::Tree;
use tests::validity;

/// Lattice operands; those that enter as regions are rectilinear, so that making regions of them rounds nothing.
fn operands(seed: u64) -> Vec<Operand> {
    let pairs = [lattice(2 * seed), lattice(2 * seed + 1)];
    let all = pairs.into_iter().flat_map(|pair| [pair.a, pair.b]).enumerate();
    all.map(|(i, operand)| if i % 2 == 0 { operand } else { rectilinear(&operand) }).collect()
}

fn rectilinear(operand: &Operand) -> Operand {
    let corner = |(p, q): (DVec2, DVec2)| [p, DVec2::new(q.x, p.y)];
    let rings = operand.rings.iter().map(|ring| edges(ring).flat_map(corner).collect());
    Operand { rings: rings.collect(), rule: operand.rule }
}

#[test]
fn any_expression_is_the_set_that_the_table_makes() {
    let mut scratch = Scratch::default();
    for seed in 0..400 {
        let operands = operands(seed);
        let regions: Vec<Region> = operands.iter().map(against::region).collect();
        let mut random = Random::new(seed);
        for depth in 1..5 {
            let tree = Tree::grow(&mut |n| random.below(n), operands.len(), depth);
            let found = tree.csg(&operands, &regions).evaluate_with(&mut scratch);
            let checked = validity::check(&shapes(&found))
                .and_then(|()| check_set(&found, &operands, |classes| tree.class(classes)));
            checked.unwrap_or_else(|e| panic!("lattices {seed}: {tree:?}: {e}"));
        }
    }
}

#[test]
fn what_combines_nothing_is_the_empty_set_also_as_an_operand() {
    let region = against::region(&rectilinear(&lattice(1).a));
    let all = || Csg::from(&region);
    let none: [Csg<'_>; 0] = [];
    for empty in [Csg::union(none.clone()), Csg::intersection(none.clone()), Csg::symmetric_difference(none)]
    {
        assert!(empty.evaluate().is_empty());
        assert!((empty.clone() & all()).evaluate().is_empty());
        assert!(Csg::intersection([all(), empty.clone(), all()]).evaluate().is_empty());
        assert!((empty.clone() - all()).evaluate().is_empty());
        assert_eq!((all() - empty.clone()).evaluate(), region);
        assert_eq!((all() | empty.clone()).evaluate(), region);
        assert_eq!((all() ^ empty).evaluate(), region);
    }
}
