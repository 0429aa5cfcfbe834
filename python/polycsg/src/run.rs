//! Work without the interpreter, which Ctrl-C stops.
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

/// Signals are looked for so often.
const WATCH: Duration = Duration::from_millis(50);

/// Inputs of fewer vertices take less time than starting a thread for them is worth.
const FEW: usize = 5_000;

/// Calls a function with a flag that says whether to stop, set by Ctrl-C. Meanwhile other Python threads run.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    vertices: usize,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    if vertices < FEW {
        return py.detach(|| work(&stop));
    }
    py.detach(|| {
        thread::scope(|scope| {
            let (done, is_done) = sync_channel(1);
            let stop = &stop;
            scope.spawn(move || done.send(work(stop)));
            loop {
                match is_done.recv_timeout(WATCH) {
                    Ok(result) => return result,
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(signal) = Python::attach(|py| py.check_signals()) {
                            stop.store(true, Ordering::Relaxed);
                            return Err(signal);
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(pyo3::exceptions::PyRuntimeError::new_err("the work ended without a result"));
                    }
                }
            }
        })
    })
}
