//! Counts the work of a call against its limits.
//!
//! Whatever may take long counts its steps as it goes, so that the caller is asked in time:
//!
//! | work | counted by |
//! | --- | --- |
//! | loops and lists of many short steps | [`Meter::for_each`], [`Meter::for_all`], [`Meter::extend`], [`Meter::fill`] |
//! | loops that may fail, or whose steps differ | a [`Tally`] of their own |
//! | sorting | [`sort`](super::sort::sort), [`sort_on`](super::sort::sort_on) |
//! | all else | [`Meter::spend`] |

use super::parts::{PART, Parts};
use crate::error::Error;
use crate::limits::Limits;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The caller is asked whether to stop about once in so much work: some hundred microseconds.
pub(crate) const OFTEN: u64 = 1 << 14;

/// So much is added to a list at a time.
const MANY: usize = 1 << 14;

/// Which limit of a call is met: one byte, as it is asked at every turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    Contacts,
    Work,
    Stopped,
}

/// The work of one call so far, for all of its threads.
#[derive(Debug)]
pub(crate) struct Meter<'a> {
    limits: Limits<'a>,
    is_limited: bool,
    spent: AtomicU64,
    /// Whether the caller said so: then nobody asks again.
    is_stopped: AtomicBool,
}

impl<'a> Meter<'a> {
    pub(crate) fn new(limits: Limits<'a>) -> Meter<'a> {
        let is_limited = limits.work < u64::MAX || limits.stop.is_some();
        Meter { limits, is_limited, spent: AtomicU64::new(0), is_stopped: AtomicBool::new(false) }
    }

    /// Whether anything but contacts is limited.
    pub(crate) fn is_limited(&self) -> bool {
        self.is_limited
    }

    /// The most contacts that there may be.
    pub(crate) fn contacts(&self) -> usize {
        self.limits.contacts
    }

    /// What the caller is told.
    pub(crate) fn error(&self, refusal: Refusal) -> Error {
        match refusal {
            Refusal::Contacts => Error::TooManyContacts { limit: self.limits.contacts },
            Refusal::Work => Error::TooMuchWork { limit: self.limits.work },
            Refusal::Stopped => Error::Stopped,
        }
    }

    /// Counts work, and asks the caller now and then.
    ///
    /// # Errors
    /// [`Refusal::Work`] and [`Refusal::Stopped`].
    #[inline]
    pub(crate) fn spend(&self, work: usize) -> Result<(), Refusal> {
        if self.is_limited { self.count(work as u64) } else { Ok(()) }
    }

    /// Counts work by its sum so far, of which some is counted: a comparison, most times.
    ///
    /// # Errors
    /// Those of [`spend`](Meter::spend).
    #[inline]
    pub(crate) fn spend_up_to(&self, sum: usize, counted: &mut usize) -> Result<(), Refusal> {
        if sum - *counted < PART { Ok(()) } else { self.spend(sum - std::mem::replace(counted, sum)) }
    }

    /// Visits each of many items.
    ///
    /// # Errors
    /// Those of [`spend`](Meter::spend).
    #[inline]
    pub(crate) fn for_each<P: Parts>(&self, items: P, mut visit: impl FnMut(P::Item)) -> Result<(), Refusal> {
        for part in items.parts() {
            let count = part.len();
            for item in part {
                visit(item);
            }
            self.spend(count)?;
        }
        Ok(())
    }

    /// The same for items that are not known before.
    ///
    /// # Errors
    /// Those of [`spend`](Meter::spend).
    #[inline]
    pub(crate) fn for_all<T>(
        &self,
        items: impl IntoIterator<Item = T>,
        mut visit: impl FnMut(T),
    ) -> Result<(), Refusal> {
        let mut left = PART;
        items.into_iter().try_for_each(|item| {
            visit(item);
            left -= 1;
            if left > 0 {
                return Ok(());
            }
            left = PART;
            self.spend(PART)
        })?;
        self.spend(PART - left)
    }

    /// Adds many items to a list.
    ///
    /// # Errors
    /// Those of [`spend`](Meter::spend).
    #[inline]
    pub(crate) fn extend<T>(
        &self,
        list: &mut Vec<T>,
        items: impl IntoIterator<Item = T>,
    ) -> Result<(), Refusal> {
        if self.is_limited {
            return self.extend_by_parts(list, items.into_iter());
        }
        list.extend(items);
        Ok(())
    }

    #[inline(never)]
    fn extend_by_parts<T>(
        &self,
        list: &mut Vec<T>,
        mut items: impl Iterator<Item = T>,
    ) -> Result<(), Refusal> {
        list.reserve(items.size_hint().0);
        let mut count = MANY;
        while count == MANY {
            let before = list.len();
            list.extend(items.by_ref().take(MANY));
            count = list.len() - before;
            self.spend(count)?;
        }
        Ok(())
    }

    /// Makes a list of so many equal items: new memory takes its time.
    ///
    /// # Errors
    /// Those of [`spend`](Meter::spend).
    #[inline]
    pub(crate) fn fill<T: Clone>(&self, list: &mut Vec<T>, item: T, count: usize) -> Result<(), Refusal> {
        list.clear();
        if self.is_limited {
            return self.fill_by_parts(list, item, count);
        }
        list.resize(count, item);
        Ok(())
    }

    #[inline(never)]
    fn fill_by_parts<T: Clone>(&self, list: &mut Vec<T>, item: T, count: usize) -> Result<(), Refusal> {
        list.reserve(count);
        while list.len() < count {
            let before = list.len();
            list.resize(count.min(before + MANY), item.clone());
            self.spend(list.len() - before)?;
        }
        Ok(())
    }

    /// Starts to count the steps of a loop.
    pub(crate) fn tally(&self) -> Tally<'_> {
        Tally { meter: self, uncounted: 0 }
    }

