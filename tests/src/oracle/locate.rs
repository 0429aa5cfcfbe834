//! Where a point lies against rings, exactly.
use super::Operand;
use super::cut::{Edge, Homogeneous};
use super::winding::{contains, crossing, sign, turn};
use crate::exact::Grid;
use glam::DVec2;
use num_bigint::BigInt;
use num_traits::One;

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Its winding number is one of those that the rule takes.
    Inside,
    /// It is not.
    Outside,
    /// On an edge.
    OnEdge,
}

/// The place of a finite point by winding numbers.
pub fn locate(point: DVec2, operand: &Operand) -> Place {
    let grid = Grid::of(operand.rings.iter().flatten().chain([&point]));
    let at = Homogeneous { x: grid.steps(point.x), y: grid.steps(point.y), w: BigInt::one() };
    let mut winding = 0;
    for edge in super::collect(std::slice::from_ref(operand), |value| grid.steps(value)) {
        let turn = turn(&edge, &at);
        if turn == 0 && contains(&edge, &at) {
            return Place::OnEdge;
        }
        winding += crossing(levels(&edge, &at), 0, turn);
    }
    if operand.rule.holds(winding) { Place::Inside } else { Place::Outside }
}

/// Heights of an edge's ends against a grid point.
fn levels(edge: &Edge<BigInt>, point: &Homogeneous<BigInt>) -> [i32; 2] {
    [&edge.start, &edge.end].map(|end| sign(&(&end[1] - &point.y)))
}
