//! Vertices that are gone but touch an edge that is left: they are vertices of it from then on, as they are where nothing
//! cancels.

use super::cells::Cells;
use crate::edges::{Edges, Ring};
use crate::predicates::{Side, is_inside, lexicographic, side};
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

/// So many edges are in a cell on the average: maps have far more at some places.
const EDGES_PER_CELL: usize = 2;

/// Edges that are left may touch so many cells each, on the average, and some more.
const CELLS_PER_EDGE: usize = 4;
const MORE: usize = 1000;

/// So many pairs of a vertex and an edge in its cell are looked at for each edge: where one far point makes one cell of all
/// others, they would be too many.
const PAIRS_PER_EDGE: usize = 64;

/// See the module's page.
#[derive(Debug, Default)]
pub(super) struct Touched {
    /// Edges that are left and points inside them, in order along each.
    inside: Vec<(u32, DVec2)>,
    /// Per cell where its edges start in `near`: those that are left and whose boxes touch it.
    starts: Vec<u32>,
    near: Vec<u32>,
}

impl Touched {
    /// Finds them; false where the edges that are left are too long, or all too close together, for that.
    pub(super) fn find(&mut self, edges: &Edges, gone: &[bool]) -> bool {
        let cells = Cells::over(edges.points(), EDGES_PER_CELL);
        let is_left = |ring: &&Ring| gone[ring.start as usize..ring.end as usize].contains(&false);
        let left = edges.rings().iter().filter(is_left).flat_map(|ring| ring.start..ring.end);
        let left = left.filter(|&edge| !gone[edge as usize]);
        self.list(edges, cells, left, gone.len()) && self.look(edges, cells, gone)
    }

    /// The points inside some edges, by edge and in order along each.
    pub(super) fn inside(&self, span: Range<u32>) -> &[(u32, DVec2)] {
        let first = self.inside.partition_point(|(edge, _)| *edge < span.start);
        let count = self.inside[first..].partition_point(|(edge, _)| *edge < span.end);
        &self.inside[first..first + count]
    }

    /// Lists the edges that are left cell by cell.
    fn list(
        &mut self,
        edges: &Edges,
        cells: Cells,
        left: impl Iterator<Item = u32> + Clone,
        count: usize,
    ) -> bool {
        let touched = |edge: u32| {
            let [a, b] = edges.segment(edge);
            cells.within(a.min(b), a.max(b)).flatten().map(|cell| cell as usize)
        };
        self.starts.clear();
        self.starts.resize(cells.len() + 2, 0);
        let mut room = MORE + CELLS_PER_EDGE * count;
        for edge in left.clone() {
            for cell in touched(edge) {
                if room == 0 {
                    return false;
                }
                room -= 1;
                self.starts[cell + 2] += 1;
            }
        }
        for cell in 2..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.near.clear();
        self.near.resize(self.starts.last().copied().unwrap_or(0) as usize, 0);
        for edge in left {
            for cell in touched(edge) {
                self.near[self.starts[cell + 1] as usize] = edge;
                self.starts[cell + 1] += 1;
            }
        }
        true
    }

    /// Looks at the vertices between two gone edges.
    fn look(&mut self, edges: &Edges, cells: Cells, gone: &[bool]) -> bool {
        self.inside.clear();
        let mut room = MORE + PAIRS_PER_EDGE * gone.len();
        for ring in edges.rings().iter().filter(|ring| ring.is_closed()) {
            let span = ring.start as usize..ring.end as usize;
            let mut before = gone[span.end - 1];
            for (&p, &gone) in edges.points()[span.clone()].iter().zip(&gone[span]) {
                if before & gone {
                    let looked_at = self.look_at(edges, cells.at(p) as usize, p);
                    let Some(left) = room.checked_sub(looked_at) else { return false };
                    room = left;
                }
                before = gone;
            }
        }
        self.sort(edges);
        true
    }

    fn sort(&mut self, edges: &Edges) {
        self.inside.sort_unstable_by(|(e, p), (f, q)| {
            let along = || if rises(edges, *e) { lexicographic(*p, *q) } else { lexicographic(*q, *p) };
            e.cmp(f).then_with(along)
        });
        self.inside.dedup();
    }

    /// Returns at how many edges it looked.
    #[inline]
    fn look_at(&mut self, edges: &Edges, cell: usize, p: DVec2) -> usize {
        let [start, end] = [self.starts[cell] as usize, self.starts[cell + 1] as usize];
        for &edge in &self.near[start..end] {
            let [a, b] = edges.segment(edge);
            if is_inside([a, b], p) && side(a, b, p) == Side::On {
                self.inside.push((edge, p));
            }
        }
        end - start
    }
}

/// Whether an edge starts in its smaller end.
#[inline]
fn rises(edges: &Edges, edge: u32) -> bool {
    let [start, end] = edges.segment(edge);
    lexicographic(start, end) == Ordering::Less
}
