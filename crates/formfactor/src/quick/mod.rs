//! The quick route: form factors in plain doubles, where these decide everything that matters for certain. Most are found here.
//!
//! A convex polygon seen from dA is a cone, the intersection of the half-spaces inside its edges' planes through dA. A piece of
//! an edge of the target is visible where no occluder's cone contains it. A piece of an occluder's edge is part of the visible
//! boundary where it is inside the target's cone and no other occluder's cone contains it. So the edges of every two cones that
//! may meet are clipped against each other, and Lambert's sum is taken over what is left: nothing is projected and no arrangement
//! is built [vertex tracing: Stark and Riesenfeld 2000]. The signs of all corners against all planes of two cones are found first;
//! they tell which edges cross, and divisions are needed for those alone.
//!
//! Every sign comes with a bound on its error, and is found exactly where that leaves it open and the vertices are known as given. Where one
//! end of an edge may lie on either side of a plane, the parameter of the crossing errs by little, and the bound counts it. Where
//! all of an edge lies exactly in the plane of another one, as edges of buildings do, one of the two counts as far as they run along each
//! other; where it may or may not, the exact route takes over. It does so too where the bound would be too large. Polygons that
//! are not convex are convex pieces that meet in whole edges: an edge between two of them is hidden by both.
mod boundary;
mod classify;
mod clip;
mod cone;
mod contour;
mod corners;
mod exact_side;
mod horizon;
mod inset;
mod inside;
mod interval;
mod lanes;
mod neighbours;
mod seams;
mod sides;
mod slopes;
pub(crate) mod target;
mod trace;

pub(crate) use contour::unoccluded;
pub(crate) use horizon::most_seen;

use crate::form_factor::FormFactor;
use crate::numeric::rounding::ROUNDING;
use crate::occluders::{Reach, Taker, each};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::stats::Stats;
use classify::{Class, classify};
use cone::{Cones, Corner, CornerId, Edge, Spread};
use glam::DVec3;
use std::cmp::Ordering;
use std::ops::ControlFlow;
use target::{HalfSpace, Target};

/// The quick route's buffers, to be used again.
#[derive(Debug, Default)]
pub(crate) struct QuickBuffers {
    corners: [Vec<Corner>; 2],
    edges: Vec<Edge>,
    ids: Vec<CornerId>,
    sides: Vec<HalfSpace>,
    spread: Spread,
    cones: Cones,
    trace: trace::TraceBuffers,
    /// The ids of the occluders that may hide some of the last target,
    pub(crate) blockers: Vec<usize>,
    /// and a bound on the form factor of what others may hide.
    pub(crate) lost: f64,
}

impl QuickBuffers {
    /// The visible boundary of the last target, if [`boundary`] found it: parts of edges relative to dA.
    pub(crate) fn recorded(&self) -> &[[DVec3; 2]] {
        &self.trace.record.parts
    }
}

/// The error up to which a form factor is good enough beside a boundary.
const ROUGH: f64 = 1e-9;

/// The form factor of a target whose visible boundary is kept, to be read off the buffers; `None` where doubles do not decide it.
pub(crate) fn boundary<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    buffers: &mut QuickBuffers,
) -> Option<FormFactor> {
    buffers.trace.record.is_kept = true;
    let factor = form_factor(from, to, occluders, Some(ROUGH), buffers, &mut Stats::default());
    buffers.trace.record.is_kept = false;
    factor
}

/// Of a target in more convex pieces the exact route sees the whole at once.
const MANY: usize = 16;

/// The form factor past the occluders that `occluders` finds for each convex piece of the target; `None` where doubles do not decide it, or
/// leave more open than is good enough: `within` or, where that is not given, little.
pub(crate) fn form_factor<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    within: Option<f64>,
    buffers: &mut QuickBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    buffers.trace.record.parts.clear();
    buffers.blockers.clear();
    buffers.lost = 0.0;
    let mut pieces = to.convex_pieces();
    let whole = pieces.next()?;
    let count = 1 + pieces.count();
    if count == 1 {
        return to_piece(from, (to, whole), &occluders, within, buffers, stats);
    }
    if count > MANY || to.plane().quick_side(from.position()) != Some(Ordering::Greater) {
        return None;
    }
    let share = within.map(|within| within / count as f64);
    let (mut value, mut error_bound) = (0.0_f64, 0.0);
    for piece in to.convex_pieces() {
        let part = to_piece(from, (to, piece), &occluders, share, buffers, stats)?;
        value += part.value;
        error_bound += part.error_bound;
    }
    *stats = stats.as_one();
    error_bound += count as f64 * ROUNDING * value;
    Some(FormFactor { value: value.min(1.0), error_bound })
}

