//! Convex pieces of polygons.
use super::loops::leaf;
use super::polygon::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::Region;

/// Convex pieces that make up a polygon, counter-clockwise seen from its front: itself, or trapezoids.
pub(crate) fn pieces(polygon: &PlanarPolygon) -> Vec<Vec<DVec3>> {
    if polygon.is_convex() {
        return vec![polygon.points().to_vec()];
    }
    let raised = |ring: Vec<DVec2>| ring.iter().map(|p| polygon.raise(*p)).collect();
    trapezoids(&leaf(&polygon.flat_loops()).evaluate()).into_iter().map(raised).collect()
}

/// A region cut into trapezoids at the heights of its vertices.
pub(crate) fn trapezoids(region: &Region) -> Vec<Vec<DVec2>> {
    let rings: Vec<&[DVec2]> = region.rings().collect();
    let mut heights: Vec<f64> = rings.iter().flat_map(|ring| ring.iter()).map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    heights.windows(2).flat_map(|pair| between(&rings, pair[0], pair[1])).collect()
}

/// What lies between two heights with no vertex in between: left and right sides take turns.
fn between(rings: &[&[DVec2]], low: f64, high: f64) -> Vec<Vec<DVec2>> {
    let edges = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let mut sides: Vec<[DVec2; 2]> = edges
        .map(|(a, b)| if a.y <= b.y { (a, b) } else { (b, a) })
        .filter(|(a, b)| a.y <= low && b.y >= high)
        .map(|(a, b)| [low, high].map(|y| at_height(*a, *b, y)))
        .collect();
    sides.sort_by(|a, b| (a[0].x + a[1].x).total_cmp(&(b[0].x + b[1].x)));
    let trapezoid = |pair: &[[DVec2; 2]]| {
        let mut corners = vec![pair[0][0], pair[1][0], pair[1][1], pair[0][1]];
        corners.dedup();
        corners.truncate(corners.len() - usize::from(corners.last() == corners.first()));
        corners
    };
    sides.chunks_exact(2).map(trapezoid).filter(|corners| corners.len() > 2).collect()
}

fn at_height(a: DVec2, b: DVec2, y: f64) -> DVec2 {
    if y == a.y {
        a
    } else if y == b.y {
        b
    } else {
        DVec2::new(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)), y)
    }
}
