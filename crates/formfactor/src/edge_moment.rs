//! The first moments of the form factor's kernel over the triangle between an edge and the foot of the perpendicular from dA to its plane.
//!
//! ```text
//! integral of y K dA = (1 / pi) sum over edges of the integral of e (a J2(z) + h w J3(z)) dphi, z = r / h,
//! J2 = (atan z - z / (1 + z^2)) / 2,   J3 = (ln(1 + z^2) - z^2 / (1 + z^2)) / 2,
//! ```
//!
//! which Gauss's rule finds along every edge, to nine digits of how large it is as far aside as the edge is far. See
//! [`centroid`](crate::centroid) for a, h, r, phi, e and w.
use crate::numeric::angle::angle;
use crate::numeric::gauss::{RULE_2, RULE_3, RULE_4, RULE_6, RULE_8};
use std::f64::consts::FRAC_PI_2;

/// Gauss's rules, and the longest edges, as shares of twice how far they are, over which they find an integral to 1e-9 that falls as the fourth
/// power of the distance, as along an edge that runs away from the foot. The moments of a strip's edges cancel but for its width: their errors may
/// not be as large as what is left.
const SHORT: [(f64, &[[f64; 2]]); 5] =
    [(0.004, &RULE_2), (0.028, &RULE_3), (0.075, &RULE_4), (0.2, &RULE_6), (0.34, &RULE_8)];
/// The longest stretch over which six nodes find one to 1e-10 that is analytic but from pi / 2 aside on: they err by (d + (d^2 + 1)^(1/2))^-12, with
/// that d times half the stretch aside (Trefethen 2008, theorem 4.5).
const LONGEST: f64 = 0.9;

/// From this slope on an angle is found from the other axis.
const STEEP: f64 = 3.0;

/// Coefficients of sinh(x) / x and cosh(x) by powers of x^2, the last ones first.
const HYPERBOLIC: [[f64; 8]; 2] = [
    [
        0.0,
        1.0 / 6_227_020_800.0,
        1.0 / 39_916_800.0,
        1.0 / 362_880.0,
        1.0 / 5_040.0,
        1.0 / 120.0,
        1.0 / 6.0,
        1.0,
    ],
    [
        1.0 / 87_178_291_200.0,
        1.0 / 479_001_600.0,
        1.0 / 3_628_800.0,
        1.0 / 40_320.0,
        1.0 / 720.0,
        1.0 / 24.0,
        1.0 / 2.0,
        1.0,
    ],
];

/// Where z^2 is below this J2 and J3 are found by their series, and coefficients of J2 / z^3 and J3 / z^4 by powers of -z^2, the last ones first.
const SMALL: f64 = 1e-2;
const INNER: [[f64; 5]; 2] = [
    [5.0 / 11.0, 4.0 / 9.0, 3.0 / 7.0, 2.0 / 5.0, 1.0 / 3.0],
    [5.0 / 12.0, 2.0 / 5.0, 3.0 / 8.0, 1.0 / 3.0, 1.0 / 4.0],
];

/// The line of an edge in a target's plane, by the place on it from where it is nearest to the foot.
pub(crate) struct EdgeLine {
    /// How far it is from the foot, dA from the plane, and dA from the line.
    across: f64,
    height: f64,
    clear: f64,
    /// a, and r w where the place is 0 and for each unit of it.
    rise: f64,
    lean: [f64; 2],
}

impl EdgeLine {
    pub(crate) fn new([across, height]: [f64; 2], rise: f64, lean: [f64; 2]) -> Self {
        let clear = (across * across + height * height).sqrt();
        Self { across, height, clear, rise, lean }
    }

    /// The integrals of (a J2 + h w J3) / r^3 ds and of the same times the place: dphi = (across / r^2) ds, e = (away across + along s) / r.
    ///
    /// They are analytic but where r^2 = -h^2, at s = i c and -i c, c = clear: as seen from places on a short edge that is far, and with
    /// s = c sinh t it is pi / 2 aside of every real t.
    pub(crate) fn integral(&self, ends: [f64; 2]) -> [f64; 2] {
        let [middle, half] = [ends[0] + ends[1], ends[1] - ends[0]].map(|twice| twice / 2.0);
        let share = half.abs() / (middle * middle + self.clear * self.clear).sqrt();
        match SHORT.iter().find(|(longest, _)| share <= *longest) {
            Some((_, rule)) => sum(rule
                .iter()
                .map(|[node, weight]| self.at(middle + half * (2.0 * node - 1.0), 2.0 * half * weight))),
            None => self.long(ends),
        }
    }

