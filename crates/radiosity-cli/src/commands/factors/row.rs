//! Rows of form factors.
use crate::commands::patience::Patience;
use crate::failure::Failure;
use radiosity::Scene;
use radiosity::formfactor::{DifferentialArea, Enclosure, FactorMatrix, Limits};
use rayon::prelude::*;
use std::borrow::Cow;

/// A form factor to a receiver, by its index.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) to: usize,
    pub(super) value: f64,
    /// A bound for factors from a point; an estimate for those from an area.
    pub(super) error: f64,
}

/// The form factors from a point or a surface.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The surface; none for a point.
    pub(super) from: Option<usize>,
    /// By the receiver that they lead to; what is not seen may be missing.
    pub(super) entries: Vec<Entry>,
}

impl Row {
    /// From a point to every patch.
    fn of_point(enclosure: &Enclosure, from: &DifferentialArea) -> Row {
        let factors = enclosure.row(from).into_iter().enumerate();
        let entry = |(to, factor): (usize, radiosity::formfactor::FormFactor)| Entry {
            to,
            value: factor.value,
            error: factor.error_bound,
        };
        Row { from: None, entries: factors.map(entry).collect() }
    }

    fn of_matrix(matrix: &FactorMatrix, from: usize) -> Row {
        let entry = |f: radiosity::formfactor::Factor| Entry { to: f.to, value: f.value, error: f.error };
        Row { from: Some(from), entries: matrix.row(from).map(entry).collect() }
    }

    /// The sum of the factors, and of their errors.
    pub(super) fn sum(&self) -> (f64, f64) {
        let sum = |pick: fn(&Entry) -> f64| self.entries.iter().map(pick).sum();
        (sum(|entry| entry.value), sum(|entry| entry.error))
    }

    /// The factor to a receiver.
    pub(super) fn to(&self, receiver: usize) -> f64 {
        let place = self.entries.binary_search_by_key(&receiver, |entry| entry.to);
        place.map_or(0.0, |place| self.entries[place].value)
    }
}

/// Rows one by one, or the first ones of a matrix: one of many surfaces is large.
#[derive(Debug)]
pub(super) enum Rows {
    Listed(Vec<Row>),
    Matrix(FactorMatrix, usize),
}

impl Default for Rows {
    fn default() -> Self {
        Self::Listed(Vec::new())
    }
}

impl Rows {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Listed(rows) => rows.len(),
            Self::Matrix(_, count) => *count,
        }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Cow<'_, Row>> {
        (0..self.len()).map(|index| match self {
            Self::Listed(rows) => Cow::Borrowed(&rows[index]),
            Self::Matrix(matrix, _) => Cow::Owned(Row::of_matrix(matrix, index)),
        })
    }
}

/// Where exact form factors start.
pub(super) enum Origin {
    Point(DifferentialArea),
    /// The middles of these patches, or of all.
    Middles(Vec<usize>),
}

impl Origin {
    /// The rows of form factors from there.
    pub(super) fn rows(&self, scene: &Scene, enclosure: &Enclosure) -> Vec<Row> {
        match self {
            Self::Point(point) => vec![Row::of_point(enclosure, point)],
            Self::Middles(named) => from_middles(scene, enclosure, named),
        }
    }
}

/// From the middle of each of the named patches, or of all that do more than block, exactly.
fn from_middles(scene: &Scene, enclosure: &Enclosure, named: &[usize]) -> Vec<Row> {
    let row = |&patch: &usize| match scene.patches[patch].middle() {
        Some(middle) => Row { from: Some(patch), ..Row::of_point(enclosure, &middle.owned_by(patch)) },
        None => Row { from: Some(patch), entries: Vec::new() },
    };
    let all: Vec<usize> =
        (0..scene.patches.len()).filter(|patch| !scene.patches[*patch].only_blocks).collect();
    let chosen = if named.is_empty() { &all } else { named };
    chosen.par_iter().map(row).collect()
}

/// From the named patches, area to area; as many of them as there is time for.
pub(super) fn from_areas(
    enclosure: &Enclosure,
    named: &[usize],
    tolerance: f64,
    patience: &Patience,
) -> Result<Vec<Row>, Failure> {
    let limits = Limits { stop: &|| patience.is_over(), ..Limits::default() };
    let row = |patch: &usize| {
        let row = enclosure.area_row(*patch, tolerance, &limits).map_err(Failure::usage)?;
        Ok(row.map(|row| {
            let factors = row.into_iter();
            let entries = factors.map(|(to, f)| Entry { to, value: f.value, error: f.error_estimate });
            Row { from: Some(*patch), entries: entries.collect() }
        }))
    };
    named.iter().map(row).take_while(|row| !matches!(row, Ok(None))).filter_map(Result::transpose).collect()
}
