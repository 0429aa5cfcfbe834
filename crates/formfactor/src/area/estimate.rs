//! What quadrature rules may err by on a cell.
use super::point::Focus;
use crate::numeric::gauss::{RULE_1, RULE_2, RULE_3, RULE_4, RULE_6, RULE_8, RULE_12};

/// Rules by order.
pub(super) const RULES: [&[[f64; 2]]; 7] = [&RULE_1, &RULE_2, &RULE_3, &RULE_4, &RULE_6, &RULE_8, &RULE_12];

/// From this place on differences to the two rules before say what a rule may err by.
pub(super) const FINE: usize = 4;

/// How a cell sees the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellView {
    pub(super) focus: Focus,
    /// Whether it was cut at all events that change much.
    pub(super) is_cut: bool,
    /// How far it is from a parallelogram: the difference of two opposite sides, by the longest; 1 for a triangle.
    pub(super) skewness: f64,
    /// How far it is at least from what it looks at, by half of its longest side.
    pub(super) apart: f64,
}

/// What a rule of few nodes may err by on a cell, as a share of what it were with nothing in between.
///
/// What is hidden in part is a polynomial of degree 2 where planes are parallel and nearly one elsewhere: each order more
/// takes away one or two digits. The constants are three times the errors that 99 of 100 cells stayed below, in rooms with boxes.
/// Nearby they say nothing, and in between the next rule has to confirm them.
pub(super) fn a_priori(view: &CellView, order: usize) -> f64 {
    if view.apart < NEAR {
        return f64::INFINITY;
    }
    let ratio = 1.0 / view.apart;
    // Where sides differ, nodes' weights vary along the others: a degree is lost.
    let lost = (view.skewness * view.apart).max(1.0);
    lost * match (view.focus, order) {
        (Focus::Part, 0) => 0.3,
        (Focus::Part, 1) => 0.06 * ratio,
        (Focus::Part, 2) => 3e-3 * ratio.powi(2),
        (Focus::Part, _) => 3e-4 * ratio.powi(3),
        // By the remainder of Gauss's rule, raised for planes that cut polygons off, where factors fall to 0: of 18 000 random pairs
        // of parallelograms and triangles with sides of 1 to 1 000 none is off by more than half of this.
        _ => 20.0 * ratio.powi(2 * i32::try_from(RULES[order].len()).unwrap_or(i32::MAX)),
    }
}

/// A cell so close to what it looks at, in halves of its longest side, needs a fine rule.
const NEAR: f64 = 0.5;

/// How smooth an integrand is on a cell.
#[derive(Clone, Copy, Debug)]
pub(super) enum Smoothness {
    /// Analytic, with nothing singular nearer than so many halves of the longest side.
    Analytic { apart: f64 },
    /// Its second derivatives may jump along a curve, where edges of two shadows seem to cross on an edge.
    Bends,
}

impl Smoothness {
    /// By how much errors fall with a rule's nodes, up to a constant of the integrand.
    ///
    /// Where the integrand is analytic at all points of an ellipse around the foci -1 and 1 with semiaxes that add to r, n nodes
    /// err by less than C r^(-2n) [Trefethen, Approximation Theory and Approximation Practice, theorem 19.3]. Where its second derivative
    /// jumps, by C n^(-3) [Xiang and Bornemann 2012].
    ///
    /// The difference of two rules says what C is, as that of the coarser one's error. One alone may be small by chance, as may two: the
    /// largest of the last three counts. Distances are lower bounds, so that earlier ones exaggerate.
    pub(super) fn rate(self, order: usize) -> f64 {
        let nodes = i32::try_from(RULES[order].len()).unwrap_or(i32::MAX);
        match self {
            Self::Analytic { apart } => (apart + apart.hypot(1.0)).min(FAST).powi(-2 * nodes),
            Self::Bends => f64::from(nodes).powi(-3),
        }
    }
}

/// Faster rates than this need no telling apart.
const FAST: f64 = 1e6;

/// By so much the constant that differences say is raised. With 8, one of 140 000 factors past obstructions was off by 1.01 times its
/// estimate.
pub(super) const SURE: f64 = 12.0;
