//! Shafts: the polygons that can stand between two sets of points meet the convex hull of the boxes around both.
//!
//! ```text
//!          ______----+---+
//!   +---+--          |   |     Seen along each axis the hull has at most two sides that are no side of either box.
//!   |   |            |   |
//!   +---+--____      |   |
//!              ----__+---+
//! ```
//! [Haines and Wallace 1991, "Shaft culling for efficient ray-traced radiosity", section 2.]
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;

/// What is outside of a plane by less than this share of the largest coordinates may be inside: far more than roundings, also those of
/// the plane.
const MARGIN: f64 = 1e-12;

/// What is beyond a plane through some points: `outward` · p > `most`.
#[derive(Debug)]
struct Beyond {
    outward: DVec3,
    /// The largest of their products with it.
    most: f64,
    /// The largest of their coordinates: where products cancel out, roundings do not.
    size: f64,
}

/// The convex hull of two boxes, cut off at planes.
#[derive(Debug)]
pub(crate) struct Shaft {
    extent: Extent,
    sides: Vec<Beyond>,
}

impl Shaft {
    /// The shaft between points whose boxes these are.
    pub(crate) fn between(ends: [Extent; 2]) -> Self {
        let mut shaft = Self { extent: ends[0].with(ends[1]), sides: Vec::new() };
        for (x, y) in [(0, 1), (1, 2), (2, 0)] {
            for corner in [[false, false], [false, true], [true, false], [true, true]] {
                shaft.sides.extend(side(ends, [x, y], corner));
            }
        }
        shaft
    }

    /// Cuts off what is farther along `outward` than all of some points.
    pub(crate) fn cut_off(&mut self, outward: DVec3, points: impl IntoIterator<Item = DVec3>) {
        self.sides.push(Beyond::through(outward, points));
    }

    /// Whether a box is outside for certain. Polygons in it may lie off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        let size = extent.low.abs().max(extent.high.abs()).max_element();
        extent.misses(&self.extent.grown(deviation))
            || self.sides.iter().any(|side| {
                let innermost = (side.outward * extent.low).min(side.outward * extent.high).element_sum();
                side.is_beyond(innermost, size, deviation)
            })
    }

    /// Whether a polygon that may lie off its vertices by `deviation` is outside for certain.
    pub(crate) fn misses(&self, polygon: &PlanarPolygon, deviation: f64) -> bool {
        let points = polygon.points();
        let size = points.iter().fold(0.0, |size: f64, p| size.max(p.abs().max_element()));
        self.sides.iter().any(|side| {
            let innermost = points.iter().map(|p| side.outward.dot(*p)).fold(f64::INFINITY, f64::min);
            side.is_beyond(innermost, size, deviation)
        })
    }
}

impl Beyond {
    /// What is farther along `outward` than all of some points.
    fn through(outward: DVec3, points: impl IntoIterator<Item = DVec3>) -> Self {
        let none = Self { outward, most: f64::NEG_INFINITY, size: 0.0 };
        points.into_iter().fold(none, |beyond, p| Self {
            most: beyond.most.max(outward.dot(p)),
            size: beyond.size.max(p.abs().max_element()),
            ..beyond
        })
    }

    /// Whether a place is beyond the plane for certain, by its product with `outward` and its largest coordinate.
    fn is_beyond(&self, product: f64, size: f64, deviation: f64) -> bool {
        let margin = MARGIN * (size + self.size) + deviation;
        product - self.most > margin * self.outward.abs().element_sum()
    }
}

