//! How much is done before the watcher is asked whether to go on.
use std::{ops::Range, time::Instant};

/// Batches become smaller that take more seconds, and larger that take less than half of them; the watcher is asked as often.
pub(super) const PAUSE: f64 = if cfg!(test) { 0.0 } else { 0.1 };

/// The sizes of batches, by how long the one before took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    size: usize,
    start: Instant,
}

impl Pace {
    /// The first batch is small: one item may take long among very many polygons.
    pub(super) fn new() -> Pace {
        Pace { size: rayon::current_num_threads(), start: Instant::now() }
    }

    /// Which come next of so many, after those that are done.
    pub(super) fn batch(&mut self, done: usize, count: usize) -> Range<usize> {
        if done > 0 {
            self.size = next(self.size, self.start.elapsed().as_secs_f64());
        }
        self.start = Instant::now();
        done..count.min(done + self.size)
    }
}

/// The size of a batch after one that took so long.
fn next(size: usize, seconds: f64) -> usize {
    match seconds / PAUSE {
        ..0.5 => 2 * size,
        ..1.0 => size,
        _ => rayon::current_num_threads().max(size / 2),
    }
}
