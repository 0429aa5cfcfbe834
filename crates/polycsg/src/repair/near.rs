//! Which fragments are near those that were cut last: only these can be in a conflict that was not seen before.

use crate::predicates::Segment;
use glam::DVec2;

/// So many boxes are looked at for each fragment that is asked for, on the average.
const BOXES: usize = 64;

/// The boxes of some segments, or the whole plane.
#[derive(Debug)]
pub(super) struct Near {
    /// By their left sides; none for the whole plane.
    boxes: Option<Vec<[DVec2; 2]>>,
    /// The furthest right side of the boxes up to each.
    furthest: Vec<f64>,
    looked_at: usize,
    asked: usize,
}

impl Near {
    pub(super) fn everything() -> Near {
        Near { boxes: None, furthest: Vec::new(), looked_at: 0, asked: 0 }
    }

    pub(super) fn to(segments: impl Iterator<Item = Segment>) -> Near {
        let mut boxes: Vec<[DVec2; 2]> = segments.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        boxes.sort_unstable_by(|a, b| a[0].x.total_cmp(&b[0].x));
        let further = |furthest: &mut f64, [_, high]: &[DVec2; 2]| {
            *furthest = furthest.max(high.x);
            Some(*furthest)
        };
        let furthest = boxes.iter().scan(f64::NEG_INFINITY, further).collect();
        Near { boxes: Some(boxes), furthest, looked_at: 0, asked: 0 }
    }

    /// Whether the box of a segment meets one of the boxes. When that takes too long, says so of any segment.
    pub(super) fn meets(&mut self, [a, b]: Segment) -> bool {
        let Some(boxes) = &self.boxes else { return true };
        let (low, high) = (a.min(b), a.max(b));
        let end = boxes.partition_point(|[left, _]| left.x <= high.x);
        self.asked += 1;
        for i in (0..end).rev().take_while(|&i| self.furthest[i] >= low.x) {
            self.looked_at += 1;
            let [from, to] = boxes[i];
            if from.cmple(high).all() && to.cmpge(low).all() {
                return true;
            }
        }
        if self.looked_at > BOXES * (self.asked + boxes.len()) {
            self.boxes = None;
        }
        false
    }
}
