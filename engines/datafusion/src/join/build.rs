//! The geometries of an input, read once, and the side of a join that is held.
use super::tree::Tree;
use crate::column::encoding::Encoding;
use crate::column::features::Features;
use crate::column::read;
use arrow_array::RecordBatch;
use datafusion_common::Result;
use datafusion_execution::memory_pool::MemoryReservation;
use datafusion_physical_expr::PhysicalExpr;
use std::sync::Arc;

/// The name that messages about types give.
const NAME: &str = "BoxJoinExec";

/// The rows of the left input, its geometries, and their boxes in a tree.
pub(crate) struct Build {
    pub(crate) rows: RecordBatch,
    pub(crate) features: Arc<Features>,
    pub(crate) tree: Tree,
    /// Held as long as the rows are.
    _memory: MemoryReservation,
}

impl Build {
    /// The memory for the rows is reserved already.
    pub(crate) fn new(
        rows: RecordBatch,
        key: &Arc<dyn PhysicalExpr>,
        memory: MemoryReservation,
    ) -> Result<Build> {
        let features = features(&rows, key)?;
        memory.try_grow(features.size() + Tree::size_of(features.len()))?;
        let boxed = |row| {
            let bounds = features.bounds(features.at(row)?);
            bounds[0].cmple(bounds[1]).all().then_some((bounds, row))
        };
        let tree = Tree::new((0..features.len()).filter_map(boxed).collect());
        Ok(Build { rows, features: Arc::new(features), tree, _memory: memory })
    }
}

/// The geometries of a batch, all finite.
pub(crate) fn features(batch: &RecordBatch, key: &Arc<dyn PhysicalExpr>) -> Result<Features> {
    let field = key.return_field(batch.schema_ref())?;
    let values = key.evaluate(batch)?.into_array(batch.num_rows())?;
    let features = read::features(&values, &Encoding::of(NAME, &field)?, &field)?;
    Ok(features.all_finite()?)
}
