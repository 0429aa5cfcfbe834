//! Triangulations of nasty regions: they cover the region once, add no vertex, and are constrained Delaunay.
use glam::DVec2;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use polycsg::{Csg, FillRule, Region};
use std::collections::BTreeMap;
use tests::against::{csg, leaf, sorted_edges, twice_area};
use tests::exact::{ratio, twice_signed_area};
use tests::generators::{KINDS, lattice, nasty};
use tests::oracle::{Operation, sort};

type Triangle = [DVec2; 3];

/// An edge in an order of its own, to look it up.
fn bits([a, b]: [DVec2; 2]) -> [u64; 4] {
    [a.x, a.y, b.x, b.y].map(f64::to_bits)
}

/// Every directed edge of the triangles with the corner that lies opposite.
fn edges(triangles: &[Triangle]) -> BTreeMap<[u64; 4], ([DVec2; 2], DVec2)> {
    let edges = triangles.iter().flat_map(|&[a, b, c]| [([a, b], c), ([b, c], a), ([c, a], b)]);
    edges.map(|(edge, opposite)| (bits(edge), (edge, opposite))).collect()
}

/// The edges of all triangles whose opposite is no edge of another, sorted.
fn open_edges(triangles: &[Triangle]) -> Vec<[DVec2; 2]> {
    let edges = edges(triangles);
    let is_open = |&&([a, b], _): &&([DVec2; 2], DVec2)| !edges.contains_key(&bits([b, a]));
    let mut open: Vec<[DVec2; 2]> = edges.values().filter(is_open).map(|&(edge, _)| edge).collect();
    sort(&mut open);
    open
}

/// Every triangle counter-clockwise, their areas the region's, their open edges its own: so they cover it once.
fn check_cover(region: &Region) -> Result<(), String> {
    let triangles = region.triangulate();
    let areas: Vec<BigRational> = triangles.iter().map(|t| twice_signed_area([&t[..]])).collect();
    if !areas.iter().all(Signed::is_positive) {
        return Err("a triangle is not counter-clockwise".into());
    }
    if areas.iter().fold(BigRational::zero(), |sum, area| sum + area) != twice_area(region) {
        return Err("the triangles' areas do not add up to the region's".into());
    }
    if open_edges(&triangles) != sorted_edges(region) {
        return Err("the triangles are not bounded by the region's edges".into());
    }
    Ok(())
}

#[test]
fn triangles_cover_every_nasty_region_once() {
    for kind in 0..KINDS.len() {
        for seed in 0..30 {
            let pair = nasty(kind, seed);
            for operation in Operation::ALL {
                let region = csg(operation, leaf(&pair.a), leaf(&pair.b)).evaluate();
                check_cover(&region).unwrap_or_else(|e| panic!("{} {operation:?}: {e}", pair.name));
            }
        }
    }
}

/// Whether `d` lies inside the circle through the counter-clockwise `a b c`: the sign of a determinant of degree 4.
fn is_in_circle([a, b, c]: Triangle, d: DVec2) -> bool {
    let row = |p: DVec2| {
        let (x, y) = (ratio(p.x) - ratio(d.x), ratio(p.y) - ratio(d.y));
        let lift = &x * &x + &y * &y;
        [x, y, lift]
    };
    let [p, q, r] = [a, b, c].map(row);
    let minor = |u: &[BigRational; 3], v: &[BigRational; 3]| &u[0] * &v[1] - &u[1] * &v[0];
    (&p[2] * minor(&q, &r) - &q[2] * minor(&p, &r) + &r[2] * minor(&p, &q)).is_positive()
}

/// No edge but the region's own could be flipped to a better one.
fn check_delaunay(region: &Region) -> Result<(), String> {
    let edges = edges(&region.triangulate());
    for &([a, b], c) in edges.values() {
        if let Some(&(_, d)) = edges.get(&bits([b, a])) {
            if is_in_circle([a, b, c], d) {
                return Err(format!("{d} lies in the circle of {a} {b} {c}"));
            }
        }
    }
    Ok(())
}

#[test]
fn triangles_are_constrained_delaunay() {
    let is_ordinary = |name: &str| !["exponents", "subnormals"].iter().any(|part| name.contains(part));
    let kinds = (0..KINDS.len()).filter(|&kind| is_ordinary(KINDS[kind].0));
    let pairs = kinds.flat_map(|kind| (0..4).map(move |seed| nasty(kind, seed)));
    for pair in (0..150).map(lattice).chain(pairs) {
        let region = csg(Operation::Union, leaf(&pair.a), leaf(&pair.b)).evaluate();
        check_delaunay(&region).unwrap_or_else(|e| panic!("{}: {e}", pair.name));
    }
}

/// A disk of many corners minus a crowd of small squares, some of which touch: large, with holes of every kind.
#[test]
fn a_large_perforated_disk() {
    let circle = |count: u32, radius: f64| -> Vec<DVec2> {
        let corner =
            |i: u32| radius * DVec2::from_angle(f64::from(i) / f64::from(count) * std::f64::consts::TAU);
        (0..count).map(corner).collect()
    };
    let square = |i: u32, j: u32| {
        let low = DVec2::new(f64::from(i), f64::from(j)) * 0.5 - DVec2::splat(10.0);
        [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| low + p * 0.5).to_vec()
    };
    let squares =
        (0..40).flat_map(|i| (0..40).filter(move |j| (i + j) % 2 == 0 || j % 3 == 0).map(move |j| (i, j)));
    let squares = Csg::rings(squares.map(|(i, j)| square(i, j)), FillRule::NonZero).expect("finite");
    let disk = Csg::rings([circle(3000, 9.7)], FillRule::NonZero).expect("finite");
    let region = (disk - squares).evaluate();
    check_cover(&region).unwrap_or_else(|e| panic!("{e}"));
}
