//! What all methods have in common.
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// A way to find form factors, by rows, so that a method that sees everything in one pass pays for it once.
pub trait Method {
    /// The method and its parameters, for a table.
    fn name(&self) -> String;

    /// The form factors from `from` to the polygons `targets` of the enclosure, in that order.
    ///
    /// # Panics
    /// When there is no polygon with one of the ids.
    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64>;
}