/// The side of the hull along the third axis through one corner of both boxes, as seen along that axis; `corner` says of each of the two
/// axes whether it is the upper one. Nothing where the hull has no such side.
fn side(ends: [Extent; 2], [x, y]: [usize; 2], corner: [bool; 2]) -> Option<Beyond> {
    let at = |end: Extent, axis: usize, is_upper: bool| if is_upper { end.high[axis] } else { end.low[axis] };
    let [one, other] = ends.map(|end| [at(end, x, corner[0]), at(end, y, corner[1])]);
    let [along, up] = [other[0] - one[0], other[1] - one[1]];
    let signs = corner.map(|is_upper| if is_upper { 1.0 } else { -1.0 });
    // The normal of a side through these corners points the way that the corners are.
    let faces = |[a, b]: [f64; 2]| a * signs[0] > 0.0 && b * signs[1] > 0.0;
    let [a, b] = [[up, -along], [-up, along]].into_iter().find(|normal| faces(*normal))?;
    let in_plane = |[p, q]: [f64; 2]| {
        let mut point = DVec3::ZERO;
        (point[x], point[y]) = (p, q);
        point
    };
    Some(Beyond::through(in_plane([a, b]), [one, other].map(in_plane)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(prop_oneof![-9.0..9.0, (-3..4).prop_map(f64::from)]).prop_map(DVec3::from)
    }

    /// Points, and a polygon around a point between one of these and one of others.
    fn on_the_way() -> impl Strategy<Value = ([Vec<DVec3>; 2], PlanarPolygon)> {
        let some = || prop::collection::vec(point(), 1..6);
        let at = (any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0.0..=1.0);
        (some(), some(), at, point(), point()).prop_filter_map("a triangle", |(one, other, at, a, b)| {
            let middle = at.0.get(&one).lerp(*at.1.get(&other), at.2);
            let triangle = PlanarPolygon::new([[a, b, 3.0 * middle - a - b]]).ok()?;
            Some(([one, other], triangle))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// What meets the way between two points is not outside, whichever they are.
        #[test]
        fn nothing_on_the_way_is_outside((ends, triangle) in on_the_way()) {
            let shaft = Shaft::between([&ends[0], &ends[1]].map(|end| Extent::around(end)));
            prop_assert!(!shaft.misses(&triangle, 0.0));
            prop_assert!(!shaft.misses_box(&Extent::around(triangle.points()), 0.0));
        }
    }

    /// Two places far away and exactly opposite as seen from a third, and a triangle around that, which is smaller than what roundings do to
    /// the places.
    fn opposite() -> impl Strategy<Value = ([DVec3; 2], PlanarPolygon)> {
        // With 45 bits for the way and 7 for the place between them, all sums are exact.
        let whole = |bits: u32| prop::array::uniform3(-(1i64 << bits)..1 << bits);
        let place = |whole: [i64; 3]| DVec3::from(whole.map(|x| x as f64));
        (whole(45), whole(7), point(), point()).prop_filter_map("a triangle", move |(way, middle, a, b)| {
            let (way, middle) = (place(way), place(middle));
            let triangle =
                PlanarPolygon::new([[a, b, -(a + b)].map(|corner| middle + corner * 1e-3)]).ok()?;
            Some(([middle + way, middle - way], triangle))
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_is_tiny_among_what_is_far_is_not_outside((ends, triangle) in opposite()) {
            let shaft = Shaft::between(ends.map(|end| Extent { low: end, high: end }));
            prop_assert!(!shaft.misses(&triangle, 0.0));
            prop_assert!(!shaft.misses_box(&Extent::around(triangle.points()), 0.0));
        }
    }

    /// Two unit squares, ten apart and five up: what lies below, above, beside or beyond is outside, by a plane that is no box's.
    #[test]
    fn what_is_beside_is_outside() {
        let extent =
            |x: f64, y: f64| Extent { low: DVec3::new(x, y, 0.0), high: DVec3::new(x + 1.0, y + 1.0, 0.0) };
        let mut shaft = Shaft::between([extent(0.0, 0.0), extent(10.0, 5.0)]);
        let at =
            |x: f64, y: f64| Extent { low: DVec3::new(x, y, -1.0), high: DVec3::new(x + 0.1, y + 0.1, 1.0) };
        assert!(!shaft.misses_box(&at(5.5, 3.0), 0.0));
        assert!(shaft.misses_box(&at(5.5, 4.0), 0.0) && shaft.misses_box(&at(5.5, 1.5), 0.0));
        assert!(!shaft.misses_box(&at(5.5, 4.0), 1.0));
        shaft.cut_off(DVec3::X, [DVec3::X * 3.0, DVec3::X * 4.0]);
        assert!(shaft.misses_box(&at(5.5, 3.0), 0.0) && !shaft.misses_box(&at(3.5, 2.0), 0.0));
    }
}
