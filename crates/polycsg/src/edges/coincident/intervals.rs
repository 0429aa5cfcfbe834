//! Edges that overlap on one line, cut at all their ends: one edge for each interval, with the sum of all changes there.

use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::edges::{Change, Edges};
use crate::predicates::lexicographic;
use glam::DVec2;
use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BinaryHeap};

/// Where an edge that runs up, or the reverse of one that runs down, starts or ends.
#[derive(Clone, Copy, Debug)]
struct LineEnd {
    point: DVec2,
    edge: u32,
    starts: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(super) struct Intervals {
    ends: Vec<LineEnd>,
    /// By how much each counter changes from the right to the left of the line, which runs up.
    sums: BTreeMap<u32, i32>,
    /// The edges over the interval, and some that have ended.
    over: BinaryHeap<Reverse<u32>>,
    changes: Vec<Change>,
}

impl Intervals {
    /// Adds an open ring for each interval between neighbouring ends. O(k log k) for k edges, and what the sums take.
    pub(super) fn add(
        &mut self,
        edges: &Edges,
        overlapping: &[u32],
        united: &mut Edges,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.list_ends(edges, overlapping, meter)?;
        self.sums.clear();
        self.over.clear();
        let ends = std::mem::take(&mut self.ends);
        let mut tally = meter.tally();
        let mut places = ends.chunk_by(|a, b| a.point == b.point).peekable();
        while let Some(place) = places.next() {
            place.iter().for_each(|end| self.pass(edges, *end));
            tally.add(place.len())?;
            let start = place[0].point;
            if let (Some(next), Some(first)) = (places.peek(), self.first_over(edges, start)) {
                self.changes.clear();
                let changes = self.sums.iter().map(|(&counter, &winds)| Change { counter, winds });
                self.changes.extend(changes);
                tally.add(self.changes.len())?;
                united.add_edge(start, edges.origin(first));
                united.end_ring(Some(next[0].point), &self.changes);
            }
        }
        self.ends = ends;
        Ok(())
    }

    fn list_ends(&mut self, edges: &Edges, overlapping: &[u32], meter: &Meter<'_>) -> Result<(), Refusal> {
        self.ends.clear();
        self.ends.extend(overlapping.iter().flat_map(|&edge| {
            let [low, high] = low_and_high(edges, edge);
            [LineEnd { point: low, edge, starts: true }, LineEnd { point: high, edge, starts: false }]
        }));
        sort(&mut self.ends, |a, b| lexicographic(a.point, b.point), meter)
    }

    /// Takes up an edge that starts, or drops one that ends.
    fn pass(&mut self, edges: &Edges, LineEnd { point, edge, starts }: LineEnd) {
        let runs_up = (edges.point(edge) == point) == starts;
        for Change { counter, winds } in edges.changes(edges.ring(edge)) {
            let sum = self.sums.entry(counter).or_default();
            *sum += if runs_up == starts { winds } else { -winds };
            if *sum == 0 {
                self.sums.remove(&counter);
            }
        }
        if starts {
            self.over.push(Reverse(edge));
        }
    }

    /// The first of the edges that go on beyond a point.
    fn first_over(&mut self, edges: &Edges, point: DVec2) -> Option<u32> {
        while let Some(&Reverse(edge)) = self.over.peek() {
            if lexicographic(point, low_and_high(edges, edge)[1]) == Ordering::Less {
                return Some(edge);
            }
            self.over.pop();
        }
        None
    }
}

fn low_and_high(edges: &Edges, edge: u32) -> [DVec2; 2] {
    let [a, b] = edges.segment(edge);
    if lexicographic(a, b) == Ordering::Less { [a, b] } else { [b, a] }
}
