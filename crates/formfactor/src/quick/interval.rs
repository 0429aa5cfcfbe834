//! Intervals of an edge whose ends are known within bounds, and what is left between them.

/// A parameter along an edge, 0 at its start and 1 at its end: somewhere from `least` to `most`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameter {
    pub(super) at: f64,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Parameter {
    const START: Self = Self { at: 0.0, least: 0.0, most: 0.0 };
    const END: Self = Self { at: 1.0, least: 1.0, most: 1.0 };

    pub(super) fn new(at: f64, error: f64) -> Self {
        Self { at, least: at - error, most: at + error }
    }

    /// The one of two that comes first, as far as they are known.
    pub(super) fn first(self, other: Self) -> Self {
        Self {
            at: lesser(self.at, other.at),
            least: lesser(self.least, other.least),
            most: lesser(self.most, other.most),
        }
    }

    /// The one of two that comes last.
    pub(super) fn last(self, other: Self) -> Self {
        Self {
            at: greater(self.at, other.at),
            least: greater(self.least, other.least),
            most: greater(self.most, other.most),
        }
    }

    /// How far it may be from `at`.
    pub(super) fn error(&self) -> f64 {
        greater(self.at - self.least, self.most - self.at)
    }
}

// `f64::min` and `max` cost more, as they look for NaN, which no parameter is.
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

pub(super) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A part of an edge; empty where `high` comes before `low`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) low: Parameter,
    pub(super) high: Parameter,
}

impl Interval {
    pub(super) const WHOLE: Self = Self { low: Parameter::START, high: Parameter::END };

    /// Whether it is empty for certain.
    pub(super) fn is_empty(&self) -> bool {
        self.low.least >= self.high.most
    }

    /// Whether another one lies in it for certain.
    pub(super) fn covers(&self, other: &Self) -> bool {
        self.low.most <= other.low.least && self.high.least >= other.high.most
    }
}

/// Calls back with what the hidden intervals leave of a whole: gaps, some of which may be empty.
///
/// ```text
/// whole   |-----------------------------------|
/// hidden      |-----|      |------------|
///                |------|      |---|
/// gaps    |---|         |--|            |-----|
/// ```
///
/// The intervals come in the order of their least starts. The gap before one ends somewhere between its least and its most
/// start: the others start no earlier. The gap begins between the largest of the ends so far, least and most.
#[inline]
pub(super) fn for_each_gap(whole: Interval, hidden: &mut [Interval], mut found: impl FnMut(Interval)) {
    hidden.sort_unstable_by(|a, b| a.low.least.total_cmp(&b.low.least));
    let last = Interval { low: whole.high, high: whole.high };
    let mut low = whole.low;
    for interval in hidden.iter().chain(std::iter::once(&last)) {
        let gap = Interval { low, high: interval.low.first(whole.high) };
        if !gap.is_empty() {
            found(gap);
        }
        low = low.last(interval.high);
    }
}
