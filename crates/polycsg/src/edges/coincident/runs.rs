//! Runs of edges that change the same. Those that lead on from one another become one ring: what is left of neighbours whose
//! common border is gone is a closed one, which meets nothing in the corners of the border.

use crate::base::meter::{Refusal, Tally};
use crate::base::{id::index, sort::sort};
use crate::edges::{Change, Edges};
use crate::predicates::lexicographic;
use std::{cmp::Ordering, ops::Range};

/// No run, and one that is in a ring.
const NONE: u32 = u32::MAX;
const TAKEN: u32 = u32::MAX - 1;

/// Of the runs that start in one point, so many are looked at.
const AT_ONE_POINT: usize = 4;

/// Edges of one ring, from one on to the slot in which the last one ends, over the ring's end if that is not behind.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeRun {
    pub(super) start: u32,
    pub(super) end: u32,
    /// What crossing them changes, where that is simple.
    pub(super) change: Option<Change>,
}

impl EdgeRun {
    pub(super) fn spans(self, edges: &Edges) -> [Range<u32>; 2] {
        let ring = edges.ring(self.start);
        if self.start < self.end {
            [self.start..self.end, 0..0]
        } else {
            [self.start..ring.end, ring.start..self.end]
        }
    }
}

/// See the module's page.
#[derive(Debug, Default)]
pub(super) struct EdgeRuns {
    pub(super) all: Vec<EdgeRun>,
    /// Those with a simple change, by where they start.
    by_start: Vec<u32>,
    /// Per run the one that goes on where it ends, and whether it goes on from one.
    next: Vec<u32>,
    goes_on: Vec<bool>,
    /// The runs ring by ring, and of each ring where they stand and whether it is open.
    ordered: Vec<EdgeRun>,
    rings: Vec<(Range<usize>, bool)>,
}

impl EdgeRuns {
    /// Finds out which runs lead on to which: of those that change the same to the first at the point that no other does.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn join(&mut self, edges: &Edges, tally: &mut Tally<'_>) -> Result<(), Refusal> {
        let EdgeRuns { all, by_start, next, goes_on, .. } = self;
        let start = |run: u32| edges.point(all[run as usize].start);
        by_start.clear();
        by_start.extend((0..index(all.len())).filter(|&run| all[run as usize].change.is_some()));
        let by_place = |&a: &u32, &b: &u32| lexicographic(start(a), start(b)).then(a.cmp(&b));
        sort(by_start, by_place, tally.meter())?;
        next.clear();
        goes_on.clear();
        goes_on.resize(all.len(), false);
        for run in &*all {
            tally.add(1)?;
            let end = edges.point(run.end);
            let first = by_start.partition_point(|&other| lexicographic(start(other), end) == Ordering::Less);
            let mut there = by_start[first..].iter().take(AT_ONE_POINT);
            let other = there.find(|&&other| {
                run.change == all[other as usize].change && start(other) == end && !goes_on[other as usize]
            });
            next.push(other.copied().unwrap_or(NONE));
            other.into_iter().for_each(|&other| goes_on[other as usize] = true);
        }
        self.order();
        Ok(())
    }

    /// Lists the runs ring by ring: the open rings from their first run on, then what is left, which closes.
    fn order(&mut self) {
        let EdgeRuns { all, next, goes_on, ordered, rings, .. } = self;
        ordered.clear();
        rings.clear();
        let firsts = (0..all.len()).filter(|&run| !goes_on[run]);
        for first in firsts.chain(0..all.len()) {
            let (mut run, before) = (index(first), ordered.len());
            while run != NONE && next[run as usize] != TAKEN {
                ordered.push(all[run as usize]);
                run = std::mem::replace(&mut next[run as usize], TAKEN);
            }
            if ordered.len() > before {
                rings.push((before..ordered.len(), run == NONE));
            }
        }
    }

    /// The runs of each ring, and whether it is open.
    pub(super) fn rings(&self) -> impl Iterator<Item = (&[EdgeRun], bool)> {
        self.rings.iter().map(|(runs, is_open)| (&self.ordered[runs.clone()], *is_open))
    }
}

#[cfg(test)]
mod tests {
    use super::{EdgeRun, EdgeRuns};
    use crate::base::meter::Meter;
    use crate::edges::{Change, Edges, Origin};
    use glam::DVec2;

    /// Two squares side by side without their common edge.
    #[test]
    fn what_is_left_of_neighbours_closes() {
        let mut edges = Edges::default();
        let change = Change { counter: 0, winds: 1 };
        for west in [DVec2::ZERO, DVec2::X] {
            for corner in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y] {
                edges.add_edge(west + corner, Origin { operand: 0, edge: 0 });
            }
            edges.end_ring(None, &[change]);
        }
        let joined = |changes: [Option<Change>; 2]| -> Vec<(Vec<u32>, bool)> {
            let mut runs = EdgeRuns::default();
            let ends = [(2, 1), (5, 8)];
            runs.all.extend(ends.iter().zip(changes).map(|(&(start, end), change)| EdgeRun {
                start,
                end,
                change,
            }));
            runs.join(&edges, &mut Meter::default().tally()).expect("no limit was given");
            runs.rings().map(|(ring, open)| (ring.iter().map(|run| run.start).collect(), open)).collect()
        };
        assert_eq!(joined([Some(change); 2]), [(vec![2, 5], false)]);
        for other in [None, Some(Change { winds: -1, ..change })] {
            assert_eq!(joined([Some(change), other]), [(vec![2], true), (vec![5], true)]);
        }
    }
}
