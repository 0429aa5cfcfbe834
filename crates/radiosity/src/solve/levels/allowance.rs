//! How large the errors of the links of every patch may be, so that its estimate is within what is asked for.
//!
//! What reflection adds to the errors of links, and what is of one sign, may leave an estimate beyond that. The share of such a patch is made
//! smaller then; where this helps no more, what others reflect is left, and those of which most of it comes are made smaller.
use super::errors::EXPONENT;

/// Errors of links are of any sign, and their estimates are large: they may add up to so many times what is asked for.
pub(super) const SUM: f64 = 2.0;
/// A share is made smaller by as much as the estimate is too large and a little more, but not by more than this at once; and by so much more
/// where the last time did not help.
const A_LITTLE: f64 = 0.9;
const LESS: f64 = 0.3;
/// It helps where what is beyond becomes less than this share of what it was. So often it may help no more.
const HELPS: f64 = 0.6;
const IDLE: usize = 2;
/// Of so many patches, the worst, it is asked what their estimates come of.
const WORST: usize = 16;
/// The light changes a little yet: estimates are to be less than what is asked for by so much.
pub(super) const NEARLY: f64 = 0.95;

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

    /// Takes in estimates; false where all are within what is asked for, or no shares help. `causes` tells for some patches what share of the estimate
    /// of each comes of the links of every patch.
    pub(super) fn after(
        &mut self,
        estimates: &[f64],
        causes: impl FnOnce(&[usize]) -> Vec<Vec<f64>>,
    ) -> bool {
        let beyond: f64 = estimates.iter().map(|estimate| (estimate - self.error).max(0.0)).sum();
        let helps = beyond <= HELPS * self.beyond;
        self.idle = if helps { 0 } else { self.idle + 1 };
        if beyond == 0.0 || self.idle > IDLE {
            return false;
        }
        self.is_own &= helps;
        self.beyond = beyond;
        let mut worst: Vec<usize> =
            (0..estimates.len()).filter(|&patch| estimates[patch] > self.error).collect();
        worst.sort_by(|a, b| estimates[*b].total_cmp(&estimates[*a]).then(a.cmp(b)));
        let (by_causes, by_own) = worst.split_at(if self.is_own { 0 } else { worst.len().min(WORST) });
        let less = if helps { A_LITTLE } else { LESS * A_LITTLE };
        for &patch in by_own {
            self.shares[patch] *= (less * self.error / estimates[patch]).max(LESS);
        }
        let of_causes = if by_causes.is_empty() { Vec::new() } else { causes(by_causes) };
        for (&patch, causes) in by_causes.iter().zip(of_causes) {
            self.lessen(&causes, self.error / estimates[patch]);
        }
        true
    }

    /// Makes the shares smaller of which most of an estimate comes, for it to be within such a share of itself.
    fn lessen(&mut self, causes: &[f64], within: f64) {
        let most = most(causes, within);
        for (share, cause) in self.shares.iter_mut().zip(causes) {
            *share *= (most / cause).powf(1.0 / EXPONENT).clamp(LESS, 1.0);
        }
    }
}

/// The most that each patch may cause of an estimate, as a share of it, for the sum to be a little less than what is to be left: nothing is
/// asked of any where what no links better is too much by itself.
fn most(causes: &[f64], within: f64) -> f64 {
    let mut sorted: Vec<f64> = causes.iter().copied().filter(|cause| *cause > 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    let fixed = 1.0 - sorted.iter().sum::<f64>();
    if fixed >= within {
        return f64::INFINITY;
    }
    let mut left = A_LITTLE * (within - fixed);
    for (place, cause) in sorted.iter().enumerate() {
        let share = left / (sorted.len() - place) as f64;
        if *cause >= share {
            return share;
        }
        left -= cause;
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_causes_are_lessened_until_the_sum_is_right() {
        let causes = [0.1, 0.5, 0.0, 0.2];
        let most = most(&causes, 0.6);
        // 0.2 of the estimate is no matter of links, and a little less than 0.4 is to be left: 0.1, and twice 0.13.
        assert!((most - 0.13).abs() < 1e-12, "{most}");
        assert_eq!(super::most(&[0.1, 0.3], 0.5), f64::INFINITY);
    }

    #[test]
    fn patches_are_asked_for_more_by_what_they_cause_once_their_own_links_do_not_help() {
        let mut allowance = Allowance::new(3, 0.01);
        assert!(allowance.after(&[0.02, 0.001, 0.001], |_| panic!("its own links may help")));
        assert!(allowance.shares()[0] < 0.01 && allowance.shares()[1..] == [0.02; 2]);
        let before = allowance.shares().to_vec();
        assert!(allowance.after(&[0.02, 0.001, 0.001], |worst| {
            assert_eq!(worst, [0]);
            vec![vec![0.0, 0.9, 0.1]]
        }));
        assert_eq!([0, 2].map(|patch| allowance.shares()[patch]), [0, 2].map(|patch| before[patch]));
        assert!(allowance.shares()[1] < 0.01);
    }
}
