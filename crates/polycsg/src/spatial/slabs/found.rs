//! The pairs found so far, counted before they are too many.

use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;

/// See the module's page. A pair may be found in several slabs, and is dropped when they are counted.
#[derive(Debug, Default)]
pub(super) struct Found {
    pairs: Vec<[u32; 2]>,
    most: usize,
    /// How many only come near one another, those found twice counted twice, and how many may.
    near: usize,
    most_near: usize,
    /// How many of all of these are counted as work.
    counted: usize,
    is_over: bool,
}

impl Found {
    /// Starts over, with room for so many pairs, and so many that only come near one another.
    pub(super) fn start(&mut self, most: usize, near: usize) {
        self.pairs.clear();
        self.most = most;
        self.near = 0;
        self.most_near = near;
        self.counted = 0;
        self.is_over = false;
    }

    /// Starts over for a part of a search.
    pub(super) fn start_part(&mut self, whole: &Found) {
        self.start(whole.most, whole.most_near);
    }

    /// Adds what was found in a part.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn add_part(&mut self, part: Found, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.pairs.extend(part.pairs);
        self.near += part.near;
        self.is_over |= part.is_over || self.near > self.most_near;
        self.check(meter)
    }

    /// Adds pairs, each with whether it may be new, which may only come near one another; when there are too many, nothing. Those
    /// that are not new are counted, as looking at them takes as long.
    #[inline]
    pub(super) fn add(&mut self, pairs: impl Iterator<Item = ([u32; 2], bool)>, is_near: bool) {
        if self.is_over {
            return;
        }
        let mut count = 0;
        let new = pairs.inspect(|_| count += 1).filter(|pair| pair.1);
        self.pairs.extend(new.map(|([i, j], _)| [i.min(j), i.max(j)]));
        if is_near {
            self.near += count;
            self.is_over = self.near > self.most_near;
        }
    }

    /// Counts what was added since the last call as work, and finds out whether there are too many.
    ///
    /// # Errors
    /// Those of the meter's limits.
    #[inline]
    pub(super) fn check(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        meter.spend_up_to(self.pairs.len() + self.near, &mut self.counted)?;
        if self.pairs.len() / 2 > self.most { self.count(meter).map(drop) } else { Ok(()) }
    }

    /// Drops what was found twice; returns whether there are too many even so.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn count(&mut self, meter: &Meter<'_>) -> Result<bool, Refusal> {
        sort(&mut self.pairs, Ord::cmp, meter)?;
        self.pairs.dedup();
        self.counted = self.pairs.len() + self.near;
        self.is_over |= self.pairs.len() > self.most;
        Ok(self.is_over)
    }

    /// Whether more were added than there is room for: there is nothing left to look for.
    pub(super) fn is_over(&self) -> bool {
        self.is_over
    }

    /// How many pairs there was room for at most.
    #[cfg(test)]
    pub(super) fn room(&self) -> usize {
        self.pairs.capacity()
    }

    pub(super) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }
}
