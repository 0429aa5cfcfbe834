//! Vectors of integers, and clipping by planes through dA or before it.
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

pub(super) type Vector = [BigInt; 3];

pub(super) fn minus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

pub(super) fn plus(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| &a[i] + &b[i])
}

pub(super) fn times(a: &Vector, x: &BigInt) -> Vector {
    [0, 1, 2].map(|i| &a[i] * x)
}

pub(super) fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

pub(super) fn dot(a: &Vector, b: &Vector) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

pub(super) fn sign(x: &BigInt) -> i32 {
    i32::from(x.is_positive()) - i32::from(x.is_negative())
}

/// Newell's sum over a loop.
pub(super) fn newell(points: &[Vector]) -> Vector {
    let spokes = points[1..].windows(2);
    let parts = spokes.map(|pair| cross(&minus(&pair[0], &points[0]), &minus(&pair[1], &points[0])));
    parts.reduce(|a, b| plus(&a, &b)).expect("three points or more")
}

/// The part of loops where `height` is not negative, as directions: clip points are scaled by a positive number.
///
/// `height` must be affine in the point, so that clipping by a plane off dA comes before clipping by planes through dA.
pub(super) fn above(loops: &[Vec<Vector>], height: impl Fn(&Vector) -> BigInt) -> Vec<Vec<Vector>> {
    let clip = |points: &Vec<Vector>| {
        let mut kept = Vec::new();
        let heights: Vec<BigInt> = points.iter().map(&height).collect();
        for (i, here) in points.iter().enumerate() {
            let before = (i + points.len() - 1) % points.len();
            if sign(&heights[i]) * sign(&heights[before]) < 0 {
                let (p, q) = (times(here, &heights[before].abs()), times(&points[before], &heights[i].abs()));
                kept.push(primitive(plus(&p, &q)));
            }
            if !heights[i].is_negative() {
                kept.push(here.clone());
            }
        }
        kept
    };
    loops.iter().map(clip).collect()
}

/// A vector without the powers of two that its components share.
pub(super) fn primitive(v: Vector) -> Vector {
    let shift = v.iter().filter(|x| !x.is_zero()).filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    v.map(|x| x >> shift)
}
