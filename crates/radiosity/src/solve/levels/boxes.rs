//! A tree of the boxes around polygons.
use crate::extent::Extent;

/// So many boxes are not parted.
const FEW: usize = 4;

/// A tree of boxes: what may be in a place is found without looking at all.
#[derive(Debug)]
pub(super) struct Boxes {
    /// Those of each branch, one after the other.
    order: Vec<u32>,
    branches: Vec<Branch>,
}

#[derive(Debug)]
struct Branch {
    extent: Extent,
    members: std::ops::Range<usize>,
    halves: Option<[usize; 2]>,
}

impl Boxes {
    /// O(n log² n) for n boxes.
    pub(super) fn around(extents: &[Extent]) -> Boxes {
        let mut boxes = Boxes { order: (0..).take(extents.len()).collect(), branches: Vec::new() };
        boxes.grow(extents, 0..extents.len());
        boxes
    }

    fn grow(&mut self, extents: &[Extent], members: std::ops::Range<usize>) -> usize {
        let of = |id: &u32| &extents[*id as usize];
        let extent = self.order[members.clone()].iter().map(of).fold(Extent::NOTHING, |a, b| a.with(b));
        let branch = self.branches.len();
        self.branches.push(Branch { extent, members: members.clone(), halves: None });
        if members.len() > FEW {
            let axis = extent.longest();
            let middle = |id: &u32| of(id).low[axis] + of(id).high[axis];
            self.order[members.clone()]
                .sort_unstable_by(|a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
            let half = members.start + members.len() / 2;
            let halves = [members.start..half, half..members.end].map(|part| self.grow(extents, part));
            self.branches[branch].halves = Some(halves);
        }
        branch
    }

    /// Looks at those whose boxes are not outside, until one of them ends the search: whether one did.
    pub(super) fn any(&self, outside: impl Fn(&Extent) -> bool, mut ends: impl FnMut(u32) -> bool) -> bool {
        let mut open = vec![0];
        while let Some(branch) = open.pop() {
            let Branch { extent, members, halves } = &self.branches[branch];
            match halves {
                _ if members.is_empty() || outside(extent) => {}
                Some(halves) => open.extend(halves),
                None if self.order[members.clone()].iter().any(|id| ends(*id)) => return true,
                None => {}
            }
        }
        false
    }

    /// Those whose boxes may not be outside, in ascending order.
    pub(super) fn find(&self, outside: impl Fn(&Extent) -> bool) -> Vec<u32> {
        let mut found = Vec::new();
        self.any(outside, |id| {
            found.push(id);
            false
        });
        found.sort_unstable();
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn what_is_not_outside_is_found() {
        let at = |k: u32| DVec3::new(f64::from(k % 7), f64::from(k % 5), f64::from(k % 3));
        let extents: Vec<Extent> =
            (0..100).map(|k| Extent { low: at(k), high: at(k) + DVec3::splat(0.5) }).collect();
        let tree = Boxes::around(&extents);
        for k in 0..100 {
            let place = Extent { low: at(k) - DVec3::splat(0.7), high: at(k) + DVec3::splat(1.2) };
            let mut found = tree.find(|extent| !extent.is_near(&place, 0.0));
            found.retain(|id| extents[*id as usize].is_near(&place, 0.0));
            let all: Vec<u32> = (0..100).filter(|id| extents[*id as usize].is_near(&place, 0.0)).collect();
            assert_eq!(found, all);
        }
        assert!(Boxes::around(&[]).find(|_| false).is_empty());
    }
}
