//! Expressions of Booleans over any number of operands, evaluated in one arrangement.

use crate::rings::Rings;
use crate::{Boundary, Error, Region, Scratch, pipeline};
use glam::DVec2;
use std::ops::{BitAnd, BitOr, BitXor, Sub};

/// What raw rings mean: which winding numbers are inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FillRule {
    /// Odd winding numbers are inside; the direction of a ring does not matter.
    EvenOdd,
    /// Every winding number but zero is inside.
    NonZero,
    /// Positive winding numbers are inside: counter-clockwise rings fill, clockwise ones cut.
    Positive,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Union,
    Intersection,
    Difference,
    SymmetricDifference,
}

#[derive(Clone, Debug)]
pub(crate) enum Token<'a> {
    Region(&'a Region),
    Rings(Rings, FillRule),
    /// An open edge: it bounds nothing, and the arrangement tells what lies beside it.
    Edge([DVec2; 2]),
    /// Takes that many operands, those that stand before it.
    Operator(Operator, usize),
}

impl Token<'_> {
    /// The rings of an operand.
    pub(crate) fn rings(&self) -> Option<&Rings> {
        match self {
            Token::Region(region) => Some(region.rings_of()),
            Token::Rings(rings, _) => Some(rings),
            Token::Edge(_) | Token::Operator(..) => None,
        }
    }
}

/// An expression of Booleans: regions and raw rings, combined by `|`, `&`, `-`, `^` or by the n-ary constructors.
///
/// All operands enter one arrangement and every vertex of the result is rounded once, so that a nested expression
/// has no rounding in between. Operands count in their order of appearance, from 0; see [`BoundaryEdge::operand`].
///
/// [`BoundaryEdge::operand`]: crate::BoundaryEdge::operand
///
/// ```
/// use polycsg::{Csg, FillRule, Region};
/// let square = |x: f64, y: f64, s: f64| {
///     Region::from_rings([[[x, y], [x + s, y], [x + s, y + s], [x, y + s]]], FillRule::NonZero)
/// };
/// let wall = square(0.0, 0.0, 10.0)?;
/// let windows = [square(1.0, 1.0, 2.0)?, square(6.0, 1.0, 2.0)?];
/// let rest = (Csg::from(&wall) - Csg::union(&windows)).evaluate();
/// assert_eq!(rest.area(), 92.0);
/// # Ok::<(), polycsg::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Csg<'a> {
    // Postfix, so that neither evaluating nor dropping a deep expression recurses.
    postfix: Vec<Token<'a>>,
}

impl<'a> From<&'a Region> for Csg<'a> {
    fn from(region: &'a Region) -> Self {
        Csg { postfix: vec![Token::Region(region)] }
    }
}

impl<'a> Csg<'a> {
    /// Raw rings as an operand: self-intersecting, nested, touching, any direction, as `rule` reads them.
    ///
    /// # Errors
    /// [`Error::NonFinite`] names the first ring and vertex with a NaN or an infinity.
    pub fn rings<R, P>(rings: R, rule: FillRule) -> Result<Csg<'a>, Error>
    where
        R: IntoIterator,
        R::Item: AsRef<[P]>,
        P: Copy + Into<DVec2>,
    {
        Ok(Csg { postfix: vec![Token::Rings(Rings::read(rings)?, rule)] })
    }

    /// The union of any number of operands; of none, the empty set.
    pub fn union<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::Union, operands)
    }

    /// The intersection of any number of operands; of none, the empty set.
    pub fn intersection<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::Intersection, operands)
    }

    /// What lies in an odd number of the operands; of none, the empty set.
    pub fn symmetric_difference<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::SymmetricDifference, operands)
    }

    /// The open edge beside `region`: the set is the region, the edge takes part in the arrangement alone.
    pub(crate) fn edge_beside(edge: [DVec2; 2], region: &'a Region) -> Csg<'a> {
        let postfix = vec![Token::Edge(edge), Token::Region(region), Token::Operator(Operator::Union, 2)];
        Csg { postfix }
    }

    /// Positively wound rings, already read.
    pub(crate) fn positive(rings: Rings) -> Csg<'static> {
        Csg { postfix: vec![Token::Rings(rings, FillRule::Positive)] }
    }

    pub(crate) fn postfix(&self) -> &[Token<'a>] {
        &self.postfix
    }

    fn joined<I>(operator: Operator, operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        let mut postfix = Vec::new();
        let mut count = 0;
        for operand in operands {
            postfix.append(&mut operand.into().postfix);
            count += 1;
        }
        // Nothing combines to the empty set, which as an operand is not the same as no operand at all.
        let operator = if count == 0 { Operator::Union } else { operator };
        postfix.push(Token::Operator(operator, count));
        Csg { postfix }
    }

    fn then(mut self, operator: Operator, mut other: Csg<'a>) -> Csg<'a> {
        self.postfix.append(&mut other.postfix);
        self.postfix.push(Token::Operator(operator, 2));
        self
    }

    /// The set as a valid [`Region`]. Expected O(n log n + k) for n edges with k contacts.
    pub fn evaluate(&self) -> Region {
        self.evaluate_in(&mut Scratch::default())
    }

    /// As [`evaluate`](Csg::evaluate), in buffers that the caller keeps from call to call.
    pub fn evaluate_in(&self, scratch: &mut Scratch) -> Region {
        pipeline::region(self, scratch)
    }

    /// The directed edges that bound the set, interior to the left, each vertex rounded once.
    ///
    /// Stops before the check for rounding, the rings and the nesting: for whoever sums over edges.
    pub fn boundary<'s>(&self, scratch: &'s mut Scratch) -> Boundary<'s> {
        pipeline::boundary(self, scratch)
    }
}

/// Union.
impl<'a> BitOr for Csg<'a> {
    type Output = Csg<'a>;
    fn bitor(self, other: Csg<'a>) -> Csg<'a> {
        self.then(Operator::Union, other)
    }
}

/// Intersection.
impl<'a> BitAnd for Csg<'a> {
    type Output = Csg<'a>;
    fn bitand(self, other: Csg<'a>) -> Csg<'a> {
        self.then(Operator::Intersection, other)
    }
}

/// Difference.
impl<'a> Sub for Csg<'a> {
    type Output = Csg<'a>;
    fn sub(self, other: Csg<'a>) -> Csg<'a> {
        self.then(Operator::Difference, other)
    }
}

/// Symmetric difference.
impl<'a> BitXor for Csg<'a> {
    type Output = Csg<'a>;
    fn bitxor(self, other: Csg<'a>) -> Csg<'a> {
        self.then(Operator::SymmetricDifference, other)
    }
}
