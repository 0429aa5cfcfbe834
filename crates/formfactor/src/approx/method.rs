//! The trait that all methods have in common.
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// A method that finds form factors, by rows: a method that sees everything in one pass does so once per row.
pub trait Method {
    /// The method's name with its parameters, as for a table.
    #[must_use]
    fn name(&self) -> String;

    /// The form factors from `from` to the polygons of the enclosure whose ids are `targets`, in that order.
    ///
    /// # Panics
    /// When there is no polygon with one of the ids.
    #[must_use]
    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64>;
}
