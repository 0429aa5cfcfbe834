//! Work without the interpreter, which Ctrl-C stops.
use polycsg::Scratch;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Inputs of fewer vertices take less time than a person waits, whatever they are, and than starting threads is worth.
const FEW: usize = 500;

/// Calls a function with a flag that says whether to stop.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    vertices: usize,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send,
) -> PyResult<T> {
    if vertices < FEW {
        return python_run::quick(py, work);
    }
    python_run::watched(py, |_| Ok(()), work)
}

/// Something for each number below a count, until it is to stop.
pub(crate) fn each<T: Send>(
    count: usize,
    stop: &AtomicBool,
    find: impl Fn(&mut Scratch, usize) -> PyResult<T> + Send + Sync,
) -> PyResult<Vec<T>> {
    python_run::each(count, Scratch::default, |scratch, i| {
        if stop.load(Ordering::Relaxed) {
            return Err(PyKeyboardInterrupt::new_err(()));
        }
        find(scratch, i)
    })
}
