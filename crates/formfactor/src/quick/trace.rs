//! The visible boundary, edge by edge: what the occluders leave of the target's edges, and what they and the target leave of
//! the occluders' edges.
use super::cone::{Cones, Edge, Frame, Slopes};
use super::contour::{Parts, Sum};
use super::inside::{Inside, inside};
use super::interval::{Interval, for_each_gap};
use super::{neighbours::Neighbours, target::Target};
use crate::exact::whole::unhidden;
use crate::form_factor::FormFactor;
use crate::numeric::rounding::ROUNDING;
use crate::stats::Stats;

/// The buffers of [`sum`], to be used again.
#[derive(Debug, Default)]
pub(super) struct TraceBuffers {
    neighbours: Neighbours,
    hidden: Vec<Interval>,
    extents: Vec<Slopes>,
}

/// The error up to which the sum is good enough, by the angle that the target's boundary subtends where that is less than 1:
/// 2^-40, below 1e-12. Many small errors hardly add up; one large one may be true, and is good enough up to 2^-42.
const FINE: f64 = 8192.0 * ROUNDING;
const FINE_ALONE: f64 = FINE / 4.0;

/// The form factor of the target behind the cones: Lambert's sum over the visible boundary, with an error of at most `open`
/// from what was culled and cut. `None` where doubles leave more open.
pub(super) fn sum(
    target: &Target,
    cones: &mut Cones,
    open: f64,
    TraceBuffers { neighbours, hidden, extents }: &mut TraceBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    let mut sum = Sum::new(target.from.normal());
    let error = target.error + open;
    if cones.len() == 0 {
        stats.none += 1;
        target.edges.iter().for_each(|edge| sum.add_whole(edge, &sum.line(edge.inward, edge.coarse_error())));
        return sum.fine(error).or_else(|| unhidden(target.from, target.to, open));
    }
    let frame = Frame::new(-target.to.plane().rounded(), target.to.axes()[2]);
    cones.measure(&frame);
    extents.clear();
    frame.measure(target.edges, extents);
    neighbours.find(cones);
    for (edge, extent) in target.edges.iter().zip(&*extents) {
        let near = (0..cones.len()).filter(|other| cones.extent(*other).meets(extent));
        trace(edge, Interval::WHOLE, Owner::Target, near, cones, hidden, &mut sum)?;
    }
    let whole = extents.iter().copied().reduce(Slopes::join)?;
    for cone in 0..cones.len() {
        let edges = cones.edges(cone).iter().zip(cones.edge_extents(cone));
        for (edge, extent) in edges.filter(|(_, extent)| whole.meets(extent)) {
            // An occluder's edge counts only where the target is behind it. One along an edge of the target is that edge's.
            let Inside::Part(before) = inside(edge, target.edges)? else { continue };
            let near = neighbours.of(cone).filter(|other| cones.extent(*other).meets(extent));
            trace(edge, before, Owner::Occluder(cone), near, cones, hidden, &mut sum)?;
        }
    }
    stats.partial += 1;
    stats.traced += 1;
    let perimeter: f64 = target.edges.iter().map(Edge::least_angle).sum();
    let scale = perimeter.min(1.0);
    let is_fine = sum.worst() <= FINE_ALONE * scale && error <= FINE_ALONE * scale;
    sum.form_factor(error).filter(|factor| is_fine && factor.error_bound <= FINE * scale)
}

/// The polygon whose edge is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Owner {
    Target,
    Occluder(usize),
}

impl Owner {
    /// Whether an edge that cone `other` shares is no part of the visible boundary. The other polygon runs along it the same
    /// way or the other way.
    ///
    /// The same way, both polygons are on one side of the edge. Two occluders have it on the boundary of their union: the first of
    /// the two keeps it. An edge of the target is hidden. The other way, the polygons are on either side: the edge is inside the
    /// union of two occluders, and both lose it.
    fn loses(self, other: usize, is_same_way: bool) -> bool {
        match self {
            Owner::Target => is_same_way,
            Owner::Occluder(cone) => !is_same_way || other < cone,
        }
    }
}

/// Adds what the cones leave of a part of an edge to the sum.
fn trace(
    edge: &Edge,
    whole: Interval,
    owner: Owner,
    near: impl Iterator<Item = usize>,
    cones: &Cones,
    hidden: &mut Vec<Interval>,
    sum: &mut Sum,
) -> Option<()> {
    hidden.clear();
    for other in near {
        match inside(edge, cones.edges(other))? {
            Inside::Part(part) if part.covers(&whole) => return Some(()),
            Inside::Part(part) => hidden.push(part),
            Inside::Twin { is_same_way } if owner.loses(other, is_same_way) => return Some(()),
            Inside::Twin { .. } | Inside::Nothing => (),
        }
    }
    let mut line = sum.line(edge.inward, edge.error);
    if owner != Owner::Target {
        // An occluder's edge has the visible part on its other side.
        line.cosine = -line.cosine;
    }
    if hidden.is_empty() && whole == Interval::WHOLE {
        sum.add_whole(edge, &line);
    } else {
        let mut parts = Parts::default();
        for_each_gap(whole, hidden, |gap| sum.add_part(edge, &line, gap, &mut parts));
        sum.add_parts(edge, &line, parts);
    }
    Some(())
}