/// The form factor of a convex piece of a polygon, or of a hair less of it where so much may be off and doubles decide that.
fn to_piece<'a>(
    from: &DifferentialArea,
    to: (&PlanarPolygon, &[DVec3]),
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    within: Option<f64>,
    buffers: &mut QuickBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    // A boundary is wanted where it is.
    let may_lose = within.filter(|_| !buffers.trace.record.is_kept).map(|within| within / 2.0);
    let before = buffers.lost;
    let found = of_piece(from, to, &occluders, (within, may_lose), buffers, stats);
    if found.is_some() || buffers.lost == before {
        return found;
    }
    buffers.lost = before;
    of_piece(from, to, &occluders, (within, None), buffers, stats)
}

/// That of the piece less what may be lost.
fn of_piece<'a>(
    from: &DifferentialArea,
    to: (&PlanarPolygon, &[DVec3]),
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    (within, may_lose): (Option<f64>, Option<f64>),
    buffers: &mut QuickBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    let QuickBuffers { corners, edges, ids, sides, spread, cones, trace, blockers, lost } = buffers;
    let Some(target) = Target::new(from, to, corners, (edges, ids), sides, spread, may_lose) else {
        let error_bound = most_seen(from, to).filter(|most| *most <= within.unwrap_or(0.0))?;
        stats.none += 1;
        return Some(FormFactor { value: 0.0, error_bound });
    };
    *lost += target.lost;
    let near = |taker: Taker<'_, 'a>| occluders(&Reach::Quick(&target), taker);
    match hidden(&target, near, corners, (cones, blockers), stats)? {
        Hidden::Whole => Some(FormFactor { value: 0.0, error_bound: target.lost }),
        Hidden::Part { open } if target.lost > 0.0 && cones.len() == 0 => {
            let open = open + target.lost;
            let target = Target::new(from, to, corners, (edges, ids), sides, spread, None)?;
            trace::sum(&target, cones, (open, within), trace, stats)
        }
        Hidden::Part { open } => trace::sum(&target, cones, (open, within), trace, stats),
    }
}

/// What occluders hide of a target.
#[derive(Clone, Copy, Debug)]
enum Hidden {
    /// All of it.
    Whole,
    /// What is inside the cones, or nothing where there are none; the form factor may be off by `open`.
    Part { open: f64 },
}

/// Puts the cones of what may hide some of the target in place of those before, and adds the ids; `None` where doubles do not decide it.
fn hidden<'a>(
    target: &Target,
    occluders: impl FnOnce(Taker<'_, 'a>),
    corners: &mut [Vec<Corner>; 2],
    (cones, blockers): (&mut Cones, &mut Vec<usize>),
    stats: &mut Stats,
) -> Option<Hidden> {
    let (mut open, mut hidden) = (0.0, None);
    let mut is_decided = true;
    cones.clear();
    occluders(&mut |id, occluder| {
        stats.looked_at += 1;
        match classify(target, occluder, corners, cones) {
            Some(Class::Misses { error }) => {
                stats.culled += 1;
                open += error;
                blockers.extend((error > 0.0).then_some(id));
            }
            Some(Class::Blocks { error, is_clipped }) => {
                stats.clipped += u64::from(is_clipped);
                open += error;
                blockers.push(id);
            }
            Some(Class::Covers) => {
                stats.total += 1;
                blockers.push(id);
                hidden = Some(Hidden::Whole);
                return ControlFlow::Break(());
            }
            None => {
                is_decided = false;
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    });
    is_decided.then_some(hidden.unwrap_or(Hidden::Part { open }))
}

/// Whether occluders may leave anything of a convex target visible; those that may hide some of it are noted in the buffers. `None` where
/// doubles do not decide it, or the target is not convex.
pub(crate) fn is_open<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl IntoIterator<Item = (usize, &'a PlanarPolygon)>,
    buffers: &mut QuickBuffers,
) -> Option<bool> {
    let QuickBuffers { corners, edges, ids, sides, spread, cones, blockers, lost, .. } = buffers;
    let mut pieces = to.convex_pieces();
    let piece = pieces.next().filter(|_| pieces.next().is_none())?;
    let target = Target::new(from, (to, piece), corners, (edges, ids), sides, spread, None)?;
    blockers.clear();
    *lost = 0.0;
    let found =
        hidden(&target, |taker| each(occluders, taker), corners, (cones, blockers), &mut Stats::default())?;
    Some(matches!(found, Hidden::Part { .. }))
}
