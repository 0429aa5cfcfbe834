//! Pieces of a polygon that is integrated over.
use crate::numeric::gauss::RULE_2;
use glam::DVec3;

/// A plane convex quadrilateral; its last two corners are one in a triangle.
pub(crate) type Cell = [DVec3; 4];

/// A convex polygon as cells around its first corner.
pub(crate) fn fan(corners: &[DVec3]) -> Vec<Cell> {
    let Some((first, rest)) = corners.split_first() else { return Vec::new() };
    let cell = |i: usize| [*first, rest[i], rest[i + 1], rest[(i + 2).min(rest.len() - 1)]];
    (0..rest.len().saturating_sub(1)).step_by(2).map(cell).collect()
}

/// The area of a cell.
pub(crate) fn area(cell: &Cell) -> f64 {
    (cell[2] - cell[0]).cross(cell[3] - cell[1]).length() / 2.0
}

/// Two halves, along the middles of the longer two of opposite sides.
pub(crate) fn halves([a, b, c, d]: Cell) -> [Cell; 2] {
    if a.distance(b) + c.distance(d) >= b.distance(c) + d.distance(a) {
        let (low, high) = (a.midpoint(b), c.midpoint(d));
        [[a, low, high, d], [low, b, c, high]]
    } else {
        let (right, left) = (b.midpoint(c), d.midpoint(a));
        [[a, b, right, left], [left, right, c, d]]
    }
}

/// The nodes of a rule's product with itself on a cell, with their weights, which add to its area.
pub(crate) fn nodes<'a>(
    [a, b, c, d]: &'a Cell,
    rule: &'a [[f64; 2]],
) -> impl Iterator<Item = (DVec3, f64)> + 'a {
    rule.iter().flat_map(move |&[v, across]| {
        let (left, right) = (a.lerp(*d, v), b.lerp(*c, v));
        rule.iter().map(move |&[u, along]| {
            let up = (*d - *a).lerp(*c - *b, u);
            (left.lerp(right, u), along * across * (right - left).cross(up).length())
        })
    })
}

/// Four nodes of a cell, by coordinate, and their weights.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Nodes {
    pub(crate) x: [f64; 4],
    pub(crate) y: [f64; 4],
    pub(crate) z: [f64; 4],
    pub(crate) weights: [f64; 4],
}

impl Nodes {
    /// Exact up to degree 3 in a parallelogram and in a triangle, which has its own rule across.
    pub(crate) fn of(cell: &Cell) -> Self {
        let [a, b, c, d] = cell;
        let mut all = Self::default();
        let rows = if c == d { TO_A_CORNER } else { RULE_2 };
        for (i, [v, across]) in rows.into_iter().enumerate() {
            let (left, right) = (a.lerp(*d, v), b.lerp(*c, v));
            for (j, [u, along]) in RULE_2.into_iter().enumerate() {
                let point = left.lerp(right, u);
                let size = if c == d {
                    area(cell)
                } else {
                    (right - left).cross((*d - *a).lerp(*c - *b, u)).length()
                };
                let k = 2 * i + j;
                (all.x[k], all.y[k], all.z[k], all.weights[k]) =
                    (point.x, point.y, point.z, along * across * size);
            }
        }
        all
    }
}

/// Two nodes from a side of a triangle to the corner across, for the weight 2 - 2 v [Gauss and Jacobi].
const TO_A_CORNER: [[f64; 2]; 2] =
    [[0.155_051_025_721_682_2, 0.636_082_763_487_954_2], [0.644_948_974_278_317_8, 0.363_917_236_512_045_8]];
