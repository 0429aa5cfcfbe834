//! Where a nested loop of an engine's plan becomes a join by boxes.
use super::exec::BoxJoinExec;
use super::overlaid::Overlaid;
use super::sides::with_columns;
use datafusion_common::Result;
use datafusion_common::config::ConfigOptions;
use datafusion_common::tree_node::{Transformed, TransformedResult, TreeNode};
use datafusion_physical_expr::PhysicalExpr;
use datafusion_physical_expr::expressions::Column;
use datafusion_physical_expr::utils::collect_columns;
use datafusion_physical_optimizer::PhysicalOptimizerRule;
use datafusion_physical_plan::ExecutionPlan;
use datafusion_physical_plan::joins::NestedLoopJoinExec;
use datafusion_physical_plan::projection::{ProjectionExec, ProjectionExpr};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Replaces nested loops by joins by boxes, where they are inner joins on `ST_Intersects` or `ST_Contains` of a geometry of each side.
///
/// The rows are those of the nested loop; their order is another one. The left input is held in memory, within the engine's limit. A
/// Boolean of the two geometries that stands in the projection over the join, as `ST_Intersection`, is taken from the comparison.
/// `EXPLAIN` shows a `BoxJoinExec`. Register the rule behind the engine's own ones:
///
/// ```
/// use datafusion::execution::SessionStateBuilder;
/// use datafusion::prelude::SessionContext;
/// use polycsg_datafusion::{BoxJoin, Functions};
/// use std::sync::Arc;
/// # tokio::runtime::Runtime::new()?.block_on(async {
/// let state = SessionStateBuilder::new().with_default_features().with_physical_optimizer_rule(Arc::new(BoxJoin));
/// let mut context = SessionContext::new_with_state(state.build());
/// Functions::default().register(&mut context)?;
/// let tables = "CREATE TABLE a AS SELECT X'0101000000000000000000F03F0000000000000040' AS geom";
/// context.sql(tables).await?;
/// let plan = context.sql("EXPLAIN SELECT count(*) FROM a JOIN a AS b ON st_intersects(a.geom, b.geom)").await?;
/// assert!(plan.to_string().await?.contains("BoxJoinExec"));
/// # Ok::<(), datafusion::error::DataFusionError>(()) })?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct BoxJoin;

impl PhysicalOptimizerRule for BoxJoin {
    fn optimize(&self, plan: Arc<dyn ExecutionPlan>, _: &ConfigOptions) -> Result<Arc<dyn ExecutionPlan>> {
        plan.transform_up(replaced).data()
    }

    fn name(&self) -> &'static str {
        "box_join"
    }

    fn schema_check(&self) -> bool {
        true
    }
}

fn replaced(plan: Arc<dyn ExecutionPlan>) -> Result<Transformed<Arc<dyn ExecutionPlan>>> {
    let found = if let Some(nested) = plan.downcast_ref::<NestedLoopJoinExec>() {
        BoxJoinExec::of(nested)?.map(|join| Arc::new(join) as Arc<dyn ExecutionPlan>)
    } else if let Some(projection) = plan.downcast_ref::<ProjectionExec>() {
        match projection.input().downcast_ref::<BoxJoinExec>() {
            Some(join) if join.is_bare() => overlaid(projection, join)?,
            _ => None,
        }
    } else {
        None
    };
    Ok(found.map_or_else(|| Transformed::no(plan), Transformed::yes))
}

/// A projection whose Booleans the join gives; none, if it has none.
fn overlaid(projection: &ProjectionExec, join: &BoxJoinExec) -> Result<Option<Arc<dyn ExecutionPlan>>> {
    let mut found: Vec<Overlaid> = Vec::new();
    let count = join.columns().len();
    let given = |it: &ProjectionExpr| {
        let expression = Arc::clone(&it.expr).transform_down(|part| by_join(part, join, count, &mut found));
        expression.data().map(|expression| (expression, it.alias.clone()))
    };
    let expressions: Vec<(Arc<dyn PhysicalExpr>, String)> =
        projection.expr().iter().map(given).collect::<Result<_>>()?;
    if found.is_empty() {
        return Ok(None);
    }
    let used: BTreeSet<usize> =
        expressions.iter().flat_map(|(it, _)| collect_columns(it)).map(|column| column.index()).collect();
    let kept: Vec<usize> = used.iter().copied().filter(|&i| i < count).collect();
    // Columns that nobody asks for are dropped, so that the others, and the Booleans behind them, move up.
    let number = |column: &Column| match column.index().checked_sub(count) {
        Some(boolean) => kept.len() + boolean,
        None => kept.partition_point(|&i| i < column.index()),
    };
    let renumbered = |(it, alias): (Arc<dyn PhysicalExpr>, String)| {
        with_columns(&it, &number).map(|expr| ProjectionExpr { expr, alias })
    };
    let expressions: Vec<ProjectionExpr> = expressions.into_iter().map(renumbered).collect::<Result<_>>()?;
    let join: Arc<dyn ExecutionPlan> = Arc::new(join.with(kept.clone(), found)?);
    Ok(Some(Arc::new(ProjectionExec::try_new(expressions, join)?)))
}

/// A part of an expression as a column of the join, if it is a Boolean of its geometries.
fn by_join(
    part: Arc<dyn PhysicalExpr>,
    join: &BoxJoinExec,
    count: usize,
    found: &mut Vec<Overlaid>,
) -> Result<Transformed<Arc<dyn PhysicalExpr>>> {
    let schema = join.schema();
    let Some(overlaid) = Overlaid::of(&part, join.condition(), &join.columns(), &schema)? else {
        return Ok(Transformed::no(part));
    };
    let before = found.iter().position(|it| it.expression.eq(&overlaid.expression));
    let place = before.unwrap_or(found.len());
    let column = Column::new(overlaid.field.name(), count + place);
    if before.is_none() {
        found.push(overlaid);
    }
    Ok(Transformed::yes(Arc::new(column)))
}
