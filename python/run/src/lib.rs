//! Work without the interpreter, on threads, which Ctrl-C stops: what both packages have in common.
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::mem;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// Signals are looked for so often.
const WATCH: Duration = Duration::from_millis(50);

/// Calls a function on this thread, for what takes less time than a person waits. Meanwhile other Python threads run.
pub fn quick<T: Send>(py: Python<'_>, work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send) -> PyResult<T> {
    py.detach(|| work(&AtomicBool::new(false)))
}

/// Calls a function on the threads of the pool, with a flag that says whether to stop, set by Ctrl-C or once `look`, which is called
/// now and then and in the end, raises something. Meanwhile other Python threads run.
pub fn watched<T: Send>(
    py: Python<'_>,
    mut look: impl FnMut(Python<'_>) -> PyResult<()> + Send,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    let found = py.detach(|| {
        let pool = pool()?;
        let (look, stop) = (&mut look, &stop);
        thread::scope(|scope| {
            let (done, is_done) = sync_channel(1);
            scope.spawn(move || done.send(pool.install(|| work(stop))));
            loop {
                match is_done.recv_timeout(WATCH) {
                    Ok(result) => return result,
                    Err(RecvTimeoutError::Timeout) => {
                        Python::attach(|py| py.check_signals().and_then(|()| look(py)))
                            .inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
                    }
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("the work ended without a result"));
                    }
                }
            }
        })
    })?;
    look(py)?;
    Ok(found)
}

/// Something for each number below a count, with buffers that are kept; on the threads of the pool, if this is one of them.
pub fn each<T: Send, B>(
    count: usize,
    buffers: impl Fn() -> B + Send + Sync,
    find: impl Fn(&mut B, usize) -> PyResult<T> + Send + Sync,
) -> PyResult<Vec<T>> {
    if rayon::current_thread_index().is_some() {
        return (0..count).into_par_iter().map_init(buffers, find).collect();
    }
    let mut buffers = buffers();
    (0..count).map(|i| find(&mut buffers, i)).collect()
}

/// The threads of this process. Those of a process that forked are not in its child.
fn pool() -> PyResult<Arc<ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let mut found = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    match &*found {
        Some((owner, pool)) if *owner == process::id() => return Ok(pool.clone()),
        // Dropping the parent's would wait for threads that are not there.
        Some(_) => mem::forget(found.take()),
        None => {}
    }
    let pool = Arc::new(
        ThreadPoolBuilder::new().build().map_err(|error| PyRuntimeError::new_err(error.to_string()))?,
    );
    *found = Some((process::id(), pool.clone()));
    Ok(pool)
}
