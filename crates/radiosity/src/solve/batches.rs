//! Form factors and light of many points, batch by batch: between two batches the watcher is asked whether to go on.
use super::{
    factors::PieceShape,
    pace::{PAUSE, Pace},
    run::Run,
    state::Column,
};
use crate::error::Error;
use std::{ops::Range, sync::Arc};

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
        let (mut found, mut pace) = (Vec::with_capacity(count), Pace::new());
        while found.len() < count {
            found.extend(find(self, pace.batch(found.len(), count))?);
            let is_due = self.asked.elapsed().as_secs_f64() >= PAUSE;
            if found.len() < count && is_due && self.report().is_break() {
                break;
            }
        }
        Ok(found)
    }
}
