//! The exact route: every decision is exact, and what stays visible is found by polygon Booleans.
//!
//! [`view`] cuts the target off at the horizon, [`cull`] decides which occluders can block, [`project`] casts their shadows
//! on the target's plane, [`visible`] subtracts the shadows, and [`lambert`] sums over the boundary of what remains.
pub(crate) mod cubature;
pub(crate) mod cull;
pub(crate) mod deviation;
pub(crate) mod halves;
pub(crate) mod horizon;
pub(crate) mod lambert;
pub(crate) mod planarity;
pub(crate) mod project;
pub(crate) mod projected_vertex;
pub(crate) mod pyramid;
pub(crate) mod shadows;
pub(crate) mod view;
pub(crate) mod visible;
pub(crate) mod whole;

use crate::form_factor::FormFactor;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use crate::stats::Stats;
use polycsg::Scratch;
use pyramid::Pyramid;
use shadows::{Shadows, shadows};
use view::View;

/// The form factor past what `occluders` finds for the target's pyramid.
pub(crate) fn form_factor<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl FnOnce(&Pyramid) -> I,
    scratch: &mut Scratch,
    stats: &mut Stats,
) -> FormFactor
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    let Some(view) = View::new(from, to) else {
        stats.none += 1;
        return deviation::unseen(from, to);
    };
    let Shadows::Some(shadows, open) = shadows(&view, occluders(&view.pyramid), stats) else {
        stats.total += 1;
        return FormFactor::default();
    };
    if shadows.is_empty() {
        stats.none += 1;
    } else {
        stats.partial += 1;
    }
    if shadows.is_empty() && to.is_convex() {
        return whole::form_factor(&view, view.facing_error + open);
    }
    stats.csg_edges += visible::edge_count(&view, &shadows);
    visible::sum(&view, &shadows, scratch).form_factor(view.flat_error + view.facing_error + open)
}
