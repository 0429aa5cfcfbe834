//! Random expressions of any shape against the oracle, which applies them to the classes of each piece of an edge.
use glam::DVec2;
use polycsg::{Csg, Region, Scratch};
use tests::against::{self, check_set, leaf, shapes};
use tests::exact::edges;
use tests::generators::lattice;
use tests::oracle::{Class, Operand};
use tests::random::Random;
use tests::validity;

/// An expression over numbered operands.
#[derive(Clone, Debug)]
enum Tree {
    Operand(usize),
    Union(Vec<Tree>),
    Intersection(Vec<Tree>),
    SymmetricDifference(Vec<Tree>),
    Difference(Box<[Tree; 2]>),
}

impl Tree {
    fn random(random: &mut Random, operands: usize, depth: usize) -> Tree {
        if depth == 0 || random.one_in(5) {
            return Tree::Operand(random.below(operands));
        }
        let mut branch = || Tree::random(random, operands, depth - 1);
        let pair = Box::new([branch(), branch()]);
        let count = random.below(4);
        let branches = (0..count).map(|_| Tree::random(random, operands, depth - 1)).collect();
        match random.below(5) {
            0 => Tree::Union(branches),
            1 => Tree::Intersection(branches),
            2 => Tree::SymmetricDifference(branches),
            _ => Tree::Difference(pair),
        }
    }

    /// The expression with leaves of two kinds: raw rings, and regions (every other operand).
    fn csg<'a>(&self, operands: &[Operand], regions: &'a [Region]) -> Csg<'a> {
        let all = |trees: &[Tree]| trees.iter().map(|tree| tree.csg(operands, regions)).collect::<Vec<_>>();
        match self {
            Tree::Operand(i) if i % 2 == 0 => leaf(&operands[*i]),
            Tree::Operand(i) => Csg::from(&regions[*i]),
            Tree::Union(trees) => Csg::union(all(trees)),
            Tree::Intersection(trees) => Csg::intersection(all(trees)),
            Tree::SymmetricDifference(trees) => Csg::symmetric_difference(all(trees)),
            Tree::Difference(pair) => pair[0].csg(operands, regions) - pair[1].csg(operands, regions),
        }
    }

    /// Table 3.1 all the way up; what combines nothing is the empty set.
    fn class(&self, classes: &[Class]) -> Class {
        let folded = |trees: &[Tree], combine: fn(Class, Class) -> Class| {
            trees.iter().map(|tree| tree.class(classes)).reduce(combine).unwrap_or(Class::Out)
        };
        match self {
            Tree::Operand(i) => classes[*i],
            Tree::Union(trees) => folded(trees, Class::union),
            Tree::Intersection(trees) => folded(trees, Class::intersection),
            Tree::SymmetricDifference(trees) => folded(trees, Class::symmetric_difference),
            Tree::Difference(pair) => pair[0].class(classes).difference(pair[1].class(classes)),
        }
    }
}

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
            let tree = Tree::random(&mut random, operands.len(), depth);
            let found = tree.csg(&operands, &regions).evaluate_in(&mut scratch);
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
