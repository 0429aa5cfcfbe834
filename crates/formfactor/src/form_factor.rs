//! A form factor with its error bound.

/// A form factor, and a bound on its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FormFactor {
    /// The fraction of the power leaving dA that reaches the target: a number from 0 to 1, without a unit.
    pub value: f64,
    /// |value - exact| is at most this, where *exact* is for the doubles of the input as given.
    pub error_bound: f64,
}
