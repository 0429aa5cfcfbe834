//! Opposite edges of one counter cancel before they are compared with others, where many do.
//!
//! ```text
//!     +-->--+-->--+         The cells of a grid or the countries of a map: an edge that two of them share changes the
//!     |     ^|    |         winding number forth and back, so the sum of all rings is that of the outer edges alone.
//!     ^  a  |v b  v         What is left of the rings is linked to closed rings again; at each point as many edges are
//!     |     |     |         left that arrive as that leave.
//!     +--<--+--<--+
//! ```
//!
//! A sample of the edges at a few points decides whether this pays. The points are chosen by their digits, so that the order
//! of the input, its scale and quarter turns do not matter.

mod cells;
mod table;
mod touched;

use crate::base::{hash::mixed, id::index};
use crate::edges::{EdgeRing, Edges};
use crate::predicates::lexicographic;
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};
use table::Table;
use touched::Touched;

/// Fewer edges are not worth a sample.
const FEW: usize = 256;

/// Edges at one point in so many are looked at, at most.
const SAMPLE: usize = 128;

/// Consecutive edges of a ring that are left, `count` from `first` on, going round.
#[derive(Clone, Copy, Debug)]
struct EdgeRun {
    ring: u32,
    first: u32,
    count: u32,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct OppositeEdges {
    /// Edges by their keys.
    sample: Vec<(u64, u32)>,
    table: Table,
    /// Per edge whether it has cancelled.
    gone: Vec<bool>,
    touched: Touched,
    /// The runs of rings of which edges are gone, ring by ring, and their order by counter and first point.
    runs: Vec<EdgeRun>,
    order: Vec<u32>,
    /// Per place in `order` that is the first of its point: how many were taken.
    taken: Vec<u32>,
    used: Vec<bool>,
    linked: Edges,
}

impl OppositeEdges {
    /// Lets opposite edges cancel, if a good part of all edges has an opposite one.
    pub(crate) fn cancel(&mut self, edges: &mut Edges) {
        if edges.len() >= FEW && self.pays(edges) {
            self.table.find(edges, &mut self.gone);
            if self.touched.find(edges, &self.gone, self.table.cells()) {
                self.find_runs(edges);
                self.sort_runs(edges);
                self.link(edges);
                std::mem::swap(edges, &mut self.linked);
            }
        }
    }

    /// Whether of the edges at some points one in eight cancels.
    fn pays(&mut self, edges: &Edges) -> bool {
        let shift = 64 - (edges.len() / 128).min(SAMPLE).ilog2();
        self.sample.clear();
        for ring in edges.rings().iter().filter(|ring| ring.is_closed()) {
            for vertex in (ring.start..ring.end).filter(|&v| digits(edges.point(v)) >> shift == 0) {
                self.sample.extend([ring.previous(vertex), vertex].map(|edge| (key(edges, edge), edge)));
            }
        }
        self.sample.sort_unstable();
        self.sample.dedup();
        let cancels = |same: &[(u64, u32)]| {
            let rightward = same.iter().filter(|&&(_, edge)| is_rightward(edges, edge)).count();
            2 * rightward.min(same.len() - rightward)
        };
        let kinds = self.sample.chunk_by(|a, b| a.0 == b.0);
        !self.sample.is_empty() && 8 * kinds.map(cancels).sum::<usize>() >= self.sample.len()
    }

    fn find_runs(&mut self, edges: &Edges) {
        self.runs.clear();
        for (ring, about) in (0..).zip(edges.rings()) {
            if !self.gone[about.start as usize..about.end as usize].contains(&false) {
                continue;
            }
            let is_gone = |edge: u32| self.gone[edge as usize];
            let Some(last_gone) = (about.start..about.end).rfind(|&edge| is_gone(edge)) else { continue };
            let mut run = EdgeRun { ring, first: about.next(last_gone), count: 0 };
            let mut edge = run.first;
            for _ in about.start..about.end {
                if !is_gone(edge) {
                    run.count += 1;
                } else {
                    self.runs.extend((run.count > 0).then_some(run));
                    run = EdgeRun { ring, first: about.next(edge), count: 0 };
                }
                edge = about.next(edge);
            }
        }
    }

