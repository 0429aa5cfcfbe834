//! Limits of time, and Ctrl-C.
use crate::failure::Failure;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// What a shell reports of a program that Ctrl-C ended.
const INTERRUPTED: u8 = 130;
/// Stopped before all was done.
const UNDONE: u8 = 4;

/// How long a command may take, and whether somebody wants it no longer.
#[derive(Debug)]
pub(super) struct Patience {
    deadline: Option<Instant>,
    interrupted: Arc<AtomicBool>,
}

impl Patience {
    /// From now on, for so many seconds.
    pub(super) fn new(seconds: Option<f64>) -> Patience {
        let limit = seconds.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX));
        Patience {
            deadline: limit.and_then(|limit| Instant::now().checked_add(limit)),
            interrupted: Arc::default(),
        }
    }

    /// Takes over Ctrl-C, which ends the program at once until then. A second one does so afterwards.
    pub(super) fn listen(&self) -> Result<(), Failure> {
        let flag = Arc::clone(&self.interrupted);
        let stop = move || {
            if flag.swap(true, Ordering::SeqCst) {
                std::process::exit(INTERRUPTED.into());
            }
        };
        ctrlc::set_handler(stop)
            .map_err(|error| Failure::internal(format!("Ctrl-C cannot be handled: {error}")))
    }

    /// Whether to stop; asked by any thread.
    pub(super) fn is_over(&self) -> bool {
        self.interrupted.load(Ordering::Relaxed) || self.deadline.is_some_and(|end| Instant::now() >= end)
    }

    /// The exit code of a run that was stopped.
    pub(super) fn code(&self) -> ExitCode {
        ExitCode::from(if self.interrupted.load(Ordering::SeqCst) { INTERRUPTED } else { UNDONE })
    }
}
