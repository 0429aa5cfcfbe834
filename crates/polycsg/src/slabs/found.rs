//! The pairs found so far, counted before they are too many.

/// See the module's page. A pair may be found in several slabs, and is dropped when they are counted.
#[derive(Debug, Default)]
pub(super) struct Found {
    pairs: Vec<[u32; 2]>,
    most: usize,
    is_over: bool,
}

impl Found {
    /// Starts over, with room for so many pairs.
    pub(super) fn start(&mut self, most: usize) {
        self.pairs.clear();
        self.most = most;
        self.is_over = false;
    }

    /// Adds pairs; when there are too many, nothing.
    #[inline]
    pub(super) fn add(&mut self, pairs: impl Iterator<Item = [u32; 2]>) {
        if self.is_over {
            return;
        }
        self.pairs.extend(pairs.map(|[i, j]| [i.min(j), i.max(j)]));
        if self.pairs.len() / 2 > self.most {
            self.count();
        }
    }

    /// Drops what was found twice; returns whether there are too many even so.
    pub(super) fn count(&mut self) -> bool {
        self.pairs.sort_unstable();
        self.pairs.dedup();
        self.is_over |= self.pairs.len() > self.most;
        self.is_over
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
