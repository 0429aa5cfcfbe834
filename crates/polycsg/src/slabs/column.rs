//! Slabs without width: parts of a vertical line, between two ends on it.
//!
//! Edges that are not vertical are in one point there. Where two of them meet, they do so in the next slab to the left or
//! right that has a width, at its side; so only vertical edges are compared, with one another and with all others.

use super::{Bar, Slab, Slabs};
use crate::truth::index;

impl Slabs {
    /// Finds the pairs of the open edges from `start` on that may meet in a slab without width.
    pub(super) fn look_into_column(&mut self, slab: Slab, start: usize) {
        let Slabs { ends, open, .. } = self;
        let is_vertical = |bar: &Bar| ends[bar.ranks[0] as usize].x == ends[bar.ranks[1] as usize].x;
        let count = open[start..].iter().filter(|bar| is_vertical(bar)).count();
        if count == 0 || self.found.is_over() {
            return;
        }
        open[start..].sort_unstable_by_key(|bar| (!is_vertical(bar), bar.ranks, bar.id));
        let others = start + count;
        self.sort_keys(slab, others);
        for i in start..others {
            self.compare_vertical(i, others);
        }
    }

    /// Sorts the open edges from a place on by their heights at a slab's left side.
    fn sort_keys(&mut self, slab: Slab, start: usize) {
        let mut keys = std::mem::take(&mut self.keys);
        keys.clear();
        keys.extend((start..self.open.len()).zip(index(start)..).map(|(i, place)| {
            let bar = self.open[i];
            let rank = slab[0].clamp(bar.ranks[0], bar.ranks[1]);
            (self.height(bar.ranks, self.line(bar, slab), rank), place)
        }));
        keys.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        self.keys = keys;
    }

    /// Finds the vertical edges behind a vertical one, and the others, that it may meet.
    fn compare_vertical(&mut self, i: usize, others: usize) {
        let Slabs { ends, open, keys, found, slack, .. } = self;
        let bar = open[i];
        let [low, high] = bar.ranks.map(|rank| ends[rank as usize].y);
        let upright = open[i + 1..others].iter().take_while(|other| other.ranks[0] < bar.ranks[1]);
        let first = keys.partition_point(|key| key.0 + *slack < low);
        let level =
            keys[first..].iter().take_while(|key| key.0 <= high + *slack).map(|key| &open[key.1 as usize]);
        let level = level.filter(|other| other.ranks.iter().all(|rank| !bar.ranks.contains(rank)));
        found.add(upright.chain(level).map(|other| [bar.id, other.id]));
    }
}
