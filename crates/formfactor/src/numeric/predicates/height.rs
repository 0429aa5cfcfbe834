//! Heights over planes, and their signs: almost every decision in space is the sign of one polynomial of degree 3 in the input's
//! doubles, the height (b - a) x (c - a) . (x - y). It is computed in up to three ways:
//!
//! 1. in doubles, with an error below [`QUICK`] times the sum of its terms' magnitudes;
//! 2. in double-doubles, with an error below 2^-96 of that sum ([`crate::numeric::offset::size`] accounts for underflow);
//! 3. in integers, where nothing is rounded.
use crate::numeric::offset::{Offset, sizes};
use crate::numeric::rounding::ROUNDING;
use exactfloat::{DoubleDouble, Integer, integers, orient2d, sign};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// Error of the filter in double-doubles, relative to the sum of the terms' magnitudes: 2^-96.
const FILTER: f64 = 1.262_177_448_353_619e-29;

/// The same for the filter in doubles: three factors of a few roundings each, and their sum.
const QUICK: f64 = 32.0 * ROUNDING;
/// More than underflow can take from a product of three, for coordinates up to 2^200.
const QUICK_UNDERFLOW: f64 = 1e-240;

/// A height with its exact sign. `value` has that sign and is within `error`; it is zero when the sign is `Equal`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Height {
    pub(crate) value: DoubleDouble,
    pub(crate) error: f64,
    pub(crate) sign: Ordering,
}

impl From<Height> for (DoubleDouble, f64) {
    fn from(height: Height) -> Self {
        (height.value, height.error)
    }
}

/// The plane through three points, and its normal (b - a) x (c - a) in double-double arithmetic.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    pub(crate) corners: [DVec3; 3],
    pub(crate) normal: Offset,
    /// Sums of magnitudes of the terms of each component of the normal.
    terms: DVec3,
    /// The normal in doubles, and a bound on the error of its product with a rounded offset, per component of the offset.
    rounded: DVec3,
    rounded_error: DVec3,
}

