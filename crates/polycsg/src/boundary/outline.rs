//! The rounded boundary: directed chains from node to node.

use super::select::{Piece, Selection};
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, sort::sort};
use crate::contacts::Contacts;
use crate::edges::Edges;
use crate::predicates::{Segment, lexicographic};
use glam::DVec2;

/// A directed chain of points between two nodes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundaryChain {
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// The place of its first point.
    first: u32,
}

/// Chains that meet in nodes only, as many arriving as leaving in each.
#[derive(Debug, Default)]
pub(crate) struct Outline {
    /// Of all chains in a row: the points without the last.
    points: Vec<DVec2>,
    chains: Vec<BoundaryChain>,
    node_count: usize,
    /// For numbering points: every start of a segment and its place in the input.
    starts: Vec<(DVec2, u32)>,
    numbered: Vec<DVec2>,
    unsorted: Vec<[u32; 2]>,
}

impl Outline {
    /// Takes the pieces as they are: their nodes are distinct points.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn take(
        &mut self,
        edges: &Edges,
        contacts: &Contacts,
        selection: &Selection,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.points.clear();
        self.chains.clear();
        self.node_count = contacts.node_count();
        let mut tally = meter.tally();
        for piece in selection.pieces() {
            let first = index(self.points.len());
            let [start, end] = piece.nodes.unwrap_or_else(|| {
                self.node_count += 1;
                [index(self.node_count - 1); 2]
            });
            let (from, to) = if piece.along { (start, end) } else { (end, start) };
            self.chains.push(BoundaryChain { start: from, end: to, first });
            self.points.push(match piece.nodes {
                Some(_) => selection.node_point(edges, contacts, from),
                None => edges.point(piece.edge_spans()[0].start),
            });
            self.add_inner(edges, piece);
            tally.add(self.points.len() - first as usize)?;
        }
        Ok(())
    }

    fn add_inner(&mut self, edges: &Edges, piece: &Piece) {
        let spans = piece.inner();
        if piece.along {
            spans.into_iter().for_each(|span| self.points.extend_from_slice(&edges.points()[span]));
        } else {
            for span in spans.into_iter().rev() {
                self.points.extend(edges.points()[span].iter().rev());
            }
        }
    }

    /// Numbers the points of closed walks, drops empty edges and, if any may coincide, cancels opposite ones: each
    /// edge that is left is a chain.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn build(
        &mut self,
        segments: impl Iterator<Item = Segment> + Clone,
        may_coincide: bool,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.number_starts(segments.clone(), meter)?;
        self.number_ends(segments, meter)?;
        self.unsorted.retain(|edge| edge[0] != edge[1]);
        if may_coincide {
            self.cancel_opposite(meter)?;
        }
        self.node_count = self.numbered.len() + 1;
        self.points.clear();
        let points = self.unsorted.iter().map(|edge| self.numbered[edge[0] as usize]);
        meter.extend(&mut self.points, points)?;
        self.chains.clear();
        let chain = |(&[start, end], first): (&[u32; 2], u32)| BoundaryChain { start, end, first };
        meter.extend(&mut self.chains, self.unsorted.iter().zip(0..).map(chain))
    }

    fn number_starts(
        &mut self,
        segments: impl Iterator<Item = Segment>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.starts.clear();
        meter.extend(&mut self.starts, segments.zip(0..).map(|([start, _], i)| (start, i)))?;
        sort(&mut self.starts, |a, b| lexicographic(a.0, b.0), meter)?;
        self.numbered.clear();
        meter.fill(&mut self.unsorted, [0; 2], self.starts.len())?;
        meter.for_each(&self.starts[..], |&(point, segment)| {
            if self.numbered.last() != Some(&point) {
                self.numbered.push(point);
            }
            self.unsorted[segment as usize][0] = index(self.numbered.len() - 1);
        })
    }

    /// Each point where a walk arrives is also left: the ends are found among the starts, most of them beside their own. Any
    /// that are not have one more number, so that nothing leaves them.
    fn number_ends(
        &mut self,
        segments: impl Iterator<Item = Segment>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let nowhere = self.numbered.len();
        meter.for_all(segments.enumerate(), |(i, [_, end])| {
            let beside = [i + 1, i.wrapping_sub(1)].into_iter().filter_map(|j| self.unsorted.get(j));
            let beside = beside.map(|edge| edge[0]).find(|&number| self.numbered[number as usize] == end);
            let compare = |p: &DVec2| lexicographic(*p, end);
            let search = || index(self.numbered.binary_search_by(compare).unwrap_or(nowhere));
            self.unsorted[i][1] = beside.unwrap_or_else(search);
        })
    }

    /// Removes pairs of opposite edges.
    fn cancel_opposite(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        let ends = |e: &[u32; 2]| (e[0].min(e[1]), e[0].max(e[1]));
        sort(&mut self.unsorted, |e, f| (ends(e), e[0]).cmp(&(ends(f), f[0])), meter)?;
        let mut kept: Vec<[u32; 2]> = Vec::with_capacity(self.unsorted.len());
        meter.for_all(self.unsorted.chunk_by(|a, b| ends(a) == ends(b)), |group| {
            let forward = group.iter().filter(|e| e[0] < e[1]).count();
            let cancelled = forward.min(group.len() - forward);
            kept.extend(&group[cancelled..group.len() - cancelled]);
        })?;
        self.unsorted = kept;
        Ok(())
    }

    /// Keeps some of the chains of an outline that was built of edges.
    pub(crate) fn retain(&mut self, mut is_wanted: impl FnMut(u32) -> bool) {
        let mut wanted = (0..index(self.chains.len())).map(&mut is_wanted);
        self.chains.retain(|_| wanted.next() == Some(true));
        self.points.clear();
        for chain in &mut self.chains {
            chain.first = index(self.points.len());
            self.points.push(self.numbered[chain.start as usize]);
        }
    }

    /// The node where a chain starts, or that where it ends.
    #[inline]
    pub(crate) fn node(&self, chain: u32, leaves: bool) -> u32 {
        let BoundaryChain { start, end, .. } = self.chains[chain as usize];
        if leaves { start } else { end }
    }

    /// The point of a node of an outline that was built of edges.
    #[inline]
    pub(crate) fn node_point(&self, node: u32) -> DVec2 {
        self.numbered[node as usize]
    }

    pub(crate) fn node_count(&self) -> usize {
        self.node_count
    }

    pub(crate) fn chains(&self) -> &[BoundaryChain] {
        &self.chains
    }

    /// The points of a chain, without the last.
    #[inline]
    pub(crate) fn points(&self, chain: u32) -> &[DVec2] {
        let end = self.chains.get(chain as usize + 1).map_or(self.points.len(), |next| next.first as usize);
        &self.points[self.chains[chain as usize].first as usize..end]
    }
}
