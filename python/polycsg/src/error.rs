//! What Python raises.
use polycsg::Error;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::{PyErr, create_exception};

create_exception!(
    polycsg,
    GeometryError,
    PyValueError,
    "A geometry that cannot be read: the message names the feature, the ring and the vertex."
);

/// An error of the feature with a number.
pub(crate) fn of_feature(feature: usize, error: Error) -> PyErr {
    match error {
        Error::NonFinite { ring, vertex } => GeometryError::new_err(format!(
            "feature {feature}, ring {ring}, vertex {vertex}: a coordinate is NaN or infinite; give finite numbers"
        )),
        Error::Stopped => PyKeyboardInterrupt::new_err(()),
        other => GeometryError::new_err(format!("feature {feature}: {other}")),
    }
}
