//! Work without the interpreter, which Ctrl-C stops.
use polycsg::Scratch;
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

/// Inputs of fewer vertices take less time than a person waits, whatever they are.
const FEW: usize = 500;

/// Calls a function with a flag that says whether to stop, set by Ctrl-C. Meanwhile other Python threads run.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    vertices: usize,
    work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    py.detach(|| if vertices < FEW { work(&stop) } else { watched(&stop, work) })
}

fn watched<T: Send>(stop: &AtomicBool, work: impl FnOnce(&AtomicBool) -> PyResult<T> + Send) -> PyResult<T> {
    let pool = pool()?;
    thread::scope(|scope| {
        let (done, is_done) = sync_channel(1);
        scope.spawn(move || done.send(pool.install(|| work(stop))));
        loop {
            match is_done.recv_timeout(WATCH) {
                Ok(result) => return result,
                Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())
                    .inspect_err(|_| stop.store(true, Ordering::Relaxed))?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("the work ended without a result"));
                }
            }
        }
    })
}

/// Something for each number below a count, on the threads of the pool if this is one of them.
pub(crate) fn each<T: Send>(
    count: usize,
    find: impl Fn(&mut Scratch, usize) -> PyResult<T> + Send + Sync,
) -> PyResult<Vec<T>> {
    if rayon::current_thread_index().is_some() {
        return (0..count).into_par_iter().map_init(Scratch::default, find).collect();
    }
    let mut scratch = Scratch::default();
    (0..count).map(|i| find(&mut scratch, i)).collect()
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
    let pool = ThreadPoolBuilder::new().thread_name(|i| format!("polycsg {i}")).build();
    let pool = Arc::new(pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?);
    *found = Some((process::id(), pool.clone()));
    Ok(pool)
}
