//! Whether rounding made pieces of the boundary meet.

use super::fragment::{Fragment, in_conflict};
use super::{Repair, fragments::Rounded, index::Index};
use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::contacts::close_pairs::ClosePairs;
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
    ) -> Result<bool, Refusal> {
        if !close_pairs.all() && close_pairs.pairs().is_empty() {
            debug_assert!(self.is_sound_throughout(rounded, index)?);
            return Ok(true);
        }
        let are_close_sound = match close_pairs.all() {
            true => None,
            false => self.are_close_sound(rounded, close_pairs, index.meter)?,
        };
        match are_close_sound {
            None => self.is_sound_throughout(rounded, index),
            Some(true) => {
                debug_assert!(self.is_sound_throughout(rounded, index)?);
                Ok(true)
            }
            Some(false) => {
                self.find_close_conflicts(rounded, close_pairs, index.meter)?;
                Ok(false)
            }
        }
    }

    /// Whether all close pairs of edges are sound, or `None` where their fragments are too many to compare each with each.
    fn are_close_sound(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<Option<bool>, Refusal> {
        self.edges.clear();
        meter.extend(&mut self.edges, close_pairs.pairs().iter().flatten().copied())?;
        sort(&mut self.edges, u32::cmp, meter)?;
        self.edges.dedup();
        rounded.list_parts(Some(&self.edges), &mut self.parts, meter)?;
        rounded.round(&self.parts, &mut self.fragments, meter)?;
        self.sort_by_edge(meter)?;
        let Repair { fragments, .. } = &*self;
        let mut count = 0;
        meter.for_each(close_pairs.pairs(), |&[e, f]| count += self.on(e).len() * self.on(f).len())?;
        if count > PAIRS * fragments.len() {
            return Ok(None);
        }
        let is_sound = |[i, j]: [u32; 2]| {
            let (f, g) = (&fragments[i as usize], &fragments[j as usize]);
            !(f.moved || g.moved) || are_sound(f, g)
        };
        let mut all_sound = !fragments.iter().any(|f| f.segment[0] == f.segment[1]);
        meter.for_each(close_pairs.pairs(), |&pair| {
            all_sound = all_sound && self.pairs_on(pair).all(is_sound);
        })?;
        Ok(Some(all_sound))
    }

    fn sort_by_edge(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.by_edge.clear();
        let by_edge = (0..).zip(&self.fragments).map(|(i, fragment)| [fragment.edge, i]);
        meter.extend(&mut self.by_edge, by_edge)?;
        sort(&mut self.by_edge, Ord::cmp, meter)
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
    fn find_close_conflicts(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        rounded.list_parts(None, &mut self.parts, meter)?;
        rounded.round(&self.parts, &mut self.fragments, meter)?;
        self.sort_by_edge(meter)?;
        let edges = std::mem::take(&mut self.edges);
        self.find_alike(|fragment| edges.binary_search(&fragment.edge).is_ok(), meter)?;
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
        meter.for_all(classes, |[i, j]| {
            let differ = i != j && i != NONE && j != NONE;
            conflicts.extend(differ.then(|| self.conflict(i.min(j), i.max(j))).flatten());
        })?;
        sort(&mut conflicts, Ord::cmp, meter)?;
        conflicts.dedup();
        self.conflicts = conflicts;
        Ok(())
    }

    /// Whether no two fragments at all meet but in common vertices: the law behind [`is_sound`](Repair::is_sound).
    fn is_sound_throughout(&mut self, rounded: Rounded<'_>, index: &mut Index<'_>) -> Result<bool, Refusal> {
        rounded.list_parts(None, &mut self.parts, index.meter)?;
        rounded.round(&self.parts, &mut self.fragments, index.meter)?;
        self.find_alike(|_| true, index.meter)?;
        self.find_conflicts(index)?;
        // None collapsed, no two have both ends in common, and each point is one vertex.
        let is_sound = self.classes.len() == self.fragments.len() && self.conflicts.is_empty();
        Ok(is_sound && self.are_distinct(index.meter)?)
    }

    /// Whether ends in one point are one vertex.
    fn are_distinct(&self, meter: &Meter<'_>) -> Result<bool, Refusal> {
        let ends_of = |f: &Fragment| [0, 1].map(|i| (f.segment[i], f.ends[i]));
        let mut ends: Vec<(DVec2, u32)> = Vec::with_capacity(2 * self.fragments.len());
        meter.for_each(&self.fragments[..], |fragment| ends.extend(ends_of(fragment)))?;
        sort(&mut ends, |a, b| lexicographic(a.0, b.0), meter)?;
        Ok(ends.windows(2).all(|pair| pair[0].0 != pair[1].0 || pair[0].1 == pair[1].1))
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
