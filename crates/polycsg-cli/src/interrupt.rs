//! Ctrl-C, or another signal that ends programs: the command ends before anything is put in place.
use crate::failure::Failure;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// A command that has not ended so long after Ctrl-C waits for a pipe or a disk.
const LONGEST: Duration = Duration::from_secs(2);

/// Whether somebody pressed Ctrl-C.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt {
    is_set: Arc<AtomicBool>,
    /// A file in the making, which nobody drops where the process is ended from here.
    unfinished: Arc<Mutex<Option<PathBuf>>>,
}

impl Interrupt {
    /// Takes over Ctrl-C.
    pub(crate) fn listen() -> Result<Interrupt, Failure> {
        let interrupt = Interrupt::default();
        let pressed = interrupt.clone();
        let stop = move || {
            if pressed.is_set.swap(true, Ordering::SeqCst) {
                pressed.end();
            }
            let pressed = pressed.clone();
            std::thread::spawn(move || {
                std::thread::sleep(LONGEST);
                pressed.end();
            });
        };
        ctrlc::set_handler(stop)
            .map_err(|error| Failure::File(format!("Ctrl-C cannot be handled: {error}")))?;
        Ok(interrupt)
    }

    /// Whether to stop.
    pub(crate) fn is_set(&self) -> bool {
        self.is_set.load(Ordering::SeqCst)
    }

    /// Ends the command where somebody asked for it.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        if self.is_set() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// Names the file in the making.
    pub(crate) fn leave_nothing_of(&self, path: &Path) {
        *self.unfinished.lock().unwrap_or_else(PoisonError::into_inner) = Some(path.to_owned());
    }

    /// Ends the process. A file that is in its place has another name by now, so that nothing is found to be removed.
    fn end(&self) -> ! {
        let unfinished = self.unfinished.lock().unwrap_or_else(PoisonError::into_inner);
        let _ = unfinished.as_ref().map(std::fs::remove_file);
        Failure::Interrupted.report();
        std::process::exit(130);
    }
}
