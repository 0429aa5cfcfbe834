//! Where rounding breaks things: slivers of a few ulps, bundles through nearly one point, the ends of the range.

use polycsg::{Csg, DVec2, FillRule, Region};
use proptest::prelude::*;

/// Quads squeezed into a slab of a given height: most crossings round onto or over something.
fn slab_quads(height: f64) -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let point = (0.0..1.0f64, 0.0..1.0f64).prop_map(move |(x, y)| DVec2::new(x, 0.7 + y * height));
    proptest::collection::vec(proptest::collection::vec(point, 4), 1..12)
}

/// Thin triangles whose long edges all pass within an ulp or so of one point.
fn bundle() -> impl Strategy<Value = Vec<Vec<DVec2>>> {
    let triangle =
        (0.0..std::f64::consts::TAU, 1e-17..1e-15f64, 1.0..3.0f64).prop_map(|(angle, jitter, r)| {
            let (s, c) = angle.sin_cos();
            let centre = DVec2::new(0.3 + jitter, 0.7 - jitter);
            vec![
                centre - DVec2::new(c, s) * r,
                centre + DVec2::new(c, s) * r,
                centre + DVec2::new(c - 0.1, s) * r,
            ]
        });
    proptest::collection::vec(triangle, 1..14)
}

fn check(a: &[Vec<DVec2>], b: &[Vec<DVec2>], slack: f64) -> Result<(), TestCaseError> {
    let (csg_a, csg_b) = (
        || Csg::from_rings(a, FillRule::EvenOdd).expect("finite"),
        || Csg::from_rings(b, FillRule::EvenOdd).expect("finite"),
    );
    let region =
        [csg_a() | csg_b(), csg_a() & csg_b(), csg_a() - csg_b(), csg_a() ^ csg_b()].map(|c| c.evaluate());
    for r in &region {
        prop_assert_eq!(r.validate(), Ok(()));
    }
    let [union, common, rest, either] = region.map(|r| r.area());
    prop_assert!((union - common - either).abs() <= slack, "{union} {common} {either}");
    prop_assert!((csg_a().evaluate().area() - common - rest).abs() <= slack);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn slivers_stay_valid((a, b) in (10i32..18).prop_flat_map(|digits| {
        let height = 10f64.powi(-digits);
        (slab_quads(height), slab_quads(height))
    })) {
        check(&a, &b, 1e-15)?;
    }

    #[test]
    fn bundles_stay_valid(a in bundle(), b in bundle()) {
        check(&a, &b, 1e-12)?;
    }

    #[test]
    fn the_range_does_not_matter(quads in slab_quads(0.5), exponent in -950i32..1000) {
        let scale = 2f64.powi(exponent);
        let scaled: Vec<Vec<DVec2>> = quads.iter().map(|q| q.iter().map(|&p| p * scale).collect()).collect();
        let (one, other) = (
            Region::from_rings(&quads, FillRule::NonZero).expect("finite"),
            Region::from_rings(&scaled, FillRule::NonZero).expect("finite"),
        );
        let rescaled: Vec<Vec<DVec2>> = one.rings().map(|r| r.iter().map(|&p| p * scale).collect()).collect();
        prop_assert_eq!(other.rings().map(<[DVec2]>::to_vec).collect::<Vec<_>>(), rescaled);
    }
}

#[test]
fn subnormal_and_huge_coordinates_mix() {
    let tiny = 5e-324;
    let huge = f64::MAX;
    let rings = [
        [[-huge, -huge], [huge, -huge], [huge, huge], [-huge, huge]],
        [[0.0, 0.0], [tiny, 0.0], [tiny, tiny], [0.0, tiny]],
        [[-huge, 0.0], [huge, tiny], [huge, huge], [tiny, tiny]],
    ];
    let region = Region::from_rings(rings, FillRule::EvenOdd).expect("finite");
    assert_eq!(region.validate(), Ok(()));
    assert_eq!(region.area(), f64::INFINITY);
}

/// Sixty needles through nearly one point: thousands of crossings within a few ulps, most pieces alike.
#[test]
fn many_needles_through_nearly_one_point() {
    let centre = DVec2::new(0.3, 0.7);
    let needles: Vec<Vec<DVec2>> = (0..60)
        .map(|i| {
            let (s, c) = (f64::from(i) * std::f64::consts::PI / 60.0).sin_cos();
            let tip = centre + DVec2::new(c, s);
            vec![centre - DVec2::new(c, s), tip, tip + DVec2::new(1e-3, 2e-3)]
        })
        .collect();
    let region = Region::from_rings(&needles, FillRule::EvenOdd).expect("finite");
    assert_eq!(region.validate(), Ok(()));
}

/// Seen from its leftmost, far corner the triangle's terms agree in their first 37 digits.
#[test]
fn areas_are_right_where_their_terms_cancel() {
    let near = [DVec2::new(0.0, 0.0), DVec2::new(1e-10, 0.0)];
    for far in [1e17, 1e20, 1e27, 1e30, 1e100] {
        let triangle = [[near[0], near[1], DVec2::new(-0.3 * far, far)]];
        let region = Region::from_rings(triangle, FillRule::EvenOdd).expect("finite");
        let expected = 0.5 * 1e-10 * far;
        assert!((region.area() - expected).abs() <= 2e-16 * expected, "{far:e}: {:e}", region.area());
    }
}

/// A needle 1e-16 wide at its foot and nothing at its tip: two edges of a triangle cross it, and where these crossings are
/// rounded both sides of the needle become one.
#[test]
fn the_tip_of_a_needle_may_vanish() {
    let tip = [1.0, 0.6];
    let needle = [[0.0, 0.3_f64.next_up().next_up()], [0.0, 0.3], tip];
    let triangle = [[1.0, 0.7], [0.2, 0.0], [0.9, 0.1]];
    let region = |ring| Region::from_rings([ring], FillRule::NonZero).expect("finite");
    let union = region(needle).union(&region(triangle));
    assert_eq!(union.validate(), Ok(()));
    let kept = |p: [f64; 2]| union.rings().flatten().any(|&q| q == DVec2::from(p));
    assert!(needle[..2].iter().chain(&triangle).all(|&p| kept(p)));
    assert!(!kept(tip));
    assert!(region(needle).rings().flatten().any(|&q| q == DVec2::from(tip)));
}
