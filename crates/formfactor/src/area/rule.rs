//! Products of Gauss's rules on a cell, one finer than the other, and what they say of their error.
use super::cell::Cell;
use crate::gauss::{RULE_3, RULE_5, RULE_8, RULE_11};
use glam::DVec2;

/// An integral, an estimate of its error, and how many values of the integrand it took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) evaluations: u64,
}

/// A smooth integrand's error falls by a power of the number of nodes. The estimate takes this many times what is left of
/// it by that law.
const CAUTION: f64 = 10.0;

/// The integral over a cell: rules of 3, 5, 8 and 11 nodes a side until the error seems to be within `tolerance`, or
/// falls too slowly for the next one to help.
///
/// With errors e and e' of the two rules before the last, both seen from it, the last one's is e' (e' / e)^p, where p is how
/// many times further the last step goes than the one before. Two rules alone say that the error of the second is
/// below their difference.
pub(super) fn integrate(cell: &Cell, tolerance: f64, mut f: impl FnMut(DVec2) -> f64) -> Integral {
    let mut sum = |rule: &[[f64; 2]]| over(cell, rule, &mut f);
    let (first, second) = (sum(&RULE_3), sum(&RULE_5));
    let mut found = Integral { value: second, error: (second - first).abs(), evaluations: 34 };
    if found.error <= tolerance {
        return found;
    }
    let third = sum(&RULE_8);
    found = Integral { value: third, error: left([first, second, third], 1.5), evaluations: 98 };
    let falls = (third - second).abs() < 0.3 * (second - first).abs();
    if found.error <= tolerance || !falls {
        return found;
    }
    let fourth = sum(&RULE_11);
    Integral { value: fourth, error: left([second, third, fourth], 1.0), evaluations: 219 }
}

/// What is left of the error after the last of three rules.
fn left([first, second, last]: [f64; 3], power: f64) -> f64 {
    let (before, after) = ((last - first).abs(), (last - second).abs());
    if after >= before { after } else { after * (CAUTION * (after / before).powf(power)).min(1.0) }
}

/// The product of a rule with itself on the bilinear image of the unit square.
fn over([a, b, c, d]: &Cell, rule: &[[f64; 2]], f: &mut impl FnMut(DVec2) -> f64) -> f64 {
    let mut sum = 0.0;
    for &[v, v_weight] in rule {
        let (left, right) = (a.lerp(*d, v), b.lerp(*c, v));
        let mut row = 0.0;
        for &[u, u_weight] in rule {
            let up = (*d - *a).lerp(*c - *b, u);
            row += u_weight * (right - left).perp_dot(up) * f(left.lerp(right, u));
        }
        sum += v_weight * row;
    }
    sum
}
