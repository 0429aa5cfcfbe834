//! Fans: rungs beside one another that share an end. Near it their heights are one, and their exact order takes over.

use super::rungs::Span;
use super::{Bar, Slabs};
use crate::predicates::{Side, side};
use crate::truth::index;
use std::ops::Range;

impl Slabs {
    /// Finds for each rung where those end that follow it and share its left end, or its right one.
    pub(super) fn find_fans(&mut self) {
        let Slabs { rungs, fans, .. } = self;
        fans.clear();
        fans.resize(rungs.len(), [index(rungs.len()); 2]);
        for i in (1..rungs.len()).rev() {
            for side in [0, 1] {
                let is_shared = rungs[i - 1].bar.ranks[side] == rungs[i].bar.ranks[side];
                fans[i - 1][side] = if is_shared { fans[i][side] } else { index(i) };
            }
        }
    }

    /// Of a fan of rungs that share an end, those that an edge may meet which comes near at a side; if none, an empty
    /// range between those below the edge and those above.
    ///
    /// Near the common end, the edge is among those around it there. Elsewhere it is between these and those around its
    /// own end, which the fan's lines are in the same order around.
    #[cold]
    pub(super) fn met_in_fan(&self, bar: Bar, fan: &Range<usize>, end: usize, side: usize) -> Range<usize> {
        let rung = self.rungs[fan.start].bar;
        if end == side {
            return self.around_common_end(bar, fan, end);
        }
        let around_end = self.around(bar.ranks[side], fan);
        if rung.ranks[end] == bar.ranks[end] {
            return around_end;
        }
        let around = self.around_common_end(bar, fan, end);
        around.start.min(around_end.start)..around.end.max(around_end.end)
    }

    /// Of a fan's rungs, those between which an edge is where they all end or, if it does not come so far, where it ends.
    fn around_common_end(&self, bar: Bar, fan: &Range<usize>, end: usize) -> Range<usize> {
        let [own, common] = [bar, self.rungs[fan.start].bar].map(|bar| bar.ranks[end]);
        if (end == 0) != (own < common) {
            return self.around(own, fan);
        }
        let [a, b] = self.segment(bar);
        match side(a, b, self.ends[common as usize]) {
            Side::Left => fan.start..fan.start,
            Side::On => fan.clone(),
            Side::Right => fan.end..fan.end,
        }
    }

    /// Of a fan's rungs, those whose lines go through a point, or an empty range between those below and those above.
    fn around(&self, rank: u32, fan: &Range<usize>) -> Range<usize> {
        let side_of = |rung: &Span| {
            let [a, b] = self.segment(rung.bar);
            side(a, b, self.ends[rank as usize])
        };
        let rungs = &self.rungs[fan.clone()];
        let below = rungs.partition_point(|rung| side_of(rung) == Side::Left);
        let on = rungs[below..].partition_point(|rung| side_of(rung) == Side::On);
        fan.start + below..fan.start + below + on
    }
}
