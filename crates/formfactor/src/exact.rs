//! The exact form factor: the stages, one after the other.
use crate::cull::{Hidden, Pyramid, hidden};
use crate::pool::Buffers;
use crate::project::Shadow;
use crate::stats::Stats;
use crate::view::View;
use crate::visible::visible_sum;
use crate::{DifferentialArea, PlanarPolygon, cubature, doubt, quick};
use glam::DVec2;
use polycsg::Scratch;

/// A form factor and how far it may be from the exact one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FormFactor {
    /// The fraction of the power leaving dA that reaches the target: between 0 and 1.
    pub value: f64,
    /// A bound: |value - exact| <= error_bound, where exact is for the input's doubles as given.
    pub error_bound: f64,
}

/// The form factor from a differential area to the front of a polygon, past occluders.
///
/// An occluder blocks a ray from dA to a point of the target exactly when it meets the ray strictly between them. An
/// occluder that is coplanar with the target, or whose plane contains dA, blocks nothing. A dA on or behind the target's
/// plane sees exactly 0, and so does one whose view of the target a single convex occluder covers.
///
/// The value depends on the order of `occluders` at most within the bounds, and not on their orientation. Takes time
/// linear in what culling drops, and that of one polygon Boolean for the rest.
#[must_use]
pub fn form_factor(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> FormFactor {
    if occluders.is_empty() {
        return unoccluded(from, to);
    }
    let mut buffers = Buffers::default();
    let Buffers { quick, scratch, stats } = &mut buffers;
    quick::form_factor(from, to, |_| occluders, quick, stats)
        .unwrap_or_else(|| by_csg(from, to, |_| occluders, scratch, stats))
}

/// The form factor from a differential area to the front of a polygon with nothing in between.
#[must_use]
pub fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    quick::unoccluded(from, to).unwrap_or_else(|| {
        let Buffers { quick, scratch, stats } = &mut Buffers::default();
        quick::form_factor(from, to, |_| [], quick, stats)
            .unwrap_or_else(|| by_csg(from, to, |_| [], scratch, stats))
    })
}

/// [`form_factor`] past what `occluders` finds for the target's pyramid, every decision exact.
pub(crate) fn by_csg<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl FnOnce(&Pyramid) -> I,
    scratch: &mut Scratch,
    stats: &mut Stats,
) -> FormFactor
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    *stats = Stats::default();
    let Some(view) = View::new(from, to) else {
        stats.none += 1;
        return unseen(from, to);
    };
    match shadows(&view, occluders(&view.pyramid), stats) {
        Shadows::Total => {
            stats.total += 1;
            FormFactor::default()
        }
        Shadows::Some(shadows, doubt) => {
            if shadows.is_empty() {
                stats.none += 1;
            } else {
                stats.partial += 1;
            }
            if shadows.is_empty() && to.is_convex() {
                return whole(&view, view.doubt + doubt);
            }
            stats.csg_edges +=
                edge_count(&view.flat) + shadows.iter().map(|s| edge_count(&s.loops)).sum::<u64>();
            visible_sum(&view, &shadows, scratch).form_factor(view.rounding + view.doubt + doubt)
        }
    }
}

/// The form factor of a convex target of which it is known that nothing hides it but what `doubt` leaves open.
pub(crate) fn unhidden(from: &DifferentialArea, to: &PlanarPolygon, doubt: f64) -> Option<FormFactor> {
    let view = View::new(from, to)?;
    Some(whole(&view, view.doubt + doubt))
}

/// The form factor of a convex target that nothing hides: by whichever of two ways knows it better when the edges cancel.
fn whole(view: &View, doubt: f64) -> FormFactor {
    const FINE: f64 = 1e-13;
    let summed = view.contour().form_factor(doubt);
    if summed.error_bound <= FINE * summed.value {
        return summed;
    }
    let spread = cubature::form_factor(view);
    let better = spread.filter(|spread| spread.error_bound + doubt < summed.error_bound);
    better.map_or(summed, |spread| FormFactor { error_bound: spread.error_bound + doubt, ..spread })
}

fn edge_count(loops: &[Vec<DVec2>]) -> u64 {
    loops.iter().flatten().map(|_| 1).sum()
}

/// What the occluders hide together.
#[derive(Debug)]
pub(crate) enum Shadows {
    Total,
    /// The shadows, and a bound on the form factor of all that is wrong with them.
    Some(Vec<Shadow>, f64),
}

/// The shadows of the occluders that can block.
pub(crate) fn shadows<'a>(
    view: &View,
    occluders: impl IntoIterator<Item = &'a PlanarPolygon>,
    stats: &mut Stats,
) -> Shadows {
    let (mut found, mut error) = (Vec::new(), 0.0);
    for occluder in occluders {
        stats.looked_at += 1;
        match hidden(view, occluder) {
            Hidden::Nothing(doubt) => {
                stats.culled += 1;
                error += doubt;
            }
            Hidden::Shadow(shadow) => {
                stats.clipped += u64::from(shadow.is_clipped);
                error += shadow.error;
                found.push(shadow);
            }
            Hidden::All => return Shadows::Total,
        }
    }
    found.retain(|shadow: &Shadow| !shadow.loops.is_empty());
    Shadows::Some(found, error)
}

/// What a target gets that turns its back or lies below the horizon.
pub(crate) fn unseen(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    FormFactor { value: 0.0, error_bound: doubt::of_unseen(from, to).min(1.0) }
}
