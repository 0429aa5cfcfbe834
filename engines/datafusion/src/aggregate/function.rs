//! What the engine sees of an aggregate: its name, its types, and its accumulators.
use super::accumulator::One;
use super::evaluate::GroupLimits;
use super::group::Aggregate;
use super::groups::Groups;
use crate::column::encoding::{Encoding, may_be_geometry};
use crate::page::Page;
use arrow_schema::{DataType, Field, FieldRef};
use datafusion_common::{Result, internal_err, plan_err};
use datafusion_expr::function::{AccumulatorArgs, StateFieldsArgs};
use datafusion_expr::utils::{AggregateOrderSensitivity, format_state_name};
use datafusion_expr::{
    Accumulator, AggregateUDFImpl, Documentation, GroupsAccumulator, Signature, Volatility,
};
use std::sync::Arc;

/// A function of groups.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct AggregateFunction {
    page: Page,
    aggregate: Aggregate,
    signature: Signature,
    limits: GroupLimits,
}

impl AggregateFunction {
    pub(crate) fn new(page: Page, aggregate: Aggregate, limits: GroupLimits) -> AggregateFunction {
        let signature = Signature::user_defined(Volatility::Immutable);
        AggregateFunction { page, aggregate, signature, limits }
    }

    fn groups(&self, args: &AccumulatorArgs) -> Result<Groups> {
        let [field] = args.expr_fields else {
            return internal_err!("{} was planned with {} arguments", self.page.name, args.expr_fields.len());
        };
        let input = (Encoding::of(self.page.name, field)?, field.clone());
        Ok(Groups::new(self.aggregate, input, args.return_field.clone(), self.limits))
    }
}

impl AggregateUDFImpl for AggregateFunction {
    fn name(&self) -> &str {
        self.page.name
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        internal_err!("the result's type depends on metadata: return_field tells it")
    }

    fn return_field(&self, fields: &[FieldRef]) -> Result<FieldRef> {
        match fields {
            [field] => Ok(Encoding::of(self.page.name, field)?.result_field(self.page.name, field)),
            _ => plan_err!("{} takes one geometry, not {}", self.page.name, fields.len()),
        }
    }

    fn coerce_types(&self, kinds: &[DataType]) -> Result<Vec<DataType>> {
        match kinds {
            [kind] if may_be_geometry(kind) => Ok(kinds.to_vec()),
            [other] => {
                plan_err!("{} takes geometries as WKB (a binary) or as GeoArrow, not {other}", self.page.name)
            }
            _ => plan_err!("{} takes one geometry, not {}", self.page.name, kinds.len()),
        }
    }

    fn accumulator(&self, args: AccumulatorArgs) -> Result<Box<dyn Accumulator>> {
        Ok(Box::new(One::new(self.groups(&args)?)))
    }

    fn groups_accumulator_supported(&self, _: AccumulatorArgs) -> bool {
        true
    }

    fn create_groups_accumulator(&self, args: AccumulatorArgs) -> Result<Box<dyn GroupsAccumulator>> {
        Ok(Box::new(self.groups(&args)?))
    }

    fn state_fields(&self, args: StateFieldsArgs) -> Result<Vec<FieldRef>> {
        let name = format_state_name(args.name, "rings");
        Ok(vec![Arc::new(Field::new(name, DataType::LargeBinary, true))])
    }

    fn order_sensitivity(&self) -> AggregateOrderSensitivity {
        AggregateOrderSensitivity::Insensitive
    }

    fn documentation(&self) -> Option<&Documentation> {
        Some(self.page.documentation())
    }
}
