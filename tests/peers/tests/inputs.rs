//! What the inputs promise to peers with rules of validity, and that all engines understand them alike.

#![allow(clippy::unwrap_used, reason = "a test stops at whatever is missing")]

use peers::engines::{PEERS, POLYCSG, POLYCSG_BOUNDARY, POLYCSG_REGIONS, POLYCSG_REGIONS_BOUNDARY};
use peers::job::{Job, Polygon};
use peers::shapes::{family, is_fetched};
use polycsg::{FillRule, Region};

/// Small inputs of each generated kind.
fn jobs() -> Vec<(&'static str, Job)> {
    let sizes = [
        ("square-triangle", 0),
        ("square-rectangles", 60),
        ("octagons", 300),
        ("stars", 200),
        ("combs", 60),
        ("blobs", 400),
        ("annuli", 20),
        ("holes", 50),
        ("grid", 12),
        ("checkers-shifted", 12),
        ("checkers-complement", 12),
    ];
    sizes.into_iter().map(|(name, size)| (name, (family(name).unwrap().make)(size).unwrap())).collect()
}

fn region(rings: &[Vec<[f64; 2]>], rule: FillRule) -> Region {
    Region::from_rings(rings, rule).unwrap()
}

/// Rings that are simple, nested and turned rightly fill the same set under all rules.
fn assert_rules_agree(name: &str, polygon: &Polygon) {
    let [odd, wound, positive] =
        [FillRule::EvenOdd, FillRule::NonZero, FillRule::Positive].map(|rule| region(polygon, rule));
    assert_eq!(odd, wound, "{name}");
    assert_eq!(wound, positive, "{name}");
    assert_eq!(wound.polygons().count(), 1, "{name}");
}

#[test]
fn polygons_are_valid() {
    for (name, job) in jobs() {
        job.subject.iter().chain(&job.clip).for_each(|polygon| assert_rules_agree(name, polygon));
    }
}

#[test]
fn disjoint_polygons_fill_the_sum_of_their_areas() {
    for (name, job) in jobs().into_iter().filter(|(_, job)| job.disjoint) {
        for operand in [&job.subject, &job.clip] {
            let sum: f64 = operand.iter().map(|polygon| region(polygon, FillRule::NonZero).area()).sum();
            let all = region(&operand.concat(), FillRule::NonZero).area();
            assert!((sum - all).abs() <= 1e-12 * sum, "{name}: {sum} {all}");
        }
    }
}

#[test]
fn engines_agree() {
    for (name, job) in jobs() {
        let area = (POLYCSG.load)(&job).unwrap().outcome().unwrap().area;
        let ours = [POLYCSG_BOUNDARY, POLYCSG_REGIONS, POLYCSG_REGIONS_BOUNDARY];
        for engine in ours.iter().chain(PEERS) {
            let outcome = (engine.load)(&job).unwrap().outcome().unwrap();
            let error = (outcome.area - area).abs();
            assert!(error <= 1e-6 * area, "{name}, {}: {} for {area}", engine.name, outcome.area);
        }
    }
}

/// On this projection (longitude, sine of latitude) areas are those on the sphere.
fn share_of_the_globe(polygons: &[Polygon]) -> f64 {
    let project = |p: &[f64; 2]| [p[0].to_radians(), p[1].to_radians().sin()];
    let rings: Vec<_> = polygons.iter().flatten().map(|ring| ring.iter().map(project).collect()).collect();
    region(&rings, FillRule::NonZero).area() / (4.0 * std::f64::consts::PI)
}

#[test]
fn maps_cover_what_they_show() {
    if !is_fetched() {
        return;
    }
    // Land covers 29.2 % of the Earth; the United States with their inland waters, without the Great Lakes,
    // 9.37 of 510 million square kilometres.
    for (name, scale, share) in [("land", 50, 0.292), ("countries", 50, 0.292), ("counties", 10, 0.0184)] {
        let job = (family(name).unwrap().make)(scale).unwrap();
        let found = share_of_the_globe(&job.subject);
        assert!((found / share - 1.0).abs() < 0.03, "{name}: {found}");
    }
}
