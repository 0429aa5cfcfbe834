//! The quick route: form factors in plain doubles, where these decide everything that matters for certain. Most are found here.
//!
//! A convex polygon seen from dA is a cone, the intersection of the half-spaces inside its edges' planes through dA. A piece of
//! an edge of the target is visible where no occluder's cone contains it. A piece of an occluder's edge is part of the visible
//! boundary where it is inside the target's cone and no other occluder's cone contains it. So the edges of every two cones that
//! may meet are clipped against each other, and Lambert's sum is taken over what is left: nothing is projected and no arrangement
//! is built [vertex tracing: Stark and Riesenfeld 2000]. The signs of all corners against all planes of two cones are found first;
//! they tell which edges cross, and divisions are needed for those alone.
//!
//! Every sign comes with a bound on its error. Where one end of an edge may lie on either side of a plane, the parameter of the
//! crossing errs by little, and the bound counts it. Where a whole edge may lie in a plane, the two edges must be one and the
//! same; if not, the exact route takes over. It does so too where a polygon is not convex, and where the bound would be too
//! large.
mod boundary;
mod classify;
mod clip;
mod cone;
mod contour;
mod corners;
mod inside;
mod interval;
mod lanes;
mod neighbours;
mod sides;
mod slopes;
pub(crate) mod target;
mod trace;

pub(crate) use contour::unoccluded;

use crate::form_factor::FormFactor;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::stats::Stats;
use classify::{Class, classify};
use cone::{Cones, Corner, Edge, Spread};
use glam::DVec3;
use target::{HalfSpace, Target};

/// The quick route's buffers, to be used again.
#[derive(Debug, Default)]
pub(crate) struct QuickBuffers {
    corners: [Vec<Corner>; 2],
    edges: Vec<Edge>,
    sides: Vec<HalfSpace>,
    spread: Spread,
    cones: Cones,
    trace: trace::TraceBuffers,
}

impl QuickBuffers {
    /// Whether the visible boundary is to be kept from now on.
    pub(crate) fn record(&mut self, is_kept: bool) {
        self.trace.record.is_kept = is_kept;
    }

    /// The visible boundary of the last form factor that was found, in parts of edges relative to dA.
    pub(crate) fn recorded(&self) -> impl Iterator<Item = [DVec3; 2]> {
        self.trace.record.parts.iter().copied()
    }
}

/// The form factor past the occluders that `occluders` finds for the target; `None` where doubles do not decide it.
pub(crate) fn form_factor<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl FnOnce(&Target) -> I,
    buffers: &mut QuickBuffers,
    stats: &mut Stats,
) -> Option<FormFactor>
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    let QuickBuffers { corners, edges, sides, spread, cones, trace } = buffers;
    trace.record.parts.clear();
    let target = Target::new(from, to, corners, edges, sides, spread)?;
    let mut open = 0.0;
    cones.clear();
    for occluder in occluders(&target) {
        stats.looked_at += 1;
        match classify(&target, occluder, corners, cones)? {
            Class::Misses { error } => {
                stats.culled += 1;
                open += error;
            }
            Class::Blocks { error, is_clipped } => {
                stats.clipped += u64::from(is_clipped);
                open += error;
            }
            Class::Covers => {
                stats.total += 1;
                return Some(FormFactor::default());
            }
        }
    }
    trace::sum(&target, cones, open, trace, stats)
}
