//! Cuts fragments that are in conflict until none is.

use super::fragment::{Class, CutAt, Fragment, in_conflict};
use super::{Repair, fragments::Rounded, index::Index, near::Near};
use crate::base::meter::{Meter, Refusal};
use crate::base::parts::Numbered;
use crate::base::{id, sort::sort};
use crate::boundary::outline::Outline;
use crate::predicates::{Segment, lexicographic, rightward};
use std::cmp::Ordering;

impl Repair {
    /// Puts the pieces into an outline: no two of its edges meet but in their ends.
    ///
    /// The first conflicts are known. Then only what is near the last cuts is looked at, as nothing else can be in a new one.
    /// Fragments that rounding made vertical and that overlap are not cut at abscissae; they are cut in the end.
    ///
    /// # Errors
    /// Those of the limits of the index.
    pub(super) fn cut(
        &mut self,
        rounded: Rounded<'_>,
        index: &mut Index<'_>,
        outline: &mut Outline,
    ) -> Result<(), Refusal> {
        let (mut may_coincide, mut overlap, meter) = (false, false, index.meter);
        for round in 1.. {
            may_coincide |= self.classes.len() < self.alike.len();
            let affected = self.list_cuts(rounded, round, &mut overlap, meter)?;
            if self.cuts.is_empty() {
                break;
            }
            rounded.cut_up(&self.cuts, &mut self.fragments, meter)?;
            let mut near = Near::to(affected.into_iter(), meter)?;
            self.find_alike(|fragment| near.is_slow() || near.meets(fragment.segment), meter)?;
            if near.is_slow() {
                // A class must be whole: some of its members have other abscissae in common than all have.
                self.find_alike(|_| true, meter)?;
            }
            if !self.find_conflicts_again(round, index)? {
                self.find_conflicts(index)?;
            }
        }
        debug_assert!(overlap || self.is_repaired(index)?);
        self.vertices = self.fragments.len() - self.parts.len();
        if overlap {
            let segments = cut_verticals(&self.fragments, meter)?;
            let whole = self.fragments.iter().filter(|f| f.segment[0] != f.segment[1]);
            self.vertices += segments.len() - whole.count();
            outline.build(segments.iter().copied(), true, meter)
        } else {
            outline.build(self.fragments.iter().map(|f| f.segment), may_coincide, meter)
        }
    }

