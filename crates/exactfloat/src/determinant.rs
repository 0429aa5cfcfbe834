//! Orientation determinants: expansions (Shewchuk's adaptive predicates) where no bit of theirs is lost, else
//! numbers of 125 bits with bounds on their errors, else integers.

use crate::integers::{integers, sign};
use crate::wide::Wide;
use dashu_int::IBig;
use std::{cmp::Ordering, ops::RangeInclusive};

/// 2 to a power of -1022 … 1023.
const fn power(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// Where expansions of degree 2 neither overflow nor lose bits: the lowest set bit of a coordinate is then at least 2^-532,
/// so that of a product at least 2^-1064, and products stay below 2^1004.
const WINDOW_2: RangeInclusive<f64> = power(-480)..=power(500);

/// The same for degree 3: 2^-353 and 2^-1059, and below 2^910.
const WINDOW_3: RangeInclusive<f64> = power(-300)..=power(300);

fn are_in<const D: usize, const N: usize>(window: &RangeInclusive<f64>, points: &[[f64; D]; N]) -> bool {
    points.iter().all(|point| point.iter().all(|&x| x == 0.0 || window.contains(&x.abs())))
}

/// A number with the sign of `(a - c) × (b - c)`: positive where `a b c` run counter-clockwise, 0 where they are collinear.
///
/// The points are finite; of the number the sign alone is right.
#[must_use]
pub fn orient2d(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    if are_in(&WINDOW_2, &[a, b, c]) {
        let [a, b, c] = [a, b, c].map(|[x, y]| robust::Coord { x, y });
        return robust::orient2d(a, b, c);
    }
    let by_bounds = orient2d_by_bounds([a, b, c]).map(|order| f64::from(order as i8));
    by_bounds.unwrap_or_else(|| {
        let [[ax, ay], [bx, by], [cx, cy]] = integers([a, b, c]);
        number((ax - &cx) * (by - &cy) - (ay - cy) * (bx - cx))
    })
}

/// The sign, seen from the point with the smallest abscissa: no other abscissa loses bits.
fn orient2d_by_bounds(points: [[f64; 2]; 3]) -> Option<Ordering> {
    let size = |i: usize| points[i][0].abs();
    let least = if size(0) < size(1) && size(0) < size(2) { 0 } else { 2 - usize::from(size(1) < size(2)) };
    let [p, q, o] = [1, 2, 0].map(|i| points[(least + i) % 3].map(Wide::from));
    ((p[0] - o[0]) * (q[1] - o[1])).compare((p[1] - o[1]) * (q[0] - o[0]))
}

/// A number with the sign of `(a - d) × (b - d) · (c - d)`: negative where `a b c` run counter-clockwise seen from `d`, 0 where
/// the four are coplanar.
///
/// The points are finite; of the number the sign alone is right.
///
/// ```
/// use exactfloat::orient3d;
/// let [a, b, c] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// assert!(orient3d(a, b, c, [0.0, 0.0, 5e-324]) < 0.0);
/// assert_eq!(orient3d(a, b, c, [7.0, 3.0, 0.0]), 0.0);
/// ```
#[must_use]
pub fn orient3d(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> f64 {
    if are_in(&WINDOW_3, &[a, b, c, d]) {
        let [a, b, c, d] = [a, b, c, d].map(|[x, y, z]| robust::Coord3D { x, y, z });
        return robust::orient3d(a, b, c, d);
    }
    let [a, b, c, [dx, dy, dz]] = integers([a, b, c, d]);
    let [a, b, c] = [a, b, c].map(|[x, y, z]| [x - &dx, y - &dy, z - &dz]);
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    number(minor(1, 2) * &c[0] + minor(2, 0) * &c[1] + minor(0, 1) * &c[2])
}

fn number(determinant: IBig) -> f64 {
    f64::from(sign(&determinant) as i8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::Zero;
    use proptest::prelude::*;

    /// Small integers, ordinary numbers, and numbers of any exponent.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            4 => (-4i32..5).prop_map(f64::from),
            4 => -1.0..1.0f64,
            1 => (-1.0..1.0f64, -1070i32..1020).prop_map(|(m, e)| m * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)),
            1 => Just(f64::MAX), 1 => Just(5e-324), 1 => Just(0.0),
        ]
    }

    fn exact(x: f64) -> BigRational {
        BigRational::from_float(x).expect("finite")
    }

    fn rows<const N: usize>(points: &[[f64; N]]) -> Vec<[BigRational; N]> {
        let last = points[points.len() - 1];
        let row = |p: &[f64; N]| std::array::from_fn(|i| exact(p[i]) - exact(last[i]));
        points[..points.len() - 1].iter().map(row).collect()
    }

    fn determinant(rows: &[[BigRational; 3]]) -> BigRational {
        let minor = |i: usize, j: usize| &rows[0][i] * &rows[1][j] - &rows[0][j] * &rows[1][i];
        minor(1, 2) * &rows[2][0] + minor(2, 0) * &rows[2][1] + minor(0, 1) * &rows[2][2]
    }

    /// Four points of a plane through the origin, which rounding moves off it.
    fn nearly_coplanar() -> impl Strategy<Value = [[f64; 3]; 4]> {
        let shares = prop::array::uniform4(prop::array::uniform2(-1.0..1.0f64));
        let plane = prop::array::uniform2(prop::array::uniform3(-1.0..1.0f64));
        (plane, shares)
            .prop_map(|([u, v], shares)| shares.map(|[s, t]| std::array::from_fn(|i| s * u[i] + t * v[i])))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn orient2d_has_the_sign(points in prop::array::uniform3(prop::array::uniform2(coordinate()))) {
            let rows = rows(&points);
            let wanted = (&rows[0][0] * &rows[1][1] - &rows[0][1] * &rows[1][0]).cmp(&BigRational::zero());
            prop_assert_eq!(orient2d(points[0], points[1], points[2]).partial_cmp(&0.0), Some(wanted));
        }

        #[test]
        fn orient3d_has_the_sign(points in prop::array::uniform4(prop::array::uniform3(coordinate()))) {
            let wanted = determinant(&rows(&points)).cmp(&BigRational::zero());
            let [a, b, c, d] = points;
            prop_assert_eq!(orient3d(a, b, c, d).partial_cmp(&0.0), Some(wanted));
        }

        #[test]
        fn orient2d_has_the_sign_near_a_line_at_every_scale(
            [from, along] in prop::array::uniform2(prop::array::uniform2(-1.0..1.0f64)),
            shares in prop::array::uniform3(-1.0..1.0f64),
            scales in prop::array::uniform2(prop_oneof![-520i32..520, -540i32..-460, 470i32..520]),
        ) {
            let points = shares.map(|s| std::array::from_fn(|i| (from[i] + s * along[i]) * 2f64.powi(scales[i])));
            let rows = rows(&points);
            let wanted = (&rows[0][0] * &rows[1][1] - &rows[0][1] * &rows[1][0]).cmp(&BigRational::zero());
            prop_assert_eq!(orient2d(points[0], points[1], points[2]).partial_cmp(&0.0), Some(wanted));
        }

        /// Axes of one scale, and of different ones about the edges of the window.
        #[test]
        fn orient3d_has_the_sign_where_rounding_alone_decides(
            points in nearly_coplanar(),
            scales in prop_oneof![prop::array::uniform3(-320i32..320), (-900i32..900).prop_map(|e| [e; 3])],
        ) {
            let points = points.map(|p| std::array::from_fn(|i| p[i] * 2f64.powi(scales[i])));
            let wanted = determinant(&rows(&points)).cmp(&BigRational::zero());
            let [a, b, c, d] = points;
            prop_assert_eq!(orient3d(a, b, c, d).partial_cmp(&0.0), Some(wanted));
        }
    }

    #[test]
    fn where_expansions_alone_are_wrong() {
        assert_eq!(
            orient2d([0.0, 0.0], [3e-170, 3e-170], [1e-170, 2e-170]).partial_cmp(&0.0),
            Some(Ordering::Greater)
        );
        assert_eq!(
            orient2d([0.0, 0.0], [3e160, 3e160], [1e160, 2e160]).partial_cmp(&0.0),
            Some(Ordering::Greater)
        );
        assert_eq!(orient2d([0.0, 0.0], [3e160, 3e160], [1e160, 1e160]), 0.0);
    }
}
