//! Counts the work of a call against its limits.

use crate::error::Error;
use crate::limits::Limits;
use std::sync::atomic::{AtomicU64, Ordering};

/// The caller is asked whether to stop about once in so much work: some hundred microseconds.
const OFTEN: u64 = 1 << 14;

/// The work of one call so far, for all of its threads.
#[derive(Debug)]
pub(crate) struct Meter<'a> {
    limits: Limits<'a>,
    is_limited: bool,
    spent: AtomicU64,
}

impl<'a> Meter<'a> {
    pub(crate) fn new(limits: Limits<'a>) -> Meter<'a> {
        let is_limited = limits.work < u64::MAX || limits.stop.is_some();
        Meter { limits, is_limited, spent: AtomicU64::new(0) }
    }

    /// The most contacts that there may be.
    pub(crate) fn contacts(&self) -> usize {
        self.limits.contacts
    }

    /// Counts work, and asks the caller now and then.
    ///
    /// # Errors
    /// [`Error::TooMuchWork`] and [`Error::Stopped`].
    #[inline]
    pub(crate) fn spend(&self, work: usize) -> Result<(), Error> {
        if self.is_limited { self.count(work as u64) } else { Ok(()) }
    }

    #[cold]
    fn count(&self, work: u64) -> Result<(), Error> {
        // No other thread's data depend on the count.
        let before = self.spent.fetch_add(work, Ordering::Relaxed);
        let spent = before.saturating_add(work);
        if spent > self.limits.work {
            return Err(Error::TooMuchWork { limit: self.limits.work });
        }
        match self.limits.stop {
            Some(stop) if before / OFTEN != spent / OFTEN && stop() => Err(Error::Stopped),
            _ => Ok(()),
        }
    }
}

impl Default for Meter<'_> {
    fn default() -> Self {
        Meter::new(Limits::default())
    }
}
