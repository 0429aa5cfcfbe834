//! One job on as many threads as rayon's current pool has, with the feature `rayon`; without it, on one.
//!
//! A job is cut into parts that do not depend on the number of threads, and what they yield is put together in their
//! order: results are the same bit for bit.

#[cfg(feature = "rayon")]
use rayon::prelude::*;

/// Fewer edges are quicker on one thread.
#[cfg(feature = "rayon")]
const FEW: usize = if cfg!(any(test, fuzzing)) { 64 } else { 20_000 };

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
    pub(crate) fn for_each<P: Send>(
        self,
        parts: impl Iterator<Item = P> + Send,
        work: impl Fn(P) + Sync + Send,
    ) {
        #[cfg(feature = "rayon")]
        if self.many {
            return parts.par_bridge().for_each(work);
        }
        parts.for_each(work);
    }

    /// What each part yields, in their order.
    pub(crate) fn map<P: Send, R: Send>(
        self,
        parts: impl Iterator<Item = P>,
        work: impl Fn(P) -> R + Sync + Send,
    ) -> Vec<R> {
        #[cfg(feature = "rayon")]
        if self.many {
            return parts.collect::<Vec<P>>().into_par_iter().map(work).collect();
        }
        parts.map(work).collect()
    }
}
