//! The geometries of one column of a batch, in flat arrays.
use crate::error::Error;
use polycsg::{Csg, DVec2, FillRule};
use std::ops::Range;
use std::sync::OnceLock;

/// A box, by its low and its high corner; the low one is not below the high one, if it is around nothing.
pub(crate) type Bounds = [DVec2; 2];

const NOWHERE: Bounds = [DVec2::INFINITY, DVec2::NEG_INFINITY];

/// What two boxes have in common.
pub(crate) fn common(one: &Bounds, other: &Bounds) -> Bounds {
    [one[0].max(other[0]), one[1].min(other[1])]
}

/// Whether two boxes have a point in common.
pub(crate) fn meet(one: &Bounds, other: &Bounds) -> bool {
    let [low, high] = common(one, other);
    low.cmple(high).all()
}

fn around([low, high]: Bounds, point: DVec2) -> Bounds {
    [low.min(point), high.max(point)]
}

/// Features and the rows that hold them. Rows that follow one another and are equal share a feature, so that what a join or a
/// constant repeats is read once and prepared once.
#[derive(Default)]
pub(crate) struct Features {
    points: Vec<DVec2>,
    /// Where each ring ends in the points.
    ring_ends: Vec<usize>,
    /// The box around each ring.
    ring_bounds: Vec<Bounds>,
    /// Which rings are the first of their polygon.
    is_outer: Vec<bool>,
    features: Vec<Feature>,
    /// The feature of each row; NULL, if none.
    rows: Vec<Option<usize>>,
}

/// What a feature is.
#[derive(Clone)]
enum Shape {
    /// An area, of so many rings.
    Area(Range<usize>),
    /// A point; none, if it is empty.
    Point(Option<DVec2>),
}

struct Feature {
    shape: Shape,
    /// The box around it.
    bounds: Bounds,
    is_finite: bool,
    /// Whether each of its edges bounds it, once that is known.
    is_plain: OnceLock<bool>,
    /// The row where it was read, for messages.
    row: usize,
    /// How many rows hold it.
    uses: usize,
}

impl Features {
    /// How many rows there are.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// The feature of a row; NULL, if none.
    pub(crate) fn at(&self, row: usize) -> Option<usize> {
        self.rows[row]
    }

    /// How many rows hold a feature.
    pub(crate) fn uses(&self, feature: usize) -> usize {
        self.features[feature].uses
    }

    /// The point that a feature is: none for an area, and none within for an empty one.
    pub(crate) fn point(&self, feature: usize) -> Option<Option<DVec2>> {
        match self.features[feature].shape {
            Shape::Point(point) => Some(point),
            Shape::Area(_) => None,
        }
    }

    /// The rings of a feature, each without the vertex that closes it.
    pub(crate) fn rings(&self, feature: usize) -> impl ExactSizeIterator<Item = &[DVec2]> + Clone {
        self.ring_numbers(feature).map(|ring| self.ring(ring))
    }

    /// The polygons of a feature, each its rings.
    pub(crate) fn polygons(&self, feature: usize) -> Vec<Vec<&[DVec2]>> {
        let rings: Vec<usize> = self.ring_numbers(feature).collect();
        let polygons = rings.chunk_by(|_, &next| !self.is_outer[next]);
        polygons.map(|rings| rings.iter().map(|&ring| self.ring(ring)).collect()).collect()
    }

    /// Whether all of a feature's coordinates are finite.
    pub(crate) fn is_finite(&self, feature: usize) -> bool {
        self.features[feature].is_finite
    }

