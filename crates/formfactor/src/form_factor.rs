//! A form factor with its error bound.

/// A form factor and how far it may be from the exact one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FormFactor {
    /// The fraction of the power leaving dA that reaches the target: between 0 and 1.
    pub value: f64,
    /// A bound: |value - exact| <= error_bound, where exact is for the input's doubles as given.
    pub error_bound: f64,
}
