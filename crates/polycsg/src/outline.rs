//! The rounded boundary: distinct points in lexicographic order and directed edges between them.

use crate::predicates::lexicographic;
use crate::truth::index;
use glam::DVec2;
use std::ops::Range;

/// Points and directed edges by point ids, each edge once; the smaller id is the lexicographically smaller point.
#[derive(Debug, Default)]
pub(crate) struct Outline {
    points: Vec<DVec2>,
    edges: Vec<[u32; 2]>,
    /// Per point its first leaving edge; edges are sorted by start.
    leaving: Vec<u32>,
    /// Per point the place of its first arriving edge in `by_end`.
    arriving: Vec<u32>,
    by_end: Vec<u32>,
}

impl Outline {
    /// Numbers the points; cancels opposite edges, drops empty ones.
    pub(crate) fn of(segments: &[[DVec2; 2]]) -> Outline {
        let mut ends: Vec<(DVec2, usize)> =
            segments.iter().flatten().copied().enumerate().map(|(i, p)| (p, i)).collect();
        ends.sort_unstable_by(|a, b| lexicographic(a.0, b.0));
        let mut outline = Outline::default();
        let mut ids = vec![0; ends.len()];
        for (point, end) in ends {
            if outline.points.last() != Some(&point) {
                outline.points.push(point);
            }
            ids[end] = index(outline.points.len() - 1);
        }
        outline
            .edges
            .extend(ids.chunks_exact(2).filter(|pair| pair[0] != pair[1]).map(|pair| [pair[0], pair[1]]));
        outline.cancel();
        outline.index_by_point();
        outline
    }

    fn index_by_point(&mut self) {
        self.leaving = self.starts(0);
        self.arriving = self.starts(1);
        self.by_end.extend(0..index(self.edges.len()));
        self.by_end.sort_unstable_by_key(|&e| self.edges[e as usize][1]);
    }

    /// Per point the number of edges whose given end has a smaller id.
    fn starts(&self, end: usize) -> Vec<u32> {
        let mut starts = vec![0; self.points.len() + 1];
        for edge in &self.edges {
            starts[edge[end] as usize + 1] += 1;
        }
        for p in 1..starts.len() {
            starts[p] += starts[p - 1];
        }
        starts
    }

    /// The edges that leave a point.
    pub(crate) fn leaving(&self, point: u32) -> Range<u32> {
        self.leaving[point as usize]..self.leaving[point as usize + 1]
    }

    /// The edges that arrive at a point.
    pub(crate) fn arriving(&self, point: u32) -> &[u32] {
        &self.by_end[self.arriving[point as usize] as usize..self.arriving[point as usize + 1] as usize]
    }

    /// Sorts the edges by their ends and removes pairs of opposite ones.
    fn cancel(&mut self) {
        let ends = |e: &[u32; 2]| (e[0].min(e[1]), e[0].max(e[1]));
        self.edges.sort_unstable_by_key(|e| (ends(e), e[0]));
        let mut kept: Vec<[u32; 2]> = Vec::with_capacity(self.edges.len());
        for group in self.edges.chunk_by(|a, b| ends(a) == ends(b)) {
            let forward = group.iter().filter(|e| e[0] < e[1]).count();
            let cancelled = forward.min(group.len() - forward);
            kept.extend(&group[cancelled..group.len() - cancelled]);
        }
        kept.sort_unstable();
        self.edges = kept;
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
    pub(crate) fn segment(&self, edge: u32) -> [DVec2; 2] {
        self.edges[edge as usize].map(|id| self.point(id))
    }
}
