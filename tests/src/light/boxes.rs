//! Which surfaces a ray may meet, by their boxes.
use super::Surface;
use glam::DVec3;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree, RTreeObject, SelectionFunction};

/// Boxes are larger than surfaces by this share of how far these are from the origin.
const AROUND: f64 = 1e-9;

type NumberedBox = GeomWithData<Rectangle<[f64; 3]>, usize>;

/// The boxes around surfaces, in a tree.
#[derive(Debug)]
pub(super) struct Boxes(RTree<NumberedBox>);

impl Boxes {
    pub(super) fn around(surfaces: &[Surface]) -> Boxes {
        let numbered = |(index, surface): (usize, &Surface)| {
            let corners = || surface.loops.iter().flatten().copied();
            let near = DVec3::splat(AROUND * corners().map(DVec3::length).fold(0.0, f64::max));
            let low = corners().fold(DVec3::INFINITY, DVec3::min) - near;
            let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max) + near;
            GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), index)
        };
        Boxes(RTree::bulk_load(surfaces.iter().enumerate().map(numbered).collect()))
    }

    /// Those that a ray may meet, in no order.
    pub(super) fn along(&self, from: DVec3, direction: DVec3) -> impl Iterator<Item = usize> {
        let ray = Ray { from, inverse: direction.recip() };
        self.0.locate_with_selection_function(ray).map(|geometry| geometry.data)
    }
}

/// Where a ray starts, and one over each part of its direction.
struct Ray {
    from: DVec3,
    inverse: DVec3,
}

impl Ray {
    /// A ray along a side is within it: 0 times infinity is no number, and is passed over.
    fn meets(&self, envelope: &AABB<[f64; 3]>) -> bool {
        let [low, high] = [envelope.lower(), envelope.upper()].map(DVec3::from);
        let (mut enters, mut leaves) = (0.0f64, f64::INFINITY);
        for axis in 0..3 {
            let [a, b] = [low, high].map(|side| (side[axis] - self.from[axis]) * self.inverse[axis]);
            (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
        }
        enters <= leaves
    }
}

impl SelectionFunction<NumberedBox> for Ray {
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 3]>) -> bool {
        self.meets(envelope)
    }

    fn should_unpack_leaf(&self, leaf: &NumberedBox) -> bool {
        self.meets(&leaf.envelope())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{room, surface::Plane};
    use super::*;
    use crate::random::Random;

    #[test]
    fn what_a_ray_meets_is_in_a_box_that_it_meets() {
        let mut random = Random::new(3);
        for kind in 0..7 {
            let surfaces = room(kind, 1);
            let (boxes, planes) =
                (Boxes::around(&surfaces), surfaces.iter().map(Plane::of).collect::<Vec<_>>());
            for turn in 0..2000 {
                let from = planes[turn % planes.len()].any_point(&mut random);
                let mut direction = planes[turn % planes.len()].any_direction(&mut random);
                if turn % 3 == 0 {
                    direction[turn % 2] = 0.0;
                }
                let found: Vec<usize> = boxes.along(from, direction).collect();
                let met = (0..planes.len()).filter(|k| planes[*k].meets(from, direction, 1e-9).is_some());
                assert!(met.into_iter().all(|surface| found.contains(&surface)));
            }
        }
    }
}
