//! Conjugate gradients for symmetric exchange areas.
use super::balance::Balance;
use crate::solve::magnitude::largest;
use std::ops::ControlFlow;

/// Betters x until `watch`, which is shown before every product x, its residual and the largest entry of that, says to
/// stop; `residual` is brought up to date.
///
/// Where A F is symmetric, I − ρF is self-adjoint and positive in the inner product Σ (A/ρ) u v; pieces with ρ = 0 are
/// eliminated: x = e there, their residual is 0, and no direction touches them. In this inner product plain conjugate
/// gradients are those of the symmetric system (A/ρ − A F) x = A e / ρ with its diagonal as preconditioner
/// (Hestenes and Stiefel 1952).
pub(super) fn conjugate_gradients(
    balance: &Balance<'_>,
    x: &mut [f64],
    residual: &mut [f64],
    mut watch: impl FnMut(&[f64], &[f64], f64) -> ControlFlow<()>,
) {
    let areas = &balance.exchange.areas;
    let (one, square) = (unit(largest(residual)), unit(largest(areas)));
    let weight = |piece: usize| {
        let rho = balance.reflectance[piece];
        if rho > 0.0 { areas[piece] / square / rho } else { 0.0 }
    };
    let weights: Vec<f64> = (0..x.len()).map(weight).collect();
    let dot = |u: &[f64], v: &[f64]| -> f64 {
        weights.iter().zip(u.iter().zip(v)).map(|(weight, (u, v))| weight * (u / one) * (v / one)).sum()
    };
    let mut direction = residual.to_vec();
    let mut length = dot(residual, residual);
    while length > 0.0 && watch(x, residual, largest(residual)).is_continue() {
        let image = balance.apply(&direction);
        let step = length / dot(&direction, &image);
        for piece in 0..x.len() {
            x[piece] += step * direction[piece];
            residual[piece] -= step * image[piece];
        }
        let next = dot(residual, residual);
        let turn = next / length;
        direction.iter_mut().zip(residual.iter()).for_each(|(d, r)| *d = r + turn * *d);
        length = next;
    }
}

/// The power of two below a magnitude: products of what is measured in it stay in the doubles' range, and no bit changes.
fn unit(magnitude: f64) -> f64 {
    f64::from_bits(magnitude.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}
