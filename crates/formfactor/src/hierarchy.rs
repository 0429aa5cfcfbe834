//! Equation 3.6.
use crate::{DifferentialArea, FormFactor, PlanarPolygon, form_factor};

/// The second route.
#[must_use]
pub fn by_hierarchy(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> FormFactor {
    form_factor(from, to, occluders)
}
