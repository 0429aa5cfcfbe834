//! Whether the geometries of two columns contain or meet one another, as closed sets.
use super::side::Side;
use crate::column::features::Features;
use crate::error::Error;
use arrow_array::{ArrayRef, BooleanArray};
use datafusion_common::Result;
use polycsg::{DVec2, Location, Scratch};
use std::sync::Arc;

/// A relation of two closed sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Relation {
    Contains,
    Intersects,
}

impl Relation {
    /// Whether it holds in each row; NULL where a side is.
    pub(crate) fn column(self, sides: [Features; 2], contacts: usize) -> Result<ArrayRef> {
        let rows = sides[0].len();
        let [one, other] = sides.map(Features::all_finite);
        let (mut one, mut other) = (Side::new(one?), Side::new(other?));
        let mut scratch = Scratch::default();
        let mut holds = |row| -> Result<Option<bool>, Error> {
            let (Some(a), Some(b)) = (one.at(row), other.at(row)) else { return Ok(None) };
            if !one.boxes_meet(a, &other, b) {
                return Ok(Some(false));
            }
            let mut pair = Pair { one: &mut one, other: &mut other, contacts, row, scratch: &mut scratch };
            pair.holds(self, [a, b]).map(Some)
        };
        let found: Result<BooleanArray, Error> = (0..rows).map(&mut holds).collect();
        Ok(Arc::new(found?))
    }
}

/// One row of both sides.
struct Pair<'a> {
    one: &'a mut Side,
    other: &'a mut Side,
    contacts: usize,
    row: usize,
    scratch: &'a mut Scratch,
}

impl Pair<'_> {
    /// The boxes of the two meet, so that neither is empty of points.
    fn holds(&mut self, relation: Relation, [a, b]: [usize; 2]) -> Result<bool, Error> {
        match (self.one.point(a), self.other.point(b), relation) {
            (Some(p), Some(q), _) => Ok(p.is_some() && p == q),
            (None, Some(q), _) => self.one_has(a, q),
            (Some(p), None, Relation::Intersects) => self.other_has(b, p),
            (Some(_), None, Relation::Contains) => Ok(false),
            (None, None, Relation::Contains) => self.contains([a, b]),
            (None, None, Relation::Intersects) => self.intersects([a, b]),
        }
    }

    fn one_has(&mut self, a: usize, point: Option<DVec2>) -> Result<bool, Error> {
        let region = self.one.prepared(a, self.contacts, self.scratch)?;
        Ok(point.is_some_and(|point| region.locate(point) != Location::Outside))
    }

    fn other_has(&mut self, b: usize, point: Option<DVec2>) -> Result<bool, Error> {
        let region = self.other.prepared(b, self.contacts, self.scratch)?;
        Ok(point.is_some_and(|point| region.locate(point) != Location::Outside))
    }

    /// Whether the other is not empty and nothing of it is left without the one.
    fn contains(&mut self, [a, b]: [usize; 2]) -> Result<bool, Error> {
        let other = self.other.operand(b, self.contacts, self.scratch)?;
        let refused = |error| Error::row(self.row, error);
        let is_empty = other.try_boundary(self.scratch, self.contacts).map_err(refused)?.is_empty();
        let one = self.one.operand(a, self.contacts, self.scratch)?;
        let rest = other - one;
        Ok(!is_empty && rest.try_boundary(self.scratch, self.contacts).map_err(refused)?.is_empty())
    }

    fn intersects(&mut self, [a, b]: [usize; 2]) -> Result<bool, Error> {
        // Meeting edges are counted before they are looked at without a limit.
        let both = self.one.operand(a, self.contacts, self.scratch)?
            & self.other.operand(b, self.contacts, self.scratch)?;
        let common = both.try_boundary(self.scratch, self.contacts);
        if !common.map_err(|error| Error::row(self.row, error))?.is_empty() {
            return Ok(true);
        }
        let other = self.other.prepared(b, self.contacts, self.scratch)?.region();
        Ok(self.one.prepared(a, self.contacts, self.scratch)?.intersects(other))
    }
}
