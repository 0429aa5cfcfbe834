//! One job on as many threads as rayon's current pool has, with the feature `rayon`; without it, on one.
//!
//! A job is cut into parts that do not depend on the number of threads, and what they yield is put together in their
//! order: results are the same bit for bit.

#[cfg(feature = "rayon")]
use rayon::prelude::*;
use std::{cmp::Ordering, ops::Range};

/// Fewer edges are quicker on one thread.
#[cfg(feature = "rayon")]
const FEW: usize = if cfg!(any(test, fuzzing)) { 64 } else { 50_000 };

/// A job has so many parts, or is cut into so many that each have some of its parts.
const MOST: usize = 64;

/// Parts of so many, the same for any number of threads.
pub(crate) fn ranges(count: usize) -> impl Iterator<Item = Range<usize>> {
    let length = count.div_ceil(MOST).max(1);
    (0..count).step_by(length).map(move |start| start..count.min(start + length))
}

/// Whether to use more than one thread.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    many: bool,
}

impl Threads {
    /// For so many edges.
    #[cfg(feature = "rayon")]
    pub(crate) fn for_edges(count: usize) -> Threads {
        Threads { many: count >= FEW && rayon::current_num_threads() > 1 }
    }

    #[cfg(not(feature = "rayon"))]
    pub(crate) fn for_edges(_: usize) -> Threads {
        Threads { many: false }
    }

    pub(crate) fn are_many(self) -> bool {
        self.many
    }

    /// Does something with each part, in any order.
    ///
    /// # Errors
    /// That of the first part with one.
    pub(crate) fn try_for_each<P: Send, E: Send>(
        self,
        mut parts: impl Iterator<Item = P>,
        work: impl Fn(P) -> Result<(), E> + Sync + Send,
    ) -> Result<(), E> {
        if self.many { self.map(parts, work).into_iter().collect() } else { parts.try_for_each(work) }
    }

    /// What each part yields, in their order.
    pub(crate) fn map<P: Send, R: Send>(
        self,
        parts: impl Iterator<Item = P>,
        work: impl Fn(P) -> R + Sync + Send,
    ) -> Vec<R> {
        #[cfg(feature = "rayon")]
        if self.many {
            // Jobs this small leave little to wait for where a thread is late.
            let parts: Vec<P> = parts.collect();
            let longest = parts.len().div_ceil(MOST).max(1);
            return parts.into_par_iter().with_max_len(longest).map(work).collect();
        }
        parts.map(work).collect()
    }

    /// Lists what each part of a range yields, in their order.
    ///
    /// # Errors
    /// That of the first part with one.
    pub(crate) fn list<R: Send, E: Send>(
        self,
        count: usize,
        all: &mut Vec<R>,
        work: impl Fn(Range<usize>, &mut Vec<R>) -> Result<(), E> + Sync + Send,
    ) -> Result<(), E> {
        if !self.many {
            return work(0..count, all);
        }
        let part = |range: Range<usize>| {
            let mut part = Vec::new();
            work(range, &mut part).map(|()| part)
        };
        self.map(ranges(count), part).into_iter().try_for_each(|part| part.map(|part| all.extend(part)))
    }

    /// Sorts by an order in which only what is the same is equal.
    pub(crate) fn sort<T: Send>(self, items: &mut [T], order: impl Fn(&T, &T) -> Ordering + Sync) {
        #[cfg(feature = "rayon")]
        if self.many {
            return items.par_sort_unstable_by(order);
        }
        items.sort_unstable_by(order);
    }
}
