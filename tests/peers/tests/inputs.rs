//! What the inputs promise to peers with rules of validity, and that all engines understand them alike.

#![allow(clippy::unwrap_used, reason = "a test stops at whatever is missing")]

use peers::engines::{PEERS, ROUTES};
use peers::job::{Job, Parts, Polygon, Ring};
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
        ("smooth-intersection", 512),
        ("smooth-union", 8),
        ("ragged-intersection", 256),
        ("tiles", 16),
        ("neighbours", 64),
        ("clips-smooth", 100),
        ("clips-spiky", 16),
        ("parcels", 400),
        ("skyline", 100),
        ("baseline-random", 50),
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
        job.subjects.iter().chain(&job.clips).flatten().for_each(|polygon| assert_rules_agree(name, polygon));
    }
}

#[test]
fn disjoint_polygons_fill_the_sum_of_their_areas() {
    for (name, job) in jobs().into_iter().filter(|(_, job)| job.parts != Parts::Overlapping) {
        for operand in job.subjects.iter().chain(&job.clips) {
            let sum: f64 = operand.iter().map(|polygon| region(polygon, FillRule::NonZero).area()).sum();
            let all = region(&operand.concat(), FillRule::NonZero).area();
            assert!((sum - all).abs() <= 1e-12 * sum, "{name}: {sum} {all}");
        }
    }
}

#[test]
fn engines_agree() {
    for (name, job) in jobs() {
        let first = (ROUTES[0].load)(&job).unwrap().outcome().unwrap();
        assert_eq!(first.areas.len(), job.subjects.len(), "{name}");
        for engine in ROUTES.iter().chain(PEERS).filter(|engine| (engine.fits)(&job)) {
            let outcome = (engine.load)(&job).unwrap().outcome().unwrap();
            assert_eq!(outcome.areas.len(), first.areas.len(), "{name}, {}", engine.name);
            let error = outcome.error(&first);
            assert!(error <= 1e-6, "{name}, {}: {error}", engine.name);
        }
    }
}

/// A coverage has no edge that more than two polygons share, and those of two run opposite ways.
#[test]
fn coverages_share_their_borders() {
    for (name, job) in jobs().into_iter().filter(|(_, job)| job.parts == Parts::Coverage) {
        let mut edges: Vec<[[u64; 2]; 2]> = Vec::new();
        let bits = |p: [f64; 2]| p.map(f64::to_bits);
        for ring in job.subjects.iter().flatten().flatten() {
            edges.extend(ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [bits(*a), bits(*b)]));
        }
        edges.sort_unstable();
        assert!(edges.windows(2).all(|pair| pair[0] != pair[1]), "{name}");
        let shared = edges.iter().filter(|[a, b]| edges.binary_search(&[*b, *a]).is_ok()).count();
        let all: Vec<Ring> = job.subjects.concat().concat();
        let outline: usize = region(&all, FillRule::NonZero).rings().map(<[_]>::len).sum();
        assert_eq!(edges.len() - shared, outline, "{name}");
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
        let found = share_of_the_globe(&job.subjects[0]);
        assert!((found / share - 1.0).abs() < 0.03, "{name}: {found}");
    }
}
