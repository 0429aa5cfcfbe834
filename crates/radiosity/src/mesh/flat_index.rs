//! Segments and points of a plane, to be found by where they are.
use glam::DVec2;
use rstar::{
    AABB, RTree,
    primitives::{GeomWithData, Rectangle},
};

/// Segments, numbered in the order in which they come; a point is a segment whose ends are one. What is in a box is found in O(log n + k)
/// where they are spread out.
#[derive(Debug, Default)]
pub(super) struct FlatIndex {
    segments: Vec<[DVec2; 2]>,
    boxes: RTree<GeomWithData<Rectangle<[f64; 2]>, usize>>,
}

impl FlatIndex {
    /// O(n log n).
    pub(super) fn new(segments: Vec<[DVec2; 2]>) -> FlatIndex {
        let boxes = segments.iter().enumerate().map(boxed).collect();
        FlatIndex { boxes: RTree::bulk_load(boxes), segments }
    }

    /// Adds a segment.
    pub(super) fn push(&mut self, ends: [DVec2; 2]) {
        self.boxes.insert(boxed((self.segments.len(), &ends)));
        self.segments.push(ends);
    }

    /// The numbers of the segments whose boxes meet a box, in any order.
    pub(super) fn meeting(&self, [low, high]: [DVec2; 2]) -> impl Iterator<Item = usize> {
        let envelope = AABB::from_corners(low.to_array(), high.to_array());
        self.boxes.locate_in_envelope_intersecting(&envelope).map(|found| found.data)
    }

    /// The segments whose boxes come within a distance of a point, in any order.
    pub(super) fn around(&self, point: DVec2, distance: f64) -> impl Iterator<Item = (usize, [DVec2; 2])> {
        // A little more, so that no rounding leaves one out.
        let reach = 1.01 * distance + 4.0 * f64::EPSILON * point.abs().max_element();
        self.meeting([point - reach, point + reach]).map(|index| (index, self.segments[index]))
    }

    /// The segments that a ray from a point to the right may cross, in any order.
    pub(super) fn right_of(&self, point: DVec2) -> impl Iterator<Item = [DVec2; 2]> {
        self.meeting([point, DVec2::new(f64::MAX, point.y)]).map(|index| self.segments[index])
    }
}

/// The box around a segment, with its number.
fn boxed((index, [a, b]): (usize, &[DVec2; 2])) -> GeomWithData<Rectangle<[f64; 2]>, usize> {
    GeomWithData::new(Rectangle::from_corners(a.to_array(), b.to_array()), index)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of segments around a point, in all directions.
    fn fan() -> Vec<[DVec2; 2]> {
        let way = |turn: u32| DVec2::from_angle(f64::from(turn) / 10.0);
        (0..63).map(|turn| [way(turn), way(turn) * f64::from(1 + turn % 5)]).collect()
    }

    #[test]
    fn what_a_box_meets_is_found_whether_it_was_there_first_or_added() {
        let (all, mut added) = (FlatIndex::new(fan()), FlatIndex::default());
        fan().into_iter().for_each(|ends| added.push(ends));
        for point in [DVec2::ZERO, DVec2::new(1.5, -2.0), DVec2::new(-0.9, 0.4)] {
            let near = |[a, b]: &[DVec2; 2]| {
                let (low, high) = (a.min(*b) - point, a.max(*b) - point);
                low.max_element() <= 1.0 && high.min_element() >= -1.0
            };
            let wanted: Vec<usize> = (0..63).filter(|&index| near(&fan()[index])).collect();
            for index in [&all, &added] {
                let mut found: Vec<usize> = index.meeting([point - 1.0, point + 1.0]).collect();
                found.sort_unstable();
                assert_eq!(found, wanted);
                assert!(wanted.iter().all(|k| index.around(point, 1.0).any(|(other, _)| other == *k)));
            }
            let right = |[a, b]: &&[DVec2; 2]| (a.y > point.y) != (b.y > point.y) && a.x.min(b.x) >= point.x;
            assert!(all.right_of(point).count() >= fan().iter().filter(right).count());
        }
    }
}
