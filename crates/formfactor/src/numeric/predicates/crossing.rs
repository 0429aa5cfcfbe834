//! On which side of a plane a line crosses another plane.
//!
//! Where the line from p to q has the heights h and k over the plane that it crosses, of opposite signs, it does so at (k p - h q) / (k - h).
//! Heights t and u over the other plane are linear, too, so that the height of that place has the sign of (k t - h u) (k - h): of degree 6.
use super::height::{Height, Plane, cross, dot, height_over, minus};
use exactfloat::{DoubleDouble, Integer, integers, sign};
use glam::DVec3;
use std::cmp::Ordering;

/// What rounding takes from two products in double-doubles and their difference, relative to the sum of their magnitudes.
const PRODUCTS: f64 = 1e-30;

/// On which side of the plane through three points, `Greater` where (b - a) x (c - a) leads, the line between two ends crosses another plane,
/// on either side of which one end must be.
pub(crate) fn side_of_crossing(plane: &[DVec3; 3], ends: [DVec3; 2], crossed: &Plane) -> Ordering {
    let [t, u] = ends.map(|end| height_over(plane, end));
    match [t.sign, u.sign] {
        [one, other] if one == other || other.is_eq() => return one,
        [Ordering::Equal, other] => return other,
        _ => (),
    }
    let [h, k] = ends.map(|end| crossed.side(end));
    let (value, error) = difference([&k, &t], [&h, &u]);
    let difference = match value.hi.abs() > error {
        true => value.hi.total_cmp(&0.0),
        false => exact_difference(plane, ends, &crossed.corners),
    };
    if k.sign.is_gt() { difference } else { difference.reverse() }
}

/// a b - c d, and a bound on its error.
fn difference([a, b]: [&Height; 2], [c, d]: [&Height; 2]) -> (DoubleDouble, f64) {
    let size = |height: &Height| height.value.hi.abs() + height.error;
    let error = |a: &Height, b: &Height| {
        size(a) * b.error + size(b) * a.error + PRODUCTS * size(a) * size(b) + f64::MIN_POSITIVE
    };
    (a.value * b.value - c.value * d.value, 2.0 * (error(a, b) + error(c, d)))
}

/// The same on integers, where nothing is rounded.
fn exact_difference(plane: &[DVec3; 3], [p, q]: [DVec3; 2], crossed: &[DVec3; 3]) -> Ordering {
    let ([a, b, c], [d, e, f]) = (*plane, *crossed);
    let [a, b, c, d, e, f, p, q] = integers([a, b, c, d, e, f, p, q].map(Into::into));
    let height = |[a, b, c]: [&[Integer; 3]; 3], p: &[Integer; 3]| {
        dot(&cross(&minus(b, a), &minus(c, a)), &minus(p, a))
    };
    let [t, u] = [&p, &q].map(|end| height([&a, &b, &c], end));
    let [h, k] = [&p, &q].map(|end| height([&d, &e, &f], end));
    sign(&(k * t - h * u))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::predicates::height::turn;
    use proptest::prelude::*;

    fn whole(size: i32) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..=size).prop_map(|point| DVec3::from(point.map(f64::from)))
    }

    fn any_point() -> impl Strategy<Value = DVec3> {
        let number =
            prop_oneof![(-4i32..=4).prop_map(f64::from), -1.0..1.0, (-1.0..1.0).prop_map(|x: f64| x * 1e40)];
        prop::array::uniform3(number).prop_map(DVec3::from)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn a_place_that_is_a_point_has_the_side_of_that_point(
            plane in prop::array::uniform3(whole(6)), at in whole(6), ways in prop::array::uniform3(whole(3)),
            steps in prop::array::uniform2(1i32..5), size in prop_oneof![Just(1.0), Just(0.1), Just(1e-30)],
        ) {
            let [u, v, along] = ways;
            let scaled = |point: DVec3| point * size;
            let crossed = Plane::through([at, at + u, at + v].map(scaled));
            let ends = [at + along * f64::from(steps[0]), at - along * f64::from(steps[1])].map(scaled);
            let Some(crossed) = crossed.filter(|crossed| !crossed.side_of(ends[0]).is_eq()) else { return Ok(()) };
            // Of tenths only the size is exact: the place is then where the rounded line is.
            if size == 0.1 {
                prop_assume!(crossed.side_of(ends[0]) == crossed.side_of(ends[1]).reverse());
                let reversed = side_of_crossing(&plane.map(scaled), [ends[1], ends[0]], &crossed);
                prop_assert_eq!(side_of_crossing(&plane.map(scaled), ends, &crossed), reversed);
            } else {
                let plane = plane.map(scaled);
                prop_assert_eq!(side_of_crossing(&plane, ends, &crossed), turn(plane[0], plane[1], plane[2], scaled(at)));
            }
        }

        #[test]
        fn the_filter_decides_as_integers_do(
            plane in prop::array::uniform3(any_point()), crossed in prop::array::uniform3(any_point()), ends in prop::array::uniform2(any_point()),
        ) {
            let Some(crossed) = Plane::through(crossed) else { return Ok(()) };
            let [h, k] = ends.map(|end| crossed.side_of(end));
            if h.is_ne() && h == k.reverse() {
                let exact = exact_difference(&plane, ends, &crossed.corners);
                prop_assert_eq!(side_of_crossing(&plane, ends, &crossed), if k.is_gt() { exact } else { exact.reverse() });
            }
        }
    }
}
