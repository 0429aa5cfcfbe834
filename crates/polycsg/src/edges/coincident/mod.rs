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
//! What is left of rings and changes the same is joined where it leads on: around a block of cells to one closed ring.
//!
//! A sample of the edges decides whether this pays.
//!
//! Edges that overlap in part are cut at all ends on their line, and one edge stands for all in each interval. So n edges on
//! one line meet O(n) times, and not n² times. That is done where a sample of the pairs of edges finds many that overlap.

mod cells;
mod covered;
mod intervals;
mod lines;
mod runs;
mod sample;
mod table;
mod touched;

use crate::base::meter::{Meter, Refusal, Tally};
use crate::edges::{Change, END, EdgeRing, Edges};
use crate::expression::{csg::Csg, winding::WindingNumbers};
use crate::spatial::strips::Strips;
use covered::CoveredRings;
use intervals::Intervals;
use lines::Lines;
use runs::{EdgeRun, EdgeRuns};
use sample::EdgeSample;
use std::ops::Range;
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

/// What the edges change that one stands for, besides its own ring's changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Company {
    Nobody,
    /// Most have one neighbour.
    One(Change),
    /// The sum of all is listed.
    More,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct CoincidentEdges {
    sample: EdgeSample,
    covered: CoveredRings,
    table: Table,
    fates: Vec<Fate>,
    touched: Touched,
    /// What crossing one edge changes, and what crossing the one before it does.
    changes: Vec<Change>,
    before: Vec<Change>,
    lines: Lines,
    intervals: Intervals,
    runs: EdgeRuns,
    /// Whether runs are joined.
    joins: bool,
    united: Edges,
}

