//! Whether rounding made pieces of the boundary meet.

use super::fragment::{Fragment, in_conflict};
use super::{Repair, fragments::Rounded, index::Index};
use crate::contacts::close_pairs::ClosePairs;
use crate::error::Error;
use crate::predicates::lexicographic;
use glam::DVec2;

/// So many pairs for each of the fragments on edges of close pairs are quickly compared.
const PAIRS: usize = 64;

/// No class.
const NONE: u32 = u32::MAX;

impl Repair {
    /// Whether rounding left every piece where it was, as seen from the others: of the close pairs of edges, which are
    /// the only ones that can meet, no two fragments do but in a vertex of both. Else the conflicts are found.
    pub(super) fn is_sound(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        index: &mut Index<'_>,
    ) -> Result<bool, Error> {
        if !close_pairs.all() && close_pairs.pairs().is_empty() {
            debug_assert!(self.is_sound_throughout(rounded, index)?);
            return Ok(true);
        }
        index.meter.spend(close_pairs.pairs().len())?;
        match if close_pairs.all() { None } else { self.are_close_sound(rounded, close_pairs) } {
            None => self.is_sound_throughout(rounded, index),
            Some(true) => {
                debug_assert!(self.is_sound_throughout(rounded, index)?);
                Ok(true)
            }
            Some(false) => {
                self.find_close_conflicts(rounded, close_pairs);
                Ok(false)
            }
        }
    }

    /// Whether all close pairs of edges are sound, or `None` where their fragments are too many to compare each with each.
    fn are_close_sound(&mut self, rounded: Rounded<'_>, close_pairs: &ClosePairs) -> Option<bool> {
        self.edges.clear();
        self.edges.extend(close_pairs.pairs().iter().flatten());
        self.edges.sort_unstable();
        self.edges.dedup();
        rounded.list_parts(Some(&self.edges), &mut self.parts);
        rounded.round(&self.parts, &mut self.fragments);
        self.sort_by_edge();
        let Repair { fragments, .. } = &*self;
        let count = |&[e, f]: &[u32; 2]| self.on(e).len() * self.on(f).len();
        if close_pairs.pairs().iter().map(count).sum::<usize>() > PAIRS * fragments.len() {
            return None;
        }
        let collapsed = fragments.iter().any(|f| f.segment[0] == f.segment[1]);
        let is_sound = |[i, j]: [u32; 2]| {
            let (f, g) = (&fragments[i as usize], &fragments[j as usize]);
            !(f.moved || g.moved) || are_sound(f, g)
        };
        Some(!collapsed && close_pairs.pairs().iter().all(|&pair| self.pairs_on(pair).all(is_sound)))
    }

    fn sort_by_edge(&mut self) {
        self.by_edge.clear();
        self.by_edge.extend((0..).zip(&self.fragments).map(|(i, fragment)| [fragment.edge, i]));
        self.by_edge.sort_unstable();
    }

    /// The fragments on an edge, with it.
    fn on(&self, edge: u32) -> &[[u32; 2]] {
        let start = self.by_edge.partition_point(|entry| entry[0] < edge);
        let count = self.by_edge[start..].partition_point(|entry| entry[0] == edge);
        &self.by_edge[start..start + count]
    }

    /// Each fragment on one edge with each on another.
    fn pairs_on(&self, [e, f]: [u32; 2]) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.on(e).iter().flat_map(move |i| self.on(f).iter().map(move |j| [i[1], j[1]]))
    }

    /// The conflicts of all fragments, by those of close pairs of edges.
    fn find_close_conflicts(&mut self, rounded: Rounded<'_>, close_pairs: &ClosePairs) {
        rounded.list_parts(None, &mut self.parts);
        rounded.round(&self.parts, &mut self.fragments);
        self.sort_by_edge();
        let edges = std::mem::take(&mut self.edges);
        self.find_alike(|fragment| edges.binary_search(&fragment.edge).is_ok());
        self.edges = edges;
        self.class_of.clear();
        self.class_of.resize(self.fragments.len(), NONE);
        for (class, about) in (0..).zip(&self.classes) {
            self.alike[about.members.clone()].iter().for_each(|&(_, i)| self.class_of[i as usize] = class);
        }
        let mut conflicts = std::mem::take(&mut self.conflicts);
        conflicts.clear();
        let pairs = close_pairs.pairs().iter().flat_map(|&pair| self.pairs_on(pair));
        let classes = pairs.map(|pair| pair.map(|i| self.class_of[i as usize]));
        conflicts.extend(
            classes
                .filter(|[i, j]| i != j && *i != NONE && *j != NONE)
                .filter_map(|[i, j]| self.conflict(i.min(j), i.max(j))),
        );
        conflicts.sort_unstable();
        conflicts.dedup();
        self.conflicts = conflicts;
    }

    /// Whether no two fragments at all meet but in common vertices: the law behind [`is_sound`](Repair::is_sound).
    fn is_sound_throughout(&mut self, rounded: Rounded<'_>, index: &mut Index<'_>) -> Result<bool, Error> {
        rounded.list_parts(None, &mut self.parts);
        rounded.round(&self.parts, &mut self.fragments);
        self.find_alike(|_| true);
        self.find_conflicts(index)?;
        // None collapsed, no two have both ends in common, and each point is one vertex.
        Ok(self.classes.len() == self.fragments.len() && self.conflicts.is_empty() && self.are_distinct())
    }

    /// Whether ends in one point are one vertex.
    fn are_distinct(&self) -> bool {
        let ends = |f: &Fragment| [0, 1].map(|i| (f.segment[i], f.ends[i]));
        let mut ends: Vec<(DVec2, u32)> = self.fragments.iter().flat_map(ends).collect();
        ends.sort_unstable_by(|a, b| lexicographic(a.0, b.0));
        ends.windows(2).all(|pair| pair[0].0 != pair[1].0 || pair[0].1 == pair[1].1)
    }
}

/// Whether two fragments of different edges meet in common vertices only.
fn are_sound(f: &Fragment, g: &Fragment) -> bool {
    let same_point = |i: usize, j: usize| f.segment[i] == g.segment[j];
    let same_vertex = |i: usize, j: usize| f.ends[i] == g.ends[j];
    let ends_agree =
        [(0, 0), (0, 1), (1, 0), (1, 1)].iter().all(|&(i, j)| same_point(i, j) == same_vertex(i, j));
    let common_ends = g.segment.iter().filter(|p| f.segment.contains(p)).count();
    ends_agree && common_ends < 2 && !in_conflict([f.segment, g.segment])
}
