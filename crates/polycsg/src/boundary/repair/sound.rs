//! Whether rounding made pieces of the boundary meet.

use super::fragment::{Fragment, in_conflict};
use super::{Repair, fragments::Rounded};
use crate::base::id::index;
use crate::contacts::close_pairs::ClosePairs;
use crate::spatial::slabs::SlabDecomposition;

/// So many pairs of fragments for each close pair of edges are quickly compared.
const PAIRS: usize = 64;

impl Repair {
    /// Whether rounding left every piece where it was, as seen from the others: of the close pairs of edges, which are
    /// the only ones that can meet, no two fragments do but in a vertex of both.
    pub(super) fn is_sound(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        slabs: &mut SlabDecomposition,
    ) -> bool {
        if close_pairs.all() {
            return self.is_sound_throughout(rounded, slabs);
        }
        if close_pairs.pairs().is_empty() {
            debug_assert!(self.is_sound_throughout(rounded, slabs));
            return true;
        }
        let sound = self
            .are_all_sound(rounded, close_pairs)
            .unwrap_or_else(|| self.is_sound_throughout(rounded, slabs));
        debug_assert!(!sound || self.is_sound_throughout(rounded, slabs));
        sound
    }

    /// Whether all close pairs of edges are sound, or `None` where their fragments are too many to compare each with each.
    fn are_all_sound(&mut self, rounded: Rounded<'_>, close_pairs: &ClosePairs) -> Option<bool> {
        self.edges.clear();
        self.edges.extend(close_pairs.pairs().iter().flatten());
        self.edges.sort_unstable();
        self.edges.dedup();
        rounded.list_parts(Some(&self.edges), &mut self.parts);
        self.parts.sort_unstable_by_key(|part| part.edge);
        rounded.round(&self.parts, &mut self.fragments);
        let fragments = &self.fragments;
        let of_edge = |edge: u32| {
            let start = fragments.partition_point(|f| f.edge < edge);
            let count = fragments[start..].partition_point(|f| f.edge == edge);
            &fragments[start..start + count]
        };
        let count = |&[e, f]: &[u32; 2]| of_edge(e).len() * of_edge(f).len();
        if close_pairs.pairs().iter().map(count).sum::<usize>() > PAIRS * close_pairs.pairs().len() {
            return None;
        }
        let collapsed = fragments.iter().any(|f| f.segment[0] == f.segment[1]);
        let sound = |&[e, f]: &[u32; 2]| {
            of_edge(e)
                .iter()
                .all(|f0| of_edge(f).iter().all(|f1| !(f0.moved || f1.moved) || are_sound(f0, f1)))
        };
        Some(!collapsed && close_pairs.pairs().iter().all(sound))
    }

    /// Whether no two fragments at all meet but in common vertices: the law behind [`is_sound`](Repair::is_sound).
    fn is_sound_throughout(&mut self, rounded: Rounded<'_>, slabs: &mut SlabDecomposition) -> bool {
        let Repair { parts, fragments, .. } = self;
        rounded.list_parts(None, parts);
        rounded.round(parts, fragments);
        if fragments.iter().any(|f| f.segment[0] == f.segment[1]) {
            return false;
        }
        slabs.build(
            fragments.iter().flat_map(|f| f.segment),
            (0..index(fragments.len())).map(|i| (i, [2 * i, 2 * i + 1])),
        );
        let vertex = |end: u32| fragments[end as usize / 2].ends[end as usize % 2];
        let one_vertex = slabs.places().all(|mut place| {
            let first = place.next().map(vertex);
            place.all(|end| Some(vertex(end)) == first)
        });
        let mut sound = one_vertex && slabs.duplicates().next().is_none();
        if sound {
            slabs.pairs(|i, j| sound = sound && are_sound(&fragments[i as usize], &fragments[j as usize]));
        }
        sound
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
