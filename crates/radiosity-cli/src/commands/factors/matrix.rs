//! Rows of form factors.
use crate::failure::Failure;
use radiosity::Scene;
use radiosity::formfactor::{DifferentialArea, Enclosure, Limits};
use rayon::prelude::*;

/// A form factor to a patch, by its index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) to: usize,
    pub(super) value: f64,
    /// A bound for factors from a point; an estimate for those from an area.
    pub(super) error: f64,
}

/// The form factors from a point or a patch.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The patch; none for a point.
    pub(super) from: Option<usize>,
    /// By the patch that they lead to; patches that are not seen may be missing.
    pub(super) entries: Vec<Entry>,
}

impl Row {
    /// From a point to every patch.
    pub(super) fn of_point(enclosure: &Enclosure, from: &DifferentialArea) -> Row {
        let factors = enclosure.row(from).into_iter().enumerate();
        let entry = |(to, factor): (usize, radiosity::formfactor::FormFactor)| Entry {
            to,
            value: factor.value,
            error: factor.error_bound,
        };
        Row { from: None, entries: factors.map(entry).collect() }
    }

    /// The sum of the factors, and of their errors.
    pub(super) fn sum(&self) -> (f64, f64) {
        let sum = |pick: fn(&Entry) -> f64| self.entries.iter().map(pick).sum();
        (sum(|entry| entry.value), sum(|entry| entry.error))
    }

    /// The factor to a patch.
    pub(super) fn to(&self, patch: usize) -> f64 {
        let place = self.entries.binary_search_by_key(&patch, |entry| entry.to);
        place.map_or(0.0, |place| self.entries[place].value)
    }
}

/// From the middle of each of the named patches, or of all, exactly.
pub(super) fn from_middles(scene: &Scene, enclosure: &Enclosure, named: &[usize]) -> Vec<Row> {
    let row = |&patch: &usize| match scene.patches[patch].middle() {
        Some(middle) => Row { from: Some(patch), ..Row::of_point(enclosure, &middle.owned_by(patch)) },
        None => Row { from: Some(patch), entries: Vec::new() },
    };
    chosen(scene, named).par_iter().map(row).collect()
}

/// From area to area.
pub(super) fn from_areas(
    scene: &Scene,
    enclosure: &Enclosure,
    named: &[usize],
    tolerance: f64,
) -> Result<Vec<Row>, Failure> {
    let entries = |row: radiosity::formfactor::Row| -> Vec<Entry> {
        row.into_iter()
            .map(|(to, factor)| Entry { to, value: factor.value, error: factor.error_estimate })
            .collect()
    };
    let found = if named.is_empty() {
        enclosure.area_matrix(tolerance, &Limits::default()).map_err(Failure::usage)?.unwrap_or_default()
    } else {
        let row = |patch: &usize| enclosure.area_row(*patch, tolerance, &Limits::default());
        let rows: Result<Vec<_>, _> = named.iter().map(row).collect();
        rows.map_err(Failure::usage)?.into_iter().flatten().collect()
    };
    let all = named.is_empty();
    let from = if all { (0..scene.patches.len()).collect() } else { named.to_vec() };
    let rows = from.into_iter().zip(found).filter(|(patch, _)| !all || !scene.patches[*patch].only_blocks);
    Ok(rows.map(|(patch, row)| Row { from: Some(patch), entries: entries(row) }).collect())
}

/// The named patches, or all that do more than block.
fn chosen(scene: &Scene, named: &[usize]) -> Vec<usize> {
    if named.is_empty() {
        return (0..scene.patches.len()).filter(|patch| !scene.patches[*patch].only_blocks).collect();
    }
    named.to_vec()
}
