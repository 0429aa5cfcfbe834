//! One side of a function of two columns.
use crate::column::features::Features;
use crate::error::Error;
use polycsg::{Csg, DVec2, PreparedRegion, Scratch};

/// The features of a side, and the last of those that were prepared.
pub(crate) struct Side {
    features: Features,
    held: Option<(usize, PreparedRegion)>,
}

impl Side {
    pub(crate) fn new(features: Features) -> Side {
        Side { features, held: None }
    }

    /// The feature of a row; NULL, if none.
    pub(crate) fn at(&self, row: usize) -> Option<usize> {
        self.features.at(row)
    }

    pub(crate) fn point(&self, feature: usize) -> Option<Option<DVec2>> {
        self.features.point(feature)
    }

    /// A feature as an operand, prepared if several rows hold it.
    pub(crate) fn operand(
        &mut self,
        feature: usize,
        contacts: usize,
        scratch: &mut Scratch,
    ) -> Result<Csg<'_>, Error> {
        if self.features.uses(feature) > 1 {
            return Ok(Csg::from(self.prepared(feature, contacts, scratch)?));
        }
        self.features.operand(feature)
    }

    /// A feature, prepared.
    pub(crate) fn prepared(
        &mut self,
        feature: usize,
        contacts: usize,
        scratch: &mut Scratch,
    ) -> Result<&PreparedRegion, Error> {
        let held = match self.held.take().filter(|(held, _)| *held == feature) {
            Some(held) => held,
            None => {
                let region = self.features.operand(feature)?.try_evaluate_with(scratch, contacts);
                let region = region.map_err(|error| self.features.at_row_of(feature, error))?;
                (feature, PreparedRegion::from(region))
            }
        };
        Ok(&self.held.insert(held).1)
    }

    /// Whether the boxes around a feature of each side have a point in common.
    pub(crate) fn boxes_meet(&self, feature: usize, other: &Side, others: usize) -> bool {
        let ([low, high], [other_low, other_high]) =
            (self.features.bounds(feature), other.features.bounds(others));
        low.max(other_low).cmple(high.min(other_high)).all()
    }
}
