//! Table 3.1 of the source, completed by complement, difference and symmetric difference.

/// What an interval is against a set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Class {
    /// Inside, on both sides.
    In,
    /// Outside, on both sides.
    Out,
    /// On the boundary, with the interior to the left.
    OnPlus,
    /// On the boundary, with the interior to the right.
    OnMinus,
}

use Class::{In, OnMinus, OnPlus, Out};

impl Class {
    /// The class of an interval whose left and right sides are inside or not.
    pub fn of(left: bool, right: bool) -> Class {
        match (left, right) {
            (true, true) => In,
            (false, false) => Out,
            (true, false) => OnPlus,
            (false, true) => OnMinus,
        }
    }

    /// True for the two classes that make a boundary.
    pub fn is_on(self) -> bool {
        matches!(self, OnPlus | OnMinus)
    }

    /// Table 3.1, left half: of two ON, equal signs stay, opposite signs are inside.
    pub fn union(self, other: Class) -> Class {
        match (self, other) {
            (In, _) | (_, In) => In,
            (Out, class) | (class, Out) => class,
            (OnPlus, OnPlus) => OnPlus,
            (OnMinus, OnMinus) => OnMinus,
            (OnPlus, OnMinus) | (OnMinus, OnPlus) => In,
        }
    }

    /// Table 3.1, right half: of two ON, equal signs stay, opposite signs are outside.
    pub fn intersection(self, other: Class) -> Class {
        match (self, other) {
            (Out, _) | (_, Out) => Out,
            (In, class) | (class, In) => class,
            (OnPlus, OnPlus) => OnPlus,
            (OnMinus, OnMinus) => OnMinus,
            (OnPlus, OnMinus) | (OnMinus, OnPlus) => Out,
        }
    }

    /// The set's complement.
    pub fn complement(self) -> Class {
        match self {
            In => Out,
            Out => In,
            OnPlus => OnMinus,
            OnMinus => OnPlus,
        }
    }

    /// The first set without the second.
    pub fn difference(self, other: Class) -> Class {
        self.intersection(other.complement())
    }

    /// What is in exactly one of two sets.
    pub fn symmetric_difference(self, other: Class) -> Class {
        self.difference(other).union(other.difference(self))
    }
}
