//! What the Python package `formfactor` calls: form factors from points and between polygons.
//!
//! `polygons` reads arrays, `enclosure` finds factors, `comparators` approximate ones, `matrix` holds what was found between polygons.
mod comparators;
mod enclosure;
mod error;
mod matrix;
mod points;
mod polygons;
mod tolerance;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _formfactor {
    #[pymodule_export]
    use crate::enclosure::Enclosure;
    #[pymodule_export]
    use crate::error::GeometryError;
    #[pymodule_export]
    use crate::matrix::Matrix;
    #[pymodule_export]
    use crate::points::{form_factor, unoccluded_complement, visible_part};
    /// The package's version, on which the bits of results may depend.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
