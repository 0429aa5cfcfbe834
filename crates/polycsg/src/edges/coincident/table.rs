//! A hash table of edges by their ends.

use super::Fate;
use crate::base::hash::mixed;
use crate::base::meter::{Meter, Refusal};
use crate::edges::Edges;
use crate::predicates::Segment;
use glam::DVec2;

/// No edge.
const NONE: u32 = u32::MAX;

/// See the module's page.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// With open addressing, half of the places empty: the first of the edges with the same ends.
    firsts: Vec<u32>,
    /// Per edge another one with the same ends, as a list from the first on.
    next: Vec<u32>,
}

impl Table {
    /// Whether no other edge has the ends of one.
    pub(super) fn is_alone(&self, edge: u32) -> bool {
        self.next(edge).is_none()
    }

    /// Another edge with the ends of one that is the first of its kind.
    pub(super) fn next(&self, edge: u32) -> Option<u32> {
        Some(self.next[edge as usize]).filter(|&next| next != NONE)
    }

    /// The first edge of a kind, and all others with its ends.
    pub(super) fn alike(&self, first: u32) -> impl Iterator<Item = u32> + '_ {
        std::iter::successors(Some(first), |&edge| self.next(edge))
    }

    /// Leaves all edges alone.
    pub(super) fn clear(&mut self, edges: &Edges, fates: &mut Vec<Fate>) {
        fates.clear();
        fates.resize(edges.len(), Fate::GoesOn);
        edges.rings().iter().for_each(|ring| fates[ring.end as usize] = Fate::Represented);
        self.next.clear();
        self.next.resize(edges.len(), NONE);
    }

    /// Groups the edges that bound something by their ends; the first of each group represents the others.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn group(
        &mut self,
        edges: &Edges,
        fates: &mut Vec<Fate>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.clear(edges, fates);
        self.firsts.clear();
        self.firsts.resize(2 * edges.len(), NONE);
        let mut tally = meter.tally();
        for ring in edges.rings().iter().filter(|ring| ring.counter.is_some()) {
            let slots = ring.start as usize..ring.end as usize + 1;
            let mut key = mixed(edges.point(ring.start));
            for (edge, ends) in (ring.start..).zip(edges.points()[slots].windows(2)) {
                tally.add(1)?;
                let next_key = mixed(ends[1]);
                let key = std::mem::replace(&mut key, next_key).wrapping_add(next_key);
                if !self.is_first(edges.points(), edge, [ends[0], ends[1]], key) {
                    fates[edge as usize] = Fate::Represented;
                }
            }
        }
        Ok(())
    }

    /// Whether an edge is the first with its ends; else it joins the list of the first.
    #[inline]
    fn is_first(&mut self, points: &[DVec2], edge: u32, ends: Segment, key: u64) -> bool {
        let fraction = key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        let mut place = ((fraction * self.firsts.len() as u64) >> 32) as usize;
        loop {
            match self.firsts[place] {
                NONE => {
                    self.firsts[place] = edge;
                    return true;
                }
                first if have_same_ends(&points[first as usize..first as usize + 2], ends) => {
                    self.next[edge as usize] = std::mem::replace(&mut self.next[first as usize], edge);
                    return false;
                }
                _ => place = if place + 1 == self.firsts.len() { 0 } else { place + 1 },
            }
        }
    }
}

#[inline]
fn have_same_ends(one: &[DVec2], [c, d]: Segment) -> bool {
    (one[0] == d && one[1] == c) || (one[0] == c && one[1] == d)
}
