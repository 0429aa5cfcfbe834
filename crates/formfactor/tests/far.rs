//! Form factors from area to area far from the origin, where the roundings of coordinates are what they are known to.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::DMat3;
use formfactor::{DVec3, Enclosure, Limits, PlanarPolygon};

/// Found without end: edges in line but for roundings, and a tolerance below them.
#[test]
fn floor_and_wall_that_touch_far_from_the_origin_end_within_what_roundings_allow() {
    let squares = |at: DVec3, angle: f64| {
        let turn = |p: [f64; 3]| at + DMat3::from_rotation_z(angle) * DVec3::from(p);
        let floor = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]].map(turn);
        let wall = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]].map(turn);
        Enclosure::new([floor, wall].map(|corners| PlanarPolygon::new([corners]).unwrap()).to_vec())
    };
    // The closed form for squares with a common edge at a right angle.
    let exact = 0.200_043_776_075_402_6;
    let limits = Limits { in_all: 1_000_000, ..Limits::default() };
    for (far, tolerance) in [(0.0, 1e-17), (5e5, 1e-9), (5e5, 1e-12), (5e6, 1e-3), (5e6, 1e-11)] {
        for angle in [0.0, 0.3, 0.7, 2.0, 4.5] {
            let pair = squares(far * DVec3::new(1.0, 0.7, -0.2), angle);
            let found = pair.area_form_factor(0, 1, tolerance, &limits).unwrap().unwrap();
            let rounded = 1e-15 + 4.0 * f64::EPSILON * far;
            assert!(
                (found.value - exact).abs() <= found.error_estimate + rounded && found.error_estimate < 1e-3,
                "{far} by {angle} at {tolerance}: {found:?}"
            );
        }
    }
}
