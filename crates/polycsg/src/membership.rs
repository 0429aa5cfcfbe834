//! Which side of a sub-edge lies inside a set.
/// stub
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Membership { In, Out, OnPlus, OnMinus }
