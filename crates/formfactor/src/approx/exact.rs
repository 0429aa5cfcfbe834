//! The exact method, as one among the others.
use super::method::Method;
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// The exact form factors of [`Enclosure::form_factor`], without their bounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exact;

impl Method for Exact {
    fn name(&self) -> String {
        "exact".into()
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        targets.iter().map(|id| enclosure.form_factor(from, *id).value).collect()
    }
}
