//! Every predicate against rationals, over the whole range of exponents and close to degeneracy.

use super::*;
use glam::DVec2;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use proptest::prelude::*;

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("finite")
}

fn exact_side(a: DVec2, b: DVec2, c: DVec2) -> Side {
    let d = (exact(b.x) - exact(a.x)) * (exact(c.y) - exact(a.y))
        - (exact(b.y) - exact(a.y)) * (exact(c.x) - exact(a.x));
    sign(&d)
}

fn sign(d: &BigRational) -> Side {
    Side::from(d.cmp(&BigRational::zero()))
}

/// The exact crossing of two lines that are not parallel.
fn exact_crossing(e: Segment, f: Segment) -> [BigRational; 2] {
    let [a, b, c, d] = [e[0], e[1], f[0], f[1]].map(|p| [exact(p.x), exact(p.y)]);
    let cross = |u: &[BigRational; 2], v: &[BigRational; 2]| &u[0] * &v[1] - &u[1] * &v[0];
    let minus = |u: &[BigRational; 2], v: &[BigRational; 2]| [&u[0] - &v[0], &u[1] - &v[1]];
    let (r, s) = (minus(&b, &a), minus(&d, &c));
    let t = cross(&minus(&c, &a), &s) / cross(&r, &s);
    [&a[0] + &t * &r[0], &a[1] + &t * &r[1]]
}

/// Small integers, ordinary numbers, and numbers of any exponent.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => (-4i32..5).prop_map(f64::from),
        4 => -1.0..1.0f64,
        1 => (-1.0..1.0f64, -1070i32..1020).prop_map(|(m, e)| m * 2f64.powi(e / 2) * 2f64.powi(e - e / 2)),
        1 => Just(f64::MAX), 1 => Just(5e-324), 1 => Just(0.0),
    ]
}

fn point() -> impl Strategy<Value = DVec2> {
    (coordinate(), coordinate()).prop_map(|(x, y)| DVec2::new(x, y))
}

/// A whole configuration shifted by a power of two, so that all exponents are close to each other.
fn scaled<const N: usize>() -> impl Strategy<Value = [DVec2; N]> {
    let unit = (-1.0..1.0f64, -1.0..1.0f64).prop_map(|(x, y)| DVec2::new(x, y));
    (proptest::array::uniform::<_, N>(unit), -1000i32..1000)
        .prop_map(|(points, e)| points.map(|p| p * 2f64.powi(e)))
}

/// Points that lie on a line but for roundings.
fn nearly_collinear() -> impl Strategy<Value = [DVec2; 3]> {
    (point(), point(), 0.0..1.0f64, -2i32..3).prop_map(|(a, b, t, ulps)| {
        let c = a * (1.0 - t) + b * t;
        let nudge = |x: f64| f64::from_bits(x.to_bits().wrapping_add_signed(i64::from(ulps)));
        let y = nudge(c.y);
        [a, b, DVec2::new(c.x, if y.is_finite() { y } else { c.y })]
    })
}

/// Three segments through nearly or exactly one point, of any scale.
fn concurrent() -> impl Strategy<Value = [DVec2; 6]> {
    let end = prop_oneof![
        (-8i32..9, -8i32..9).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))),
        (-1.0..1.0f64, -1.0..1.0f64).prop_map(|(x, y)| DVec2::new(x, y))
    ];
    (proptest::array::uniform3(end), -300i32..300).prop_map(|(ends, e)| {
        let (centre, scale) = (DVec2::new(0.3, 0.7), 2f64.powi(e));
        let [a, b, c] = ends.map(|d| [(centre - d) * scale, (centre + d * 0.75) * scale]);
        [a[0], a[1], b[0], b[1], c[0], c[1]]
    })
}

