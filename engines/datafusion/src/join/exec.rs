//! The join as a physical plan.
use super::build::Build;
use super::collect::Collected;
use super::condition::Condition;
use super::overlaid::Overlaid;
use super::probe::{Output, Probe};
use arrow_array::RecordBatch;
use arrow_schema::{Schema, SchemaRef};
use datafusion_common::tree_node::TreeNodeRecursion;
use datafusion_common::{JoinSide, Result, internal_datafusion_err, internal_err};
use datafusion_execution::memory_pool::MemoryConsumer;
use datafusion_execution::{SendableRecordBatchStream, TaskContext};
use datafusion_expr::JoinType;
use datafusion_physical_expr::{EquivalenceProperties, PhysicalExpr};
use datafusion_physical_plan::execution_plan::ReplaceChildrenOptions;
use datafusion_physical_plan::joins::utils::ColumnIndex;
use datafusion_physical_plan::joins::{NestedLoopJoinExec, NestedLoopJoinExecBuilder};
use datafusion_physical_plan::metrics::{BaselineMetrics, ExecutionPlanMetricsSet, MetricsSet};
use datafusion_physical_plan::stream::RecordBatchStreamAdapter;
use datafusion_physical_plan::{
    DisplayAs, DisplayFormatType, ExecutionPlan, ExecutionPlanProperties, InputDistributionRequirements,
    PlanProperties, apply_expression_roots,
};
use futures::future::BoxFuture;
use futures::stream::{TryStreamExt, try_unfold};
use std::fmt::Formatter;
use std::sync::Arc;
use std::task::Poll;

/// An inner join whose pairs are found by boxes: the left input is held, its geometries are read once and their boxes stand in a tree;
/// the right input goes past it.
#[derive(Debug)]
pub(crate) struct BoxJoinExec {
    /// What it stands for: inputs, filter and projection.
    nested: NestedLoopJoinExec,
    condition: Condition,
    overlaid: Vec<Overlaid>,
    properties: Arc<PlanProperties>,
    collected: Collected,
    metrics: ExecutionPlanMetricsSet,
}

impl BoxJoinExec {
    /// The join that stands for a nested loop; none, if its filter has no relation of geometries.
    pub(crate) fn of(nested: &NestedLoopJoinExec) -> Result<Option<BoxJoinExec>> {
        let condition = match (nested.join_type(), nested.filter()) {
            (JoinType::Inner, Some(filter)) => Condition::of(filter)?,
            _ => None,
        };
        let anew =
            |condition| BoxJoinExec::new(NestedLoopJoinExecBuilder::from(nested).build()?, condition, vec![]);
        condition.map(anew).transpose()
    }

    fn new(nested: NestedLoopJoinExec, condition: Condition, overlaid: Vec<Overlaid>) -> Result<BoxJoinExec> {
        let properties = if overlaid.is_empty() {
            Arc::clone(nested.properties())
        } else {
            Arc::new(with_columns(nested.properties(), &overlaid))
        };
        let (collected, metrics) = (Collected::default(), ExecutionPlanMetricsSet::new());
        Ok(BoxJoinExec { nested, condition, overlaid, properties, collected, metrics })
    }

    /// The same join, with some of its columns and Booleans behind them.
    pub(crate) fn with(&self, columns: Vec<usize>, overlaid: Vec<Overlaid>) -> Result<BoxJoinExec> {
        let nested = self.nested.with_projection(Some(columns))?;
        BoxJoinExec::new(nested, self.condition.clone(), overlaid)
    }

    pub(crate) fn condition(&self) -> &Condition {
        &self.condition
    }

    /// Whether it gives nothing but columns of its inputs.
    pub(crate) fn is_bare(&self) -> bool {
        self.overlaid.is_empty()
    }

    /// Where the columns come from that are of its inputs.
    pub(crate) fn columns(&self) -> Vec<ColumnIndex> {
        let left = self.nested.left().schema().fields().len();
        let all = left + self.nested.right().schema().fields().len();
        let column = |i: usize| match i.checked_sub(left) {
            None => ColumnIndex { index: i, side: JoinSide::Left },
            Some(index) => ColumnIndex { index, side: JoinSide::Right },
        };
        match self.nested.projection() {
            Some(kept) => kept.iter().map(|&i| column(i)).collect(),
            None => (0..all).map(column).collect(),
        }
    }

    fn output(&self, batch_size: usize) -> Output {
        let (schema, columns) = (self.schema(), self.columns());
        Output { schema, columns, overlaid: self.overlaid.clone(), batch_size: batch_size.max(1) }
    }
}

/// The columns of Booleans stand behind the others, so that what is known of these by number stays true.
fn with_columns(before: &PlanProperties, overlaid: &[Overlaid]) -> PlanProperties {
    let schema = before.eq_properties.schema();
    let fields = schema.fields().iter().chain(overlaid.iter().map(|it| &it.field));
    let schema: SchemaRef =
        Arc::new(Schema::new_with_metadata(fields.cloned().collect::<Vec<_>>(), schema.metadata().clone()));
    PlanProperties::new(
        EquivalenceProperties::new(schema),
        before.partitioning.clone(),
        before.emission_type,
        before.boundedness,
    )
}

