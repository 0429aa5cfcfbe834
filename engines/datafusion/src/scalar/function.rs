//! What the engine sees of a function of rows: its name, its types, and how a batch goes through it.
use super::{measure, overlay, pairs};
use crate::column::encoding::{Encoding, common, leading, may_be_geometry};
use crate::column::features::Features;
use crate::column::read;
use crate::page::Page;
use arrow_array::ArrayRef;
use arrow_schema::{DataType, Field, FieldRef};
use datafusion_common::{Result, ScalarValue, internal_err, plan_err};
use datafusion_expr::{
    ColumnarValue, Documentation, ReturnFieldArgs, ScalarFunctionArgs, ScalarUDFImpl, Signature, Volatility,
};
use std::sync::Arc;

/// What a function does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Operation {
    Overlay(pairs::Overlay),
    MakeValid,
    Measure(measure::Measure),
    Relate(pairs::Relation),
}

/// A function of rows.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Function {
    page: Page,
    operation: Operation,
    signature: Signature,
    contacts: usize,
}

impl Function {
    pub(crate) fn new(page: Page, operation: Operation, contacts: usize) -> Function {
        Function { page, operation, signature: Signature::user_defined(Volatility::Immutable), contacts }
    }

    #[cfg(feature = "join")]
    pub(crate) fn operation(&self) -> Operation {
        self.operation
    }

    #[cfg(feature = "join")]
    pub(crate) fn contacts(&self) -> usize {
        self.contacts
    }

    fn arity(&self) -> usize {
        match self.operation {
            Operation::Overlay(_) | Operation::Relate(_) => 2,
            Operation::MakeValid | Operation::Measure(_) => 1,
        }
    }

    fn run(&self, columns: Vec<Features>, result: &Field) -> Result<ArrayRef> {
        match (self.operation, <[Features; 2]>::try_from(columns)) {
            (Operation::Overlay(overlay), Ok(sides)) => overlay.column(sides, self.contacts, result),
            (Operation::Relate(relation), Ok(sides)) => relation.column(sides, self.contacts),
            (Operation::MakeValid, Err(one)) => overlay::made_valid(one, self.contacts, result),
            (Operation::Measure(measure), Err(one)) => measure.column(one, self.contacts),
            _ => internal_err!("{} was planned with another number of arguments", self.page.name),
        }
    }
}

impl ScalarUDFImpl for Function {
    fn name(&self) -> &str {
        self.page.name
    }

    fn signature(&self) -> &Signature {
        &self.signature
    }

    fn return_type(&self, _: &[DataType]) -> Result<DataType> {
        internal_err!("the result's type depends on metadata: return_field_from_args tells it")
    }

    fn return_field_from_args(&self, args: ReturnFieldArgs) -> Result<FieldRef> {
        args.arg_fields.iter().try_for_each(|field| Encoding::of(self.page.name, field).map(drop))?;
        let encoding = common(self.page.name, args.arg_fields)?;
        let plain = |kind| Arc::new(Field::new(self.page.name, kind, true));
        Ok(match self.operation {
            Operation::Overlay(_) | Operation::MakeValid => {
                encoding.result_field(self.page.name, &leading(args.arg_fields))
            }
            Operation::Measure(measure) => plain(measure.kind()),
            Operation::Relate(_) => plain(DataType::Boolean),
        })
    }

    fn coerce_types(&self, kinds: &[DataType]) -> Result<Vec<DataType>> {
        if kinds.len() != self.arity() {
            return plan_err!("{} takes {} geometries, not {}", self.page.name, self.arity(), kinds.len());
        }
        match kinds.iter().find(|kind| !may_be_geometry(kind)) {
            Some(other) => {
                plan_err!("{} takes geometries as WKB (a binary) or as GeoArrow, not {other}", self.page.name)
            }
            None => Ok(kinds.to_vec()),
        }
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let is_constant = args.args.iter().all(|value| matches!(value, ColumnarValue::Scalar(_)));
        let rows = if is_constant { 1 } else { args.number_rows };
        let columns = args.args.iter().zip(&args.arg_fields);
        let columns: Result<Vec<Features>> =
            columns.map(|(value, field)| features(self.page.name, value, field, rows)).collect();
        let found = self.run(columns?, &args.return_field)?;
        match is_constant {
            true => Ok(ColumnarValue::Scalar(ScalarValue::try_from_array(&found, 0)?)),
            false => Ok(ColumnarValue::Array(found)),
        }
    }

    fn documentation(&self) -> Option<&Documentation> {
        Some(self.page.documentation())
    }
}

/// A constant is read once, and stands in every row.
fn features(function: &str, value: &ColumnarValue, field: &Field, rows: usize) -> Result<Features> {
    let encoding = Encoding::of(function, field)?;
    match value {
        ColumnarValue::Array(array) => read::features(array, &encoding, field),
        ColumnarValue::Scalar(one) => Ok(read::features(&one.to_array()?, &encoding, field)?.stretched(rows)),
    }
}
