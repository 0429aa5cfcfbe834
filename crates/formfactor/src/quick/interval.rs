//! Intervals of an edge whose ends are known within bounds, and what is left between them.

/// A parameter along an edge, 0 at its start and 1 at its end, within an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Parameter {
    pub(super) at: f64,
    pub(super) error: f64,
}

impl Parameter {
    pub(super) const START: Self = Self { at: 0.0, error: 0.0 };
    pub(super) const END: Self = Self { at: 1.0, error: 0.0 };

    fn least(&self) -> f64 {
        self.at - self.error
    }

    fn most(&self) -> f64 {
        self.at + self.error
    }

    /// The one of two that comes first, as far as they are known.
    pub(super) fn first(self, other: Self) -> Self {
        if self.at < other.at { self.beside(other) } else { other.beside(self) }
    }

    /// The one of two that comes last.
    pub(super) fn last(self, other: Self) -> Self {
        if self.at > other.at { self.beside(other) } else { other.beside(self) }
    }

    /// Itself, with an error that allows for another one that may lie beyond it.
    fn beside(self, other: Self) -> Self {
        Self { at: self.at, error: greater(self.error, other.error - (other.at - self.at).abs()) }
    }
}

// `f64::min` and `max` cost more, as they look for NaN, which no parameter is.
pub(super) fn lesser(a: f64, b: f64) -> f64 {
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
        self.low.least() >= self.high.most()
    }

    /// Whether another one lies in it for certain.
    pub(super) fn covers(&self, other: &Self) -> bool {
        self.low.most() <= other.low.least() && self.high.least() >= other.high.most()
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
    if hidden.len() > 1 {
        hidden.sort_unstable_by(|a, b| a.low.least().total_cmp(&b.low.least()));
    }
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
