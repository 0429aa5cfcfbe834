//! Waiting for work that cannot be stopped: reading, repair, form factors from points, and pages.
use crate::failure::Failure;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Work of such a moment is done, whatever the time.
const MOMENT: Duration = Duration::from_millis(500);
/// The time is looked at so often.
const LOOK: Duration = Duration::from_millis(20);
/// As much as a program's first thread has: readers of nested files need some.
const STACK: usize = 8 << 20;

/// What some work comes to. When it `is_late`, the work is no longer waited for, and ends with the program; a failure says what is `undone`.
pub(crate) fn wait<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
    is_late: impl Fn() -> bool,
    undone: &str,
) -> Result<T, Failure> {
    let (start, (send, receive)) = (Instant::now(), channel());
    // Who waits no longer does not want to hear of it.
    let worker = std::thread::Builder::new().stack_size(STACK).spawn(move || drop(send.send(work())));
    worker.map_err(Failure::threads)?;
    loop {
        match receive.recv_timeout(LOOK) {
            Ok(done) => return done,
            Err(RecvTimeoutError::Timeout) if start.elapsed() > MOMENT && is_late() => {
                return Err(Failure::late(undone));
            }
            Err(RecvTimeoutError::Timeout) => {}
            // The reason was told when it panicked.
            Err(RecvTimeoutError::Disconnected) => {
                return Err(Failure::internal("an internal error; the reason stands above"));
            }
        }
    }
}