impl Plane {
    /// `None` when the three points lie on a line.
    pub(crate) fn through(corners: [DVec3; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let (normal, terms) = Offset::between(a, b).cross(Offset::between(a, c));
        let certain = |i: usize| normal.0[i].hi.abs() > FILTER * terms[i];
        let spanned = (0..3).any(certain) || spans_a_plane(corners);
        let rounded = normal.round();
        let rounded_error = QUICK * rounded.abs() + FILTER * terms;
        spanned.then_some(Self { corners, normal, terms, rounded, rounded_error })
    }

    /// The normal dotted with `to - from`: positive when the way from `from` to `to` leads to the normal's side.
    pub(crate) fn height(&self, from: DVec3, to: DVec3) -> Height {
        let offset = Offset::between(from, to);
        let value = self.normal.dot(offset);
        let terms = self.terms.dot(offset.sizes());
        decide(value, terms, || exact_height(&self.corners, from, to))
    }

    /// A bound on the error of the components of `normal`, in sum.
    pub(crate) fn normal_error(&self) -> f64 {
        FILTER * self.terms.element_sum()
    }

    /// On which side of the plane `point` lies: `Greater` on the side of the normal.
    pub(crate) fn side_of(&self, point: DVec3) -> Ordering {
        match self.quick_side(point) {
            Some(side) => side,
            None => self.open_side(point.x, point.y, point.z),
        }
    }

    /// The side where doubles do not decide it. Coordinates come one by one: a reference would force the point into memory on
    /// the common path too.
    #[cold]
    fn open_side(&self, x: f64, y: f64, z: f64) -> Ordering {
        self.side(DVec3::new(x, y, z)).sign
    }

    /// Whether a point is no higher over the plane than that, on either side.
    pub(crate) fn is_within(&self, point: DVec3, height: f64) -> bool {
        let (value, error) = self.quick_height(point);
        value.abs() <= height + error && self.side(point).value.hi.abs() <= height
    }

    /// Whether it is certain that two planes are far from parallel.
    pub(crate) fn is_across(&self, other: &Self) -> bool {
        let is_known = |plane: &Self| plane.normal_error() < 1e-3 * plane.rounded.length();
        let [a, b] = [self, other].map(|plane| plane.rounded);
        is_known(self) && is_known(other) && a.dot(b).abs() < 0.5 * a.length() * b.length()
    }

    /// The height of a point over the plane in doubles, and a bound on its error.
    fn quick_height(&self, point: DVec3) -> (f64, f64) {
        let offset = point - self.corners[0];
        (self.rounded.dot(offset), self.rounded_error.dot(offset.abs()) + QUICK_UNDERFLOW)
    }

    /// The side of a point where doubles decide it; never `Equal`.
    pub(crate) fn quick_side(&self, point: DVec3) -> Option<Ordering> {
        let (value, error) = self.quick_height(point);
        if value > error {
            Some(Ordering::Greater)
        } else if value < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// The normal in doubles.
    pub(crate) fn rounded(&self) -> DVec3 {
        self.rounded
    }

    /// The height of `point` over the plane, with the sign of [`Self::side_of`].
    pub(crate) fn side(&self, point: DVec3) -> Height {
        if self.corners.contains(&point) {
            return Height { value: DoubleDouble::ZERO, error: 0.0, sign: Ordering::Equal };
        }
        self.height(self.corners[0], point)
    }
}

/// On which side of the horizon through `position` across `normal` a point lies: `Greater` above it.
pub(crate) fn place(normal: DVec3, position: DVec3, point: DVec3) -> Ordering {
    let offset = point - position;
    let value = normal.dot(offset);
    if value.abs() > QUICK * normal.abs().dot(offset.abs()) + QUICK_UNDERFLOW {
        return value.total_cmp(&0.0);
    }
    over_horizon(normal, position, point).sign
}

/// The height of `point` over the horizon through `position` across `normal`, a vector taken exactly as given.
pub(crate) fn over_horizon(normal: DVec3, position: DVec3, point: DVec3) -> Height {
    let offset = Offset::between(position, point);
    let value = Offset(normal.to_array().map(DoubleDouble::from)).dot(offset);
    let terms = sizes(normal).dot(offset.sizes());
    decide(value, terms, || exact_dot(normal, position, point))
}

/// Whether the way from `a` over `b` to `c` turns left (`Greater`), goes straight on or back, or turns right.
pub(crate) fn turn_in_plane(a: DVec2, b: DVec2, c: DVec2) -> Ordering {
    let turn = orient2d(a.into(), b.into(), c.into());
    if turn == 0.0 { Ordering::Equal } else { turn.total_cmp(&0.0) }
}

/// Whether `d` is left of, on, or right of the plane through `origin`, `a`, `b`: the sign of (a - o) x (b - o) . (d - o).
pub(crate) fn turn(origin: DVec3, a: DVec3, b: DVec3, d: DVec3) -> Ordering {
    let [p, q, r] = [a, b, d].map(|x| x - origin);
    let (value, [p, q, r]) = (p.cross(q).dot(r), [p, q, r].map(DVec3::abs));
    let terms = DVec3::new(p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x).dot(r);
    if value.abs() > QUICK * terms + QUICK_UNDERFLOW {
        return value.total_cmp(&0.0);
    }
    // Neighbours share corners, and points on a line along an axis, such as the corners of a grid, need no arithmetic either.
    if [a, b].contains(&d) || (0..3).filter(|&axis| a[axis] == b[axis] && b[axis] == d[axis]).count() > 1 {
        return Ordering::Equal;
    }
    height_over(&[origin, a, b], d).sign
}

/// The height of `d` over the plane through three points: (b - a) x (c - a) . (d - a).
pub(super) fn height_over(plane: &[DVec3; 3], d: DVec3) -> Height {
    let [a, b, c] = *plane;
    let (normal, terms) = Offset::between(a, b).cross(Offset::between(a, c));
    let offset = Offset::between(a, d);
    let terms = terms.dot(offset.sizes());
    decide(normal.dot(offset), terms, || exact_height(plane, a, d))
}

fn decide(value: DoubleDouble, terms: f64, exact: impl FnOnce() -> Ordering) -> Height {
    let error = FILTER * terms;
    if terms == 0.0 {
        return Height { value: DoubleDouble::ZERO, error, sign: Ordering::Equal };
    }
    if value.hi.abs() > error {
        return Height { value, error, sign: value.hi.total_cmp(&0.0) };
    }
    let sign = exact();
    let certain = value.hi.partial_cmp(&0.0) == Some(sign);
    // Where only integers decide the sign, any value with that sign within the filter's error will do.
    let least = DoubleDouble::from(match sign {
        Ordering::Less => -error,
        Ordering::Equal => 0.0,
        Ordering::Greater => error,
    });
    // That value may be off by the filter's error twice.
    Height { value: if certain { value } else { least }, error: 2.0 * error, sign }
}

/// (b - a) x (c - a) . (to - from), on integers.
fn exact_height([a, b, c]: &[DVec3; 3], from: DVec3, to: DVec3) -> Ordering {
    let [a, b, c, from, to] = integers([*a, *b, *c, from, to].map(Into::into));
    let normal = cross(&minus(&b, &a), &minus(&c, &a));
    sign(&dot(&normal, &minus(&to, &from)))
}

fn exact_dot(normal: DVec3, position: DVec3, point: DVec3) -> Ordering {
    let [normal] = integers([normal.into()]);
    let [position, point] = integers([position, point].map(Into::into));
    sign(&dot(&normal, &minus(&point, &position)))
}

fn spans_a_plane(corners: [DVec3; 3]) -> bool {
    let [a, b, c] = integers(corners.map(Into::into));
    cross(&minus(&b, &a), &minus(&c, &a)).iter().any(|component| sign(component).is_ne())
}

pub(super) fn minus(a: &[Integer; 3], b: &[Integer; 3]) -> [Integer; 3] {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

pub(super) fn cross(a: &[Integer; 3], b: &[Integer; 3]) -> [Integer; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(j, k)| &a[j] * &b[k] - &a[k] * &b[j])
}

pub(super) fn dot(a: &[Integer; 3], b: &[Integer; 3]) -> Integer {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn numbers() -> impl Strategy<Value = f64> {
        prop_oneof![
            (-4i32..=4).prop_map(f64::from),
            -1.0..1.0,
            (-1.0..1.0).prop_map(|x: f64| x * 1e60),
            (-1.0..1.0).prop_map(|x: f64| x * 1e-60),
            Just(5e-324),
            Just(-1e-200),
        ]
    }

    fn point() -> impl Strategy<Value = DVec3> {
        (numbers(), numbers(), numbers()).prop_map(DVec3::from)
    }

    /// The three offsets are rounded by 0.9, −0.2 and 0.9: in doubles the height is 2, in truth −0.2.
    #[test]
    fn the_horizon_is_exact_where_rounded_offsets_lie() {
        let (normal, position) = (DVec3::new(1.0, -2.0, 1.0), DVec3::new(-1.1, -0.2, 0.9));
        assert_eq!(place(normal, position, DVec3::splat(1e16)), Ordering::Less);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_filter_decides_as_integers_do(corners in prop::array::uniform3(point()), from in point(), to in point()) {
            if let Some(plane) = Plane::through(corners) {
                prop_assert_eq!(plane.height(from, to).sign, exact_height(&corners, from, to));
                prop_assert_eq!(plane.side(to).sign, exact_height(&corners, corners[0], to));
                prop_assert_eq!(plane.side_of(to), plane.side(to).sign);
            }
            prop_assert_eq!(turn(from, corners[0], corners[1], to), exact_height(&[from, corners[0], corners[1]], from, to));
            prop_assert_eq!(over_horizon(corners[0], from, to).sign, exact_dot(corners[0], from, to));
            prop_assert_eq!(place(corners[0], from, to), exact_dot(corners[0], from, to));
        }

        #[test]
        fn turns_in_the_plane_are_those_in_space(a in point(), b in point(), c in point()) {
            let [a, b, c] = [a, b, c].map(|p| p.with_z(0.0));
            let wanted = exact_height(&[a, b, c], DVec3::ZERO, DVec3::Z);
            prop_assert_eq!(turn_in_plane(a.truncate(), b.truncate(), c.truncate()), wanted);
        }

        #[test]
        fn the_value_has_the_sign(corners in prop::array::uniform3(point()), from in point(), to in point()) {
            if let Some(plane) = Plane::through(corners) {
                let height = plane.height(from, to);
                prop_assert_eq!(height.value.hi.partial_cmp(&0.0), Some(height.sign));
            }
        }

        #[test]
        fn points_of_a_plane_are_on_it(corners in prop::array::uniform3(point()), i in 0usize..3) {
            if let Some(plane) = Plane::through(corners) {
                prop_assert_eq!(plane.side(corners[i]).sign, Ordering::Equal);
            }
        }

        #[test]
        fn points_along_an_axis_turn_nowhere(from in point(), at in point(), along in prop::array::uniform3(numbers()), axis in 0usize..3) {
            let [a, b, d] = along.map(|x| {
                let mut point = at;
                point[axis] = x;
                point
            });
            prop_assert_eq!(turn(from, a, b, d), Ordering::Equal);
            prop_assert_eq!(exact_height(&[from, a, b], from, d), Ordering::Equal);
        }

        #[test]
        fn swapping_two_corners_turns_the_plane_over(corners in prop::array::uniform3(point()), at in point()) {
            let [a, b, c] = corners;
            if let (Some(plane), Some(turned)) = (Plane::through(corners), Plane::through([b, a, c])) {
                prop_assert_eq!(plane.side(at).sign, turned.side(at).sign.reverse());
            }
        }
    }

    #[test]
    fn a_last_bit_off_a_sloping_plane_is_seen() {
        let plane =
            Plane::through([DVec3::new(1.0, 0.0, 0.0), DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.0, 0.0, 1.0)]);
        let plane = plane.expect("three points that span a plane");
        let third = 1.0 / 3.0;
        // 1/3 rounds down, so that three of them fall short of 1 by 3 * 2^-54 / 3.
        assert_eq!(plane.side(DVec3::splat(third)).sign, Ordering::Less);
        assert_eq!(plane.side(DVec3::splat(third + f64::EPSILON / 4.0)).sign, Ordering::Greater);
        assert_eq!(plane.side(DVec3::new(0.25, 0.25, 0.5)).sign, Ordering::Equal);
    }

    #[test]
    fn points_on_a_line_span_no_plane() {
        let third = DVec3::new(0.1, 0.2, 0.3);
        assert!(Plane::through([DVec3::ZERO, third, 2.0 * third]).is_none());
        assert!(
            Plane::through([DVec3::ZERO, third, DVec3::new(0.2, 0.4, 0.6 + f64::EPSILON / 2.0)]).is_some()
        );
    }
}
