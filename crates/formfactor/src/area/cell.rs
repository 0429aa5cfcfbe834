//! Pieces of the polygon that is integrated over, in its two kept coordinates.
use crate::shapes::{loops::leaf, polygon::PlanarPolygon};
use glam::DVec2;

/// A convex quadrilateral, counter-clockwise; its last two corners are one in a triangle.
pub(super) type Cell = [DVec2; 4];

/// Cells that make up a polygon: itself, or trapezoids between the heights of its vertices.
pub(super) fn cells(polygon: &PlanarPolygon) -> Vec<Cell> {
    if polygon.is_convex() {
        return fan(&polygon.flat_loops()[0]);
    }
    let region = leaf(&polygon.flat_loops()).evaluate();
    let rings: Vec<&[DVec2]> = region.rings().collect();
    let mut heights: Vec<f64> = rings.iter().flat_map(|ring| ring.iter()).map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    heights.windows(2).flat_map(|pair| trapezoids(&rings, pair[0], pair[1])).collect()
}

/// What lies between two heights with no vertex in between: left and right sides take turns.
fn trapezoids(rings: &[&[DVec2]], low: f64, high: f64) -> Vec<Cell> {
    let edges = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let mut sides: Vec<[DVec2; 2]> = edges
        .map(|(a, b)| if a.y <= b.y { (a, b) } else { (b, a) })
        .filter(|(a, b)| a.y <= low && b.y >= high)
        .map(|(a, b)| [low, high].map(|y| at_height(*a, *b, y)))
        .collect();
    sides.sort_by(|a, b| (a[0].x + a[1].x).total_cmp(&(b[0].x + b[1].x)));
    sides.chunks_exact(2).map(|pair| [pair[0][0], pair[1][0], pair[1][1], pair[0][1]]).collect()
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

/// A convex polygon as cells around its first corner.
fn fan(corners: &[DVec2]) -> Vec<Cell> {
    let Some((first, rest)) = corners.split_first() else { return Vec::new() };
    let cell = |i: usize| [*first, rest[i], rest[i + 1], rest[(i + 2).min(rest.len() - 1)]];
    (0..rest.len().saturating_sub(1)).step_by(2).map(cell).collect()
}

/// The area of a cell.
pub(super) fn area(cell: &Cell) -> f64 {
    (cell[2] - cell[0]).perp_dot(cell[3] - cell[1]) / 2.0
}

/// Two halves, along the middles of the longer two of opposite sides.
pub(super) fn halves([a, b, c, d]: Cell) -> [Cell; 2] {
    if a.distance(b) + c.distance(d) >= b.distance(c) + d.distance(a) {
        let (low, high) = (a.midpoint(b), c.midpoint(d));
        [[a, low, high, d], [low, b, c, high]]
    } else {
        let (right, left) = (b.midpoint(c), d.midpoint(a));
        [[a, b, right, left], [left, right, c, d]]
    }
}

/// A piece that is smaller than this share of its cell or of `whole` is not worth a cut.
const SLIGHT: f64 = 1e-9;

/// A cell cut along the line of a segment that passes through it, as cells; `None` when none does. `whole` is the area of
/// what is cut up in all.
pub(super) fn cut(cell: &Cell, segment: [DVec2; 2], whole: f64) -> Option<Vec<Cell>> {
    let [start, end] = within(cell, segment)?;
    let way = (end - start).try_normalize()?;
    let heights = cell.map(|p| way.perp_dot(p - start));
    let [left, right] = [1.0, -1.0].map(|sign| fan(&kept(cell, heights.map(|h| sign * h))));
    let size = |cells: &[Cell]| cells.iter().map(area).sum::<f64>();
    let least = SLIGHT * area(cell).max(whole);
    (size(&left) > least && size(&right) > least).then(|| [left, right].concat())
}

/// The part of a segment that is inside a cell.
fn within(cell: &Cell, [start, end]: [DVec2; 2]) -> Option<[DVec2; 2]> {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for (i, a) in cell.iter().enumerate() {
        let side = cell[(i + 1) % 4] - *a;
        let (from, to) = (side.perp_dot(start - *a), side.perp_dot(end - *a));
        match (from < 0.0, to < 0.0) {
            (true, true) => return None,
            (true, false) => low = low.max(from / (from - to)),
            (false, true) => high = high.min(from / (from - to)),
            (false, false) => (),
        }
    }
    (low < high).then(|| [low, high].map(|share| start.lerp(end, share)))
}

/// The part of a cell at heights that are not negative.
fn kept(cell: &Cell, heights: [f64; 4]) -> Vec<DVec2> {
    let mut corners = Vec::with_capacity(6);
    for i in 0..4 {
        let (j, here, next) = ((i + 1) % 4, heights[i], heights[(i + 1) % 4]);
        if here >= 0.0 {
            corners.push(cell[i]);
        }
        if (here < 0.0 && next > 0.0) || (here > 0.0 && next < 0.0) {
            corners.push(cell[i] + (cell[j] - cell[i]) * (here / (here - next)));
        }
    }
    corners.dedup();
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(size: f64) -> impl Strategy<Value = DVec2> {
        (-size..size, -size..size).prop_map(DVec2::from)
    }

    proptest! {
        #[test]
        fn the_pieces_of_a_cell_add_up_to_it(
            corner in point(1.0), sides in (0.1..1.0, 0.1..1.0, -0.5..0.5, -0.5..0.5), through in point(1.0), to in point(1.0),
            far in prop_oneof![Just(1.0), 1.0..1e3, Just(1e12)],
        ) {
            let (u, v) = (DVec2::new(sides.0, sides.2 * sides.0), DVec2::new(sides.3 * sides.1, sides.1));
            let cell = [corner, corner + u, corner + u + v, corner + v];
            let way = (to - through) * far;
            if let Some(pieces) = cut(&cell, [through - way, through + way], 0.0) {
                let sum: f64 = pieces.iter().map(area).sum();
                prop_assert!((sum / area(&cell) - 1.0).abs() < 1e-12, "{sum} of {}", area(&cell));
                prop_assert!(pieces.iter().all(|piece| area(piece) >= -1e-15));
            }
        }
    }
}
