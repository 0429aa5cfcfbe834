//! The left input of a join, collected once for all partitions of the right one.
use super::build::Build;
use arrow_array::RecordBatch;
use arrow_select::concat::concat_batches;
use datafusion_common::utils::memory::get_record_batch_memory_size;
use datafusion_common::{DataFusionError, Result};
use datafusion_execution::SendableRecordBatchStream;
use datafusion_execution::memory_pool::MemoryReservation;
use datafusion_physical_expr::PhysicalExpr;
use futures::future::{BoxFuture, FutureExt, Shared, ready};
use futures::stream::TryStreamExt;
use std::sync::{Arc, Mutex, PoisonError};

type Shareable = Shared<BoxFuture<'static, Result<Arc<Build>, Arc<DataFusionError>>>>;

/// What the first partition starts to collect, and all wait for.
#[derive(Default)]
pub(crate) struct Collected(Mutex<Option<Shareable>>);

impl std::fmt::Debug for Collected {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Collected")
    }
}

impl Collected {
    /// The held side, from whoever came first.
    pub(crate) fn or_start(
        &self,
        start: impl FnOnce() -> Result<(SendableRecordBatchStream, MemoryReservation)>,
        key: &Arc<dyn PhysicalExpr>,
    ) -> BoxFuture<'static, Result<Arc<Build>>> {
        let mut held = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let shared = held.get_or_insert_with(|| {
            let key = Arc::clone(key);
            match start() {
                Ok((left, memory)) => collect(left, memory, key)
                    .map(|done| done.map(Arc::new).map_err(Arc::new))
                    .boxed()
                    .shared(),
                Err(error) => ready(Err(Arc::new(error))).boxed().shared(),
            }
        });
        shared.clone().map(|done| done.map_err(DataFusionError::Shared)).boxed()
    }
}

async fn collect(
    mut left: SendableRecordBatchStream,
    memory: MemoryReservation,
    key: Arc<dyn PhysicalExpr>,
) -> Result<Build> {
    let (schema, mut batches) = (left.schema(), Vec::<RecordBatch>::new());
    while let Some(batch) = left.try_next().await? {
        memory.try_grow(get_record_batch_memory_size(&batch))?;
        batches.push(batch);
    }
    let apart = memory.size();
    memory.try_grow(apart)?; // to join batches takes them twice
    let rows = concat_batches(&schema, &batches)?;
    drop(batches);
    memory.shrink(apart);
    Build::new(rows, &key, memory)
}
