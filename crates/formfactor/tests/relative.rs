//! Small, far and sliver targets: the value keeps its digits where the edges of the contour sum cancel.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded};
use proptest::prelude::*;

/// 2^-20.
const TINY: f64 = 1.0 / 1_048_576.0;

/// What it is, dA's position and normal, the target, and its form factor: Lambert's sum with 80 digits.
type Row = (&'static str, [f64; 3], [f64; 3], &'static [[f64; 3]], f64);

const ROWS: [Row; 10] = [
    (
        "a square 1e3 aside",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[1e3, 0.0, 1.0], [1001.0, 0.0, 1.0], [1001.0, 1.0, 1.0], [1e3, 1.0, 1.0]],
        3.176_734_795_710_142_4e-13,
    ),
    (
        "a square 1e6 aside",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[1e6, 0.0, 1.0], [1000001.0, 0.0, 1.0], [1000001.0, 1.0, 1.0], [1e6, 1.0, 1.0]],
        3.183_092_495_642_305e-25,
    ),
    (
        "a strip 1e-12 wide",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1e-12, 1.0], [0.0, 1e-12, 1.0]],
        2.045_774_715_459_476_6e-13,
    ),
    (
        "an oblique strip",
        [0.25, -0.125, 0.0],
        [1.0, 2.0, 3.0],
        &[[-1.0, 0.5, 1.0], [1.0, 0.5, 1.0], [1.0, 0.5 + TINY, 1.0], [-1.0, 0.5 + TINY, 1.0]],
        2.382_336_847_243_04e-7,
    ),
    (
        "a small triangle",
        [0.1, 0.2, 0.3],
        [1.0, 2.0, 2.0],
        &[[1.0, 0.5, 1.0], [1.0 + TINY, 0.5, 1.0], [1.0, 0.5 + TINY / 2.0, 1.0 + TINY / 4.0]],
        1.991_589_252_294_173_5e-14,
    ),
    (
        "a sliver triangle",
        [0.0; 3],
        [0.0, 1.0, 2.0],
        &[[-2.0, 1.0, 1.0], [3.0, 1.5, 2.0], [0.5, 1.25 + TINY / 1024.0, 1.5]],
        1.016_727_994_705_632_7e-10,
    ),
    (
        "a far wall through the horizon",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[1e3, -0.5, -0.5], [1e3, 0.5, -0.5], [1e3, 0.5, 0.5], [1e3, -0.5, 0.5]],
        3.978_871_919_434_039_4e-11,
    ),
    (
        "one 1e6 away",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[1e6, -0.5, -0.25], [1e6, 0.5, -0.25], [1e6, 0.5, 0.5], [1e6, -0.5, 0.5]],
        3.978_873_577_295_725_5e-20,
    ),
    (
        "a narrow plate",
        [0.0; 3],
        [0.0, 0.0, 1.0],
        &[[1.0, -1e-9, 0.5], [2.0, -1e-9, 0.5], [2.0, 1e-9, 0.5], [1.0, 1e-9, 0.5]],
        3.435_395_321_499_685e-11,
    ),
    (
        "a plate 2^-30 before the point, through the horizon",
        [0.25, 0.5, -TINY / 1024.0],
        [1.0, 2.0, 1.0],
        &[[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, -1.0, 0.0]],
        0.704_124_144_358_819_6,
    ),
];

fn facing(points: &[DVec3], from: DVec3) -> PlanarPolygon {
    let polygon = PlanarPolygon::new([points]).unwrap();
    if polygon.normal().dot(from - points[0]) > 0.0 {
        return polygon;
    }
    let reversed: Vec<DVec3> = points.iter().rev().copied().collect();
    PlanarPolygon::new([reversed]).unwrap()
}

#[test]
fn values_are_right_to_1e_13_of_themselves_and_bounds_say_so() {
    for (name, position, normal, points, expected) in ROWS {
        let from = DifferentialArea::new(position.into(), normal.into()).unwrap();
        let points: Vec<DVec3> = points.iter().map(|p| DVec3::from(*p)).collect();
        let factor = unoccluded(&from, &facing(&points, position.into()));
        let error = (factor.value - expected).abs();
        assert!(
            error <= factor.error_bound + expected * f64::EPSILON,
            "{name}: {factor:?}, off by {error:e}"
        );
        assert!(factor.error_bound <= 1e-13 * expected, "{name}: {factor:?}");
    }
}

proptest! {
    /// The kernel at the middle of a target of size s is the mean over it within s^2: a law that knows of no edges.
    #[test]
    fn tiny_triangles_have_the_kernel_of_their_middle(
        at in prop::array::uniform3(1.0..3.0), u in prop::array::uniform3(-1.0..1.0), v in prop::array::uniform3(-1.0..1.0),
        shrink in 20i32..30,
    ) {
        let (at, scale) = (DVec3::from(at), 0.5f64.powi(shrink));
        let points = [at, at + scale * DVec3::from(u), at + scale * DVec3::from(v)];
        let Ok(polygon) = PlanarPolygon::new([points]) else { return Ok(()) };
        let across = (points[1] - points[0]).cross(points[2] - points[0]);
        let (middle, slant) = ((points[0] + points[1] + points[2]) / 3.0, polygon.normal().dot(at).abs());
        prop_assume!(slant > 0.01 && across.length() > 1e-3 * scale * scale);
        let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
        let factor = unoccluded(&from, &facing(&points, DVec3::ZERO));
        let square = middle.length_squared();
        let kernel = middle.z * across.dot(middle).abs() / (2.0 * std::f64::consts::PI * square * square);
        prop_assert!((factor.value / kernel - 1.0).abs() < 100.0 * scale, "{factor:?} is not {kernel}");
        prop_assert!(factor.error_bound <= 1e-13 * factor.value, "{factor:?}");
    }
}