    fn sort_runs(&mut self, edges: &Edges) {
        self.order.clear();
        self.order.extend(0..index(self.runs.len()));
        let runs = &self.runs;
        let start = |run: u32| RunStart::of(edges, runs[run as usize]);
        self.order.sort_unstable_by(|&a, &b| start(a).order(start(b)).then(a.cmp(&b)));
        self.taken.clear();
        self.taken.resize(self.order.len(), 0);
        self.used.clear();
        self.used.resize(self.order.len(), false);
    }

    /// Puts the rings that are whole, and closed walks over the runs of all others, ring by ring.
    fn link(&mut self, edges: &Edges) {
        self.linked.clear();
        let mut run = 0;
        for (ring, about) in (0..).zip(edges.rings()) {
            if !self.gone[about.start as usize..about.end as usize].contains(&true) {
                self.add_edges(edges, about.start..about.end);
                self.linked.close(about.counter());
            }
            while self.runs.get(run).is_some_and(|run| run.ring == ring) {
                if !self.used[run] {
                    self.walk(edges, index(run), *about);
                }
                run += 1;
            }
        }
    }

    /// Adds edges to a new ring, cut at the vertices that touch them.
    fn add_edges(&mut self, edges: &Edges, mut span: Range<u32>) {
        for &(edge, point) in self.touched.inside(span.clone()) {
            self.linked.add_edges(edges, span.start..edge + 1);
            self.linked.add_edge(point, edges.origin(edge));
            span.start = edge + 1;
        }
        self.linked.add_edges(edges, span);
    }

    /// Walks from a run to any other that starts where it ends, and so on until it is back.
    fn walk(&mut self, edges: &Edges, first: u32, ring: EdgeRing) {
        let start = edges.point(self.runs[first as usize].first);
        let mut run = self.take(edges, RunStart { counter: ring.counter(), point: start });
        // Whichever run was taken starts in the same point.
        loop {
            let EdgeRun { ring, first, count } = self.runs[run as usize];
            let about = edges.rings()[ring as usize];
            let before_end = count.min(about.end - first);
            self.add_edges(edges, first..first + before_end);
            self.add_edges(edges, about.start..about.start + count - before_end);
            let last = if count > before_end { about.start + count - before_end } else { first + count };
            let end = edges.point(last);
            if end == start {
                break;
            }
            run = self.take(edges, RunStart { counter: about.counter(), point: end });
        }
        self.linked.close(ring.counter());
    }

    /// Takes the next unused run from a point.
    fn take(&mut self, edges: &Edges, start: RunStart) -> u32 {
        let before = |&run: &u32| RunStart::of(edges, self.runs[run as usize]).order(start) == Ordering::Less;
        let place = self.order.partition_point(before);
        let run = self.order[place + self.taken[place] as usize];
        self.taken[place] += 1;
        self.used[run as usize] = true;
        run
    }
}

/// Where a run starts.
#[derive(Clone, Copy)]
struct RunStart {
    counter: Option<u32>,
    point: DVec2,
}

impl RunStart {
    fn of(edges: &Edges, run: EdgeRun) -> RunStart {
        RunStart { counter: edges.rings()[run.ring as usize].counter(), point: edges.point(run.first) }
    }

    fn order(self, other: RunStart) -> Ordering {
        self.counter.cmp(&other.counter).then_with(|| lexicographic(self.point, other.point))
    }
}

/// A number made of the digits of a point's coordinates: not of their signs, exponents and order.
#[inline]
fn digits(p: DVec2) -> u64 {
    let of = |x: f64| {
        let product = (x.to_bits() & ((1 << 52) - 1)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        product ^ product >> 32
    };
    of(p.x).wrapping_add(of(p.y)).wrapping_mul(0xc4ce_b9fe_1a85_ec53)
}

fn is_rightward(edges: &Edges, edge: u32) -> bool {
    let [a, b] = edges.segment(edge);
    lexicographic(a, b) == Ordering::Less
}

/// Equal for edges with the same ends and counter, and hardly ever for others.
fn key(edges: &Edges, edge: u32) -> u64 {
    let [a, b] = edges.segment(edge).map(mixed);
    a.wrapping_add(b) ^ edges.ring(edge).counter().map_or(0, u64::from)
}
