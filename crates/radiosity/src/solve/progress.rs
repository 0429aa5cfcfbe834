//! The progress of a run, as its caller sees it.
use super::{ledger::Ledger, solution::Solution, state::State};
use glam::DVec3;
use std::{fmt, ops::Range};

/// Where a run stands: what its light comes from, and what comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Moment<'p> {
    /// Nothing has changed since the last time: form factors are found, or a system is solved.
    Preparation,
    /// So many shots were made, and these elements have most to shoot.
    Shot(usize, &'p Range<usize>),
    /// The light after so many reflections; see [`Options::record`](crate::Options::record).
    Bounce(usize),
    /// The light of tiles and links that were refined so many times.
    Round(usize),
}

/// What light by levels goes between.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LinkedTiles {
    /// The corners of every tile there is, counter-clockwise seen from the front; later rounds only add to them.
    pub tiles: Vec<Vec<DVec3>>,
    /// Pairs of tiles that exchange light as a whole.
    pub links: Vec<[usize; 2]>,
}

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
    /// Where the run stands.
    pub moment: Moment<'p>,
    /// Finds the light so far.
    pub(super) light: &'p dyn Fn() -> Solution,
    pub(super) open: &'p dyn Fn() -> Vec<f64>,
    pub(super) tiles: &'p dyn Fn() -> LinkedTiles,
    pub(super) state: &'p State,
}

impl Progress<'_> {
    /// The light so far.
    #[must_use]
    pub fn solution(&self) -> Solution {
        (self.light)()
    }

    /// The radiosity that every element has yet to shoot, elements × bands, W/m², of either sign; empty where the method has no such light.
    #[must_use]
    pub fn unshot_radiosity(&self) -> Vec<f64> {
        (self.open)()
    }

    /// The tiles and links so far; none but by [`Method::Hierarchical`](crate::Method::Hierarchical).
    #[must_use]
    pub fn linked_tiles(&self) -> LinkedTiles {
        (self.tiles)()
    }

    /// The state from which the run can be resumed.
    #[must_use]
    pub fn state(&self) -> &State {
        self.state
    }
}

impl fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Progress { shots, products, unshot, bound, ledger, seconds, moment, .. } = self;
        let mut shown = f.debug_struct("Progress");
        shown.field("shots", shots).field("products", products).field("unshot", unshot).field("bound", bound);
        shown
            .field("ledger", ledger)
            .field("seconds", seconds)
            .field("moment", moment)
            .finish_non_exhaustive()
    }
}
