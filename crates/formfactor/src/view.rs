//! A target as a differential area sees it, before anything stands in between.
use crate::cull::Pyramid;
use crate::horizon::{Loops, Vertex, above, sight};
use crate::lambert::{self, Arc, ContourSum, Sight};
use crate::polygon::ROUNDING;
use crate::predicates::place;
use crate::twofold::{Offset, Twofold};
use crate::{DifferentialArea, PlanarPolygon, doubt};
use glam::DVec2;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// The part of a target above dA's horizon: as loops in space and, rounded, in the two kept coordinates of its plane.
#[derive(Debug)]
pub(crate) struct View<'a> {
    pub(crate) from: &'a DifferentialArea,
    pub(crate) to: &'a PlanarPolygon,
    /// dA's distance before the target's plane, times the length of the plane's normal: positive.
    pub(crate) height: Twofold,
    pub(crate) loops: Loops,
    pub(crate) flat: Vec<Vec<DVec2>>,
    /// A bound on what rounding the clip points of `flat` changes in the form factor of any part of the target.
    pub(crate) rounding: f64,
    /// What rounding of the target's vertices leaves open about the side on which dA lies.
    pub(crate) doubt: f64,
    pub(crate) pyramid: Pyramid,
}

impl<'a> View<'a> {
    /// `None` when the target turns its back or lies below the horizon: it is not seen, exactly.
    pub(crate) fn new(from: &'a DifferentialArea, to: &'a PlanarPolygon) -> Option<Self> {
        if to.plane().side_of(from.position()) != Ordering::Greater {
            return None;
        }
        let height = to.plane().side(from.position());
        let (loops, cut) = above(from, to);
        if loops.is_empty() {
            return None;
        }
        let spots: Vec<Vec<Spot>> =
            loops.iter().map(|l| l.iter().map(|v| spot(from, to, v)).collect()).collect();
        let flat: Vec<Vec<DVec2>> = spots.iter().map(|l| l.iter().map(|s| s.flat).collect()).collect();
        let pyramid = Pyramid::over(from, to, height.value.round(), &flat);
        let rounding = if cut { spots.iter().map(|l| swept(l)).sum() } else { 0.0 };
        let doubt = doubt::of_facing(from.position(), to);
        Some(Self { from, to, height: height.value, loops, flat, rounding, doubt, pyramid })
    }

    /// Lambert's sum over the target as it stands: right for a convex one.
    ///
    /// Edges on the horizon are added as such. Where dA is near the target's plane one passes it almost through, and what
    /// rounding of its ends might sweep were it any edge is far more than what that can change.
    pub(crate) fn contour(&self) -> ContourSum {
        let mut sum = ContourSum::new(self.from.normal());
        for vertices in &self.loops {
            let Some(last) = vertices.last() else { continue };
            for (a, b) in std::iter::once(last).chain(vertices).zip(vertices) {
                if self.is_on_horizon(a) && self.is_on_horizon(b) {
                    sum.add_horizon(sight(a), sight(b));
                } else {
                    sum.add(sight(a), sight(b));
                }
            }
        }
        sum
    }

    /// Whether a vertex lies on the horizon, exactly: it was clipped there, or given so. Not where vertices stand for
    /// others, which need not lie there.
    fn is_on_horizon(&self, vertex: &Vertex) -> bool {
        let place = |i: usize| place(self.from.given_normal(), self.from.position(), self.to.points()[i]);
        self.to.deviation() == 0.0 && vertex.given.is_none_or(|i| place(i) == Ordering::Equal)
    }

    /// The direction to a point of the target's plane: exact for the target's own vertices, else as near as doubles are,
    /// with the blur that rounding its two coordinates brought.
    pub(crate) fn sight(&self, flat: DVec2) -> Sight {
        let slack = self.to.deviation();
        let given = self.to.find(flat);
        if let Some(index) = given {
            let offset = Offset::between(self.from.position(), self.to.points()[index]);
            return sight(&Vertex { offset, given, slack, depth: Twofold::ZERO });
        }
        let seen = sight(&Vertex {
            offset: self.to.lift(self.from.position(), flat),
            given,
            slack,
            depth: Twofold::ZERO,
        });
        let anchor = self.to.flat(self.to.plane().corners[0]);
        // The dropped axis is the steepest: a step in a kept coordinate is at most sqrt 2 times as long in the plane.
        let step = 1.5 * ROUNDING * (flat.x.abs() + flat.y.abs());
        let slope = self.to.lift_error() * ((flat.x - anchor.x).abs() + (flat.y - anchor.y).abs());
        Sight { blur: seen.blur + (step + slope) / seen.toward.length(), ..seen }
    }
}

/// A vertex put on the target's plane: its rounded coordinates, the direction to it, and the blur that this brought.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) flat: DVec2,
    sight: Sight,
}

/// A vertex on the target's plane, its two kept coordinates rounded.
fn spot(from: &DifferentialArea, to: &PlanarPolygon, vertex: &Vertex) -> Spot {
    if let Some(index) = vertex.given {
        return Spot { flat: to.flat(to.points()[index]), sight: sight(vertex) };
    }
    let [u, v, _] = to.axes();
    let flat = [u, v].map(|axis| (Twofold::from(from.position()[axis]) + vertex.offset.0[axis]).round());
    Spot::measured(from, to, flat.into(), vertex)
}

impl Spot {
    /// The spot `flat`, its blur measured as the angle between the direction to it and that to the vertex it stands for.
    pub(crate) fn measured(
        from: &DifferentialArea,
        to: &PlanarPolygon,
        flat: DVec2,
        vertex: &Vertex,
    ) -> Self {
        let (toward, put) = (vertex.offset.round(), to.lift(from.position(), flat).round());
        let off = Arc::between(Sight { toward, blur: 0.0 }, Sight { toward: put, blur: 0.0 }).angle();
        let anchor = to.flat(to.plane().corners[0]);
        let slope = to.lift_error() * ((flat.x - anchor.x).abs() + (flat.y - anchor.y).abs()) / put.length();
        let blur = off * (1.0 + 16.0 * ROUNDING) + 4.0 * ROUNDING + slope + vertex.slack / toward.length();
        // NaN comes of a spot at dA itself: it may be anywhere.
        Self { flat, sight: Sight { toward, blur: if blur <= PI { blur } else { PI } } }
    }
}

/// A bound on the form factor of what the edges of a loop sweep when its spots move to where they stand for.
pub(crate) fn swept(spots: &[Spot]) -> f64 {
    let Some(last) = spots.last() else { return 0.0 };
    let edges = std::iter::once(last).chain(spots).zip(spots);
    edges.map(|(a, b)| lambert::swept(a.sight, b.sight)).sum()
}
