//! Exact checks of a triangulation.
use crate::against::{sorted_edges, twice_area};
use crate::exact::{ratio, twice_signed_area};
use crate::oracle::sort;
use glam::DVec2;
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use polycsg::Region;
use std::collections::BTreeMap;

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
pub fn check_cover(region: &Region) -> Result<(), String> {
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
pub fn check_delaunay(region: &Region) -> Result<(), String> {
    let edges = edges(&region.triangulate());
    for &([a, b], c) in edges.values() {
        let other = edges.get(&bits([b, a])).map(|&(_, d)| d);
        if let Some(d) = other.filter(|&d| is_in_circle([a, b, c], d)) {
            return Err(format!("{d} lies in the circle of {a} {b} {c}"));
        }
    }
    Ok(())
}
