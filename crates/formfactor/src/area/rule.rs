//! Products of Gauss's rules on a cell, one finer than the other, and what they say of their error.
use super::cell::Cell;
use crate::numeric::gauss::{RULE_4, RULE_5, RULE_8, RULE_11};
use glam::DVec2;

/// An integral, an estimate of its error, and how many values of the integrand it took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integral {
    pub(super) value: f64,
    pub(super) error: f64,
    pub(super) evaluations: u64,
}

/// The integral over a cell: rules of 4, 5, 8 and 11 nodes a side until the error seems to be within `tolerance`, or
/// falls too slowly for the next one to help. The first one looks close to the cell's sides, for what is seen only there.
///
/// A rule errs by less than it differs from the one before. Where the integrand is smooth the differences fall by a factor
/// from rule to rule, and the last one's error is the last difference times that factor: ten times that is taken, when
/// both of the last two factors are below a tenth. One small difference alone may be chance: it counts as no less than a
/// hundredth of the one before. Where there may be kinks no law is relied upon.
pub(super) fn integrate(
    cell: &Cell,
    tolerance: f64,
    is_smooth: bool,
    mut f: impl FnMut(DVec2) -> f64,
) -> Integral {
    let mut sum = |rule: &[[f64; 2]]| over(cell, rule, &mut f);
    let (first, second) = (sum(&RULE_4), sum(&RULE_5));
    let coarse = (second - first).abs();
    if coarse <= tolerance && is_smooth {
        return Integral { value: second, error: coarse, evaluations: 41 };
    }
    let third = sum(&RULE_8);
    let middle = (third - second).abs();
    let (seen, falls) =
        if is_smooth { (0.01 * coarse, middle < 0.1 * coarse) } else { (0.25 * coarse, false) };
    let found = Integral { value: third, error: middle.max(seen), evaluations: 105 };
    if found.error <= tolerance || !falls {
        return found;
    }
    let fourth = sum(&RULE_11);
    let fine = (fourth - third).abs().max(1e-4 * middle);
    let left = if fine < 0.1 * middle { (10.0 * fine / middle).max(1e-3) } else { 1.0 };
    Integral { value: fourth, error: left * fine, evaluations: 226 }
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
