//! Coincident edges are one edge: one of those with the same two ends stands for all, and crossing it changes all their counters.
//!
//! ```text
//!     +-->--+-->--+         Neighbours that share a border: the edges there of a and of b become one open ring, which
//!     |     ^|    |         changes both counters, and what is left of a and of b are two more. Rings with the same
//!     ^  a  |v b  v         points become one closed ring. Where the changes of an edge add up to nothing, as those of
//!     |     |     |         one counter do between the cells of a grid or the countries of a map, it is gone. Its
//!     +--<--+--<--+         vertices count all the same: where they touch an edge, they become vertices of that.
//! ```
//!
//! A sample of the edges decides whether this pays.
//!
//! Edges that overlap in part are cut at all ends on their line, and one edge stands for all in each interval. So n edges on
//! one line meet O(n) times, and not n² times. That is done where a sample of the pairs of edges finds many that overlap.

mod cells;
mod intervals;
mod lines;
mod sample;
mod table;
mod touched;

use crate::edges::{Change, EdgeRing, Edges};
use intervals::Intervals;
use lines::Lines;
use sample::Sample;
use table::Table;
use touched::Touched;

/// What becomes of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    /// It goes on from the edge before it.
    GoesOn,
    /// It starts an open ring.
    Starts,
    /// Another one stands for it, or it is no edge.
    Represented,
    /// It stands for edges whose changes add up to nothing.
    Gone,
}

impl Fate {
    fn is_kept(self) -> bool {
        matches!(self, Fate::GoesOn | Fate::Starts)
    }
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct CoincidentEdges {
    sample: Sample,
    table: Table,
    fates: Vec<Fate>,
    touched: Touched,
    /// What crossing one edge changes, and what crossing the one before it does.
    changes: Vec<Change>,
    before: Vec<Change>,
    lines: Lines,
    intervals: Intervals,
    united: Edges,
}

impl CoincidentEdges {
    /// Lets one edge stand for all that coincide with it, if a good part of all edges coincide.
    pub(crate) fn unite(&mut self, edges: &mut Edges) {
        if self.sample.pays(edges) {
            self.table.group(edges, &mut self.fates);
            self.cancel(edges);
            self.find_starts(edges);
            self.link(edges);
            std::mem::swap(edges, &mut self.united);
        }
    }

    /// Cuts the edges that overlap in part, and lets one edge stand for all in each interval.
    pub(crate) fn cut(&mut self, edges: &mut Edges) {
        self.lines.find(edges);
        self.table.clear(edges, &mut self.fates);
        self.touched.clear();
        for &edge in self.lines.components().flatten() {
            self.fates[edge as usize] = Fate::Represented;
        }
        self.find_starts(edges);
        self.link(edges);
        for overlapping in self.lines.components() {
            self.intervals.add(edges, overlapping, &mut self.united);
        }
        std::mem::swap(edges, &mut self.united);
    }

    /// Drops the edges whose changes add up to nothing, unless finding what they touch takes too long.
    fn cancel(&mut self, edges: &Edges) {
        let mut any = false;
        for edge in self.table.several() {
            add_up(edges, &self.table, edge, &mut self.changes);
            if self.changes.is_empty() {
                self.fates[edge as usize] = Fate::Gone;
                any = true;
            }
        }
        self.touched.clear();
        if any && !self.touched.find(edges, &self.fates, self.table.cells()) {
            self.touched.clear();
            self.fates.iter_mut().filter(|fate| **fate == Fate::Gone).for_each(|fate| *fate = Fate::GoesOn);
        }
    }

    /// Finds the edges where the changes are not those of the edge before.
    fn find_starts(&mut self, edges: &Edges) {
        for ring in edges.rings() {
            for edge in ring.start..ring.end {
                let is_kept = self.fates[edge as usize].is_kept();
                let goes_on = |before| self.goes_on(edges, before, edge);
                if is_kept && !ring.edge_before(edge).is_some_and(goes_on) {
                    self.fates[edge as usize] = Fate::Starts;
                }
            }
        }
    }

    fn goes_on(&mut self, edges: &Edges, before: u32, edge: u32) -> bool {
        if !self.fates[before as usize].is_kept() {
            return false;
        }
        let CoincidentEdges { table, changes, before: changes_before, .. } = self;
        [before, edge].iter().all(|&edge| table.is_alone(edge)) || {
            add_up(edges, table, before, changes_before);
            add_up(edges, table, edge, changes);
            changes_before == changes
        }
    }

    /// Puts the rings that are whole, and of all others what is left as open rings.
    fn link(&mut self, edges: &Edges) {
        self.united.clear();
        for &ring in edges.rings() {
            let fate = |edge: u32| self.fates[edge as usize];
            match (ring.start..ring.end).find(|&edge| fate(edge) == Fate::Starts) {
                Some(first) => self.add_open_rings(edges, ring, first),
                None if fate(ring.start).is_kept() => {
                    (ring.start..ring.end).for_each(|edge| self.add_edge(edges, edge));
                    self.end_ring(edges, ring.start, None);
                }
                None => {}
            }
        }
    }

    /// Goes once round a ring, from an edge that starts an open one.
    fn add_open_rings(&mut self, edges: &Edges, ring: EdgeRing, first: u32) {
        let mut start = first;
        for edge in (first..ring.end).chain(ring.start..first) {
            let fate = self.fates[edge as usize];
            if !fate.is_kept() {
                continue;
            }
            if fate == Fate::Starts {
                start = edge;
            }
            self.add_edge(edges, edge);
            let next = if edge + 1 == ring.end { ring.start } else { edge + 1 };
            if self.fates[next as usize] != Fate::GoesOn || ring.is_open && edge + 1 == ring.end {
                self.end_ring(edges, start, Some(edge + 1));
            }
        }
    }

    /// Adds an edge, cut at the vertices that touch it.
    fn add_edge(&mut self, edges: &Edges, edge: u32) {
        let origin = edges.origin(edge);
        self.united.add_edge(edges.point(edge), origin);
        self.touched.inside(edge).iter().for_each(|&(_, point)| self.united.add_edge(point, origin));
    }

    /// Ends a ring that changes what an edge does.
    fn end_ring(&mut self, edges: &Edges, edge: u32, end: Option<u32>) {
        add_up(edges, &self.table, edge, &mut self.changes);
        self.united.end_ring(end.map(|slot| edges.point(slot)), &self.changes);
    }
}

/// What crossing an edge and all that it stands for changes, by counters.
fn add_up(edges: &Edges, table: &Table, first: u32, changes: &mut Vec<Change>) {
    changes.clear();
    for edge in table.alike(first) {
        let along = edges.point(edge) == edges.point(first);
        let turned =
            |change: Change| Change { winds: if along { change.winds } else { -change.winds }, ..change };
        changes.extend(edges.changes(edges.ring(edge)).map(turned));
    }
    if !table.is_alone(first) {
        changes.sort_unstable();
        changes.dedup_by(|change, sum| {
            let same = change.counter == sum.counter;
            sum.winds += if same { change.winds } else { 0 };
            same
        });
        changes.retain(|change| change.winds != 0);
    }
}
