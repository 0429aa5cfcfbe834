//! One group in the making.
use super::covered::without_covered;
use super::outline::without_shared_edges;
use super::state;
use crate::error::Error;
use polycsg::DVec2;

/// A state of fewer bytes is not worth making smaller.
const FEW: usize = 1 << 16;

/// What the aggregates do with a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Aggregate {
    Union,
    Intersection,
}

/// The state of a group, and how long it was when it was last made smaller.
#[derive(Default)]
pub(crate) struct Group {
    state: Vec<u8>,
    reduced: usize,
}

impl Group {
    /// The state; empty, if the group holds nothing but NULL.
    pub(crate) fn state(&self) -> &[u8] {
        &self.state
    }

    /// The memory that it takes beside itself.
    pub(crate) fn size(&self) -> usize {
        self.state.capacity()
    }

    /// Adds a feature of finite points.
    pub(crate) fn push<'r>(
        &mut self,
        aggregate: Aggregate,
        rings: impl Iterator<Item = &'r [DVec2]>,
    ) -> Result<(), Error> {
        state::append(&mut self.state, rings);
        self.reduce_if_grown(aggregate)
    }

    /// Adds the features of another state.
    pub(crate) fn merge(&mut self, aggregate: Aggregate, other: &[u8]) -> Result<(), Error> {
        state::split(other)?;
        self.state.extend_from_slice(other);
        self.reduce_if_grown(aggregate)
    }

    fn reduce_if_grown(&mut self, aggregate: Aggregate) -> Result<(), Error> {
        if self.state.len() < FEW.max(2 * self.reduced) {
            return Ok(());
        }
        self.reduce(aggregate)
    }

    /// Leaves out what changes no bit of the result: all but one of equal features and, for unions, those in the interior of another
    /// and the edges that neighbours share, where these are many.
    pub(crate) fn reduce(&mut self, aggregate: Aggregate) -> Result<(), Error> {
        let mut features = state::sorted(&self.state)?;
        let mut outlined = None;
        if aggregate == Aggregate::Union {
            features = without_covered(features)?;
            outlined = without_shared_edges(&features)?;
        }
        let reduced = outlined.unwrap_or_else(|| features.concat());
        self.reduced = reduced.len();
        self.state = reduced;
        Ok(())
    }
}
