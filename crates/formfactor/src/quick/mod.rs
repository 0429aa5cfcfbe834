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
mod inside;
mod interval;
mod lanes;
mod neighbours;
mod seams;
mod sides;
mod slopes;
pub(crate) mod target;
mod trace;
mod uncovered;

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
use trace::Kept;
use uncovered::Uncovered;

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
    uncovered: Uncovered,
    /// The ids of the occluders that may hide some of the last target,
    pub(crate) blockers: Vec<usize>,
    /// and a bound on the form factor of what others may hide.
    pub(crate) others: f64,
}

impl QuickBuffers {
    /// What [`boundary`] or [`parts`] found last: parts of edges relative to dA.
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
    kept(Kept::Boundary, from, to, occluders, buffers)
}

/// The same with the boundaries of parts that make up what is visible: doubles decide these more often.
pub(crate) fn parts<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    buffers: &mut QuickBuffers,
) -> Option<FormFactor> {
    kept(Kept::Parts, from, to, occluders, buffers)
}

fn kept<'a>(
    kept: Kept,
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    buffers: &mut QuickBuffers,
) -> Option<FormFactor> {
    buffers.trace.record.kept = kept;
    let factor = form_factor(from, to, occluders, Some(ROUGH), buffers, &mut Stats::default());
    buffers.trace.record.kept = Kept::Nothing;
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
    buffers.others = 0.0;
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

/// The form factor of a convex piece of a polygon.
fn to_piece<'a>(
    from: &DifferentialArea,
    to: (&PlanarPolygon, &[DVec3]),
    occluders: impl Fn(&Reach, Taker<'_, 'a>),
    within: Option<f64>,
    buffers: &mut QuickBuffers,
    stats: &mut Stats,
) -> Option<FormFactor> {
    let QuickBuffers { corners, edges, ids, sides, spread, cones, trace, blockers, uncovered, others } =
        buffers;
    let Some(target) = Target::new(from, to, corners, (edges, ids), sides, spread) else {
        let error_bound = most_seen(from, to).filter(|most| *most <= within.unwrap_or(0.0))?;
        stats.none += 1;
        return Some(FormFactor { value: 0.0, error_bound });
    };
    // A boundary is wanted as it is.
    let is_rough = within.is_some() && trace.record.kept != Kept::Boundary;
    let most = within.unwrap_or(0.0) - target.error;
    let near = |taker: Taker<'_, 'a>| occluders(&Reach::Quick(&target), taker);
    let rough = is_rough.then_some((&mut *uncovered, most));
    match hidden(&target, near, corners, (cones, blockers), rough, stats)? {
        Hidden::Whole { error } => {
            *others += error;
            Some(FormFactor { value: 0.0, error_bound: error })
        }
        Hidden::Part { open } if is_rough && cones.len() > 0 => {
            let found = uncovered.form_factor(&target, open);
            let found = found.filter(|found| Some(found.error_bound) <= within);
            stats.partial += u64::from(found.is_some());
            if found.is_some() && trace.record.kept == Kept::Parts {
                trace.record.parts.extend(uncovered.edges());
            }
            found.or_else(|| trace::sum(&target, cones, (open, within), trace, stats))
        }
        Hidden::Part { open } => trace::sum(&target, cones, (open, within), trace, stats),
    }
}

/// What occluders hide of a target.
#[derive(Clone, Copy, Debug)]
enum Hidden {
    /// All of it, but for a form factor of at most `error`.
    Whole { error: f64 },
    /// What is inside the cones, or nothing where there are none; the form factor may be off by `open`.
    Part { open: f64 },
}

/// Puts the cones of what may hide some of the target in place of those before, and adds the ids; `None` where doubles do not decide it.
/// Where a form factor may be off by so much, as is given beside what is left of the target, no more are asked for when nothing is.
fn hidden<'a>(
    target: &Target,
    occluders: impl FnOnce(Taker<'_, 'a>),
    corners: &mut [Vec<Corner>; 2],
    (cones, blockers): (&mut Cones, &mut Vec<usize>),
    mut rough: Option<(&mut Uncovered, f64)>,
    stats: &mut Stats,
) -> Option<Hidden> {
    let (mut open, mut whole, mut is_decided) = (0.0, None, true);
    cones.clear();
    rough.iter_mut().for_each(|(uncovered, _)| uncovered.begin(target.cone));
    occluders(&mut |id, occluder| {
        stats.looked_at += 1;
        let known = cones.len();
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
                blockers.push(id);
                whole = Some(0.0);
            }
            None => is_decided = false,
        }
        if let Some((uncovered, most)) = &mut rough {
            (known..cones.len()).for_each(|cone| uncovered.subtract(cones.cone(cone)));
            let error = open + uncovered.error();
            whole = whole.or((uncovered.is_empty() && error <= *most).then_some(error + target.error));
        }
        if whole.is_none() && is_decided { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    stats.total += u64::from(whole.is_some());
    is_decided.then_some(whole.map_or(Hidden::Part { open }, |error| Hidden::Whole { error }))
}

/// Whether occluders may leave anything of a convex target visible; those that may hide some of it are noted in the buffers. `None` where
/// doubles do not decide it, or the target is not convex.
pub(crate) fn is_open<'a>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl IntoIterator<Item = (usize, &'a PlanarPolygon)>,
    buffers: &mut QuickBuffers,
) -> Option<bool> {
    let QuickBuffers { corners, edges, ids, sides, spread, cones, blockers, others, .. } = buffers;
    let mut pieces = to.convex_pieces();
    let piece = pieces.next().filter(|_| pieces.next().is_none())?;
    let target = Target::new(from, (to, piece), corners, (edges, ids), sides, spread)?;
    blockers.clear();
    *others = 0.0;
    let found = hidden(
        &target,
        |taker| each(occluders, taker),
        corners,
        (cones, blockers),
        None,
        &mut Stats::default(),
    )?;
    Some(matches!(found, Hidden::Part { .. }))
}
