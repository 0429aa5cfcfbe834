//! A Boolean of the two geometries that a join compares, which the join gives as a column of its own: its pairs are read already, and
//! what they have in common tells that they meet.
use super::condition::{Condition, called};
use super::sides::of_one_side;
use crate::scalar::function::Operation;
use crate::scalar::pairs::Overlay;
use arrow_schema::{FieldRef, Schema};
use datafusion_common::{JoinSide, Result};
use datafusion_physical_expr::PhysicalExpr;
use datafusion_physical_plan::joins::utils::ColumnIndex;
use std::sync::Arc;

/// A Boolean as a column of a join.
#[derive(Clone, Debug)]
pub(crate) struct Overlaid {
    pub(crate) overlay: Overlay,
    /// Whether its first argument is the right geometry.
    pub(crate) is_swapped: bool,
    pub(crate) field: FieldRef,
    /// The call, over the join's columns without it.
    pub(crate) expression: Arc<dyn PhysicalExpr>,
}

impl Overlaid {
    /// A call in a projection over a join, if it is of the join's geometries and within its limit.
    pub(crate) fn of(
        expression: &Arc<dyn PhysicalExpr>,
        condition: &Condition,
        columns: &[ColumnIndex],
        schema: &Schema,
    ) -> Result<Option<Overlaid>> {
        let Some((function, [first, second])) = called(expression) else { return Ok(None) };
        let Operation::Overlay(overlay) = function.operation() else { return Ok(None) };
        let (first, second) = (of_one_side(first, columns)?, of_one_side(second, columns)?);
        let (Some((side, first)), Some((other, second))) = (first, second) else { return Ok(None) };
        let is_swapped = side == JoinSide::Right;
        let keys = if is_swapped { [second, first] } else { [first, second] };
        if side == other || keys != condition.keys || function.contacts() != condition.contacts {
            return Ok(None);
        }
        let field = expression.return_field(schema)?;
        Ok(Some(Overlaid { overlay, is_swapped, field, expression: Arc::clone(expression) }))
    }
}
