//! Which segments may meet: those whose boxes do or, where these are far too many, those that the slab decomposition finds.

use crate::base::id::index;
use crate::base::meter::{Meter, Refusal};
use crate::contacts::budget::WorkBudget;
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
    ) -> Result<bool, Refusal> {
        let Index { strips, budget, meter, .. } = self;
        let (count, mut pairs, mut tally) = (segments.len(), 0, meter.tally());
        strips.build(segments.map(|[a, b]| [a.min(b), a.max(b)]), meter)?;
        strips.pairs_within(0..strips.len(), budget.blocks(count), meter, |i, j| {
            pairs += 1;
            tally.add(1)?;
            Ok(visit(i, j) && budget.lasts(count, DEAR * pairs, 0))
        })
    }

    /// Calls `visit` for all pairs of segments that may meet elsewhere than in common ends.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn pairs_by_slabs(
        &mut self,
        segments: impl ExactSizeIterator<Item = Segment> + Clone,
        visit: impl FnMut(u32, u32),
    ) -> Result<(), Refusal> {
        let numbers = 0..index(segments.len());
        self.slabs.build(segments.flatten(), numbers.map(|i| (i, [2 * i, 2 * i + 1])), self.meter)?;
        self.slabs.pairs(self.meter, visit)
    }
}
