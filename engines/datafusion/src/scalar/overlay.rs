//! Booleans of the areas of two columns, and the areas of one made valid.
use super::pairs::{Overlay, Pairs};
use crate::column::features::Features;
use crate::column::write::Written;
use crate::error::Error;
use arrow_array::ArrayRef;
use arrow_schema::Field;
use datafusion_common::Result;
use geo_types::MultiPolygon;
use polycsg::Scratch;
use std::sync::Arc;

impl Overlay {
    /// The Boolean of each row; NULL where a side is.
    pub(crate) fn column(self, sides: [Features; 2], contacts: usize, result: &Field) -> Result<ArrayRef> {
        let rows = sides[0].len();
        let [one, other] = sides.map(Features::areas_only);
        let mut pairs = Pairs::new([Arc::new(one?), Arc::new(other?)], contacts);
        let mut written = Written::new(result)?;
        for row in 0..rows {
            let found = pairs.at(row).map(|pair| pairs.overlay(self, pair, row)).transpose()?;
            written.push(found.as_ref().map(MultiPolygon::from).as_ref())?;
        }
        Ok(written.finish())
    }
}

/// Each area made valid.
pub(crate) fn made_valid(columns: Vec<Features>, contacts: usize, result: &Field) -> Result<ArrayRef> {
    let (mut written, mut scratch) = (Written::new(result)?, Scratch::default());
    for features in columns {
        let features = features.areas_only()?;
        for row in 0..features.len() {
            let Some(feature) = features.at(row) else {
                written.push(None)?;
                continue;
            };
            let found = features.operand(feature)?.try_evaluate_with(&mut scratch, contacts);
            let found = found.map_err(|error| Error::row(row, error))?;
            written.push(Some(&MultiPolygon::from(&found)))?;
        }
    }
    Ok(written.finish())
}
