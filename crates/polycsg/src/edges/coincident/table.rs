//! A hash table of edges by their ends.

use super::Fate;
use crate::base::hash::mixed;
use crate::edges::Edges;

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
    pub(super) fn group(&mut self, edges: &Edges, fates: &mut Vec<Fate>) {
        self.clear(edges, fates);
        self.firsts.clear();
        self.firsts.resize(2 * edges.len(), NONE);
        for ring in edges.rings() {
            let mut key = mixed(edges.point(ring.start));
            for edge in ring.start..ring.end {
                let next_key = mixed(edges.point(edge + 1));
                if ring.counter.is_some() && !self.is_first(edges, edge, key.wrapping_add(next_key)) {
                    fates[edge as usize] = Fate::Represented;
                }
                key = next_key;
            }
        }
    }

    /// Whether an edge is the first with its ends; else it joins the list of the first.
    fn is_first(&mut self, edges: &Edges, edge: u32, key: u64) -> bool {
        let fraction = key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        let mut place = ((fraction * self.firsts.len() as u64) >> 32) as usize;
        while self.firsts[place] != NONE && !have_same_ends(edges, self.firsts[place], edge) {
            place = if place + 1 == self.firsts.len() { 0 } else { place + 1 };
        }
        let first = self.firsts[place];
        if first == NONE {
            self.firsts[place] = edge;
            return true;
        }
        self.next[edge as usize] = std::mem::replace(&mut self.next[first as usize], edge);
        false
    }
}

#[inline]
fn have_same_ends(edges: &Edges, e: u32, f: u32) -> bool {
    let ([a, b], [c, d]) = (edges.segment(e), edges.segment(f));
    (a == d && b == c) || (a == c && b == d)
}