fn crosses(e: Segment, f: Segment) -> bool {
    let apart = |e: Segment, f: Segment| {
        let (p, q) = (side(e[0], e[1], f[0]), side(e[0], e[1], f[1]));
        p != Side::On && q == p.reversed()
    };
    apart(e, f) && apart(f, e)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn side_is_exact(a in point(), b in point(), c in point()) {
        prop_assert_eq!(side(a, b, c), exact_side(a, b, c));
    }

    #[test]
    fn side_is_exact_near_a_line([a, b, c] in nearly_collinear()) {
        prop_assert_eq!(side(a, b, c), exact_side(a, b, c));
    }

    #[test]
    fn side_is_exact_at_every_scale([a, b, c] in scaled::<3>()) {
        prop_assert_eq!(side(a, b, c), exact_side(a, b, c));
    }

    #[test]
    fn turn_is_exact(a in point(), b in point(), c in point(), d in point()) {
        let cross = (exact(b.x) - exact(a.x)) * (exact(d.y) - exact(c.y))
            - (exact(b.y) - exact(a.y)) * (exact(d.x) - exact(c.x));
        prop_assert_eq!(turn([a, b], [c, d]), sign(&cross));
    }

    #[test]
    fn crossings_are_rounded_correctly([a, b, c, d] in prop_oneof![proptest::array::uniform4(point()), scaled::<4>(), concurrent().prop_map(|p| [p[0], p[1], p[2], p[3]])]) {
        let (e, f) = ([a, b], [c, d]);
        if !crosses(e, f) {
            return Ok(());
        }
        let [x, y] = exact_crossing(e, f);
        let p = crossing_point(e, f);
        for (rounded, exact_value) in [(p.x, x), (p.y, y)] {
            prop_assert!(rounded.is_finite());
            let off = |v: f64| (exact(v) - &exact_value).abs();
            let best = off(rounded);
            for neighbour in [rounded.next_up(), rounded.next_down()].into_iter().filter(|n| n.is_finite()) {
                prop_assert!(best <= off(neighbour));
            }
        }
        prop_assert_eq!(p, crossing_point([d, c], [b, a]));
    }

    #[test]
    fn crossings_are_ordered_exactly(points in prop_oneof![proptest::array::uniform6(point()), scaled::<6>(), concurrent()]) {
        let [a, b, c, d, g, h] = points;
        let e = [a, b];
        if !crosses(e, [c, d]) || !crosses(e, [g, h]) {
            return Ok(());
        }
        let along = |f: Segment| {
            let [x, y] = exact_crossing(e, f);
            (x - exact(a.x)) * (exact(b.x) - exact(a.x)) + (y - exact(a.y)) * (exact(b.y) - exact(a.y))
        };
        prop_assert_eq!(crossing_order(e, [c, d], [g, h]), along([c, d]).cmp(&along([g, h])));
    }

    #[test]
    fn heights_and_abscissae_are_ordered_exactly(points in prop_oneof![proptest::array::uniform4(point()), scaled::<4>()]) {
        let [a, b, c, d] = points;
        let (e, f) = (rightward([a, b]), rightward([c, d]));
        let x = e[0].x.max(f[0].x);
        if x < e[1].x.min(f[1].x) {
            let run = |s: Segment| (exact(s[1].x) - exact(s[0].x), exact(s[1].y) - exact(s[0].y));
            let height = |s: Segment| { let (dx, dy) = run(s); exact(s[0].y) + (exact(x) - exact(s[0].x)) * dy / dx };
            let slope = |s: Segment| { let (dx, dy) = run(s); dy / dx };
            let order = height(e).cmp(&height(f)).then_with(|| slope(e).cmp(&slope(f)));
            prop_assert_eq!(height_order([a, b], [d, c], x), order);
        }
        if crosses(e, f) {
            prop_assert_eq!(crossing_x_order(e, f, x), exact_crossing(e, f)[0].cmp(&exact(x)));
        }
    }
}

#[test]
fn where_robust_alone_is_wrong() {
    let p = |x: f64, y: f64| DVec2::new(x, y);
    assert_eq!(side(p(0.0, 0.0), p(3e-170, 3e-170), p(1e-170, 2e-170)), Side::Left);
    assert_eq!(side(p(0.0, 0.0), p(3e160, 3e160), p(1e160, 2e160)), Side::Left);
    assert_eq!(side(p(0.0, 0.0), p(3e160, 3e160), p(1e160, 1e160)), Side::On);
}

#[test]
fn directions_go_round_from_just_above_straight_down() {
    let steps = || (-2..=2).map(f64::from);
    let directions =
        steps().flat_map(|x| steps().map(move |y| DVec2::new(x, y))).filter(|p| *p != DVec2::ZERO);
    let angle = |p: DVec2| p.to_angle() + if p.y < 0.0 && p.x <= 0.0 { std::f64::consts::TAU } else { 0.0 };
    let compass = |p: DVec2| Compass::of([DVec2::ONE, DVec2::ONE + p]);
    let mut directions: Vec<DVec2> = directions.collect();
    directions.sort_by(|p, q| angle(*p).total_cmp(&angle(*q)));
    assert!(directions.is_sorted_by_key(|p| compass(*p)));
    assert!(directions.iter().all(|p| compass(*p).is_axis() == (p.x == 0.0 || p.y == 0.0)));
    assert_eq!([directions[0], directions[23]].map(compass), [Compass::SouthEast, Compass::South]);
}
