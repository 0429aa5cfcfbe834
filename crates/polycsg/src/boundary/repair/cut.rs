//! Cuts fragments that are in conflict until none is.

use super::fragment::{Class, CutAt, Fragment, in_conflict};
use super::{Repair, fragments::Rounded, near::Near};
use crate::base::id::index;
use crate::boundary::outline::Outline;
use crate::contacts::close_pairs::ClosePairs;
use crate::predicates::{Segment, lexicographic, rightward};
use crate::spatial::slabs::SlabDecomposition;
use glam::DVec2;
use std::cmp::Ordering;

impl Repair {
    /// Puts the pieces into an outline: no two of its edges meet but in their ends.
    ///
    /// At first only what is near the edges of close pairs is looked at, as nothing else can be in a conflict; then only what is
    /// near the last cuts. Fragments that rounding made vertical and that overlap are not cut at abscissae; they are cut in
    /// the end.
    pub(super) fn cut(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        slabs: &mut SlabDecomposition,
        outline: &mut Outline,
    ) {
        rounded.list_parts(None, &mut self.parts);
        rounded.round(&self.parts, &mut self.fragments);
        let (mut may_coincide, mut overlap) = (false, false);
        let mut near = self.near_close_pairs(close_pairs);
        loop {
            self.find_alike(&mut near);
            self.find_conflicts(slabs);
            may_coincide |= self.classes.len() < self.alike.len();
            let affected = self.list_cuts(rounded, &mut overlap);
            if self.cuts.is_empty() {
                break;
            }
            rounded.cut_up(&self.cuts, &mut self.fragments);
            near = Near::to(affected.into_iter());
        }
        debug_assert!(overlap || self.is_repaired(slabs));
        self.vertices = self.fragments.len() - self.parts.len();
        if overlap {
            let segments = cut_verticals(&self.fragments);
            let whole = self.fragments.iter().filter(|f| f.segment[0] != f.segment[1]);
            self.vertices += segments.len() - whole.count();
            outline.build(segments.iter().copied(), true);
        } else {
            outline.build(self.fragments.iter().map(|f| f.segment), may_coincide);
        }
    }

    /// What is near the fragments of the edges of close pairs.
    fn near_close_pairs(&self, close_pairs: &ClosePairs) -> Near {
        if close_pairs.all() {
            return Near::everything();
        }
        let Repair { edges, fragments, .. } = self;
        let is_close = |fragment: &&Fragment| edges.binary_search(&fragment.edge).is_ok();
        Near::to(fragments.iter().filter(is_close).map(|fragment| fragment.segment))
    }

    /// Groups the fragments with the same ends, of those near some place; any that rounding shrank to a point are left out.
    ///
    /// Where hundreds of edges pass through nearly one point, most fragments there are alike.
    fn find_alike(&mut self, near: &mut Near) {
        let Repair { fragments, alike, classes, .. } = self;
        alike.clear();
        alike.extend((0..index(fragments.len())).filter(|&i| {
            let segment = fragments[i as usize].segment;
            segment[0] != segment[1] && near.meets(segment)
        }));
        let compare = |i: u32, j: u32| {
            let (s, t) = (rightward(fragments[i as usize].segment), rightward(fragments[j as usize].segment));
            lexicographic(s[0], t[0]).then_with(|| lexicographic(s[1], t[1]))
        };
        alike.sort_unstable_by(|&i, &j| compare(i, j).then(i.cmp(&j)));
        classes.clear();
        let mut start = 0;
        for class in alike.chunk_by(|&i, &j| compare(i, j) == Ordering::Equal) {
            let end = start + class.len();
            let moved = class.iter().any(|&i| fragments[i as usize].moved);
            classes.push(Class { members: start..end, moved });
            start = end;
        }
    }

    /// Whether no fragments at all are in conflict.
    fn is_repaired(&mut self, slabs: &mut SlabDecomposition) -> bool {
        self.find_alike(&mut Near::everything());
        self.find_conflicts(slabs);
        self.conflicts.is_empty()
    }

    fn members(&self, class: u32) -> &[u32] {
        &self.alike[self.classes[class as usize].members.clone()]
    }

