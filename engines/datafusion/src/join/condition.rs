//! What a join asks: a relation of a geometry of each side, and the rest of its filter.
use super::sides::of_one_side;
use crate::scalar::function::{Function, Operation};
use crate::scalar::pairs::Relation;
use datafusion_common::{JoinSide, Result};
use datafusion_physical_expr::utils::{conjunction_opt, split_conjunction};
use datafusion_physical_expr::{PhysicalExpr, ScalarFunctionExpr};
use datafusion_physical_plan::joins::utils::JoinFilter;
use std::sync::Arc;

/// A relation of geometries, each an expression over one input.
#[derive(Clone, Debug)]
pub(crate) struct Condition {
    pub(crate) relation: Relation,
    /// The left geometry and the right one.
    pub(crate) keys: [Arc<dyn PhysicalExpr>; 2],
    /// Whether the relation's first argument is the right one.
    pub(crate) is_swapped: bool,
    pub(crate) contacts: usize,
    /// The other conjuncts.
    pub(crate) rest: Option<JoinFilter>,
}

impl Condition {
    /// That of a filter, if one of its conjuncts is a relation of both sides.
    pub(crate) fn of(filter: &JoinFilter) -> Result<Option<Condition>> {
        let conjuncts = split_conjunction(filter.expression());
        for (i, conjunct) in conjuncts.iter().enumerate() {
            let Some((relation, keys, is_swapped, contacts)) = related(conjunct, filter)? else { continue };
            let others = conjuncts.iter().enumerate().filter(|(j, _)| *j != i);
            let rest = conjunction_opt(others.map(|(_, other)| Arc::clone(other)));
            let rest = rest.map(|rest| {
                JoinFilter::new(rest, filter.column_indices().to_vec(), Arc::clone(filter.schema()))
            });
            return Ok(Some(Condition { relation, keys, is_swapped, contacts, rest }));
        }
        Ok(None)
    }
}

type Related = (Relation, [Arc<dyn PhysicalExpr>; 2], bool, usize);

fn related(conjunct: &Arc<dyn PhysicalExpr>, filter: &JoinFilter) -> Result<Option<Related>> {
    let Some((function, [first, second])) = called(conjunct) else { return Ok(None) };
    let Operation::Relate(relation) = function.operation() else { return Ok(None) };
    let columns = filter.column_indices();
    let (first, second) = (of_one_side(first, columns)?, of_one_side(second, columns)?);
    let contacts = function.contacts();
    Ok(match (first, second) {
        (Some((JoinSide::Left, left)), Some((JoinSide::Right, right))) => {
            Some((relation, [left, right], false, contacts))
        }
        (Some((JoinSide::Right, right)), Some((JoinSide::Left, left))) => {
            Some((relation, [left, right], true, contacts))
        }
        _ => None,
    })
}

/// One of this crate's functions of two geometries, and its arguments.
pub(crate) fn called(expression: &Arc<dyn PhysicalExpr>) -> Option<(&Function, &[Arc<dyn PhysicalExpr>; 2])> {
    let call = expression.downcast_ref::<ScalarFunctionExpr>()?;
    Some((call.fun().inner().downcast_ref::<Function>()?, call.args().try_into().ok()?))
}
