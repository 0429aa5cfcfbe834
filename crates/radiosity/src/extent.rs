//! Boxes around patches, and which of them meet.
use crate::scene::patch::Patch;
use formfactor::PlanarPolygon;
use glam::DVec3;
use rstar::{
    AABB, RTree,
    primitives::{GeomWithData, Rectangle},
};

/// The least box with sides along the axes that holds a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Extent {
    /// The box of a patch.
    pub(crate) fn of(patch: &Patch) -> Extent {
        Extent::around(&patch.polygon)
    }

    /// The box of a polygon.
    pub(crate) fn around(polygon: &PlanarPolygon) -> Extent {
        Extent::holding(polygon.loops().flatten())
    }

    /// The box of some points.
    pub(crate) fn holding<'p>(points: impl IntoIterator<Item = &'p DVec3>) -> Extent {
        let none = Extent { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points
            .into_iter()
            .fold(none, |Extent { low, high }, point| Extent { low: low.min(*point), high: high.max(*point) })
    }

    /// The box that is larger by `distance` on every side.
    pub(crate) fn grown(&self, distance: f64) -> Extent {
        Extent { low: self.low - distance, high: self.high + distance }
    }

    /// The box of some points.
    pub(crate) fn of_points(points: impl Iterator<Item = DVec3>) -> Extent {
        points.fold(Extent::NOTHING, |extent, point| extent.with(&Extent { low: point, high: point }))
    }

    /// The box of nothing.
    pub(crate) const NOTHING: Extent = Extent { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    /// The box of both.
    pub(crate) fn with(&self, other: &Extent) -> Extent {
        Extent { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The axis along which it is longest.
    pub(crate) fn longest(&self) -> usize {
        let size = self.high - self.low;
        (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest })
    }

    /// The corners.
    pub(crate) fn corners(&self) -> [DVec3; 8] {
        let at = |corner: usize, axis: usize| {
            if corner >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] }
        };
        [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| DVec3::new(at(corner, 0), at(corner, 1), at(corner, 2)))
    }

    /// Whether two boxes are at most `distance` apart along every axis.
    pub(crate) fn is_near(&self, other: &Extent, distance: f64) -> bool {
        let margin = DVec3::splat(distance);
        !(self.low.cmpgt(other.high + margin) | other.low.cmpgt(self.high + margin)).any()
    }

    /// The length of the diagonal.
    pub(crate) fn diagonal(&self) -> f64 {
        (self.high - self.low).length()
    }
}

/// Boxes in a tree: those that meet a box are found in O(log n + k) where they are spread out.
#[derive(Debug)]
pub(crate) struct BoxTree(RTree<GeomWithData<Rectangle<[f64; 3]>, usize>>);

impl BoxTree {
    /// O(n log n).
    pub(crate) fn new(extents: impl IntoIterator<Item = Extent>) -> BoxTree {
        let numbered = extents.into_iter().enumerate();
        let boxes = numbered.map(|(index, Extent { low, high })| {
            GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), index)
        });
        BoxTree(RTree::bulk_load(boxes.collect()))
    }

    /// The indices of the boxes that meet this one, ascending.
    pub(crate) fn meeting(&self, extent: &Extent) -> Vec<usize> {
        let envelope = AABB::from_corners(extent.low.to_array(), extent.high.to_array());
        let found = self.0.locate_in_envelope_intersecting(&envelope);
        let mut indices: Vec<usize> = found.map(|geometry| geometry.data).collect();
        indices.sort_unstable();
        indices
    }
}
