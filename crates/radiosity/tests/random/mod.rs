//! Numbers that a seed determines.
#![allow(dead_code, reason = "no test takes all of them")]
use radiosity::glam::DVec3;

/// A linear congruential generator: L'Ecuyer 1999, Table 4.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// From 0 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(2_862_933_555_777_941_757).wrapping_add(3_037_000_493);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Within a cube of that size around the origin.
    pub(crate) fn place(&mut self, size: f64) -> DVec3 {
        size * (DVec3::new(self.next(), self.next(), self.next()) - 0.5)
    }
}
