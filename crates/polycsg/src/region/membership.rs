//! Which sides of a directed sub-edge lie inside a set.

use std::ops::Not;

/// Which of the two sides of a directed sub-edge lie inside a set.
///
/// | | left side | right side |
/// | --- | --- | --- |
/// | `In` | inside | inside |
/// | `Out` | outside | outside |
/// | `OnPlus` | inside | outside |
/// | `OnMinus` | outside | inside |
///
/// A Boolean acts on each side by itself. This yields all of Table 3.1 of Barreto (2008), completed for ON against ON of
/// either sign, for difference and for symmetric difference:
///
/// ```
/// use polycsg::Membership::{In, OnMinus, OnPlus, Out};
/// assert_eq!(OnPlus.union(OnPlus), OnPlus); // equal signs: the boundary of both
/// assert_eq!(OnPlus.union(OnMinus), In); // opposite signs: covered from both sides
/// assert_eq!(OnPlus.intersection(OnMinus), Out);
/// assert_eq!(OnPlus.difference(OnMinus), OnPlus);
/// assert_eq!(OnPlus.symmetric_difference(OnMinus), In);
/// assert_eq!(OnPlus.complement(), OnMinus);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Membership {
    /// Both sides inside.
    In,
    /// Both sides outside.
    Out,
    /// On the boundary, interior to the left.
    OnPlus,
    /// On the boundary, interior to the right.
    OnMinus,
}

impl Membership {
    /// The membership by its two sides: whether the left one is inside, and whether the right one is.
    #[must_use]
    pub fn from_sides(left: bool, right: bool) -> Membership {
        match (left, right) {
            (true, true) => Membership::In,
            (false, false) => Membership::Out,
            (true, false) => Membership::OnPlus,
            (false, true) => Membership::OnMinus,
        }
    }

    /// Whether the left side is inside.
    #[must_use]
    pub fn left(self) -> bool {
        matches!(self, Membership::In | Membership::OnPlus)
    }

    /// Whether the right side is inside.
    #[must_use]
    pub fn right(self) -> bool {
        matches!(self, Membership::In | Membership::OnMinus)
    }

    fn by_side(self, other: Membership, operation: impl Fn(bool, bool) -> bool) -> Membership {
        Membership::from_sides(operation(self.left(), other.left()), operation(self.right(), other.right()))
    }

    /// The membership in A ∪ B from those in A and in B.
    #[must_use]
    pub fn union(self, other: Membership) -> Membership {
        self.by_side(other, |a, b| a | b)
    }

    /// The membership in A ∩ B from those in A and in B.
    #[must_use]
    pub fn intersection(self, other: Membership) -> Membership {
        self.by_side(other, |a, b| a & b)
    }

    /// The membership in A − B from those in A and in B.
    #[must_use]
    pub fn difference(self, other: Membership) -> Membership {
        self.by_side(other, |a, b| a & !b)
    }

    /// The membership in A ⊕ B from those in A and in B.
    #[must_use]
    pub fn symmetric_difference(self, other: Membership) -> Membership {
        self.by_side(other, |a, b| a ^ b)
    }

    /// The membership in the complement.
    #[must_use]
    pub fn complement(self) -> Membership {
        Membership::from_sides(!self.left(), !self.right())
    }

    /// The membership of the same sub-edge in the opposite direction: its sides change places.
    #[must_use]
    pub fn reversed(self) -> Membership {
        Membership::from_sides(self.right(), self.left())
    }
}

impl Not for Membership {
    type Output = Membership;
    fn not(self) -> Membership {
        self.complement()
    }
}
