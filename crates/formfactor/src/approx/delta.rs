//! Delta factors in closed form: what a rectangle of a cube around dA receives, its half-width and height being 1.
use std::{f64::consts::TAU, ops::Range};

/// Of a rectangle in the top, parallel to dA at height 1: the integral of 1 / (pi (x^2 + y^2 + 1)^2).
pub(super) fn top(x: &Range<f64>, y: &Range<f64>) -> f64 {
    let corner = |x: f64, y: f64| {
        let (a, b) = (x.hypot(1.0), y.hypot(1.0));
        (x / a * (y / a).atan() + y / b * (x / b).atan()) / TAU
    };
    between(corner, x, y)
}

/// Of a rectangle in a side, at distance 1, z above the horizon: the integral of z / (pi (y^2 + z^2 + 1)^2).
pub(super) fn side(y: &Range<f64>, z: &Range<f64>) -> f64 {
    let corner = |y: f64, z: f64| {
        let height = z.hypot(1.0);
        -(y / height).atan() / height / TAU
    };
    between(corner, y, z)
}

/// What an antiderivative in both variables gives for a rectangle.
fn between(corner: impl Fn(f64, f64) -> f64, u: &Range<f64>, v: &Range<f64>) -> f64 {
    corner(u.end, v.end) - corner(u.start, v.end) - (corner(u.end, v.start) - corner(u.start, v.start))
}

/// Scales weights so that they add to 1: without it, a closed room gains or loses light.
pub(super) fn normalise(weights: &mut [f64]) {
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|w| *w /= sum);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_five_faces_receive_everything() {
        let sides = 4.0 * side(&(-1.0..1.0), &(0.0..1.0));
        assert!((top(&(-1.0..1.0), &(-1.0..1.0)) + sides - 1.0).abs() < 1e-15);
    }

    #[test]
    fn small_cells_receive_the_integrand_at_their_middle() {
        let cell = |x: f64| x - 5e-4..x + 5e-4;
        let (u, v) = (0.3_f64, 0.7_f64);
        let falloff = std::f64::consts::PI * (u * u + v * v + 1.0).powi(2);
        assert!((top(&cell(u), &cell(v)) / 1e-6 - 1.0 / falloff).abs() < 1e-6);
        assert!((side(&cell(u), &cell(v)) / 1e-6 - v / falloff).abs() < 1e-6);
    }
}