impl DisplayAs for BoxJoinExec {
    fn fmt_as(&self, kind: DisplayFormatType, f: &mut Formatter<'_>) -> std::fmt::Result {
        if kind == DisplayFormatType::TreeRender {
            return Ok(());
        }
        let filter = self.nested.filter().map(|filter| filter.expression().to_string());
        write!(f, "BoxJoinExec: join_type=Inner, filter={}", filter.unwrap_or_default())?;
        let schema = self.schema();
        let names: Vec<&str> = schema.fields().iter().map(|field| field.name().as_str()).collect();
        write!(f, ", columns=[{}]", names.join(", "))
    }
}

impl ExecutionPlan for BoxJoinExec {
    fn name(&self) -> &'static str {
        "BoxJoinExec"
    }

    fn properties(&self) -> &Arc<PlanProperties> {
        &self.properties
    }

    fn input_distribution_requirements(&self) -> InputDistributionRequirements {
        self.nested.input_distribution_requirements()
    }

    fn maintains_input_order(&self) -> Vec<bool> {
        vec![false, false]
    }

    fn children(&self) -> Vec<&Arc<dyn ExecutionPlan>> {
        self.nested.children()
    }

    fn apply_expressions(
        &self,
        see: &mut dyn FnMut(&Arc<dyn PhysicalExpr>) -> Result<TreeNodeRecursion>,
    ) -> Result<TreeNodeRecursion> {
        apply_expression_roots(self.nested.filter().iter().map(|filter| filter.expression()), see)
    }

    fn replace_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
        _: ReplaceChildrenOptions,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let Ok([left, right]) = <[_; 2]>::try_from(children) else {
            return internal_err!("BoxJoinExec has two inputs");
        };
        let projection = self.nested.projection().as_ref().map(|kept| kept.to_vec());
        let filter = self.nested.filter().cloned();
        let nested = NestedLoopJoinExec::try_new(left, right, filter, &JoinType::Inner, projection)?;
        Ok(Arc::new(BoxJoinExec::new(nested, self.condition.clone(), self.overlaid.clone())?))
    }

    fn with_new_children(
        self: Arc<Self>,
        children: Vec<Arc<dyn ExecutionPlan>>,
    ) -> Result<Arc<dyn ExecutionPlan>> {
        let recomputed = datafusion_physical_plan::execution_plan::ChildrenPropertiesMode::Recompute;
        self.replace_children(children, ReplaceChildrenOptions::new(recomputed))
    }

    fn execute(&self, partition: usize, context: Arc<TaskContext>) -> Result<SendableRecordBatchStream> {
        if self.nested.left().output_partitioning().partition_count() != 1 {
            return internal_err!("the left input of BoxJoinExec has more than one partition");
        }
        let start = || {
            let memory = MemoryConsumer::new("BoxJoinExec").register(context.memory_pool());
            Ok((self.nested.left().execute(0, Arc::clone(&context))?, memory))
        };
        let running = Running {
            build: Some(self.collected.or_start(start, &self.condition.keys[0])),
            built: None,
            right: self.nested.right().execute(partition, Arc::clone(&context))?,
            probe: None,
            condition: self.condition.clone(),
            output: self.output(context.session_config().batch_size()),
            metrics: BaselineMetrics::new(&self.metrics, partition),
        };
        let batches = try_unfold(running, Running::next);
        Ok(Box::pin(RecordBatchStreamAdapter::new(self.schema(), batches)))
    }

    fn metrics(&self) -> Option<MetricsSet> {
        Some(self.metrics.clone_inner())
    }
}

/// A partition on its way.
struct Running {
    build: Option<BoxFuture<'static, Result<Arc<Build>>>>,
    built: Option<Arc<Build>>,
    right: SendableRecordBatchStream,
    probe: Option<Probe>,
    condition: Condition,
    output: Output,
    metrics: BaselineMetrics,
}

impl Running {
    /// The next batch that is not empty, and what comes behind it.
    async fn next(mut self) -> Result<Option<(RecordBatch, Running)>> {
        loop {
            pause().await;
            if self.probe.is_none() && !self.next_probe().await? {
                return Ok(None);
            }
            match self.step()? {
                None => self.probe = None,
                Some(batch) if batch.num_rows() > 0 => {
                    self.metrics.record_output(batch.num_rows());
                    return Ok(Some((batch, self)));
                }
                Some(_) => {}
            }
        }
    }

    fn step(&mut self) -> Result<Option<RecordBatch>> {
        let _timed = self.metrics.elapsed_compute().timer();
        let Some(probe) = &mut self.probe else { return Ok(None) };
        probe.step(&self.condition, &self.output)
    }

    /// Starts on the next batch of the right input; false, if there is none. Where the left one is empty, the right one is not read.
    async fn next_probe(&mut self) -> Result<bool> {
        if let Some(build) = self.build.take() {
            self.built = Some(build.await?);
        }
        let built = self.built.as_ref().ok_or_else(|| internal_datafusion_err!("nothing was collected"))?;
        if built.rows.num_rows() == 0 {
            return Ok(false);
        }
        let Some(batch) = self.right.try_next().await? else { return Ok(false) };
        self.probe = Some(Probe::new(Arc::clone(built), batch, &self.condition)?);
        Ok(true)
    }
}

/// Lets the runtime go on with something else, or end a query that was cancelled.
async fn pause() {
    let mut is_over = false;
    futures::future::poll_fn(|context| {
        if std::mem::replace(&mut is_over, true) {
            return Poll::Ready(());
        }
        context.waker().wake_by_ref();
        Poll::Pending
    })
    .await;
}
