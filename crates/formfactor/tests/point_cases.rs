//! Occluded form factors against exact rational arithmetic.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, FormFactor, PlanarPolygon, by_hierarchy, form_factor, unoccluded};
use serde_json::Value;

struct Case {
    name: String,
    from: DifferentialArea,
    to: PlanarPolygon,
    occluders: Vec<PlanarPolygon>,
    expected: f64,
}

fn vector(v: &Value) -> DVec3 {
    let part = |i: usize| v[i].as_f64().unwrap();
    DVec3::new(part(0), part(1), part(2))
}

fn loops(v: &Value) -> Vec<Vec<DVec3>> {
    v.as_array().unwrap().iter().map(|l| l.as_array().unwrap().iter().map(vector).collect()).collect()
}

/// The cases, every coordinate times `scale`.
fn cases(scale: f64) -> Vec<Case> {
    let data: Value = serde_json::from_str(include_str!("data/form_factor_point.json")).unwrap();
    let polygon = |v: &Value| {
        let scaled: Vec<Vec<DVec3>> =
            loops(v).iter().map(|l| l.iter().map(|p| *p * scale).collect()).collect();
        PlanarPolygon::new(scaled).unwrap()
    };
    let case = |c: &Value| Case {
        name: c["name"].as_str().unwrap().to_owned(),
        from: DifferentialArea::new(vector(&c["point"]) * scale, vector(&c["normal"])).unwrap(),
        to: polygon(&c["target"]),
        occluders: c["occluders"].as_array().unwrap().iter().map(polygon).collect(),
        expected: c["form_factor"]
            .as_str()
            .map_or_else(|| c["form_factor"].as_f64().unwrap(), |s| s.parse().unwrap()),
    };
    data["cases"].as_array().unwrap().iter().map(case).collect()
}

/// Forward, backward, odd ones first, and from the middle outward.
fn orders(occluders: &[PlanarPolygon]) -> Vec<Vec<PlanarPolygon>> {
    let backward = occluders.iter().rev().cloned().collect();
    let odd_first = (1..occluders.len()).step_by(2).chain((0..occluders.len()).step_by(2));
    let odd_first = odd_first.map(|i| occluders[i].clone()).collect();
    let (left, right) = occluders.split_at(occluders.len() / 2);
    let rotated = right.iter().chain(left).cloned().collect();
    vec![occluders.to_vec(), backward, odd_first, rotated]
}

/// Half an ulp of the reference, which was rounded to a double.
fn tolerance(case: &Case) -> f64 {
    case.expected * f64::EPSILON / 2.0
}

fn check(case: &Case, factor: FormFactor, what: &str) {
    let error = (factor.value - case.expected).abs();
    assert!(factor.value >= 0.0, "{} ({what}): {:e} is negative", case.name, factor.value);
    let bound = factor.error_bound + tolerance(case);
    assert!(error <= bound, "{} ({what}): off by {error:e}, bound {bound:e}", case.name);
}

#[test]
fn every_case_keeps_its_promise_in_every_order_of_the_occluders() {
    for case in cases(1.0) {
        for (index, order) in orders(&case.occluders).iter().enumerate() {
            let factor = form_factor(&case.from, &case.to, order);
            let error = (factor.value - case.expected).abs();
            if index == 0 {
                println!(
                    "{:55} {:.16e} error {error:.1e} bound {:.1e}",
                    case.name, factor.value, factor.error_bound
                );
            }
            check(&case, factor, &format!("order {index}"));
            assert!(error <= 1e-15, "{}: off by {error:e}", case.name);
            assert!(
                factor.error_bound <= 1e-12,
                "{}: the bound {:e} says too little",
                case.name,
                factor.error_bound
            );
        }
    }
}

#[test]
fn covered_targets_are_exactly_zero() {
    for case in cases(1.0).iter().filter(|c| c.expected == 0.0) {
        for order in orders(&case.occluders) {
            assert_eq!(form_factor(&case.from, &case.to, &order).value, 0.0, "{}", case.name);
        }
    }
}

#[test]
fn occluders_have_two_sides() {
    for case in cases(1.0) {
        let reversed = |p: &PlanarPolygon| {
            let loops: Vec<Vec<DVec3>> = p.loops().map(|l| l.iter().rev().copied().collect()).collect();
            PlanarPolygon::new(loops).unwrap()
        };
        let occluders: Vec<PlanarPolygon> = case.occluders.iter().map(reversed).collect();
        check(&case, form_factor(&case.from, &case.to, &occluders), "reversed");
    }
}

#[test]
fn powers_of_two_change_no_bit() {
    let values = |scale: f64| -> Vec<FormFactor> {
        cases(scale).iter().map(|c| form_factor(&c.from, &c.to, &c.occluders)).collect()
    };
    let one = values(1.0);
    for scale in [0.25, 2.0_f64.powi(60), 2.0_f64.powi(-100)] {
        assert_eq!(values(scale), one, "scaled by {scale:e}");
    }
}

#[test]
fn the_hierarchy_agrees() {
    for case in cases(1.0) {
        check(&case, by_hierarchy(&case.from, &case.to, &case.occluders), "by hierarchy");
    }
}

#[test]
fn without_occluders_more_is_seen() {
    for case in cases(1.0) {
        let (free, seen) =
            (unoccluded(&case.from, &case.to), form_factor(&case.from, &case.to, &case.occluders));
        assert!(seen.value <= free.value + free.error_bound + seen.error_bound, "{}", case.name);
    }
}
