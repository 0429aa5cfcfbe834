//! Which segments may meet: those whose boxes do or, where these are far too many, those that the slab decomposition finds.

use crate::base::{id::index, meter::Meter};
use crate::contacts::budget::WorkBudget;
use crate::error::Error;
use crate::predicates::Segment;
use crate::spatial::{slabs::SlabDecomposition, strips::Strips};

/// A pair counts for so many of those that edges are compared in: where fragments crowd, boxes do not prune and are soon given up.
const DEAR: usize = 4;

/// The buffers of both ways, and what boxes may cost.
#[derive(Debug)]
pub(crate) struct Index<'a> {
    pub(crate) strips: &'a mut Strips,
    pub(crate) slabs: &'a mut SlabDecomposition,
    pub(crate) budget: WorkBudget,
    pub(crate) meter: &'a Meter<'a>,
}

impl Index<'_> {
    /// Calls `visit` for all pairs of segments whose boxes meet. Returns false, not having visited all, when `visit` does or when
    /// they are too many.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn pairs_by_boxes(
        &mut self,
        segments: impl ExactSizeIterator<Item = Segment> + Clone,
        mut visit: impl FnMut(u32, u32) -> bool,
    ) -> Result<bool, Error> {
        let Index { strips, budget, meter, .. } = self;
        let (count, mut pairs, mut allowed) = (segments.len(), 0, Ok(()));
        strips.build(segments.map(|[a, b]| [a.min(b), a.max(b)]));
        let is_done = strips.pairs_within(0..strips.len(), budget.blocks(count), |i, j| {
            pairs += 1;
            allowed = meter.spend(1);
            allowed.is_ok() && visit(i, j) && budget.lasts(count, DEAR * pairs, 0)
        });
        allowed.map(|()| is_done)
    }

    /// Calls `visit` for all pairs of segments that may meet elsewhere than in common ends.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn pairs_by_slabs(
        &mut self,
        segments: impl ExactSizeIterator<Item = Segment> + Clone,
        visit: impl FnMut(u32, u32),
    ) -> Result<(), Error> {
        let numbers = 0..index(segments.len());
        self.slabs.build(segments.flatten(), numbers.map(|i| (i, [2 * i, 2 * i + 1])));
        self.slabs.find(usize::MAX, self.meter)?;
        self.slabs.visit(visit);
        Ok(())
    }
}
