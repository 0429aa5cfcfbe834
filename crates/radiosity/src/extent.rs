//! Boxes around patches, and which of them meet.
use crate::plane::Plane;
use crate::scene::patch::Patch;
use formfactor::PlanarPolygon;
use glam::DVec3;
use rstar::{
    AABB, RTree, RTreeObject, SelectionFunction,
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

    /// Whether another box lies within it.
    pub(crate) fn holds(&self, other: &Extent) -> bool {
        self.low.cmple(other.low).all() && other.high.cmple(self.high).all()
    }

    /// The length of the diagonal.
    pub(crate) fn diagonal(&self) -> f64 {
        (self.high - self.low).length()
    }
}

/// A box with its number.
type NumberedBox = GeomWithData<Rectangle<[f64; 3]>, usize>;

/// What a box must be to be found.
struct Crossed<F>(F);

impl<F: Fn(&AABB<[f64; 3]>) -> bool> SelectionFunction<NumberedBox> for Crossed<F> {
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 3]>) -> bool {
        (self.0)(envelope)
    }

    fn should_unpack_leaf(&self, leaf: &NumberedBox) -> bool {
        (self.0)(&leaf.envelope())
    }
}

/// Boxes in a tree: those that meet a box are found in O(log n + k) where they are spread out.
#[derive(Debug)]
pub(crate) struct BoxTree(RTree<NumberedBox>);

impl BoxTree {
    /// O(n log n).
    pub(crate) fn new(extents: impl IntoIterator<Item = Extent>) -> BoxTree {
        let numbered = extents.into_iter().enumerate();
        let boxes = numbered.map(|(index, Extent { low, high })| {
            GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), index)
        });
        BoxTree(RTree::bulk_load(boxes.collect()))
    }

    /// The indices of the boxes that a plane passes through, or comes as near as `near`, ascending.
    pub(crate) fn crossed_by(&self, plane: &Plane, near: f64) -> Vec<usize> {
        self.found_by(|low, high| {
            let reach = ((high - low) / 2.0).dot(plane.normal.abs());
            plane.height(low.midpoint(high)).abs() <= reach + near
        })
    }

    /// The indices of the boxes that a segment passes through, or whose sides it comes as near as `near`, ascending.
    pub(crate) fn along(&self, [a, b]: [DVec3; 2], near: f64) -> Vec<usize> {
        let way = b - a;
        self.found_by(|low, high| {
            let (mut from, mut to) = (0.0_f64, 1.0_f64);
            for axis in 0..3 {
                let [low, high] = [low[axis] - near, high[axis] + near].map(|side| side - a[axis]);
                if way[axis] == 0.0 {
                    to = if low <= 0.0 && high >= 0.0 { to } else { -1.0 };
                } else {
                    let [enters, leaves] = [low, high].map(|side| side / way[axis]);
                    (from, to) = (from.max(enters.min(leaves)), to.min(enters.max(leaves)));
                }
            }
            from <= to
        })
    }

    /// The indices of the boxes of which this holds, ascending: it holds of a box when it holds of one within.
    fn found_by(&self, holds: impl Fn(DVec3, DVec3) -> bool) -> Vec<usize> {
        let is_found = |envelope: &AABB<[f64; 3]>| holds(envelope.lower().into(), envelope.upper().into());
        let found = self.0.locate_with_selection_function(Crossed(is_found));
        let mut indices: Vec<usize> = found.map(|geometry| geometry.data).collect();
        indices.sort_unstable();
        indices
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
