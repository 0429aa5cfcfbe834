//! A hash table of edges by their ends, with a part for each cell of the plane, so that neighbours in the plane are neighbours
//! in memory.

use super::cells::Cells;
use crate::base::hash::mixed;
use crate::edges::Edges;

/// So many edges are in a cell on the average.
const EDGES_PER_CELL: usize = 64;

/// No edge.
const NONE: u32 = u32::MAX;

/// See the module's page.
#[derive(Debug, Default)]
pub(super) struct Table {
    /// Whether all rings change one counter.
    alike: bool,
    cells: Cells,
    /// Per edge its cell; per cell where its part of the table starts.
    cell: Vec<u32>,
    starts: Vec<u32>,
    /// In each part with open addressing, half of the places empty: of edges with the same ends and counter one that
    /// has not cancelled, or any.
    kinds: Vec<u32>,
    /// Per edge the next of its kind that has not cancelled, all in one direction.
    next: Vec<u32>,
}

impl Table {
    /// The cells of all points that were looked at last.
    pub(super) fn cells(&self) -> Cells {
        self.cells
    }

    /// Finds the edges that cancel: they are gone, and so is what is no edge.
    pub(super) fn find(&mut self, edges: &Edges, gone: &mut Vec<bool>) {
        gone.clear();
        gone.resize(edges.len(), false);
        self.next.clear();
        self.next.resize(edges.len(), NONE);
        self.alike = edges.rings().windows(2).all(|pair| pair[0].counter() == pair[1].counter());
        self.lay_out(edges);
        for ring in edges.rings().iter().filter(|ring| ring.is_closed()) {
            let mut key = mixed(edges.point(ring.start));
            for edge in ring.start..ring.end {
                let next_key = mixed(edges.point(edge + 1));
                self.add(edges, edge, key.wrapping_add(next_key), gone);
                key = next_key;
            }
        }
        edges.rings().iter().for_each(|ring| gone[ring.end as usize] = true);
    }

    /// Gives each cell two places for each of its edges.
    fn lay_out(&mut self, edges: &Edges) {
        self.cells = Cells::over(edges.points(), EDGES_PER_CELL);
        self.cell.clear();
        self.cell.resize(edges.len(), 0);
        self.starts.clear();
        self.starts.resize(self.cells.len() + 1, 0);
        for ring in edges.rings().iter().filter(|ring| ring.is_closed()) {
            for edge in ring.start..ring.end {
                let cell = self.cells.of(edges.segment(edge));
                self.cell[edge as usize] = cell;
                self.starts[cell as usize + 1] += 2;
            }
        }
        for cell in 1..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.kinds.clear();
        self.kinds.resize(2 * edges.len(), NONE);
    }

    /// Cancels an edge against one of its kind, or puts it into the kind's list.
    fn add(&mut self, edges: &Edges, edge: u32, key: u64, gone: &mut [bool]) {
        let cell = self.cell[edge as usize] as usize;
        let [start, end] = [self.starts[cell], self.starts[cell + 1]].map(|place| place as usize);
        let fraction = key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        let mut place = start + ((fraction * (end - start) as u64) >> 32) as usize;
        while self.kinds[place] != NONE && !self.is_kind(edges, self.kinds[place], edge) {
            place = if place + 1 == end { start } else { place + 1 };
        }
        let one = self.kinds[place];
        if one == NONE || gone[one as usize] {
            self.kinds[place] = edge;
        } else if edges.point(one) == edges.point(edge) {
            self.next[edge as usize] = one;
            self.kinds[place] = edge;
        } else {
            gone[edge as usize] = true;
            gone[one as usize] = true;
            let next = self.next[one as usize];
            self.kinds[place] = if next == NONE { one } else { next };
        }
    }

    /// Whether two edges have the same ends and change the same counter.
    #[inline]
    fn is_kind(&self, edges: &Edges, e: u32, f: u32) -> bool {
        let ([a, b], [c, d]) = (edges.segment(e), edges.segment(f));
        ((a == d && b == c) || (a == c && b == d))
            && (self.alike || edges.ring(e).counter() == edges.ring(f).counter())
    }
}
