//! What the Python package `polycsg` calls: Booleans of arrays of polygons in ragged form.
//!
//! `ragged` reads and writes arrays, `overlay`, `alone` and `prepared` compute, `run` lets go of the interpreter meanwhile.
mod alone;
mod error;
mod overlay;
mod prepared;
mod ragged;
mod run;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _polycsg {
    #[pymodule_export]
    use crate::alone::{areas, repaired, triangles, united};
    #[pymodule_export]
    use crate::error::GeometryError;
    #[pymodule_export]
    use crate::overlay::{evaluated, overlay};
    #[pymodule_export]
    use crate::prepared::Prepared;
}
