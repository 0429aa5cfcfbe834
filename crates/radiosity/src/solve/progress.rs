//! The progress of a run, as its caller sees it.
use super::{ledger::Ledger, solution::Solution, state::State};
use std::fmt;

/// The progress of the solver.
#[derive(Clone, Copy)]
pub struct Progress<'p> {
    /// Shots so far.
    pub shots: usize,
    /// Matrix-vector products so far.
    pub products: usize,
    /// Unshot power over emitted power, in the worst band.
    pub unshot: f64,
    /// See [`Solution::bound`].
    pub bound: &'p [f64],
    /// Where the emitted power is now.
    pub ledger: &'p Ledger,
    /// Seconds since the start.
    pub seconds: f64,
    /// Finds the light so far.
    pub(super) light: &'p dyn Fn() -> Solution,
    pub(super) state: &'p State,
}

impl Progress<'_> {
    /// The light so far.
    #[must_use]
    pub fn solution(&self) -> Solution {
        (self.light)()
    }

    /// The state from which the run can be resumed.
    #[must_use]
    pub fn state(&self) -> &State {
        self.state
    }
}

impl fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Progress { shots, products, unshot, bound, ledger, seconds, .. } = self;
        let mut shown = f.debug_struct("Progress");
        shown.field("shots", shots).field("products", products).field("unshot", unshot).field("bound", bound);
        shown.field("ledger", ledger).field("seconds", seconds).finish_non_exhaustive()
    }
}
