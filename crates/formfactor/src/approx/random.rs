//! Numbers that look random and are a function of a seed and of where dA lies.
use glam::DVec3;

/// Steele, Lea and Flood's splitmix64 (2014).
#[derive(Clone, Debug)]
pub(super) struct Random(u64);

impl Random {
    /// A stream for one point, so that the errors of neighbours are independent.
    pub(super) fn at(seed: u64, position: DVec3) -> Self {
        let mut stream = Self(seed);
        for part in position.to_array() {
            stream.0 = stream.bits() ^ part.to_bits();
        }
        stream
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A double in [0, 1), uniform.
    pub(super) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (f64::EPSILON / 2.0)
    }
}
