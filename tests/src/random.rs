//! Deterministic random numbers: the same seed gives the same input on every machine.
use std::f64::consts::TAU;

/// SplitMix64 (Steele, Lea and Flood 2014).
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// A stream of its own for every seed.
    pub fn new(seed: u64) -> Random {
        Random { state: seed.wrapping_mul(0xd129_0d3a_9c5f_1e35) ^ 0x5bf0_3635_dea2_8fb1 }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `limit` (which is positive and small against 2^64).
    pub fn below(&mut self, limit: usize) -> usize {
        usize::try_from(self.bits() % u64::try_from(limit).expect("a length fits 64 bits"))
            .expect("below a length")
    }

    /// An integer from `low` to `high`, both included.
    pub fn between(&mut self, low: i32, high: i32) -> i32 {
        let width = usize::try_from(high - low + 1).expect("low <= high");
        low + i32::try_from(self.below(width)).expect("below the width")
    }

    /// A double in [0, 1), uniform.
    pub fn unit(&mut self) -> f64 {
        let bits = u32::try_from(self.bits() >> 32).expect("32 bits");
        f64::from(bits) / f64::from(u32::MAX) * (1.0 - f64::EPSILON)
    }

    /// A double in [`low`, `high`).
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// An angle in radians.
    pub fn angle(&mut self) -> f64 {
        self.range(0.0, TAU)
    }

    /// True once in `n`.
    pub fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }
}
