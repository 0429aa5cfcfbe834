//! Form factors from area to area: closed forms, references with a blocker, reciprocity and closure.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{AreaFormFactor, DVec3, DifferentialArea, Enclosure, Error, PlanarPolygon};

fn rectangle([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> PlanarPolygon {
    PlanarPolygon::new([[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]]).unwrap()
}

fn turned(polygon: &PlanarPolygon) -> PlanarPolygon {
    let loops = polygon.loops().map(|l| l.iter().rev().copied().collect::<Vec<DVec3>>());
    PlanarPolygon::new(loops.collect::<Vec<_>>()).unwrap()
}

const UNIT: [f64; 2] = [0.0, 1.0];

/// Unit squares, one above the other, and a blocker in between.
fn squares(blocker: Option<PlanarPolygon>) -> Enclosure {
    let ceiling = turned(&rectangle(UNIT, UNIT, 1.0));
    Enclosure::new([rectangle(UNIT, UNIT, 0.0), ceiling].into_iter().chain(blocker).collect())
}

#[test]
fn blockers_between_squares() {
    let blockers = [
        (None, 0.199_824_895_698_387_4),
        (Some(rectangle([0.0, 0.5], [0.0, 0.5], 0.5)), 0.149_868_671_773_790),
        (Some(rectangle([0.25, 0.75], [0.25, 0.75], 0.5)), 0.099_506_294_598_984_8),
        (Some(rectangle([0.3, 0.7], [0.2, 0.9], 0.35)), 0.101_200_016_253_138),
    ];
    for (blocker, expected) in blockers {
        let found = squares(blocker).area_form_factor(0, 1, 1e-12).unwrap();
        println!("{found:?} off by {:.1e}", found.value - expected);
        assert!((found.value - expected).abs() <= 1e-12, "{found:?} is not {expected}");
        assert!(found.error_estimate <= 1e-12 && found.evaluations < 2000, "{found:?}");
    }
}

/// A source, a receiver, and an obstructor that shares a vertex with the source: View3D answers 1.31.
fn three_triangles() -> Enclosure {
    let (v1, v2) = ([2217.833_008, 1_853.818_848, 0.0], [2217.506_348, 1_853.365_601, 0.0]);
    let v3 = [2217.833_008, 1_853.818_848, 66.900_002];
    let v4 = [2218.230_957, 1_854.916_382, 0.0];
    let v5 = [2218.230_957, 1_854.916_382, 66.900_002];
    let v6 = [2201.107_910, 1_845.251_709, 66.900_002];
    let v7 = [2217.864_990, 1_854.129_883, 0.0];
    let v9 = [2217.864_990, 1_854.129_883, 66.900_002];
    let triangle = |corners: [[f64; 3]; 3]| PlanarPolygon::new([corners]).unwrap();
    Enclosure::new(vec![triangle([v1, v2, v3]), triangle([v4, v5, v6]), triangle([v7, v1, v9])])
}

#[test]
fn three_triangles_are_seen_as_by_rays() {
    let found = three_triangles().area_form_factor(0, 1, 1e-9).unwrap();
    println!("{found:?}");
    // 40 million rays: 0.753721 +- 0.000068.
    assert!((found.value - 0.753_721).abs() <= 3.0 * 0.000_068 && found.error_estimate <= 1e-9, "{found:?}");
}
