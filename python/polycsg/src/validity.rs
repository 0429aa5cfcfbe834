//! Whether geometries are valid as they are, in the sense of the simple features' standard.
use crate::input::Features;
use crate::run::{each, run};
use polycsg::flaw;
use pyo3::prelude::*;

/// Why each feature is not valid; None where it is.
#[pyfunction]
pub(crate) fn flaws(py: Python<'_>, features: Features<'_>) -> PyResult<Vec<Option<String>>> {
    let features = features.read()?;
    run(py, features.vertices(), |stop| {
        each(features.len(), stop, |scratch, i| {
            let polygons = features.polygons(i).map(|rings| rings.map(|ring| features.given_ring(ring)));
            Ok(flaw(polygons, scratch).map(|flaw| flaw.to_string()))
        })
    })
}