    /// A feature as an operand.
    pub(crate) fn operand(&self, feature: usize) -> Result<Csg<'static>, Error> {
        let read = Csg::from_rings(self.rings(feature), FillRule::EvenOdd);
        read.map_err(|error| self.at_row_of(feature, error))
    }

    /// What a window sees of a feature, as an operand: the rings whose boxes meet it. A ring that misses the window encloses nothing of
    /// it, so within the window the set is the same.
    pub(crate) fn operand_near(&self, feature: usize, window: &Bounds) -> Result<Csg<'static>, Error> {
        if !self.features[feature].is_finite {
            return self.operand(feature); // which names the ring
        }
        let read = Csg::from_rings(self.rings_near(feature, window), FillRule::EvenOdd);
        read.map_err(|error| self.at_row_of(feature, error))
    }

    /// The rings of a feature whose boxes meet a window.
    pub(crate) fn rings_near(&self, feature: usize, window: &Bounds) -> impl Iterator<Item = &[DVec2]> {
        let near = self.ring_numbers(feature).filter(|&ring| meet(&self.ring_bounds[ring], window));
        near.map(|ring| self.ring(ring))
    }

    /// Where it is kept whether each edge of a feature bounds it.
    pub(crate) fn plain(&self, feature: usize) -> &OnceLock<bool> {
        &self.features[feature].is_plain
    }

    /// The memory that they take.
    #[cfg(feature = "join")]
    pub(crate) fn size(&self) -> usize {
        let rings = size_of::<usize>() + size_of::<Bounds>() + size_of::<bool>();
        self.points.capacity() * size_of::<DVec2>()
            + self.ring_ends.capacity() * rings
            + self.features.capacity() * size_of::<Feature>()
            + self.rows.capacity() * size_of::<Option<usize>>()
    }

    /// How many points a feature has.
    pub(crate) fn point_count(&self, feature: usize) -> usize {
        self.rings(feature).map(<[DVec2]>::len).sum()
    }

    /// The box around a feature: its low corner is not below its high one, if it is empty.
    pub(crate) fn bounds(&self, feature: usize) -> Bounds {
        self.features[feature].bounds
    }

    /// An error in the row of a feature.
    pub(crate) fn at_row_of(&self, feature: usize, why: impl ToString) -> Error {
        Error::row(self.features[feature].row, why)
    }

    /// The only row, so many times.
    pub(crate) fn stretched(mut self, rows: usize) -> Features {
        self.rows = vec![self.rows.first().copied().flatten(); rows];
        self.features.iter_mut().for_each(|feature| feature.uses = rows);
        self
    }

    /// Refuses a feature with a coordinate that is not finite.
    pub(crate) fn check_finite(&self, feature: usize) -> Result<(), Error> {
        if self.is_finite(feature) { Ok(()) } else { self.operand(feature).map(drop) }
    }

    /// Refuses features with a coordinate that is not finite.
    pub(crate) fn all_finite(self) -> Result<Features, Error> {
        (0..self.features.len()).try_for_each(|feature| self.check_finite(feature))?;
        Ok(self)
    }

    /// Refuses points, for functions of areas.
    pub(crate) fn areas_only(self) -> Result<Features, Error> {
        match self.features.iter().find(|feature| matches!(feature.shape, Shape::Point(_))) {
            Some(point) => Err(Error::row(point.row, "a Polygon or a MultiPolygon is needed, not a Point")),
            None => Ok(self),
        }
    }

    /// One more row with the feature of the row before.
    pub(crate) fn repeat(&mut self) {
        let last = self.rows.last().copied().flatten();
        if let Some(feature) = last {
            self.features[feature].uses += 1;
        }
        self.rows.push(last);
    }

    /// Lets the last row share the feature of the one before, if both are one area to the bit.
    pub(crate) fn share_if_equal(&mut self) {
        let Some([before, Some(last)]) = self.rows.last_chunk().copied() else { return };
        if before.is_none_or(|before| !self.are_equal_areas(before, last)) {
            return;
        }
        let rings = self.ring_numbers(last).start;
        let points = rings.checked_sub(1).map_or(0, |ring| self.ring_ends[ring]);
        self.points.truncate(points);
        self.ring_ends.truncate(rings);
        self.ring_bounds.truncate(rings);
        self.is_outer.truncate(rings);
        self.features.pop();
        self.rows.pop();
        self.repeat();
    }

    fn are_equal_areas(&self, one: usize, other: usize) -> bool {
        let is_point = |feature| self.point(feature).is_some();
        let bits = |point: &DVec2| point.to_array().map(f64::to_bits);
        let is_equal = |(a, b)| {
            self.is_outer[a] == self.is_outer[b]
                && self.ring(a).iter().map(bits).eq(self.ring(b).iter().map(bits))
        };
        let (rings, others) = (self.ring_numbers(one), self.ring_numbers(other));
        !is_point(one) && !is_point(other) && rings.len() == others.len() && rings.zip(others).all(is_equal)
    }

    pub(crate) fn push_null(&mut self) {
        self.rows.push(None);
    }

    pub(crate) fn push_point(&mut self, point: Option<DVec2>) {
        self.push(Shape::Point(point));
    }

    /// Adds a ring to the feature that [`push_area`](Features::push_area) ends.
    pub(crate) fn push_ring(&mut self, is_outer: bool, points: impl Iterator<Item = DVec2>) {
        let start = self.points.len();
        self.points.extend(points);
        if self.points.len() > start + 1 && self.points.last() == Some(&self.points[start]) {
            self.points.pop();
        }
        self.ring_bounds.push(self.points[start..].iter().copied().fold(NOWHERE, around));
        self.ring_ends.push(self.points.len());
        self.is_outer.push(is_outer);
    }

    /// Ends an area, of the rings since a count of them.
    pub(crate) fn push_area(&mut self, first: usize) {
        self.push(Shape::Area(first..self.ring_ends.len()));
    }

    /// How many rings were read.
    pub(crate) fn ring_count(&self) -> usize {
        self.ring_ends.len()
    }

    fn push(&mut self, shape: Shape) {
        let row = self.rows.len();
        let (bounds, is_finite) = match &shape {
            Shape::Area(rings) => {
                let corners = self.ring_bounds[rings.clone()].as_flattened();
                let mut points = rings.clone().flat_map(|ring| self.ring(ring));
                (corners.iter().copied().fold(NOWHERE, around), points.all(|point| point.is_finite()))
            }
            Shape::Point(point) => (point.iter().copied().fold(NOWHERE, around), true),
        };
        self.rows.push(Some(self.features.len()));
        self.features.push(Feature { shape, bounds, is_finite, is_plain: OnceLock::new(), row, uses: 1 });
    }

    fn ring_numbers(&self, feature: usize) -> Range<usize> {
        match &self.features[feature].shape {
            Shape::Area(rings) => rings.clone(),
            Shape::Point(_) => 0..0,
        }
    }

    fn ring(&self, ring: usize) -> &[DVec2] {
        let start = if ring == 0 { 0 } else { self.ring_ends[ring - 1] };
        &self.points[start..self.ring_ends[ring]]
    }
}
