//! What the Python package `polycsg` calls: Booleans of arrays of polygons.
//!
//! `input` takes numpy arrays, `held` Arrow and WKB; `ragged` reads both, `built` makes results; `expression`, `alone`, `validity` and
//! `prepared` compute; `run` lets go of the interpreter meanwhile.
mod alone;
mod arrow;
mod built;
mod error;
mod expression;
mod held;
mod input;
mod prepared;
mod ragged;
mod run;
mod validity;
mod wkb;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _polycsg {
    #[pymodule_export]
    use crate::alone::{areas, repaired, triangles, united};
    #[pymodule_export]
    use crate::arrow::{of_arrow, to_arrow};
    #[pymodule_export]
    use crate::error::{GeometryError, no_polygon};
    #[pymodule_export]
    use crate::expression::evaluated;
    #[pymodule_export]
    use crate::held::HeldFeatures;
    #[pymodule_export]
    use crate::prepared::Prepared;
    #[pymodule_export]
    use crate::validity::flaws;
    #[pymodule_export]
    use crate::wkb::{of_wkb, to_wkb};
    /// The package's version, on which the bits of results may depend.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
