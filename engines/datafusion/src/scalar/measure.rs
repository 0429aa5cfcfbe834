//! What is told of each geometry of a column: its area, whether it is valid, and why not.
use crate::column::features::Features;
use crate::error::Error;
use crate::validity::flaw_of;
use arrow_array::{ArrayRef, BooleanArray, Float64Array, StringArray};
use arrow_schema::DataType;
use datafusion_common::Result;
use polycsg::{Flaw, Scratch};
use std::sync::Arc;

/// PostGIS says so of a valid geometry.
const VALID: &str = "Valid Geometry";

/// A question about one geometry.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Measure {
    Area,
    IsValid,
    IsValidReason,
}

impl Measure {
    /// The type of the answers.
    pub(crate) fn kind(self) -> DataType {
        match self {
            Measure::Area => DataType::Float64,
            Measure::IsValid => DataType::Boolean,
            Measure::IsValidReason => DataType::Utf8,
        }
    }

    /// The answer of each row; NULL where the geometry is.
    pub(crate) fn column(self, columns: Vec<Features>, contacts: usize) -> Result<ArrayRef> {
        let features = columns.into_iter().next().unwrap_or_default();
        let mut scratch = Scratch::default();
        let mut flaw = |row: usize| -> Result<Option<Option<Flaw>>, Error> {
            let found = features.at(row).map(|it| flaw_of(&features, it, contacts, &mut scratch));
            found.transpose()
        };
        let rows = 0..features.len();
        Ok(match self {
            Measure::Area => Arc::new(areas(&features, contacts)?) as ArrayRef,
            Measure::IsValid => {
                let is_valid = |row| Ok(flaw(row)?.map(|flaw| flaw.is_none()));
                Arc::new(rows.map(is_valid).collect::<Result<BooleanArray, Error>>()?)
            }
            Measure::IsValidReason => {
                let reason = |row| Ok(flaw(row)?.map(told));
                Arc::new(rows.map(reason).collect::<Result<StringArray, Error>>()?)
            }
        })
    }
}

fn told(flaw: Option<Flaw>) -> String {
    flaw.map_or(VALID.to_string(), |flaw| flaw.to_string())
}

fn areas(features: &Features, contacts: usize) -> Result<Float64Array, Error> {
    let mut scratch = Scratch::default();
    let mut area = |row| -> Result<Option<f64>, Error> {
        let Some(feature) = features.at(row) else { return Ok(None) };
        let operand = features.operand(feature)?;
        let boundary = operand.try_boundary(&mut scratch, contacts);
        Ok(Some(boundary.map_err(|error| Error::row(row, error))?.area()))
    };
    (0..features.len()).map(&mut area).collect()
}
