//! Norms of what a mesh does not resolve.

/// A norm of the difference between an element's radiosity B and the linear function u through the radiosities of its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Norm {
    /// The largest difference between two corners: where light changes quickly.
    Gradient,
    /// ∫|u − B| dA: power in the wrong place.
    L1,
    /// (∫(u − B)² dA)^½: what the eye sees.
    #[default]
    L2,
    /// max |u − B|: the worst place.
    LInfinity,
}

impl Norm {
    /// The norm over a triangle of area `area` of a linear function of which the corners' values are given. L1 is the
    /// trapezoidal rule on |u − B|, which is convex: an upper bound.
    pub(super) fn of(self, corners: [f64; 3], area: f64) -> f64 {
        let [a, b, c] = corners;
        match self {
            Norm::Gradient => (a - b).abs().max((b - c).abs()).max((c - a).abs()),
            Norm::L1 => area * (a.abs() + b.abs() + c.abs()) / 3.0,
            Norm::L2 => (area / 6.0 * (a * a + b * b + c * c + a * b + b * c + c * a)).sqrt(),
            Norm::LInfinity => a.abs().max(b.abs()).max(c.abs()),
        }
    }

    /// The norm over two places together.
    pub(super) fn join(self, one: f64, other: f64) -> f64 {
        match self {
            Norm::Gradient | Norm::LInfinity => one.max(other),
            Norm::L1 => one + other,
            Norm::L2 => one.hypot(other),
        }
    }
}
