//! The shoelace sum, compensated.

use crate::predicates::Segment;

/// A sum whose rounding errors are carried along (Neumaier, 1974).
#[derive(Clone, Copy, Debug, Default)]
struct Shoelace {
    sum: f64,
    carry: f64,
}

/// The area that closed walks of directed edges enclose, counter-clockwise positive.
///
/// Each walk is summed relative to its own first point and, where squares would leave the range, scaled by a power of
/// two; an area beyond the range is infinite, never NaN.
pub(crate) fn enclosed_area<W>(walks: impl Iterator<Item = W> + Clone) -> f64
where
    W: Iterator<Item = Segment> + Clone,
{
    let size = walks.clone().flatten().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let scale = scale_for(size);
    let mut sum = Shoelace::default();
    for walk in walks {
        let Some([origin, _]) = walk.clone().next() else { continue };
        for [a, b] in walk {
            let (a, b) = (a * scale - origin * scale, b * scale - origin * scale);
            sum.add(a.x * b.y);
            sum.add(-a.y * b.x);
        }
    }
    (sum.sum + sum.carry) * 0.5 / scale / scale
}

impl Shoelace {
    fn add(&mut self, term: f64) {
        let sum = self.sum + term;
        let (large, small) = if self.sum.abs() >= term.abs() { (self.sum, term) } else { (term, self.sum) };
        self.carry += (large - sum) + small;
        self.sum = sum;
    }
}

/// 1 for coordinates of moderate size, else a power of two that brings the largest near 1.
fn scale_for(size: f64) -> f64 {
    if (1e-120..1e120).contains(&size) || size == 0.0 {
        return 1.0;
    }
    let exponent = ((size.to_bits() >> 52) & 0x7ff).clamp(1, 2044);
    f64::from_bits((2046 - exponent) << 52)
}
