//! Expressions of Booleans over any number of operands, evaluated in one arrangement.

use crate::error::Error;
use crate::region::{Region, prepared::PreparedRegion, rings::Rings};
use glam::DVec2;
use std::collections::VecDeque;
use std::ops::{BitAnd, BitOr, BitXor, Sub};

/// Which winding numbers are inside: how raw rings are read.
///
/// The winding number of a point is how often the rings run around it counter-clockwise, less how often clockwise.
/// Use [`EvenOdd`](FillRule::EvenOdd) where holes may run either way (GeoJSON, shapefiles),
/// [`NonZero`](FillRule::NonZero) for shapes drawn over one another (fonts, SVG's default), and
/// [`Positive`](FillRule::Positive) where directions are known and a clockwise ring is a hole, as in a [`Region`].
///
/// ```
/// use polycsg::{FillRule, Region};
/// let square = |low: f64, high: f64| vec![[low, low], [high, low], [high, high], [low, high]];
/// let clockwise: Vec<[f64; 2]> = square(1.0, 3.0).into_iter().rev().collect();
/// let area = |rings: &[Vec<[f64; 2]>], rule| Region::from_rings(rings, rule).map(|region| region.area());
/// // Nested squares, both counter-clockwise: wound once, and twice in the middle.
/// let alike = [square(0.0, 4.0), square(1.0, 3.0)];
/// assert_eq!(area(&alike, FillRule::EvenOdd)?, 12.0);
/// assert_eq!(area(&alike, FillRule::NonZero)?, 16.0);
/// assert_eq!(area(&alike, FillRule::Positive)?, 16.0);
/// // The inner one clockwise and moved half out: wound 0 in the middle, -1 where it stands out.
/// let out: Vec<[f64; 2]> = clockwise.iter().map(|[x, y]| [x + 2.0, *y]).collect();
/// let opposed = [square(0.0, 4.0), out];
/// assert_eq!(area(&opposed, FillRule::EvenOdd)?, 16.0);
/// assert_eq!(area(&opposed, FillRule::NonZero)?, 16.0);
/// assert_eq!(area(&opposed, FillRule::Positive)?, 14.0);
/// # Ok::<(), polycsg::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum FillRule {
    /// Odd winding numbers are inside; the direction of a ring does not matter.
    EvenOdd,
    /// Every winding number but zero is inside.
    NonZero,
    /// Positive winding numbers are inside: counter-clockwise rings add, clockwise rings subtract.
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
    Prepared(&'a PreparedRegion),
    Rings(Rings, FillRule),
    /// An edge, and the way back, as a ring. It bounds nothing; the arrangement tells what lies beside it.
    Edge(Rings),
    /// It takes that many operands: those that stand before it.
    Operator(Operator, usize),
}

impl Token<'_> {
    /// The rings of an operand.
    pub(crate) fn rings(&self) -> Option<&Rings> {
        match self {
            Token::Region(region) => Some(region.rings_of()),
            Token::Prepared(prepared) => Some(prepared.rings()),
            Token::Rings(rings, _) | Token::Edge(rings) => Some(rings),
            Token::Operator(..) => None,
        }
    }
}

/// An expression of Booleans: regions and raw rings, combined by `|`, `&`, `-`, `^` or by the n-ary constructors.
///
/// All operands enter one arrangement, and every vertex of the result is rounded once: a nested expression has no rounding in
/// between, and a union of 100 000 operands is one call. Building an expression copies only raw rings. It may be nested to
/// any depth. Operands are numbered in their order of appearance, from 0; see [`BoundaryEdge::operand`].
///
/// | | operators, of two | n-ary |
/// | --- | --- | --- |
/// | in any | `a \| b` | [`Csg::union`] |
/// | in all | `a & b` | [`Csg::intersection`] |
/// | in an odd number | `a ^ b` | [`Csg::symmetric_difference`] |
/// | in the first only | `a - b` | `a - Csg::union(others)` |
///
/// The n-ary constructors take whatever yields `&Region` or `Csg`.
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
#[must_use = "an expression does nothing until it is evaluated"]
pub struct Csg<'a> {
    // Postfix, so that neither evaluating nor dropping a deep expression recurses; open at both ends, so that it grows
    // either way at the price of what is added. The last token stands apart: a single operand takes no allocation.
    before: VecDeque<Token<'a>>,
    last: Token<'a>,
}

impl<'a> From<&'a Region> for Csg<'a> {
    fn from(region: &'a Region) -> Self {
        Csg::leaf(Token::Region(region))
    }
}

impl<'a> From<&'a PreparedRegion> for Csg<'a> {
    fn from(prepared: &'a PreparedRegion) -> Self {
        Csg::leaf(Token::Prepared(prepared))
    }
}

