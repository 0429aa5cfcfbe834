//! One side of a function of two columns.
use crate::column::features::{Bounds, Features};
use crate::error::Error;
use polycsg::{Csg, DVec2, PreparedRegion, Scratch};
use std::sync::Arc;

/// To prepare a feature takes as long as reading it some fifty times.
const MANY: usize = 32;

/// The features of a side, and the last of those that were prepared.
pub(crate) struct Side {
    features: Arc<Features>,
    held: Option<(usize, PreparedRegion)>,
}

impl Side {
    pub(crate) fn new(features: Arc<Features>) -> Side {
        Side { features, held: None }
    }

    /// The feature of a row; NULL, if none.
    pub(crate) fn at(&self, row: usize) -> Option<usize> {
        self.features.at(row)
    }

    pub(crate) fn features(&self) -> &Features {
        &self.features
    }

    pub(crate) fn point(&self, feature: usize) -> Option<Option<DVec2>> {
        self.features.point(feature)
    }

    /// A feature as an operand, prepared if many rows hold it. A feature whose edges cross is never prepared: its crossings would be
    /// rounded before they are operands, so that the result would depend on how often the feature occurs.
    pub(crate) fn operand(
        &mut self,
        feature: usize,
        contacts: usize,
        scratch: &mut Scratch,
    ) -> Result<Csg<'_>, Error> {
        if self.features.uses(feature) >= MANY && self.is_plain(feature, contacts, scratch)? {
            return Ok(Csg::from(self.prepared(feature, contacts, scratch)?));
        }
        self.features.operand(feature)
    }

    /// What a window sees of a feature, as an operand: the same set within the window.
    pub(crate) fn operand_near(
        &mut self,
        feature: usize,
        window: &Bounds,
        contacts: usize,
        scratch: &mut Scratch,
    ) -> Result<Csg<'_>, Error> {
        if self.features.uses(feature) >= MANY && self.is_plain(feature, contacts, scratch)? {
            return Ok(Csg::from(self.prepared(feature, contacts, scratch)?));
        }
        self.features.operand_near(feature, window)
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

    /// Whether each edge of a feature bounds it as it is: no edges cross, coincide or touch but at their ends.
    pub(crate) fn is_plain(
        &mut self,
        feature: usize,
        contacts: usize,
        scratch: &mut Scratch,
    ) -> Result<bool, Error> {
        if let Some(&known) = self.features.plain(feature).get() {
            return Ok(known);
        }
        let region = self.prepared(feature, contacts, scratch)?.region();
        let bounding = sorted_edges(region.rings());
        Ok(*self
            .features
            .plain(feature)
            .get_or_init(|| bounding == sorted_edges(self.features.rings(feature))))
    }
}

/// The edges of rings without their direction, sorted.
fn sorted_edges<'r>(rings: impl Iterator<Item = &'r [DVec2]>) -> Vec<[[u64; 2]; 2]> {
    let bits = |point: DVec2| (point + DVec2::ZERO).to_array().map(f64::to_bits); // no -0.0
    let edges = rings.flat_map(|ring| {
        let ends = ring.iter().skip(1).chain(ring.first());
        ring.iter().zip(ends).filter(|(a, b)| a != b).map(|(a, b)| [bits(*a), bits(*b)])
    });
    let mut edges: Vec<[[u64; 2]; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges
}
