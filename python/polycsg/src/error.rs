//! What Python raises.
use polycsg::Error;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::{PyErr, create_exception, pyfunction};
use std::fmt::Display;

create_exception!(
    polycsg,
    GeometryError,
    PyValueError,
    "A geometry that cannot be read: the message names the feature, the ring and the vertex."
);

/// An error of a feature, which may be one of several operands'.
pub(crate) fn of_feature(operand: Option<usize>, feature: usize, error: Error) -> PyErr {
    if error == Error::Stopped {
        return PyKeyboardInterrupt::new_err(());
    }
    let operand = operand.map_or(String::new(), |operand| format!("operand {operand}, "));
    GeometryError::new_err(format!("{operand}feature {feature}, {error}"))
}

/// An error in how geometries are written.
pub(crate) fn unreadable(what: impl Display) -> PyErr {
    GeometryError::new_err(what.to_string())
}

/// What is said of a geometry of another kind.
#[pyfunction]
pub(crate) fn no_polygon(kind: &str) -> String {
    let holds = kind.to_lowercase().contains("collection");
    let reason = if holds { "give the polygons that it holds" } else { "it has no area" };
    format!("a {kind} is no Polygon or MultiPolygon: {reason}")
}
