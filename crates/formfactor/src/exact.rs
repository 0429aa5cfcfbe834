//! The exact form factor: the stages, one after the other.
use crate::cull::{Hidden, Pyramid, hidden};
use crate::project::Shadow;
use crate::view::View;
use crate::visible::visible_sum;
use crate::{DifferentialArea, PlanarPolygon, doubt};
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
    form_factor_past(from, to, |_| occluders, &mut Scratch::default())
}

/// [`form_factor`] past what `occluders` finds for the target's pyramid, with buffers that are used again.
pub(crate) fn form_factor_past<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl FnOnce(&Pyramid) -> I,
    scratch: &mut Scratch,
) -> FormFactor
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    let Some(view) = View::new(from, to) else {
        return unseen(from, to);
    };
    match shadows(&view, occluders(&view.pyramid)) {
        Shadows::Total => FormFactor::default(),
        Shadows::Some(shadows, doubt) => {
            if shadows.is_empty() && to.is_convex() {
                return view.contour().form_factor(view.doubt + doubt);
            }
            visible_sum(&view, &shadows, scratch).form_factor(view.rounding + view.doubt + doubt)
        }
    }
}

/// The form factor from a differential area to the front of a polygon with nothing in between.
#[must_use]
pub fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    form_factor(from, to, &[])
}

/// What the occluders hide together.
#[derive(Debug)]
pub(crate) enum Shadows {
    Total,
    /// The shadows, and a bound on the form factor of all that is wrong with them.
    Some(Vec<Shadow>, f64),
}

/// The shadows of the occluders that can block.
pub(crate) fn shadows<'a>(view: &View, occluders: impl IntoIterator<Item = &'a PlanarPolygon>) -> Shadows {
    let (mut found, mut error) = (Vec::new(), 0.0);
    for occluder in occluders {
        match hidden(view, occluder) {
            Hidden::Nothing(doubt) => error += doubt,
            Hidden::Shadow(shadow) => {
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
