//! Form factors and light of many points, batch by batch: between two batches the watcher is asked whether to go on.
use super::{factors::PieceShape, run::Run, state::Column};
use crate::error::Error;
use std::{ops::Range, sync::Arc, time::Instant};

/// Batches become smaller that take more seconds, and larger that take less than half of them; the watcher is asked as often.
const PAUSE: f64 = if cfg!(test) { 0.0 } else { 0.1 };

impl Run<'_> {
    /// The form factors from all elements to one piece; nothing when the watcher wants to stop.
    pub(super) fn column(&mut self, node: usize) -> Result<Option<Arc<Column>>, Error> {
        if let Some(known) = self.factors.known(node) {
            return Ok(Some(known));
        }
        let piece = self.factors.piece(node)?;
        let count = self.factors.groups.len();
        let found = self.in_batches(count, |run, some| run.factors.seen(some, &piece))?;
        Ok((found.len() == count).then(|| self.factors.keep(node, &found.concat())))
    }

    /// About the form factors from all elements to one piece, by who sees its cluster; nothing when the watcher wants to stop.
    pub(super) fn rough_column(&mut self, piece: &PieceShape) -> Result<Option<Arc<Column>>, Error> {
        let count = self.factors.groups.len();
        let found = self.in_batches(count, |run, some| run.factors.about(some, piece))?;
        Ok((found.len() == count).then(|| Arc::new(Column::new(&found.concat()))))
    }

    /// What `find` finds for so many points, all or as many as the watcher waits for. Batches change nothing in it.
    pub(super) fn in_batches<T>(
        &mut self,
        count: usize,
        find: impl Fn(&Self, Range<usize>) -> Result<Vec<T>, Error>,
    ) -> Result<Vec<T>, Error> {
        // One point may take long among very many polygons.
        let (mut found, mut size) = (Vec::with_capacity(count), rayon::current_num_threads());
        while found.len() < count {
            let start = Instant::now();
            let batch = found.len()..count.min(found.len() + size);
            found.extend(find(self, batch)?);
            size = next(size, start.elapsed().as_secs_f64());
            let is_due = self.asked.elapsed().as_secs_f64() >= PAUSE;
            if found.len() < count && is_due && self.report().is_break() {
                break;
            }
        }
        Ok(found)
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
