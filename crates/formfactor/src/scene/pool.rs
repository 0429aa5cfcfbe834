//! Buffers that are used again, by whichever thread comes next.
use crate::buffers::Buffers;
use std::sync::{Mutex, PoisonError};

/// Idle buffers. They carry nothing from one use to the next but their capacity, so that no result depends on them.
#[derive(Debug, Default)]
#[allow(clippy::vec_box, reason = "large buffers go in and out with every form factor")]
pub(crate) struct Pool(Mutex<Vec<Box<Buffers>>>);

impl Pool {
    /// Runs `work` with buffers that no one else uses meanwhile.
    pub(crate) fn lend<T>(&self, work: impl FnOnce(&mut Buffers) -> T) -> T {
        let mut buffers = self.idle().pop().unwrap_or_default();
        let result = work(&mut buffers);
        self.idle().push(buffers);
        result
    }

    #[allow(clippy::vec_box, reason = "as it is kept")]
    fn idle(&self) -> std::sync::MutexGuard<'_, Vec<Box<Buffers>>> {
        // A panic in `work` loses the buffers it had. Those in here are whole.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clone for Pool {
    /// A clone has buffers of its own.
    fn clone(&self) -> Self {
        Self::default()
    }
}