impl<'a> Csg<'a> {
    /// Raw rings as an operand: self-intersecting, nested, touching, any direction, as `rule` reads them.
    ///
    /// The rings enter the expression as they are. Making a [`Region`] of them first would cost one more call and would round
    /// their crossings once more.
    /// See [`Region::from_rings`] for what `rings` may be.
    ///
    /// # Errors
    /// [`Error::NonFinite`] names the first ring and vertex with a NaN or an infinity.
    pub fn from_rings<R, P>(rings: R, rule: FillRule) -> Result<Csg<'a>, Error>
    where
        R: IntoIterator,
        R::Item: AsRef<[P]>,
        P: Copy + Into<DVec2>,
    {
        Ok(Csg::of_rings(Rings::read(rings)?, rule))
    }

    /// The union of any number of operands: all points in at least one of them. Without operands, the empty set.
    pub fn union<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::Union, operands)
    }

    /// The intersection of any number of operands: all points in every one of them. Without operands, the empty set.
    pub fn intersection<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::Intersection, operands)
    }

    /// The symmetric difference of any number of operands: all points in an odd number of them. Without operands, the empty
    /// set.
    pub fn symmetric_difference<I>(operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        Csg::joined(Operator::SymmetricDifference, operands)
    }

    /// The open edge beside `region`: the set is the region, the edge takes part in the arrangement alone.
    pub(crate) fn edge_beside(edge: [DVec2; 2], region: &'a Region) -> Csg<'a> {
        let mut there_and_back = Rings::default();
        there_and_back.extend(&edge);
        there_and_back.close();
        Csg::leaf(Token::Edge(there_and_back)) | Csg::from(region)
    }

    /// Positively wound rings, already read.
    pub(crate) fn positive(rings: Rings) -> Csg<'static> {
        Csg::of_rings(rings, FillRule::Positive)
    }

    /// Rings that were read already.
    pub(crate) fn of_rings(rings: Rings, rule: FillRule) -> Csg<'a> {
        Csg::leaf(Token::Rings(rings, rule))
    }

    /// The operands, and each operator behind its operands.
    pub(crate) fn postfix(&self) -> impl DoubleEndedIterator<Item = &Token<'a>> + Clone {
        self.before.iter().chain([&self.last])
    }

    /// The number of tokens.
    pub(crate) fn len(&self) -> usize {
        self.before.len() + 1
    }

    /// The token at a place of the postfix.
    pub(crate) fn token(&self, place: usize) -> &Token<'a> {
        self.before.get(place).unwrap_or(&self.last)
    }

    fn leaf(token: Token<'a>) -> Csg<'a> {
        Csg { before: VecDeque::new(), last: token }
    }

    fn joined<I>(operator: Operator, operands: I) -> Csg<'a>
    where
        I: IntoIterator,
        I::Item: Into<Csg<'a>>,
    {
        let operands = operands.into_iter();
        let mut before = VecDeque::with_capacity(operands.size_hint().0);
        let mut count = 0;
        for operand in operands {
            before = operand.into().behind(before);
            count += 1;
        }
        // Nothing combines to the empty set, which as an operand is not the same as no operand at all.
        let operator = if count == 0 { Operator::Union } else { operator };
        Csg { before, last: Token::Operator(operator, count) }
    }

    fn then(self, operator: Operator, other: Csg<'a>) -> Csg<'a> {
        let room = if self.before.is_empty() { 2 } else { 0 };
        let before = other.behind(self.behind(VecDeque::with_capacity(room)));
        Csg { before, last: Token::Operator(operator, 2) }
    }

    /// All of its tokens behind others. The shorter row moves, so that n operands nested in any way take O(n log n) moves.
    fn behind(mut self, mut others: VecDeque<Token<'a>>) -> VecDeque<Token<'a>> {
        if others.len() < self.before.len() {
            others.into_iter().rev().for_each(|token| self.before.push_front(token));
            others = self.before;
        } else if !self.before.is_empty() {
            others.append(&mut self.before);
        }
        others.push_back(self.last);
        others
    }
}

macro_rules! operator {
    ($operator:ident, $trait:ident, $function:ident) => {
        impl<'a> $trait for Csg<'a> {
            type Output = Csg<'a>;
            fn $function(self, other: Csg<'a>) -> Csg<'a> {
                self.then(Operator::$operator, other)
            }
        }
    };
}

operator!(Union, BitOr, bitor);
operator!(Intersection, BitAnd, bitand);
operator!(Difference, Sub, sub);
operator!(SymmetricDifference, BitXor, bitxor);
