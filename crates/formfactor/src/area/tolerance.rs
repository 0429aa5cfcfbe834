//! What factors between areas may err by, and what they may cost.
use crate::error::Error;

/// What form factors between areas may err by.
///
/// An entry is refined until its estimated error is within `absolute`, or within `relative` of its value. In rows and matrices the
/// squares of the estimated errors of a row's entries also add to that of `row` at most, as those of independent errors do: half
/// of it goes to all in equal shares, half by the square roots of what they were with nothing in between, so that large factors, which cost
/// as much to know to a digit as small ones, may err by more and faint ones cost next to nothing. The looser, the cheaper.
///
/// In rooms with boxes of 100 to 2 640 surfaces no entry was off by more than 1e-4 and no row by more than 3e-4 at `absolute` 1e-3 and
/// `row` 8e-3. Ask for about thirty times what rows may be off by in truth, if no more than that is wanted.
///
/// A plain number is a tolerance for each entry and for each row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of each entry.
    pub absolute: f64,
    /// Of each entry, as a share of it.
    pub relative: f64,
    /// Of the sum of a row, were its entries' errors independent.
    pub row: f64,
}

impl From<f64> for Tolerance {
    fn from(tolerance: f64) -> Self {
        Self { absolute: tolerance, relative: 0.0, row: tolerance }
    }
}

impl Tolerance {
    pub(super) fn check(&self) -> Result<(), Error> {
        let all = [self.absolute, self.relative, self.row];
        let is_good =
            all.iter().all(|t| *t >= 0.0) && self.absolute.max(self.relative) > 0.0 && self.row > 0.0;
        if is_good { Ok(()) } else { Err(Error::BadTolerance) }
    }
}

/// What finding form factors between areas may cost, and whether it goes on.
///
/// ```
/// use formfactor::{Enclosure, Limits, PlanarPolygon};
/// use std::time::{Duration, Instant};
/// # let enclosure = Enclosure::default();
/// let deadline = Instant::now() + Duration::from_secs(60);
/// let stop = || Instant::now() > deadline;
/// let rows = enclosure.area_matrix(1e-4, &Limits { stop: &stop, ..Limits::default() })?;
/// assert!(rows.is_some(), "a minute was not enough");
/// # Ok::<(), formfactor::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// Point form factors for one pair. A pair that needs more ends there, and its estimate says what it may be off by.
    pub per_pair: u64,
    /// Point form factors in all. They are counted after each block of rows, so that the results do not depend on threads;
    /// pairs that come after get the cheapest rule, and their estimates say so.
    pub in_all: u64,
    /// Asked often, by any thread; once it says so, all ends and nothing is returned.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Limits<'_> {
    /// These, with so many evaluations left in all.
    pub(super) fn with(&self, left: u64) -> Self {
        Self { per_pair: self.per_pair.min(left), ..*self }
    }
}

impl Default for Limits<'_> {
    /// Four million for one pair, no limit in all, no stop.
    fn default() -> Self {
        Self { per_pair: 1 << 22, in_all: u64::MAX, stop: &|| false }
    }
}

impl std::fmt::Debug for Limits<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { per_pair, in_all, .. } = self;
        f.debug_struct("Limits").field("per_pair", per_pair).field("in_all", in_all).finish_non_exhaustive()
    }
}
