//! What a call may take.

use std::fmt;

/// What a call may take: contacts, which cost memory, and work, which costs time; and a function that is asked whether to stop.
///
/// Nothing is limited by default. A number is a limit on contacts alone.
///
/// ```
/// use polycsg::{Csg, Error, FillRule, Limits, Scratch};
/// use std::time::{Duration, Instant};
/// let bars = |n: usize| (0..n).map(|i| 2.0 * i as f64);
/// let upright = bars(50).map(|x| vec![[x, -1.0], [x + 1.0, -1.0], [x + 1.0, 100.0], [x, 100.0]]);
/// let level = bars(50).map(|y| vec![[-1.0, y], [100.0, y], [100.0, y + 1.0], [-1.0, y + 1.0]]);
/// let both = Csg::from_rings(upright, FillRule::NonZero)? & Csg::from_rings(level, FillRule::NonZero)?;
/// let mut scratch = Scratch::default();
/// let limits = Limits::default().work(1000);
/// assert_eq!(both.try_evaluate_with(&mut scratch, limits), Err(Error::TooMuchWork { limit: 1000 }));
/// let start = Instant::now();
/// let is_late = || start.elapsed() > Duration::from_secs(60);
/// assert_eq!(both.try_evaluate_with(&mut scratch, Limits::default().stop(&is_late))?.area(), 2500.0);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    pub(crate) contacts: usize,
    pub(crate) work: u64,
    pub(crate) stop: Option<&'a (dyn Fn() -> bool + Sync)>,
}

impl<'a> Limits<'a> {
    /// The most contacts that there may be.
    ///
    /// n edges can have n² crossings, and each takes about 600 bytes. A crossing counts as two contacts, one on each of its
    /// edges; a vertex that touches an edge counts as one, and so does each end of a run of edges that coincide with others. Where
    /// many edges lie closer to one another than floats can tell, pairs that nearly meet may count as well. No more than the
    /// limit is ever stored.
    #[must_use]
    pub fn contacts(self, most: usize) -> Limits<'a> {
        Limits { contacts: most, ..self }
    }

    /// The most work. A unit is one step of a loop, some nanoseconds to a microsecond: an edge that is read, a pair of edges that
    /// is compared, a contact, a step of the walk, a fragment that is looked at again. The count is the same from run to
    /// run. On several threads it may be higher, where comparing boxes is given up, and it may change with the version.
    #[must_use]
    pub fn work(self, most: u64) -> Limits<'a> {
        Limits { work: most, ..self }
    }

    /// A function that is asked about every 16 000 units of work, on any of the threads, and ends the call when it returns true.
    #[must_use]
    pub fn stop(self, stop: &'a (dyn Fn() -> bool + Sync)) -> Limits<'a> {
        Limits { stop: Some(stop), ..self }
    }
}

impl Default for Limits<'_> {
    fn default() -> Self {
        Limits { contacts: usize::MAX, work: u64::MAX, stop: None }
    }
}

impl From<usize> for Limits<'_> {
    fn from(contacts: usize) -> Self {
        Limits::default().contacts(contacts)
    }
}

impl fmt::Debug for Limits<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Limits { contacts, work, stop } = self;
        let mut limits = f.debug_struct("Limits");
        limits.field("contacts", contacts).field("work", work).field("stop", &stop.is_some()).finish()
    }
}
