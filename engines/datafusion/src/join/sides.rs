//! Expressions over the columns of two inputs, told apart by their side.
use datafusion_common::tree_node::{Transformed, TransformedResult, TreeNode};
use datafusion_common::{JoinSide, Result};
use datafusion_physical_expr::PhysicalExpr;
use datafusion_physical_expr::expressions::Column;
use datafusion_physical_expr::utils::collect_columns;
use datafusion_physical_plan::joins::utils::ColumnIndex;
use std::sync::Arc;

/// An expression as one over a single input, and which one; none, if it takes columns of both or of neither.
pub(crate) fn of_one_side(
    expression: &Arc<dyn PhysicalExpr>,
    columns: &[ColumnIndex],
) -> Result<Option<(JoinSide, Arc<dyn PhysicalExpr>)>> {
    let taken = collect_columns(expression);
    let sides = [JoinSide::Left, JoinSide::Right];
    let is_of = |side: &JoinSide| taken.iter().all(|column| columns[column.index()].side == *side);
    let Some(side) = sides.into_iter().find(is_of).filter(|_| !taken.is_empty()) else { return Ok(None) };
    let own = |column: &Column| columns[column.index()].index;
    Ok(Some((side, with_columns(expression, &own)?)))
}

/// An expression with its columns renumbered.
pub(crate) fn with_columns(
    expression: &Arc<dyn PhysicalExpr>,
    number: &dyn Fn(&Column) -> usize,
) -> Result<Arc<dyn PhysicalExpr>> {
    let renumbered = |expression: Arc<dyn PhysicalExpr>| match expression.downcast_ref::<Column>() {
        Some(column) => {
            let column = Column::new(column.name(), number(column));
            Ok(Transformed::yes(Arc::new(column) as Arc<dyn PhysicalExpr>))
        }
        None => Ok(Transformed::no(expression)),
    };
    Arc::clone(expression).transform_up(renumbered).data()
}
