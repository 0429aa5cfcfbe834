//! Buffers that are used again, by whichever thread comes next.
use polycsg::Scratch;
use std::sync::{Mutex, PoisonError};

/// Idle buffers. They carry nothing from one use to the next but their capacity, so that no result depends on them.
#[derive(Debug, Default)]
pub(crate) struct Pool(Mutex<Vec<Scratch>>);

impl Pool {
    /// Runs `work` with buffers that no one else uses meanwhile.
    pub(crate) fn lend<T>(&self, work: impl FnOnce(&mut Scratch) -> T) -> T {
        let mut scratch = self.idle().pop().unwrap_or_default();
        let result = work(&mut scratch);
        self.idle().push(scratch);
        result
    }

    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<Scratch>> {
        // A panic elsewhere leaves whole buffers behind.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clone for Pool {
    /// A clone has buffers of its own.
    fn clone(&self) -> Self {
        Self::default()
    }
}
