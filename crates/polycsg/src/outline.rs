//! The rounded boundary: distinct points in lexicographic order and directed edges between them.

use crate::predicates::{Segment, lexicographic};
use crate::truth::index;
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

/// Points and directed edges by point ids, each edge once; the smaller id is the lexicographically smaller point.
#[derive(Debug, Default)]
pub(crate) struct Outline {
    points: Vec<DVec2>,
    /// Sorted by start, then by end.
    edges: Vec<[u32; 2]>,
    /// Per point its first leaving edge.
    leaving: Vec<u32>,
    /// Per point the place of its first arriving edge in `by_end`.
    arriving: Vec<u32>,
    by_end: Vec<u32>,
    /// Of every start of a segment its point and its place in the input.
    starts: Vec<(DVec2, u32)>,
    unsorted: Vec<[u32; 2]>,
}

impl Outline {
    /// Numbers the points of closed walks, drops empty edges and, if any may coincide, cancels opposite ones.
    pub(crate) fn build(&mut self, segments: impl Iterator<Item = Segment> + Clone, may_coincide: bool) {
        self.starts.clear();
        self.starts.extend(segments.clone().zip(0..).map(|([start, _], i)| (start, i)));
        self.starts.sort_unstable_by(|a, b| lexicographic(a.0, b.0));
        self.points.clear();
        self.unsorted.clear();
        self.unsorted.resize(self.starts.len(), [0; 2]);
        for &(point, segment) in &self.starts {
            if self.points.last() != Some(&point) {
                self.points.push(point);
            }
            self.unsorted[segment as usize][0] = index(self.points.len() - 1);
        }
        // Each point where a walk arrives is also left: the ends are found among the starts.
        for (edge, [_, end]) in self.unsorted.iter_mut().zip(segments) {
            edge[1] = index(self.points.partition_point(|&p| lexicographic(p, end) == Ordering::Less));
        }
        self.unsorted.retain(|edge| edge[0] != edge[1]);
        if may_coincide {
            self.cancel();
        }
        self.sort();
    }

    /// Removes pairs of opposite edges.
    fn cancel(&mut self) {
        let ends = |e: &[u32; 2]| (e[0].min(e[1]), e[0].max(e[1]));
        self.unsorted.sort_unstable_by_key(|e| (ends(e), e[0]));
        let mut kept: Vec<[u32; 2]> = Vec::with_capacity(self.unsorted.len());
        for group in self.unsorted.chunk_by(|a, b| ends(a) == ends(b)) {
            let forward = group.iter().filter(|e| e[0] < e[1]).count();
            let cancelled = forward.min(group.len() - forward);
            kept.extend(&group[cancelled..group.len() - cancelled]);
        }
        self.unsorted = kept;
    }

    /// Sorts the edges by start and end, and indexes them by either.
    fn sort(&mut self) {
        sort_by_end(&self.unsorted, 1, self.points.len(), &mut self.arriving, &mut self.by_end);
        self.edges.clear();
        self.edges.extend(self.by_end.iter().map(|&e| self.unsorted[e as usize]));
        std::mem::swap(&mut self.edges, &mut self.unsorted);
        sort_by_end(&self.unsorted, 0, self.points.len(), &mut self.leaving, &mut self.by_end);
        self.edges.clear();
        self.edges.extend(self.by_end.iter().map(|&e| self.unsorted[e as usize]));
        sort_by_end(&self.edges, 1, self.points.len(), &mut self.arriving, &mut self.by_end);
    }

    /// The edges that leave a point.
    pub(crate) fn leaving(&self, point: u32) -> Range<u32> {
        self.leaving[point as usize]..self.leaving[point as usize + 1]
    }

    /// The edges that arrive at a point.
    pub(crate) fn arriving(&self, point: u32) -> &[u32] {
        &self.by_end[self.arriving[point as usize] as usize..self.arriving[point as usize + 1] as usize]
    }

    #[inline]
    pub(crate) fn point(&self, id: u32) -> DVec2 {
        self.points[id as usize]
    }

    pub(crate) fn point_count(&self) -> usize {
        self.points.len()
    }

    /// The edges, sorted by start and end.
    pub(crate) fn edges(&self) -> &[[u32; 2]] {
        &self.edges
    }

    #[inline]
    pub(crate) fn segment(&self, edge: u32) -> Segment {
        self.edges[edge as usize].map(|id| self.point(id))
    }
}

/// A stable counting sort of the edges by one of their ends: per point where its edges begin in `order`.
fn sort_by_end(edges: &[[u32; 2]], end: usize, points: usize, starts: &mut Vec<u32>, order: &mut Vec<u32>) {
    starts.clear();
    starts.resize(points + 2, 0);
    for edge in edges {
        starts[edge[end] as usize + 2] += 1;
    }
    for p in 2..points + 2 {
        starts[p] += starts[p - 1];
    }
    order.clear();
    order.resize(edges.len(), 0);
    for (i, edge) in edges.iter().enumerate() {
        let at = &mut starts[edge[end] as usize + 1];
        order[*at as usize] = index(i);
        *at += 1;
    }
    starts.pop();
}
