//! Unoccluded form factors against closed forms evaluated to 25 digits.
use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded, unoccluded_complement};

fn value(id: &str) -> (String, f64) {
    let data: serde_json::Value = serde_json::from_str(include_str!("data/closed_forms.json")).unwrap();
    let forms = data["closed_forms"].as_array().unwrap();
    let form = forms.iter().find(|f| f["id"] == id).unwrap_or_else(|| panic!("no closed form {id}"));
    (form["gives"].as_str().unwrap().to_owned(), form["value"].as_str().unwrap().parse().unwrap())
}

fn area(position: [f64; 3], normal: [f64; 3]) -> DifferentialArea {
    DifferentialArea::new(position.into(), normal.into()).unwrap()
}

/// The polygon through these points, its front toward dA at `position`.
fn facing(position: [f64; 3], points: &[[f64; 3]]) -> PlanarPolygon {
    let polygon = PlanarPolygon::new([points]).unwrap();
    let towards = DVec3::from(position) - DVec3::from(points[0]);
    if polygon.normal().dot(towards) > 0.0 {
        return polygon;
    }
    let reversed: Vec<_> = points.iter().rev().copied().collect();
    PlanarPolygon::new([reversed]).unwrap()
}

fn ceiling([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Vec<[f64; 3]> {
    vec![[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]
}

fn wall(x: f64, [y0, y1]: [f64; 2], [z0, z1]: [f64; 2]) -> Vec<[f64; 3]> {
    vec![[x, y0, z0], [x, y1, z0], [x, y1, z1], [x, y0, z1]]
}

/// Every point entry: id, position of dA, its normal, the target.
fn setups() -> Vec<(&'static str, [f64; 3], [f64; 3], Vec<[f64; 3]>)> {
    let (o, z) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let ngon = (0..64).map(|i| f64::from(i) / 32.0 * std::f64::consts::PI);
    let ngon = ngon.map(|t| [t.cos(), t.sin(), 1.0]).collect();
    let (unit, two) = ([0.0, 1.0], [-1.0, 1.0]);
    vec![
        ("dA-par-corner-1-1-1", o, z, ceiling(unit, unit, 1.0)),
        ("dA-par-corner-2-3-0.5", o, z, ceiling([0.0, 2.0], [0.0, 3.0], 0.5)),
        ("dA-par-centre-2x2-z2", o, z, ceiling(two, two, 2.0)),
        ("dA-par-offset", [3.0, -1.0, 0.0], z, ceiling(unit, [0.0, 2.0], 1.0)),
        ("dA-perp-corner-1-1-1", o, z, wall(1.0, unit, unit)),
        ("dA-perp-corner-1-2-0.25", o, z, wall(0.25, [0.0, 2.0], unit)),
        ("dA-tri", o, z, vec![[1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]),
        (
            "dA-tri-generic",
            [0.1, 0.2, 0.3],
            [1.0, 2.0, 2.0],
            vec![[1.0, 0.0, 1.0], [0.0, 2.0, 3.0], [-1.0, 1.0, 2.0]],
        ),
        ("dA-ngon-64-r1-h1", o, z, ngon),
        ("dA-horizon-clip", o, z, wall(1.0, two, two)),
        ("dA-near-1e-3", o, z, ceiling(two, two, 1e-3)),
        ("dA-near-1e-6", o, z, ceiling(two, two, 1e-6)),
        ("dA-near-1e-9", o, z, ceiling(two, two, 1e-9)),
        ("dA-near-1e-12", o, z, ceiling(two, two, 1e-12)),
        ("dA-far-1e3", o, z, ceiling(two, two, 1e3)),
        ("dA-far-1e6", o, z, ceiling(two, two, 1e6)),
        ("dA-far-1e12", o, z, ceiling(two, two, 1e12)),
        ("dA-grazing-1e-3", o, z, wall(1e-3, two, [1.0, 2.0])),
        ("dA-grazing-1e-6", o, z, wall(1e-6, two, [1.0, 2.0])),
        ("dA-grazing-1e-9", o, z, wall(1e-9, two, [1.0, 2.0])),
        ("dA-grazing-1e-12", o, z, wall(1e-12, two, [1.0, 2.0])),
        ("dA-grazing-1e-15", o, z, wall(1e-15, two, [1.0, 2.0])),
        ("dA-wall-c-1e-3", o, z, wall(1e-3, two, unit)),
        ("dA-wall-c-1e-6", o, z, wall(1e-6, two, unit)),
        ("dA-wall-c-1e-9", o, z, wall(1e-9, two, unit)),
        ("dA-wall-c-1e-12", o, z, wall(1e-12, two, unit)),
    ]
}

#[test]
fn point_factors_equal_their_closed_forms() {
    for (id, position, normal, points) in setups() {
        let (gives, expected) = value(id);
        let (from, to) = (area(position, normal), facing(position, &points));
        let factor = match gives.as_str() {
            "complement" => unoccluded_complement(&from, &to),
            _ => unoccluded(&from, &to),
        };
        let (expected, slack) =
            if gives == "half_minus" { (0.5 - expected, 1.2e-16) } else { (expected, expected * 1.2e-16) };
        let error = (factor.value - expected).abs();
        println!(
            "{id:28} {:e} rel {:.1e} abs {:.1e} bound {:.1e}",
            factor.value,
            error / expected,
            error,
            factor.error_bound
        );
        assert!(
            error <= factor.error_bound + slack,
            "{id}: {error:e} is over the bound {:e}",
            factor.error_bound
        );
    }
}
