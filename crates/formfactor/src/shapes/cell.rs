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
    pub(crate) fn of(cell: &Cell) -> Self {
        let mut all = Self::default();
        for (i, (point, weight)) in nodes(cell, &RULE_2).enumerate() {
            (all.x[i], all.y[i], all.z[i], all.weights[i]) = (point.x, point.y, point.z, weight);
        }
        all
    }
}
