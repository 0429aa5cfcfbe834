//! Lists and ranges in parts, so that a loop need not count each of its steps.

use super::id::index;
use std::iter::from_fn;
use std::ops::Range;

/// Short steps are counted so many at a time: what all threads share is slow.
pub(crate) const PART: usize = 1 << 10;

/// What can be cut into parts.
pub(crate) trait Parts {
    type Item;

    fn parts(self) -> impl Iterator<Item = impl ExactSizeIterator<Item = Self::Item>>;
}

impl<'t, T> Parts for &'t [T] {
    type Item = &'t T;

    #[inline]
    fn parts(self) -> impl Iterator<Item = impl ExactSizeIterator<Item = &'t T>> {
        self.chunks(PART).map(|part| part.iter())
    }
}

impl Parts for Range<usize> {
    type Item = usize;

    #[inline]
    fn parts(mut self) -> impl Iterator<Item = impl ExactSizeIterator<Item = usize>> {
        from_fn(move || {
            let part = self.start..self.end.min(self.start + PART);
            self.start = part.end;
            (!part.is_empty()).then_some(part)
        })
    }
}

impl Parts for Range<u32> {
    type Item = u32;

    #[inline]
    fn parts(mut self) -> impl Iterator<Item = impl ExactSizeIterator<Item = u32>> {
        from_fn(move || {
            let part = self.start..self.end.min(self.start.saturating_add(index(PART)));
            self.start = part.end;
            (!part.is_empty()).then_some(part)
        })
    }
}

/// Items with their numbers.
pub(crate) struct Numbered<'t, T>(pub(crate) &'t [T]);

impl<'t, T> Parts for Numbered<'t, T> {
    type Item = (u32, &'t T);

    #[inline]
    fn parts(self) -> impl Iterator<Item = impl ExactSizeIterator<Item = (u32, &'t T)>> {
        let mut start = 0;
        self.0.chunks(PART).map(move |part| {
            let numbers = start..start + index(part.len());
            start = numbers.end;
            numbers.zip(part)
        })
    }
}
