//! The parts of a slab on several threads.
//!
//! ```text
//!  |  part  |  part  |    What comes into a part from the left is known from the edges alone, in order by its heights
//!  |-----___|________|    there. So parts need not wait for one another: they find what they would one after the other.
//!  |___     |--------|    Parts of as many edges fork again.
//!  |   \____|___     |
//! ```

use super::SlabDecomposition;
use super::descent::{Search, by_height};
use super::segments::{ClippedSegment, Slab, parts};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort, threads::Threads};
use std::{ops::Range, sync::Arc};

impl SlabDecomposition {
    /// Looks into the parts of a slab, each with buffers of its own. Leaves nothing to who goes on behind the slab: if that was
    /// a part, it forked as well.
    pub(super) fn fork(
        &mut self,
        slab: Slab,
        base: usize,
        starts: Range<usize>,
        search: Search<'_>,
        threads: Threads,
    ) -> Result<(), Refusal> {
        let looked_into = threads.map(parts(slab), |part| {
            let mut own = self.part(part, base, starts.clone(), search.meter)?;
            let inside = own.starting_before(starts.clone(), part[0] + 1).end..starts.end;
            let inside = own.starting_before(inside, part[1]);
            own.look_into(part, 0, inside, search)?;
            Ok((part, own.found, own.nearest))
        });
        for part in looked_into {
            let (part, found, nearest) = part?;
            self.found.add_part(found, search.meter)?;
            for (query, nearest) in self.queries_in(part).zip(nearest) {
                self.nearest[self.queries[query].1 as usize] = nearest;
            }
        }
        Ok(())
    }

    /// A part with what comes into it, of the edges passing from `base` on and others that start further left, and its queries.
    fn part(
        &self,
        part: Slab,
        base: usize,
        starts: Range<usize>,
        meter: &Meter<'_>,
    ) -> Result<SlabDecomposition, Refusal> {
        let mut own = SlabDecomposition {
            ends: Arc::clone(&self.ends),
            segments: Arc::clone(&self.segments),
            error: self.error,
            slack: self.slack,
            reach: self.reach,
            has_slopes: self.has_slopes,
            ..SlabDecomposition::default()
        };
        own.found.start_part(&self.found);
        for &(rank, place) in &self.queries[self.queries_in(part)] {
            own.queries.push((rank, index(own.nearest.len())));
            own.nearest.push(self.nearest[place as usize]);
        }
        let goes_on = |segment: &ClippedSegment| segment.segment.ranks[1] > part[0];
        let p = self.ends[part[0] as usize];
        let at_side = |passing: ClippedSegment| {
            let height = self.height_inside(&passing, p);
            ClippedSegment { heights: [height; 2], ..passing }
        };
        let starting = self.edges(self.starting_before(starts, part[0] + 1));
        let starting = starting.map(|segment| self.clip(segment, [segment.ranks[0]; 2]));
        let passing = self.passing[base..].iter().copied().chain(starting);
        meter.for_all(passing, |passing| {
            own.passing.extend(goes_on(&passing).then(|| at_side(passing)));
        })?;
        sort(&mut own.passing, by_height, meter)?;
        Ok(own)
    }
}
