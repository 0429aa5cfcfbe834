//! Vectors of double-doubles, and products of vectors of doubles that err by no more than two roundings.
use exactfloat::DoubleDouble;
use glam::DVec3;
use std::ops::Add;

/// A vector of double-doubles, mostly from dA to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Offset(pub(crate) [DoubleDouble; 3]);

impl Offset {
    /// `to - from` exactly.
    pub(crate) fn between(from: DVec3, to: DVec3) -> Self {
        Self([0, 1, 2].map(|i| DoubleDouble::difference(to[i], from[i])))
    }

    /// The difference from this offset to another one.
    pub(crate) fn to(self, other: Self) -> Self {
        Self([0, 1, 2].map(|i| other.0[i] - self.0[i]))
    }

    /// The nearest vector of doubles.
    pub(crate) fn round(self) -> DVec3 {
        DVec3::from_array(self.0.map(DoubleDouble::round))
    }

    /// The magnitudes of its components, as they enter the error of a product.
    pub(crate) fn sizes(self) -> DVec3 {
        sizes(self.round())
    }

    pub(crate) fn dot(self, other: Self) -> DoubleDouble {
        (0..3).map(|i| self.0[i] * other.0[i]).fold(DoubleDouble::ZERO, Add::add)
    }

    /// The cross product, and the sums of its terms' magnitudes: each component errs by less than 2^-99 of its sum.
    pub(crate) fn cross(self, other: Self) -> (Self, DVec3) {
        let (a, b) = (self.0, other.0);
        let term = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let terms = size(a[j].hi) * size(b[k].hi) + size(a[k].hi) * size(b[j].hi);
            (a[j] * b[k] - a[k] * b[j], terms)
        };
        let parts = [0, 1, 2].map(term);
        (Self(parts.map(|t| t.0)), DVec3::from_array(parts.map(|t| t.1)))
    }

    /// The point at `share` of the way to `other`, within 2^-98 of the two lengths.
    pub(crate) fn toward(self, other: Self, share: DoubleDouble) -> Self {
        Self([0, 1, 2].map(|i| self.0[i] + share * (other.0[i] - self.0[i])))
    }
}

/// The magnitude of a factor as it enters a bound: zero for zero, else at least 2^-250. The product of three such magnitudes
/// does not underflow, and it is more than what underflow can take from the product that it bounds.
pub(crate) fn size(x: f64) -> f64 {
    const LEAST: f64 = 5.527_147_875_260_445e-76;
    if x == 0.0 { 0.0 } else { x.abs().max(LEAST) }
}

pub(crate) fn sizes(v: DVec3) -> DVec3 {
    DVec3::new(size(v.x), size(v.y), size(v.z))
}

/// `a x b`, each component within two roundings of itself and 2^-104 of its terms.
pub(crate) fn accurate_cross(a: DVec3, b: DVec3) -> DVec3 {
    let component = |i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (p, q) = (DoubleDouble::product(a[j], b[k]), DoubleDouble::product(a[k], b[j]));
        let high = DoubleDouble::sum(p.hi, -q.hi);
        high.hi + (high.lo + (p.lo - q.lo))
    };
    DVec3::new(component(0), component(1), component(2))
}

/// `a . b` within two roundings of itself and 2^-103 of its terms.
pub(crate) fn accurate_dot(a: DVec3, b: DVec3) -> f64 {
    let (x, y, z) =
        (DoubleDouble::product(a.x, b.x), DoubleDouble::product(a.y, b.y), DoubleDouble::product(a.z, b.z));
    let first = DoubleDouble::sum(x.hi, y.hi);
    let second = DoubleDouble::sum(first.hi, z.hi);
    second.hi + (second.lo + first.lo + (x.lo + y.lo + z.lo))
}

#[cfg(test)]
mod tests {
    use super::*;
    use exactfloat::Integer;
    use proptest::prelude::*;

    /// Integers that are doubles.
    fn small() -> impl Strategy<Value = i64> {
        -(1i64 << 52)..(1i64 << 52)
    }

    fn double(x: i64) -> f64 {
        // At most 53 bits: exact.
        x as f64
    }

    proptest! {
        #[test]
        fn accurate_products_round_the_exact_ones(v in prop::array::uniform6(small())) {
            let (a, b) = (DVec3::new(double(v[0]), double(v[1]), double(v[2])), DVec3::new(double(v[3]), double(v[4]), double(v[5])));
            let w: Vec<Integer> = v.iter().map(|x| Integer::from(*x)).collect();
            let exact = &w[0] * &w[3] + &w[1] * &w[4] + &w[2] * &w[5];
            let (dot, exact) = (accurate_dot(a, b), exact.to_f64().value());
            prop_assert!((dot - exact).abs() <= 2.0 * f64::EPSILON * exact.abs());
            let exact = (&w[1] * &w[5] - &w[2] * &w[4]).to_f64().value();
            prop_assert!((accurate_cross(a, b).x - exact).abs() <= 2.0 * f64::EPSILON * exact.abs());
        }
    }
}
