//! What is asked of a feature of one side and one of another.
use super::side::Side;
use super::touch::edges_meet;
use crate::column::features::{Bounds, Features, common, meet};
use crate::error::Error;
use polycsg::{Csg, DVec2, Location, Region, Scratch};
use std::sync::Arc;

/// A relation of two closed sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Relation {
    Contains,
    Intersects,
}

/// A Boolean of two areas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Overlay {
    Intersection,
    Union,
    Difference,
    SymmetricDifference,
}

impl Overlay {
    fn of<'a>(self, one: Csg<'a>, other: Csg<'a>) -> Csg<'a> {
        match self {
            Overlay::Intersection => one & other,
            Overlay::Union => one | other,
            Overlay::Difference => one - other,
            Overlay::SymmetricDifference => one ^ other,
        }
    }
}

/// Two sides of finite features, and what it takes to ask about their pairs.
pub(crate) struct Pairs {
    sides: [Side; 2],
    contacts: usize,
    scratch: Scratch,
}

impl Pairs {
    pub(crate) fn new(sides: [Arc<Features>; 2], contacts: usize) -> Pairs {
        Pairs { sides: sides.map(Side::new), contacts, scratch: Scratch::default() }
    }

    /// The features of a row; NULL, if none.
    pub(crate) fn at(&self, row: usize) -> Option<[usize; 2]> {
        Some([self.sides[0].at(row)?, self.sides[1].at(row)?])
    }

    /// An answer about a pair with its sides in the other order, if they are swapped.
    #[cfg(feature = "join")]
    pub(crate) fn turned<T>(
        &mut self,
        is_swapped: bool,
        [a, b]: [usize; 2],
        ask: impl FnOnce(&mut Pairs, [usize; 2]) -> T,
    ) -> T {
        if !is_swapped {
            return ask(self, [a, b]);
        }
        self.sides.swap(0, 1);
        let answer = ask(self, [b, a]);
        self.sides.swap(0, 1);
        answer
    }

    /// Whether a relation holds. The row is for messages.
    pub(crate) fn holds(
        &mut self,
        relation: Relation,
        [a, b]: [usize; 2],
        row: usize,
    ) -> Result<bool, Error> {
        if !self.boxes_meet([a, b]) {
            return Ok(false); // neither is empty of points from here on
        }
        match (self.sides[0].point(a), self.sides[1].point(b), relation) {
            (Some(p), Some(q), _) => Ok(p.is_some() && p == q),
            (None, Some(q), _) => self.has_point(0, a, q),
            (Some(p), None, Relation::Intersects) => self.has_point(1, b, p),
            (Some(_), None, Relation::Contains) => Ok(false),
            (None, None, Relation::Contains) => self.contains([a, b], row),
            (None, None, Relation::Intersects) => {
                Ok(!self.have_no_common_area([a, b], row)? || self.touch([a, b])?)
            }
        }
    }

    /// A Boolean of two areas, by the order of its arguments.
    pub(crate) fn overlay(
        &mut self,
        overlay: Overlay,
        pair: [usize; 2],
        row: usize,
    ) -> Result<Region, Error> {
        let window = self.window(pair);
        let Pairs { sides: [one, other], contacts, scratch } = self;
        let (one, other) = match overlay {
            Overlay::Intersection => (
                one.operand_near(pair[0], &window, *contacts, scratch)?,
                other.operand_near(pair[1], &window, *contacts, scratch)?,
            ),
            _ => (one.operand(pair[0], *contacts, scratch)?, other.operand(pair[1], *contacts, scratch)?),
        };
        let found = overlay.of(one, other).try_evaluate_with(scratch, *contacts);
        found.map_err(|error| Error::row(row, error))
    }

    /// What two areas have in common, where they meet at all; empty, if they only touch.
    #[cfg(feature = "join")]
    pub(crate) fn common(&mut self, pair: [usize; 2], row: usize) -> Result<Option<Region>, Error> {
        if !self.boxes_meet(pair) {
            return Ok(None);
        }
        let found = self.overlay(Overlay::Intersection, pair, row)?;
        let holds = !found.is_empty()
            || (self.edges_meet(pair) != Some(false) && self.holds(Relation::Intersects, pair, row)?);
        Ok(holds.then_some(found))
    }

    fn window(&self, [a, b]: [usize; 2]) -> Bounds {
        common(&self.sides[0].features().bounds(a), &self.sides[1].features().bounds(b))
    }

    fn boxes_meet(&self, [a, b]: [usize; 2]) -> bool {
        meet(&self.sides[0].features().bounds(a), &self.sides[1].features().bounds(b))
    }

    fn has_point(&mut self, side: usize, area: usize, point: Option<DVec2>) -> Result<bool, Error> {
        let region = self.sides[side].prepared(area, self.contacts, &mut self.scratch)?;
        Ok(point.is_some_and(|point| region.locate(point) != Location::Outside))
    }

    /// Whether the other is not empty and nothing of it is left without the one.
    fn contains(&mut self, [a, b]: [usize; 2], row: usize) -> Result<bool, Error> {
        let Pairs { sides: [one, other], contacts, scratch } = self;
        let refused = |error| Error::row(row, error);
        let other = other.operand(b, *contacts, scratch)?;
        let is_empty = other.try_boundary(scratch, *contacts).map_err(refused)?.is_empty();
        let rest = other - one.operand(a, *contacts, scratch)?;
        Ok(!is_empty && rest.try_boundary(scratch, *contacts).map_err(refused)?.is_empty())
    }

    fn have_no_common_area(&mut self, pair: [usize; 2], row: usize) -> Result<bool, Error> {
        let window = self.window(pair);
        let Pairs { sides: [one, other], contacts, scratch } = self;
        let both = one.operand_near(pair[0], &window, *contacts, scratch)?
            & other.operand_near(pair[1], &window, *contacts, scratch)?;
        let common = both.try_boundary(scratch, *contacts);
        Ok(common.map_err(|error| Error::row(row, error))?.is_empty())
    }

    /// Whether two areas without a common one have a point in common. Where every edge bounds its area, edges that meet tell it.
    fn touch(&mut self, [a, b]: [usize; 2]) -> Result<bool, Error> {
        let meet = self.edges_meet([a, b]);
        let Pairs { sides: [one, other], contacts, scratch } = self;
        match meet {
            Some(false) => Ok(false),
            Some(true)
                if one.is_plain(a, *contacts, scratch)? && other.is_plain(b, *contacts, scratch)? =>
            {
                Ok(true)
            }
            _ => {
                let other = other.prepared(b, *contacts, scratch)?.region();
                Ok(one.prepared(a, *contacts, scratch)?.intersects(other))
            }
        }
    }

    fn edges_meet(&self, pair: [usize; 2]) -> Option<bool> {
        let window = self.window(pair);
        let near = |side: usize| self.sides[side].features().rings_near(pair[side], &window);
        edges_meet(near(0), near(1), &window)
    }
}