impl CoincidentEdges {
    /// Drops what others cover, and lets one edge stand for all that coincide with it, if a good part of all edges coincide. What
    /// leads on is joined, which changes the order of edges, if asked for.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn unite(
        &mut self,
        edges: &mut Edges,
        csg: &Csg<'_>,
        winding: &mut WindingNumbers,
        strips: &mut Strips,
        joins: bool,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.joins = joins;
        self.drop_covered(edges, winding, meter)?;
        if self.sample.pays(edges, meter)? {
            winding.share(csg, strips, meter)?;
            edges.count_by(winding);
            self.table.group(edges, &mut self.fates, meter)?;
            self.decide(edges, meter)?;
            self.find_touched(edges, meter)?;
            self.link(edges, meter)?;
            std::mem::swap(edges, &mut self.united);
        }
        Ok(())
    }

    /// Drops the rings of a union that others of it cover.
    fn drop_covered(
        &mut self,
        edges: &mut Edges,
        winding: &WindingNumbers,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        if self.covered.pays(edges, winding, meter)? {
            self.table.clear(edges, &mut self.fates);
            self.touched.clear();
            self.covered.find(edges, &mut self.fates, self.touched.inside_mut(), meter)?;
            self.touched.sort(edges, meter)?;
            self.decide(edges, meter)?;
            self.link(edges, meter)?;
            std::mem::swap(edges, &mut self.united);
        }
        Ok(())
    }

    /// Cuts the edges that overlap in part, and lets one edge stand for all in each interval.
    ///
    /// # Errors
    /// Those of the meter's limits, by the sums of all intervals.
    pub(crate) fn cut(&mut self, edges: &mut Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.lines.find(edges, meter)?;
        self.table.clear(edges, &mut self.fates);
        self.touched.clear();
        for &edge in self.lines.components().flatten() {
            self.fates[edge as usize] = Fate::Represented;
        }
        self.decide(edges, meter)?;
        self.link(edges, meter)?;
        for overlapping in self.lines.components() {
            self.intervals.add(edges, overlapping, &mut self.united, meter)?;
        }
        std::mem::swap(edges, &mut self.united);
        Ok(())
    }

    /// Finds the edges whose changes add up to nothing, and those where they are not those of the edge before.
    fn decide(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        let mut tally = meter.tally();
        for ring in edges.rings() {
            tally.add((ring.end - ring.start) as usize)?;
            let mut before = None;
            for edge in ring.start..ring.end {
                // Half of the edges of a layer: not worth a call.
                before = match self.fates[edge as usize] {
                    Fate::Represented => None,
                    _ => self.decide_on(edges, ring, edge, before),
                };
            }
            // Where a closed ring is all alike so far, its first edge may go on from its last one.
            if !ring.is_open && before.is_some() && self.fates[ring.start as usize] == Fate::Starts {
                self.decide_on(edges, ring, ring.start, before);
            }
        }
        Ok(())
    }

    /// Decides on an edge that stands for others or itself, behind another one of its ring; returns what it stands for if it is
    /// kept.
    #[inline]
    fn decide_on(
        &mut self,
        edges: &Edges,
        ring: &EdgeRing,
        edge: u32,
        before: Option<Company>,
    ) -> Option<Company> {
        if self.fates[edge as usize] == Fate::Represented {
            return None;
        }
        let company = self.company(edges, ring, edge);
        let goes_on = company == before && (company != Some(Company::More) || self.changes == self.before);
        if company == Some(Company::More) {
            std::mem::swap(&mut self.changes, &mut self.before);
        }
        self.fates[edge as usize] = match (company, goes_on) {
            (None, _) => Fate::Gone,
            (_, true) => Fate::GoesOn,
            (_, false) => Fate::Starts,
        };
        company
    }

    /// What an edge stands for besides itself, unless the changes of all add up to nothing.
    #[inline]
    fn company(&mut self, edges: &Edges, ring: &EdgeRing, edge: u32) -> Option<Company> {
        let Some(other) = self.table.next(edge) else { return Some(Company::Nobody) };
        let others_ring = &edges.rings()[edges.ring_of(other) as usize];
        let is_simple = self.table.is_alone(other) && ring.also == END && others_ring.also == END;
        if let (true, Some(counter)) = (is_simple, others_ring.counter) {
            let along = edges.point(edge) == edges.point(other);
            let winds = if along { others_ring.winds } else { -others_ring.winds };
            let is_nothing = ring.counter == Some(counter) && ring.winds + winds == 0;
            return (!is_nothing).then_some(Company::One(Change { counter, winds }));
        }
        add_up(edges, &self.table, edge, &mut self.changes);
        (!self.changes.is_empty()).then_some(Company::More)
    }

    /// Finds what the edges touch that are gone. Where that takes too long, they are kept after all, each by itself.
    fn find_touched(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.touched.clear();
        let any = self.fates.contains(&Fate::Gone);
        if any && !self.touched.find(edges, &self.fates, meter)? {
            self.touched.clear();
            self.fates.iter_mut().filter(|fate| **fate == Fate::Gone).for_each(|fate| *fate = Fate::Starts);
        }
        Ok(())
    }

    /// Puts the rings that are whole, and of all others what is left, joined where it leads on.
    fn link(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.united.clear();
        self.runs.all.clear();
        let mut tally = meter.tally();
        for &ring in edges.rings() {
            tally.add((ring.end - ring.start) as usize)?;
            let fate = |edge: u32| self.fates[edge as usize];
            match (ring.start..ring.end).find(|&edge| fate(edge) == Fate::Starts) {
                Some(first) => {
                    self.add_runs(ring, first);
                    if !self.joins {
                        self.add_open_rings(edges, &mut tally)?;
                    }
                }
                None if fate(ring.start) == Fate::GoesOn => {
                    self.add_edges(edges, ring.start..ring.end);
                    self.end_ring(edges, ring.start, None);
                }
                None => {}
            }
        }
        self.add_open_rings(edges, &mut tally)
    }

    fn add_open_rings(&mut self, edges: &Edges, tally: &mut Tally<'_>) -> Result<(), Refusal> {
        let mut runs = std::mem::take(&mut self.runs);
        runs.join(edges, tally)?;
        for (ring, is_open) in runs.rings() {
            tally.add(ring.len())?;
            ring.iter().flat_map(|run| run.spans(edges)).for_each(|span| self.add_edges(edges, span));
            let end = ring.last().filter(|_| is_open).map(|run| run.end);
            self.end_ring(edges, ring[0].start, end);
        }
        runs.all.clear();
        self.runs = runs;
        Ok(())
    }

    /// Goes once round a ring, from an edge that starts a run.
    fn add_runs(&mut self, ring: EdgeRing, first: u32) {
        let mut start = None;
        for edge in [first..ring.end, ring.start..first].into_iter().flatten() {
            let fate = self.fates[edge as usize];
            if fate != Fate::GoesOn {
                start.into_iter().for_each(|start| self.add_run(ring, start, edge));
                start = (fate == Fate::Starts).then_some(edge);
            }
        }
        start.into_iter().for_each(|start| self.add_run(ring, start, first));
    }

    /// Adds a run that ends where another edge starts.
    fn add_run(&mut self, ring: EdgeRing, start: u32, end: u32) {
        let is_simple = self.joins && ring.also == END && self.table.is_alone(start);
        let change = ring.counter.map(|counter| Change { counter, winds: ring.winds });
        let end = if end == ring.start { ring.end } else { end };
        self.runs.all.push(EdgeRun { start, end, change: change.filter(|_| is_simple) });
    }

    /// Adds edges, cut at the vertices that touch them.
    fn add_edges(&mut self, edges: &Edges, mut span: Range<u32>) {
        for &(edge, point) in self.touched.inside(span.clone()) {
            self.united.add_edges(edges, span.start..edge + 1);
            self.united.add_edge(point, edges.origin(edge));
            span.start = edge + 1;
        }
        self.united.add_edges(edges, span);
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
        for Change { counter, winds } in edges.changes(edges.ring(edge)) {
            changes.push(Change { counter, winds: if along { winds } else { -winds } });
        }
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
