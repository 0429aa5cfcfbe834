//! Whether the geometries of two columns contain or meet one another, as closed sets.
use super::pairs::{Pairs, Relation};
use crate::column::features::Features;
use crate::error::Error;
use arrow_array::{ArrayRef, BooleanArray};
use datafusion_common::Result;
use std::sync::Arc;

impl Relation {
    /// Whether it holds in each row; NULL where a side is.
    pub(crate) fn column(self, sides: [Features; 2], contacts: usize) -> Result<ArrayRef> {
        let rows = sides[0].len();
        let [one, other] = sides.map(Features::all_finite);
        let mut pairs = Pairs::new([Arc::new(one?), Arc::new(other?)], contacts);
        let mut holds = |row| -> Result<Option<bool>, Error> {
            pairs.at(row).map(|pair| pairs.holds(self, pair, row)).transpose()
        };
        let found: Result<BooleanArray, Error> = (0..rows).map(&mut holds).collect();
        Ok(Arc::new(found?))
    }
}