    /// The same of an edge that is long for how far it is.
    fn long(&self, ends: [f64; 2]) -> [f64; 2] {
        let [low, high] = ends.map(|end| (end / self.clear).asinh());
        let count = ((high - low).abs() / LONGEST).ceil().max(1.0);
        let step = (high - low) / count;
        let at = |stretch: f64| {
            let middle = (low + step * (stretch + 0.5)).sinh();
            let rate = (1.0 + middle * middle).sqrt();
            let of_node = move |[node, weight]: &[f64; 2]| {
                let [sinh, cosh] = hyperbolic(step * (node - 0.5));
                let speed = self.clear * (rate * cosh + middle * sinh);
                self.at(self.clear * (middle * cosh + rate * sinh), weight * step * speed)
            };
            sum(RULE_6.iter().map(of_node))
        };
        sum((0_u32..).map(f64::from).take_while(|stretch| *stretch < count).map(at))
    }

    /// What a place adds to both integrals, with such a weight.
    fn at(&self, place: f64, weight: f64) -> [f64; 2] {
        let square = self.across * self.across + place * place;
        let [lean, each] = self.lean;
        let [second, third] = inner(square / (self.height * self.height));
        let found = weight / square
            * (self.rise * second / square.sqrt() + self.height * (lean + each * place) * third / square);
        [found, found * place]
    }
}

/// J2 and J3 at z^2.
fn inner(q: f64) -> [f64; 2] {
    let z = q.sqrt();
    if q < SMALL {
        let [second, third] = INNER.map(|c| c.iter().fold(0.0, |sum, c| c - q * sum));
        return [z * q * second, q * q * third];
    }
    let angle = if z < STEEP { angle(z, 1.0) } else { FRAC_PI_2 - angle(1.0, z) };
    let of_square = 1.0 / (1.0 + q);
    [(angle - z * of_square) / 2.0, ((1.0 + q).ln() - q * of_square) / 2.0]
}

/// The hyperbolic sine and cosine of at most half of [`LONGEST`], by their series, to a rounding.
fn hyperbolic(x: f64) -> [f64; 2] {
    let q = x * x;
    let [sinh, cosh] = HYPERBOLIC.map(|c| c.iter().fold(0.0, |sum, c| c + q * sum));
    [x * sinh, cosh]
}

fn sum(parts: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    parts.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn series_go_on_where_logarithms_begin() {
        let [below, above] = [inner(SMALL * (1.0 - 1e-15)), inner(SMALL)];
        for (below, above) in below.into_iter().zip(above) {
            assert!((below / above - 1.0).abs() < 1e-9, "{below} {above}");
        }
    }

    proptest! {
        /// By its places and by the arguments of their hyperbolic sines, an edge has the same integrals, and its halves add up to them.
        #[test]
        fn an_edge_has_its_integrals_however_they_are_found(
            [across, height, middle] in [-3.0..3.0f64, -3.0..3.0, -2.0..3.0],
            (half, part) in (0.0..0.34f64, 0.1..0.9f64),
            [rise, lean, each] in [0.0..1.0f64, 0.0..1.0, 0.0..1.0],
        ) {
            let line = EdgeLine::new([across, height].map(|power| 10f64.powf(power)), rise, [lean, each]);
            let middle = 10f64.powf(middle);
            let half = half * middle.hypot(line.clear);
            let ends = [middle - half, middle + half];
            let between = ends[0] + part * (ends[1] - ends[0]);
            let [short, long] = [line.integral(ends), line.long(ends)];
            let halves = sum([line.long([ends[0], between]), line.integral([between, ends[1]])].into_iter());
            // Gauss's rules err by shares of how large it is as far aside as the line is far.
            let size = line.at(middle.hypot(line.clear), 2.0 * half).map(f64::abs);
            for k in [0, 1] {
                prop_assert!((short[k] - long[k]).abs() <= 1e-8 * size[k], "{short:?} {long:?}");
                prop_assert!((short[k] - halves[k]).abs() <= 1e-8 * size[k], "{short:?} {halves:?}");
            }
        }
    }
}
