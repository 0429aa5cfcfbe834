//! The groups of one partition.
use super::evaluate::{GroupLimits, evaluated};
use super::group::{Aggregate, Group};
use crate::column::encoding::Encoding;
use crate::column::features::Features;
use crate::column::read;
use crate::column::write::Written;
use crate::error::Error;
use arrow_array::builder::LargeBinaryBuilder;
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, BooleanArray};
use arrow_schema::FieldRef;
use datafusion_common::{Result, internal_err};
use datafusion_expr::{EmitTo, GroupsAccumulator};
use polycsg::Scratch;
use std::sync::Arc;

/// The states of all groups.
pub(crate) struct Groups {
    aggregate: Aggregate,
    input: (Encoding, FieldRef),
    result: FieldRef,
    limits: GroupLimits,
    groups: Vec<Group>,
    /// What the states take together, and the longest of them.
    held: usize,
    longest: usize,
}

impl Groups {
    pub(crate) fn new(
        aggregate: Aggregate,
        input: (Encoding, FieldRef),
        result: FieldRef,
        limits: GroupLimits,
    ) -> Groups {
        Groups { aggregate, input, result, limits, groups: Vec::new(), held: 0, longest: 0 }
    }

    /// Makes room for so many groups.
    pub(crate) fn resize(&mut self, count: usize) {
        self.groups.resize_with(count.max(self.groups.len()), Group::default);
    }

    /// The results of groups, which stay.
    pub(crate) fn results(&self) -> Result<ArrayRef> {
        let (mut written, mut scratch) = (Written::new(&self.result)?, Scratch::default());
        for group in &self.groups {
            written.push(evaluated(self.aggregate, group.state(), self.limits, &mut scratch)?.as_ref())?;
        }
        Ok(written.finish())
    }

    fn features(&self, values: &[ArrayRef]) -> Result<Features> {
        let [array] = values else { return internal_err!("{} columns instead of one", values.len()) };
        Ok(read::features(array, &self.input.0, &self.input.1)?.areas_only()?)
    }

    fn push(&mut self, group: usize, features: &Features, feature: usize) -> Result<(), Error> {
        features.check_finite(feature)?;
        let aggregate = self.aggregate;
        self.change(group, |group| group.push(aggregate, features.rings(feature)))
    }

    /// Changes a group and keeps account of its size.
    fn change(
        &mut self,
        group: usize,
        change: impl FnOnce(&mut Group) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let group = &mut self.groups[group];
        self.held -= group.size();
        let changed = change(group);
        self.held += group.size();
        self.longest = self.longest.max(group.state().len());
        changed
    }

    /// Takes groups out.
    fn take(&mut self, emit_to: EmitTo) -> Vec<Group> {
        let taken = emit_to.take_needed(&mut self.groups);
        self.held = self.groups.iter().map(Group::size).sum();
        self.longest = self.groups.iter().map(|group| group.state().len()).max().unwrap_or_default();
        taken
    }
}

impl GroupsAccumulator for Groups {
    fn update_batch(
        &mut self,
        values: &[ArrayRef],
        group_indices: &[usize],
        opt_filter: Option<&BooleanArray>,
        total_num_groups: usize,
    ) -> Result<()> {
        self.resize(total_num_groups);
        let features = self.features(values)?;
        for (row, &group) in group_indices.iter().enumerate() {
            if let Some(feature) = features.at(row).filter(|_| passes(opt_filter, row)) {
                self.push(group, &features, feature)?;
            }
        }
        Ok(())
    }

    /// Each group is dropped when its result is there.
    fn evaluate(&mut self, emit_to: EmitTo) -> Result<ArrayRef> {
        let (mut written, mut scratch) = (Written::new(&self.result)?, Scratch::default());
        for group in self.take(emit_to) {
            let found = evaluated(self.aggregate, group.state(), self.limits, &mut scratch)?;
            drop(group);
            written.push(found.as_ref())?;
        }
        Ok(written.finish())
    }

    fn state(&mut self, emit_to: EmitTo) -> Result<Vec<ArrayRef>> {
        let mut states = LargeBinaryBuilder::new();
        for mut group in self.take(emit_to) {
            group.reduce(self.aggregate)?;
            states.append_option(Some(group.state()).filter(|state| !state.is_empty()));
        }
        Ok(vec![Arc::new(states.finish())])
    }

    fn merge_batch(
        &mut self,
        values: &[ArrayRef],
        group_indices: &[usize],
        total_num_groups: usize,
    ) -> Result<()> {
        self.resize(total_num_groups);
        let [states] = values else { return internal_err!("{} columns instead of one", values.len()) };
        let Some(states) = states.as_binary_opt::<i64>() else {
            return Err(Error::State("it is no LargeBinary").into());
        };
        let aggregate = self.aggregate;
        for (state, &group) in states.iter().zip(group_indices) {
            if let Some(state) = state {
                self.change(group, |group| group.merge(aggregate, state))?;
            }
        }
        Ok(())
    }

    fn convert_to_state(
        &self,
        values: &[ArrayRef],
        opt_filter: Option<&BooleanArray>,
    ) -> Result<Vec<ArrayRef>> {
        let features = self.features(values)?;
        let mut states = LargeBinaryBuilder::new();
        for row in 0..features.len() {
            let mut group = Group::default();
            if let Some(feature) = features.at(row).filter(|_| passes(opt_filter, row)) {
                features.check_finite(feature)?;
                group.push(self.aggregate, features.rings(feature))?;
            }
            states.append_option(Some(group.state()).filter(|state| !state.is_empty()));
        }
        Ok(vec![Arc::new(states.finish())])
    }

    /// The states, the results that take their places, and what evaluating the largest group may take.
    fn size(&self) -> usize {
        self.groups.capacity() * size_of::<Group>() + 2 * self.held + self.limits.taken_by(self.longest)
    }
}

fn passes(filter: Option<&BooleanArray>, row: usize) -> bool {
    filter.is_none_or(|filter| filter.is_valid(row) && filter.value(row))
}
