//! What Python raises.
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::{PyErr, create_exception};
use std::fmt::Display;

create_exception!(
    formfactor,
    GeometryError,
    PyValueError,
    "A geometry that cannot be used: the message names the polygon, the loop and the vertex, counted from 0."
);

/// An error in what something is; `which` says of what.
pub(crate) fn refused(which: impl Display, why: impl Display) -> PyErr {
    GeometryError::new_err(format!("{which}{why}"))
}

/// A number or a name that cannot be.
pub(crate) fn wrong(why: impl Display) -> PyErr {
    PyValueError::new_err(why.to_string())
}

/// Something that was stopped, which the interpreter has a signal for.
pub(crate) fn stopped() -> PyErr {
    PyKeyboardInterrupt::new_err(())
}
