//! Convex targets of which nothing is hidden.
use super::{cubature, view::View};
use crate::form_factor::FormFactor;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};

/// The relative error up to which the contour sum is good enough.
const FINE: f64 = 1e-13;

/// The form factor of a convex target of which nothing is hidden, but for an error of at most `open`.
pub(crate) fn unhidden(from: &DifferentialArea, to: &PlanarPolygon, open: f64) -> Option<FormFactor> {
    let view = View::new(from, to)?;
    Some(form_factor(&view, view.facing_error + open))
}

/// The form factor of a view of such a target.
///
/// The contour sum comes first. Where its terms cancel, cubature may know the value better.
pub(crate) fn form_factor(view: &View, open: f64) -> FormFactor {
    let summed = view.contour().form_factor(open);
    if summed.error_bound <= FINE * summed.value {
        return summed;
    }
    let integrated = cubature::form_factor(view);
    let better = integrated.filter(|found| found.error_bound + open < summed.error_bound);
    better.map_or(summed, |found| FormFactor { error_bound: found.error_bound + open, ..found })
}
