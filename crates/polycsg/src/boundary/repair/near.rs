//! Which boxes of segments meet a box.

use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::predicates::Segment;
use glam::DVec2;

/// So many boxes are looked at for each segment that is asked for, on the average.
const BOXES: usize = if cfg!(any(test, fuzzing)) { 1 } else { 64 };

type Box = [DVec2; 2];

/// The boxes of some segments.
#[derive(Debug)]
pub(super) struct Near {
    /// That at `i` has the boxes at `2 i` and `2 i + 1` in it; from half its length on they are the segments', in columns from left to
    /// right and from below in each.
    tree: Vec<Box>,
    /// The places of those segments.
    ids: Vec<u32>,
    looked_at: usize,
    asked: usize,
}

impl Near {
    /// The boxes of segments.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn to(segments: impl Iterator<Item = Segment>, meter: &Meter<'_>) -> Result<Near, Refusal> {
        let mut boxes: Vec<(Box, u32)> = Vec::new();
        meter.extend(&mut boxes, segments.map(|[a, b]| [a.min(b), a.max(b)]).zip(0..))?;
        sort(&mut boxes, |(a, _), (b, _)| a[0].x.total_cmp(&b[0].x), meter)?;
        let count = boxes.len().next_power_of_two();
        let column = 1 << count.ilog2().div_ceil(2);
        for column in boxes.chunks_mut(column) {
            meter.spend(column.len())?;
            column.sort_unstable_by(|(a, _), (b, _)| a[0].y.total_cmp(&b[0].y));
        }
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        let mut tree = vec![empty; count];
        tree.extend(boxes.iter().map(|(extent, _)| extent));
        tree.resize(2 * count, empty);
        for i in (1..count).rev() {
            let ([a, b], [c, d]) = (tree[2 * i], tree[2 * i + 1]);
            tree[i] = [a.min(c), b.max(d)];
        }
        Ok(Near { tree, ids: boxes.into_iter().map(|(_, id)| id).collect(), looked_at: 0, asked: 0 })
    }

    /// Calls `visit` for the places of segments whose boxes meet that of a segment, until it returns false.
    pub(super) fn meeting(&mut self, [a, b]: Segment, mut visit: impl FnMut(u32) -> bool) {
        self.asked += 1;
        self.look_into(1, [a.min(b), a.max(b)], &mut visit);
    }

    /// Whether the box of a segment meets one of the boxes.
    pub(super) fn meets(&mut self, segment: Segment) -> bool {
        let mut meets = false;
        self.meeting(segment, |_| {
            meets = true;
            false
        });
        meets
    }

    /// Whether more boxes were looked at than is worth it.
    pub(super) fn is_slow(&self) -> bool {
        self.looked_at > BOXES * (self.asked + self.tree.len())
    }

    fn look_into(&mut self, place: usize, [low, high]: Box, visit: &mut impl FnMut(u32) -> bool) -> bool {
        let [from, to] = self.tree[place];
        self.looked_at += 1;
        if !(from.cmple(high).all() && to.cmpge(low).all()) {
            return true;
        }
        match (2 * place).checked_sub(self.tree.len()) {
            Some(_) => visit(self.ids[place - self.tree.len() / 2]),
            None => {
                [2 * place, 2 * place + 1].into_iter().all(|half| self.look_into(half, [low, high], visit))
            }
        }
    }
}
