//! The visible boundary, edge by edge: what the occluders leave of the target's edges, and what they and the target leave of
//! the occluders' edges.
use super::boundary::Boundary;
use super::cone::{Cones, Edge};
use super::contour::{Parts, Sum};
use super::exact_side::Span;
use super::interval::{Interval, for_each_gap};
use super::neighbours::Neighbours;
use super::seams::Seams;
use super::slopes::Frame;
use super::target::Target;
use crate::exact::whole::unhidden;
use crate::form_factor::FormFactor;
use crate::numeric::rounding::ROUNDING;
use crate::stats::Stats;
use glam::DVec3;

/// The buffers of [`sum`], to be used again.
#[derive(Debug, Default)]
pub(super) struct TraceBuffers {
    neighbours: Neighbours,
    seams: Seams,
    boundary: Boundary,
    hidden: Vec<Interval>,
    pub(super) record: Record,
}

/// What is to be known of what is visible, beside how much that is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kept {
    #[default]
    Nothing,
    /// Its boundary.
    Boundary,
    /// The boundaries of parts of it, or its own.
    Parts,
}

/// Boundaries in parts of edges, each with the visible part to its left as seen from the target's front.
#[derive(Debug, Default)]
pub(super) struct Record {
    pub(super) kept: Kept,
    pub(super) parts: Vec<[DVec3; 2]>,
}

impl Record {
    /// Notes the part of an edge between two parameters, reversed where the sign is negative; not of one through dA, which has no plane.
    fn add(&mut self, edge: &Edge, sign: f64, part: [f64; 2]) {
        if self.kept != Kept::Nothing && edge.inward != DVec3::ZERO {
            let [start, end] = part.map(|at| edge.start + edge.along * at);
            self.parts.push(if sign < 0.0 { [end, start] } else { [start, end] });
        }
    }
}

/// The error up to which the sum is good enough, by the angle that the target's boundary subtends where that is less than 1:
/// 2^-40, below 1e-12. Many small errors hardly add up; one large one may be true, and is good enough up to 2^-42.
const FINE: f64 = 8192.0 * ROUNDING;
const FINE_ALONE: f64 = FINE / 4.0;

/// The form factor of the target behind the cones: Lambert's sum over the visible boundary, with an error of at most `open`
/// from what was culled and cut. `None` where doubles leave more open, than `within` if that is given.
pub(super) fn sum(
    target: &Target,
    cones: &Cones,
    (open, within): (f64, Option<f64>),
    buffers: &mut TraceBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    let mut sum = Sum::new(target.from.normal());
    let error = target.error + open;
    if cones.len() == 0 {
        stats.none += 1;
        for edge in target.cone.edges {
            sum.add_whole(edge, &sum.line(edge.inward, edge.coarse_error()));
            buffers.record.add(edge, 1.0, [0.0, 1.0]);
        }
        let whole = || unhidden(target.from, target.to, open);
        return match within {
            _ if !target.is_whole => enough(target, &sum, error, within),
            Some(_) => enough(target, &sum, error, within).or_else(whole),
            None => sum.fine(error).or_else(whole),
        };
    }
    trace(target, cones, buffers, &mut sum)?;
    stats.partial += 1;
    stats.traced += 1;
    enough(target, &sum, error, within)
}

/// The form factor where it is known well enough: within what is asked for, or for the angle that the target subtends.
fn enough(target: &Target, sum: &Sum, error: f64, within: Option<f64>) -> Option<FormFactor> {
    if let Some(within) = within {
        return sum.form_factor(error).filter(|factor| factor.error_bound <= within);
    }
    let perimeter: f64 = target.cone.edges.iter().map(Edge::least_angle).sum();
    let scale = perimeter.min(1.0);
    let is_fine = sum.worst() <= FINE_ALONE * scale && error <= FINE_ALONE * scale;
    sum.form_factor(error).filter(|factor| is_fine && factor.error_bound <= FINE * scale)
}

/// Clips all edges, and adds what is left of them.
fn trace(target: &Target, cones: &Cones, buffers: &mut TraceBuffers, sum: &mut Sum) -> Option<()> {
    let TraceBuffers { neighbours, seams, boundary, hidden, record } = buffers;
    let frame = Frame::new(-target.to.plane().rounded(), target.to.axes()[2]);
    let span = Span { origin: target.from.position(), plane: target.to.plane() };
    boundary.begin(target.cone, cones);
    neighbours.clear();
    for cone in 0..cones.len() {
        if boundary.clip(&span, target.cone, cones, cone) {
            neighbours.push(frame.around(cones.cone(cone).edges), cone);
        }
    }
    if neighbours.are_many() {
        seams.clear();
        neighbours.cones().for_each(|cone| seams.push(cones.cone(cone), cones.first(cone)));
        seams.for_each(|edge| boundary.lose_edge(edge));
        boundary.watch(cones.len());
        for (around, outer) in neighbours.largest() {
            neighbours.inside(around).for_each(|inner| boundary.swallow(cones, [inner, outer]));
        }
        neighbours.retain(|cone| !boundary.is_swallowed(cone));
    }
    neighbours.for_each_pair(|pair| boundary.hide(&span, cones, pair));
    let (of_target, of_cones) = boundary.rests();
    let of_target = target.cone.edges.iter().zip(of_target).map(|(edge, rest)| (edge, rest, 1.0));
    // An occluder's edge has the visible part on its other side.
    let of_cones = cones.edges().iter().zip(of_cones).map(|(edge, rest)| (edge, rest, -1.0));
    for (edge, rest, sign) in of_target.chain(of_cones) {
        let Some(whole) = boundary.left(rest, hidden)? else { continue };
        add(edge, sign, whole, hidden, sum, record);
    }
    Some(())
}

/// Adds what is hidden leaves of a part of an edge to the sum, with a sign.
fn add(edge: &Edge, sign: f64, whole: Interval, hidden: &mut [Interval], sum: &mut Sum, record: &mut Record) {
    let mut line = sum.line(edge.inward, edge.error);
    line.cosine *= sign;
    if hidden.is_empty() && whole == Interval::WHOLE {
        sum.add_whole(edge, &line);
        record.add(edge, sign, [0.0, 1.0]);
    } else {
        let mut parts = Parts::of(edge, &line);
        for_each_gap(whole, hidden, |gap| {
            sum.add_part(edge, &line, gap, &mut parts);
            record.add(edge, sign, [gap.low.at, gap.high.at]);
        });
        sum.add_parts(&line, &parts);
    }
}