    /// Groups the fragments with the same ends, of those that are wanted; any that rounding shrank to a point are left out.
    ///
    /// Where hundreds of edges pass through nearly one point, most fragments there are alike.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find_alike(
        &mut self,
        mut wanted: impl FnMut(&Fragment) -> bool,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let Repair { fragments, alike, classes, .. } = self;
        let mut is_wanted = |f: &Fragment| f.segment[0] != f.segment[1] && wanted(f);
        alike.clear();
        meter.for_each(Numbered(fragments), |(i, f)| {
            alike.extend(is_wanted(f).then(|| (rightward(f.segment), i)));
        })?;
        let compare =
            |s: Segment, t: Segment| lexicographic(s[0], t[0]).then_with(|| lexicographic(s[1], t[1]));
        sort(alike, |&(s, i), &(t, j)| compare(s, t).then(i.cmp(&j)), meter)?;
        classes.clear();
        let mut start = 0;
        meter.for_all(alike.chunk_by(|(s, _), (t, _)| s == t), |class| {
            let end = start + class.len();
            let members = || class.iter().map(|&(_, i)| &fragments[i as usize]);
            let (moved, round) = (members().any(|f| f.moved), members().map(|f| f.round).max().unwrap_or(0));
            classes.push(Class { members: start..end, moved, round });
            start = end;
        })
    }

    /// Whether no fragments at all are in conflict.
    fn is_repaired(&mut self, index: &mut Index<'_>) -> Result<bool, Refusal> {
        self.find_alike(|_| true, index.meter)?;
        self.find_conflicts(index)?;
        Ok(self.conflicts.is_empty())
    }

    fn members(&self, class: u32) -> impl Iterator<Item = u32> + '_ {
        self.alike[self.classes[class as usize].members.clone()].iter().map(|&(_, fragment)| fragment)
    }

    /// The ends of a class.
    fn segment(&self, class: u32) -> Segment {
        self.alike[self.classes[class as usize].members.start].0
    }

    /// Finds the pairs of classes, one at least with a rounded end, that meet otherwise than in common ends.
    pub(super) fn find_conflicts(&mut self, index: &mut Index<'_>) -> Result<(), Refusal> {
        let mut conflicts = std::mem::take(&mut self.conflicts);
        conflicts.clear();
        if self.classes.iter().any(|class| class.moved) {
            let segments = (0..self.classes.len()).map(|class| self.segment(id::index(class)));
            let is_done = index.pairs_by_boxes(segments.clone(), |i, j| {
                conflicts.extend(self.conflict(i, j));
                true
            })?;
            if !is_done {
                conflicts.clear();
                index.pairs_by_slabs(segments, |i, j| conflicts.extend(self.conflict(i, j)))?;
            }
        }
        self.conflicts = conflicts;
        Ok(())
    }

    /// The same where all conflicts are those of classes with fragments that were in conflict in a round; returns false, having
    /// found some, where these are too many for boxes.
    fn find_conflicts_again(&mut self, round: u32, index: &Index<'_>) -> Result<bool, Refusal> {
        let is_again = |class: u32| self.classes[class as usize].round == round;
        let all = 0..id::index(self.classes.len());
        let again: Vec<u32> = all.clone().filter(|&class| is_again(class)).collect();
        let mut near = Near::to(again.iter().map(|&class| self.segment(class)), index.meter)?;
        let mut tally = index.meter.tally();
        let mut conflicts = std::mem::take(&mut self.conflicts);
        conflicts.clear();
        for class in all {
            near.meeting(self.segment(class), |place| {
                let other = again[place as usize];
                if other < class || !is_again(class) {
                    conflicts.extend(self.conflict(other.min(class), other.max(class)));
                }
                true
            });
            tally.add(1)?;
            if near.is_slow() {
                break;
            }
        }
        self.conflicts = conflicts;
        Ok(!near.is_slow())
    }

    /// The pair of classes, if they are in conflict.
    pub(super) fn conflict(&self, i: u32, j: u32) -> Option<[u32; 2]> {
        let moved = [i, j].iter().any(|&class| self.classes[class as usize].moved);
        (moved && in_conflict([i, j].map(|class| self.segment(class)))).then_some([i, j])
    }

    /// Lists cuts of the conflicting fragments at the common ends of those that they conflict with, and notes whether there
    /// are any that cannot be cut so; returns the segments of the others, in whose boxes their new fragments will lie.
    fn list_cuts(
        &mut self,
        rounded: Rounded<'_>,
        round: u32,
        overlap: &mut bool,
        meter: &Meter<'_>,
    ) -> Result<Vec<Segment>, Refusal> {
        let mut affected = Vec::new();
        let mut common = vec![None; self.classes.len()];
        let mut cuts = std::mem::take(&mut self.cuts);
        cuts.clear();
        let mut tally = meter.tally();
        for &[i, j] in &self.conflicts {
            tally.add(self.members(i).chain(self.members(j)).count())?;
            let before = cuts.len();
            for (class, other) in [(i, j), (j, i)] {
                let ends = &mut common[other as usize];
                *ends = ends.or_else(|| self.common_ends(rounded, other));
                ends.iter().for_each(|&ends| self.add_cuts(rounded, class, ends, &mut cuts));
            }
            if cuts.len() == before {
                *overlap = true;
            } else {
                affected.extend([i, j]);
            }
        }
        sort(&mut affected, u32::cmp, meter)?;
        affected.dedup();
        for i in
            affected.iter().flat_map(|&class| self.alike[self.classes[class as usize].members.clone()].iter())
        {
            self.fragments[i.1 as usize].round = round;
        }
        sort(&mut cuts, Ord::cmp, meter)?;
        cuts.dedup();
        self.cuts = cuts;
        Ok(affected.into_iter().map(|class| self.segment(class)).collect())
    }

    /// The ends of the abscissae that all of a class have in common: the left end furthest right and the right end furthest
    /// left.
    fn common_ends(&self, rounded: Rounded<'_>, class: u32) -> Option<[u32; 2]> {
        let ends = |fragment: u32| rounded.rightward(self.fragments[fragment as usize].ends);
        let common =
            |[a, b]: [u32; 2], [c, d]: [u32; 2]| [rounded.rightward([a, c])[1], rounded.rightward([b, d])[0]];
        self.members(class).map(ends).reduce(common)
    }

    fn add_cuts(&self, rounded: Rounded<'_>, class: u32, vertices: [u32; 2], cuts: &mut Vec<CutAt>) {
        for fragment in self.members(class) {
            let ends = self.fragments[fragment as usize].ends;
            let inside = vertices.into_iter().filter(|&vertex| rounded.is_strictly_between(ends, vertex));
            cuts.extend(inside.map(|vertex| (fragment, vertex)));
        }
    }
}

/// All fragments, those that rounding left vertical cut at the points that lie on them.
fn cut_verticals(fragments: &[Fragment], meter: &Meter<'_>) -> Result<Vec<Segment>, Refusal> {
    let (mut points, mut tally) = (Vec::new(), meter.tally());
    meter.extend(&mut points, fragments.iter().flat_map(|f| f.segment))?;
    sort(&mut points, |&a, &b| lexicographic(a, b), meter)?;
    points.dedup();
    let mut segments = Vec::with_capacity(fragments.len());
    for fragment in fragments {
        tally.add(1)?;
        let segment = fragment.segment;
        if segment[0].x != segment[1].x {
            segments.push(segment);
            continue;
        }
        let [low, high] = rightward(segment);
        let first = points.partition_point(|&p| lexicographic(p, low) == Ordering::Less);
        let last = points.partition_point(|&p| lexicographic(p, high) == Ordering::Less);
        tally.add(last - first)?;
        for pair in points[first..=last].windows(2) {
            segments.push(if segment[0] == low { [pair[0], pair[1]] } else { [pair[1], pair[0]] });
        }
    }
    Ok(segments)
}