    #[cold]
    fn count(&self, work: u64) -> Result<(), Refusal> {
        // No other thread's data depend on the count.
        if self.is_stopped.load(Ordering::Relaxed) {
            return Err(Refusal::Stopped);
        }
        let before = self.spent.fetch_add(work, Ordering::Relaxed);
        let spent = before.saturating_add(work);
        if spent > self.limits.work {
            return Err(Refusal::Work);
        }
        match self.limits.stop {
            Some(stop) if before / OFTEN != spent / OFTEN && stop() => {
                self.is_stopped.store(true, Ordering::Relaxed);
                Err(Refusal::Stopped)
            }
            _ => Ok(()),
        }
    }
}

impl Default for Meter<'_> {
    fn default() -> Self {
        Meter::new(Limits::default())
    }
}

/// Counts the steps of one loop on one thread; the meter hears of them a part at a time. A loop keeps its own, in a register.
#[derive(Debug)]
pub(crate) struct Tally<'m> {
    meter: &'m Meter<'m>,
    uncounted: usize,
}

impl<'m> Tally<'m> {
    pub(crate) fn meter(&self) -> &'m Meter<'m> {
        self.meter
    }

    /// Counts work.
    ///
    /// # Errors
    /// Those of [`Meter::spend`].
    #[inline]
    pub(crate) fn add(&mut self, work: usize) -> Result<(), Refusal> {
        self.uncounted += work;
        if self.uncounted < PART { Ok(()) } else { self.meter.spend(std::mem::take(&mut self.uncounted)) }
    }
}

#[cfg(test)]
mod tests {
    use super::{Meter, Refusal};
    use crate::base::parts::Numbered;
    use crate::limits::Limits;
    use std::sync::atomic::{AtomicU32, Ordering};

    /// Whatever counts does so for each step, and nobody asks again once the caller said to stop.
    #[test]
    fn whatever_counts_stops() {
        type Loop = fn(&Meter<'_>, &mut Vec<u32>) -> Result<(), Refusal>;
        let loops: [Loop; 6] = [
            |meter, seen| meter.for_each(0..1_000_000_u32, |i| seen.push(i)),
            |meter, seen| meter.for_each(Numbered(&[7; 1_000_000]), |(i, _)| seen.push(i)),
            |meter, seen| meter.for_all((0..1_000_000).filter(|_| true), |i| seen.push(i)),
            |meter, seen| meter.extend(seen, 0..1_000_000),
            |meter, seen| meter.fill(seen, 0, 1_000_000),
            |meter, seen| {
                let mut tally = meter.tally();
                (0..1_000_000).try_for_each(|i| {
                    seen.push(i);
                    tally.add(1)
                })
            },
        ];
        for (i, run) in loops.into_iter().enumerate() {
            for most in [0, 1, 17, 1000] {
                let (asked, mut seen) = (AtomicU32::new(0), Vec::new());
                let stop = || asked.fetch_add(1, Ordering::Relaxed) == most;
                let meter = Meter::new(Limits::default().stop(&stop));
                let end = run(&meter, &mut seen);
                let is_stopped = most < 50;
                assert_eq!(end, if is_stopped { Err(Refusal::Stopped) } else { Ok(()) }, "loop {i}");
                assert_eq!(seen.len() < 1_000_000, is_stopped, "loop {i}");
                assert_eq!(meter.spend(1), end, "loop {i}");
                assert_eq!(asked.load(Ordering::Relaxed), if is_stopped { most + 1 } else { 61 }, "loop {i}");
            }
        }
    }
}
