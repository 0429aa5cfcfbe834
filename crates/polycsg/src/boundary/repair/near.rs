//! Which fragments are near those that were cut last: only these can be in a conflict that was not seen before.

use crate::predicates::Segment;
use glam::DVec2;

/// So many boxes are looked at for each fragment that is asked for, on the average.
const BOXES: usize = 64;

/// The boxes of some segments, or the whole plane.
#[derive(Debug)]
pub(super) struct Near {
    /// A tree over the boxes by their left sides: that at `i` has the boxes at `2 i` and `2 i + 1` in it; from half its
    /// length on they are the segments'. None for the whole plane.
    tree: Option<Vec<[DVec2; 2]>>,
    looked_at: usize,
    asked: usize,
}

impl Near {
    pub(super) fn to(segments: impl Iterator<Item = Segment>) -> Near {
        let mut boxes: Vec<[DVec2; 2]> = segments.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        boxes.sort_unstable_by(|a, b| a[0].x.total_cmp(&b[0].x));
        let count = boxes.len().next_power_of_two();
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let mut tree = vec![empty; count];
        tree.append(&mut boxes);
        tree.resize(2 * count, empty);
        for i in (1..count).rev() {
            let ([a, b], [c, d]) = (tree[2 * i], tree[2 * i + 1]);
            tree[i] = [a.min(c), b.max(d)];
        }
        Near { tree: Some(tree), looked_at: 0, asked: 0 }
    }

    /// Whether the box of a segment meets one of the boxes. When finding out takes too long, the answer is yes from then on.
    pub(super) fn meets(&mut self, [a, b]: Segment) -> bool {
        let Some(tree) = &self.tree else { return true };
        self.asked += 1;
        let meets = any(tree, 1, [a.min(b), a.max(b)], &mut self.looked_at);
        if self.looked_at > BOXES * (self.asked + tree.len()) {
            self.tree = None;
        }
        meets
    }
}

fn any(tree: &[[DVec2; 2]], place: usize, [low, high]: [DVec2; 2], looked_at: &mut usize) -> bool {
    let [from, to] = tree[place];
    *looked_at += 1;
    from.cmple(high).all()
        && to.cmpge(low).all()
        && (2 * place >= tree.len()
            || any(tree, 2 * place, [low, high], looked_at)
            || any(tree, 2 * place + 1, [low, high], looked_at))
}
