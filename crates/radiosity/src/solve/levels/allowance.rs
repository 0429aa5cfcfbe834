//! How large the errors of the links of every patch may be, so that its estimate is within what is asked for.
//!
//! What reflection adds to the errors of links, and what is of one sign, may leave an estimate beyond that. The share of such a patch is made
//! smaller then; where this helps no more, what others reflect is left, and that of all is.

/// Errors of links are of any sign, and their estimates are large: they may add up to so many times what is asked for.
pub(super) const SUM: f64 = 2.0;
/// A share is made smaller by as much as the estimate is too large and a little more, but not by more than this at once; and by so much more
/// where the last time did not help.
const A_LITTLE: f64 = 0.9;
const LESS: f64 = 0.3;
/// It helps where what is beyond becomes less than this share of what it was. So often it may help no more.
const HELPS: f64 = 0.6;
const IDLE: usize = 2;
/// The light changes a little yet: estimates are to be less than what is asked for by so much.
const NEARLY: f64 = 0.95;

/// What the links of each patch may be off by together, as a share of its light.
#[derive(Debug)]
pub(super) struct Allowance {
    error: f64,
    shares: Vec<f64>,
    /// By how much estimates were beyond what is asked for, in all.
    beyond: f64,
    /// Whether each patch is helped by its own links.
    is_own: bool,
    idle: usize,
}

impl Allowance {
    pub(super) fn new(patches: usize, error: f64) -> Allowance {
        Allowance {
            error: NEARLY * error,
            shares: vec![SUM * error; patches],
            beyond: f64::INFINITY,
            is_own: true,
            idle: 0,
        }
    }

    /// The shares as they are.
    pub(super) fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// Takes in estimates; false where all are within what is asked for, or no shares help.
    pub(super) fn after(&mut self, estimates: &[f64]) -> bool {
        let beyond: f64 = estimates.iter().map(|estimate| (estimate - self.error).max(0.0)).sum();
        let helps = beyond <= HELPS * self.beyond;
        self.idle = if helps { 0 } else { self.idle + 1 };
        if beyond == 0.0 || self.idle > IDLE {
            return false;
        }
        self.is_own &= helps;
        self.beyond = beyond;
        let worst = estimates.iter().copied().fold(0.0, f64::max);
        let less = if helps { A_LITTLE } else { LESS * A_LITTLE };
        for (share, &estimate) in self.shares.iter_mut().zip(estimates) {
            let estimate = if self.is_own { estimate } else { worst };
            *share *= (less * self.error / estimate).clamp(LESS, 1.0);
        }
        true
    }
}
