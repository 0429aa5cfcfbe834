//! Expressions of any shape: as `polycsg` evaluates them, and as Table 3.1 does.
use crate::against::leaf;
use crate::oracle::{Class, Operand};
use crate::retelling::shuffle;
use polycsg::{Csg, Region};

/// An expression over numbered operands.
#[derive(Clone, Debug)]
pub enum Tree {
    /// The operand of that number.
    Operand(usize),
    /// Of any number of operands.
    Union(Vec<Tree>),
    /// Of any number of operands; of none, the empty set.
    Intersection(Vec<Tree>),
    /// Of any number of operands.
    SymmetricDifference(Vec<Tree>),
    /// Of two.
    Difference(Box<[Tree; 2]>),
}

impl Tree {
    /// An expression of a depth at most; `choose(n)` decides by a number below n.
    pub fn grow(choose: &mut impl FnMut(usize) -> usize, operands: usize, depth: usize) -> Tree {
        if depth == 0 || choose(5) == 0 {
            return Tree::Operand(choose(operands));
        }
        match choose(5) {
            0 => Tree::Union(Tree::several(choose, operands, depth)),
            1 => Tree::Intersection(Tree::several(choose, operands, depth)),
            2 => Tree::SymmetricDifference(Tree::several(choose, operands, depth)),
            _ => Tree::Difference(Box::new([(); 2].map(|()| Tree::grow(choose, operands, depth - 1)))),
        }
    }

    fn several(choose: &mut impl FnMut(usize) -> usize, operands: usize, depth: usize) -> Vec<Tree> {
        (0..choose(4)).map(|_| Tree::grow(choose, operands, depth - 1)).collect()
    }

    /// The expression with leaves of two kinds: raw rings, and regions (every other operand).
    pub fn csg<'a>(&self, operands: &[Operand], regions: &'a [Region]) -> Csg<'a> {
        self.of(&|i| if i % 2 == 0 { leaf(&operands[i]) } else { Csg::from(&regions[i]) })
    }

    /// The expression, by the leaf that each operand is.
    pub fn of<'a>(&self, leaf: &impl Fn(usize) -> Csg<'a>) -> Csg<'a> {
        let all = |trees: &[Tree]| trees.iter().map(|tree| tree.of(leaf)).collect::<Vec<_>>();
        match self {
            Tree::Operand(i) => leaf(*i),
            Tree::Union(trees) => Csg::union(all(trees)),
            Tree::Intersection(trees) => Csg::intersection(all(trees)),
            Tree::SymmetricDifference(trees) => Csg::symmetric_difference(all(trees)),
            Tree::Difference(pair) => pair[0].of(leaf) - pair[1].of(leaf),
        }
    }

    /// The operands in the order of appearance.
    pub fn operands(&self) -> Vec<usize> {
        match self {
            Tree::Operand(i) => vec![*i],
            Tree::Union(trees) | Tree::Intersection(trees) | Tree::SymmetricDifference(trees) => {
                trees.iter().flat_map(Tree::operands).collect()
            }
            Tree::Difference(pair) => pair.iter().flat_map(Tree::operands).collect(),
        }
    }

    /// The same set: what commutes may come in another order; `choose(n)` decides by a number below n.
    pub fn retold(&self, choose: &mut impl FnMut(usize) -> usize) -> Tree {
        let mut all = |trees: &[Tree]| {
            let mut trees: Vec<Tree> = trees.iter().map(|tree| tree.retold(choose)).collect();
            shuffle(&mut trees, choose);
            trees
        };
        match self {
            Tree::Operand(i) => Tree::Operand(*i),
            Tree::Union(trees) => Tree::Union(all(trees)),
            Tree::Intersection(trees) => Tree::Intersection(all(trees)),
            Tree::SymmetricDifference(trees) => Tree::SymmetricDifference(all(trees)),
            Tree::Difference(pair) => Tree::Difference(Box::new([0, 1].map(|i| pair[i].retold(choose)))),
        }
    }

    /// Table 3.1 all the way up; what combines nothing is the empty set.
    pub fn class(&self, classes: &[Class]) -> Class {
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