    /// The first of a class.
    fn one_of(&self, class: u32) -> &Fragment {
        &self.fragments[self.members(class)[0] as usize]
    }

    /// Finds the pairs of classes, one at least with a rounded end, that meet otherwise than in common ends.
    fn find_conflicts(&mut self, slabs: &mut SlabDecomposition) {
        let mut conflicts = std::mem::take(&mut self.conflicts);
        conflicts.clear();
        if self.classes.iter().any(|class| class.moved) {
            let classes = 0..index(self.classes.len());
            let points = classes.clone().flat_map(|class| self.one_of(class).segment);
            slabs.build(points, classes.map(|class| (class, [2 * class, 2 * class + 1])));
            slabs.pairs(|i, j| {
                let moved = self.classes[i as usize].moved || self.classes[j as usize].moved;
                let segments = || [i, j].map(|class| self.one_of(class).segment);
                if moved && in_conflict(segments()) {
                    conflicts.push([i, j]);
                }
            });
        }
        self.conflicts = conflicts;
    }

    /// Lists cuts of the conflicting fragments at the common ends of those that they conflict with, and notes whether there
    /// are any that cannot be cut so; returns the segments of the others, in whose boxes their new fragments will lie.
    fn list_cuts(&mut self, rounded: Rounded<'_>, overlap: &mut bool) -> Vec<Segment> {
        let mut affected = Vec::new();
        let mut common = vec![None; self.classes.len()];
        let mut cuts = std::mem::take(&mut self.cuts);
        cuts.clear();
        for &[i, j] in &self.conflicts {
            let before = cuts.len();
            for (class, other) in [(i, j), (j, i)] {
                let ends = &mut common[other as usize];
                *ends = ends.or_else(|| self.common_ends(rounded, other));
                ends.iter().for_each(|&ends| self.add_cuts(rounded, class, ends, &mut cuts));
            }
            if cuts.len() == before {
                *overlap = true;
            } else {
                affected.extend([i, j].map(|class| self.one_of(class).segment));
            }
        }
        cuts.sort_unstable();
        cuts.dedup();
        self.cuts = cuts;
        affected
    }

    /// The ends of the abscissae that all of a class have in common: the left end furthest right and the right end furthest
    /// left.
    fn common_ends(&self, rounded: Rounded<'_>, class: u32) -> Option<[u32; 2]> {
        let ends = |&fragment: &u32| rounded.rightward(self.fragments[fragment as usize].ends);
        let common =
            |[a, b]: [u32; 2], [c, d]: [u32; 2]| [rounded.rightward([a, c])[1], rounded.rightward([b, d])[0]];
        self.members(class).iter().map(ends).reduce(common)
    }

    fn add_cuts(&self, rounded: Rounded<'_>, class: u32, vertices: [u32; 2], cuts: &mut Vec<CutAt>) {
        for &fragment in self.members(class) {
            let ends = self.fragments[fragment as usize].ends;
            let inside = vertices.into_iter().filter(|&vertex| rounded.is_strictly_between(ends, vertex));
            cuts.extend(inside.map(|vertex| (fragment, vertex)));
        }
    }
}

/// All fragments, those that rounding left vertical cut at the points that lie on them.
fn cut_verticals(fragments: &[Fragment]) -> Vec<Segment> {
    let mut points: Vec<DVec2> = fragments.iter().flat_map(|f| f.segment).collect();
    points.sort_unstable_by(|&a, &b| lexicographic(a, b));
    points.dedup();
    let mut segments = Vec::with_capacity(fragments.len());
    for fragment in fragments {
        let segment = fragment.segment;
        if segment[0].x != segment[1].x {
            segments.push(segment);
            continue;
        }
        let [low, high] = rightward(segment);
        let first = points.partition_point(|&p| lexicographic(p, low) == Ordering::Less);
        let last = points.partition_point(|&p| lexicographic(p, high) == Ordering::Less);
        for pair in points[first..=last].windows(2) {
            segments.push(if segment[0] == low { [pair[0], pair[1]] } else { [pair[1], pair[0]] });
        }
    }
    segments
}
