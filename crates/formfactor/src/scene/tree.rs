//! A binary tree of boxes around polygons: what lies outside of a target's half-spaces is skipped branch by branch.
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};

/// The boxes of all polygons. The children of node i are 2 i + 1 and 2 i + 2; each has half of its polygons.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    extents: Vec<Extent>,
    /// The polygons' ids in the order of the leaves.
    ids: Vec<usize>,
}

/// A node with so few polygons has no children.
const LEAF: usize = 4;
/// So few polygons are all returned: testing boxes first would cost more (rooms of six take a sixth less time).
const FEW: usize = 8;

impl Tree {
    /// Takes O(n log^2 n).
    pub(crate) fn over(polygons: &[PlanarPolygon]) -> Self {
        Self::around(&polygons.iter().map(|polygon| Extent::around(polygon.points())).collect::<Vec<_>>())
    }

    /// Over whatever is in boxes.
    pub(crate) fn around(extents: &[Extent]) -> Self {
        let mut tree = Self { extents: Vec::new(), ids: (0..extents.len()).collect() };
        let mut open = vec![(0, 0..extents.len())];
        while let Some((node, range)) = open.pop() {
            let ids = &mut tree.ids[range.clone()];
            let extent = ids.iter().fold(Extent::NOTHING, |all, id| all.with(extents[*id]));
            let nodes = tree.extents.len().max(node + 1);
            tree.extents.resize(nodes, Extent::NOTHING);
            tree.extents[node] = extent;
            if range.len() > LEAF {
                sort_along_longest(ids, extents, extent);
                let middle = range.start + range.len() / 2;
                open.push((2 * node + 1, range.start..middle));
                open.push((2 * node + 2, middle..range.end));
            }
        }
        tree
    }

    /// The polygons of all leaves that are not in a box that is `outside`.
    pub(crate) fn find(&self, outside: impl Fn(&Extent) -> bool) -> Vec<usize> {
        if self.ids.len() <= FEW {
            return self.ids.clone();
        }
        let mut found = Vec::new();
        self.has_any_leaf(outside, |ids| {
            found.extend_from_slice(ids);
            false
        });
        found
    }

    /// Whether any polygon of these leaves is what is looked for; the others are not looked at once there is one.
    pub(crate) fn has_any(&self, outside: impl Fn(&Extent) -> bool, is_it: impl Fn(usize) -> bool) -> bool {
        self.has_any_leaf(outside, |ids| ids.iter().any(|id| is_it(*id)))
    }

    /// Whether any leaf that is not in a box that is `outside` is what is looked for.
    fn has_any_leaf(
        &self,
        outside: impl Fn(&Extent) -> bool,
        mut is_it: impl FnMut(&[usize]) -> bool,
    ) -> bool {
        let mut open = vec![(0, 0..self.ids.len())];
        while let Some((node, range)) = open.pop() {
            if range.is_empty() || outside(&self.extents[node]) {
                continue;
            }
            if range.len() <= LEAF {
                if is_it(&self.ids[range]) {
                    return true;
                }
                continue;
            }
            let middle = range.start + range.len() / 2;
            open.push((2 * node + 2, middle..range.end));
            open.push((2 * node + 1, range.start..middle));
        }
        false
    }
}

fn sort_along_longest(ids: &mut [usize], extents: &[Extent], whole: Extent) {
    let size = whole.high - whole.low;
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let middle = |id: usize| extents[id].low[axis] / 2.0 + extents[id].high[axis] / 2.0;
    ids.sort_by(|a, b| middle(*a).total_cmp(&middle(*b)).then(a.cmp(b)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn nothing_that_meets_a_half_space_is_skipped(
            corners in prop::collection::vec(prop::array::uniform3((-9.0..9.0, -9.0..9.0, -9.0..9.0)), 0..60),
            axis in 0usize..3, bound in -9.0..9.0,
        ) {
            let polygons: Vec<PlanarPolygon> =
                corners.iter().filter_map(|c| PlanarPolygon::new([c.map(DVec3::from)]).ok()).collect();
            let mut found = Tree::over(&polygons).find(|extent| extent.low[axis] > bound);
            found.sort_unstable();
            prop_assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
            for (id, polygon) in polygons.iter().enumerate() {
                let meets = polygon.points().iter().any(|p| p[axis] <= bound);
                prop_assert!(!meets || found.binary_search(&id).is_ok());
            }
        }
    }
}
