//! Mean form factors between pieces, made to close.
//!
//! F_kj is the mean over the elements of piece k of their factors to piece j. In a closed room the rows of exact
//! factors add to 1 but for rounding, and are scaled by what is missing. The symmetric exchange areas are
//! S = (A F + (A F)ᵀ) / 2; they are scaled by D S D, D diagonal, so that they add to A in closed rooms (Sinkhorn and
//! Knopp 1967) and to no more elsewhere: as light may not grow.
use crate::mesh::subdivide::Subdivision;
use crate::solve::{light::Light, rooms::Rooms, shooters::Shooters, state::Column};
use std::sync::Arc;

/// No piece.
const NONE: usize = usize::MAX;
/// After so many rounds the scaling has either converged or never will.
const ROUNDS: usize = 200;

/// The factors between the pieces of lit patches.
#[derive(Debug)]
pub(super) struct Exchange {
    /// The pieces' areas.
    pub(super) areas: Vec<f64>,
    /// F_kj, row by row.
    factors: Vec<f64>,
    /// For each piece 1 − ΣF: 0 in closed rooms, by definition.
    pub(super) lost: Vec<f64>,
    /// What the factors from the elements of piece k to piece j are multiplied by, row by row, where the exchange areas
    /// were made symmetric.
    pub(super) corrections: Option<Vec<f64>>,
    /// The largest relative change of a factor that closure scaling made.
    pub(super) scaling: f64,
    /// The piece of every element; `usize::MAX` for what no light reaches.
    piece_of: Vec<usize>,
    /// What the factors from each element are multiplied by.
    scales: Vec<f64>,
    /// Whether each piece is in a closed room.
    closed: Vec<bool>,
}

impl Exchange {
    /// The mean factors between pieces whose columns are given.
    pub(super) fn new(
        subdivision: &Subdivision,
        light: &Light,
        rooms: &Rooms,
        shooters: &Shooters<'_>,
        columns: &[Arc<Column>],
    ) -> Exchange {
        let pieces = columns.len();
        let elements: Vec<_> =
            shooters.front().map(|node| subdivision.nodes[node].elements.clone()).collect();
        let closed_patch = rooms.closed_patches();
        let mut exchange = Exchange {
            areas: elements.iter().map(|range| light.areas[range.clone()].iter().sum()).collect(),
            factors: vec![0.0; pieces * pieces],
            lost: vec![0.0; pieces],
            corrections: None,
            scaling: 0.0,
            piece_of: vec![NONE; light.areas.len()],
            scales: vec![1.0; light.areas.len()],
            closed: shooters.front().map(|node| closed_patch[subdivision.nodes[node].patch]).collect(),
        };
        for (piece, range) in elements.into_iter().enumerate() {
            exchange.piece_of[range].fill(piece);
        }
        exchange.scale_rows(&rooms.sums);
        exchange.average(columns, &light.areas);
        exchange.lose();
        exchange
    }

    /// Scales the rows of closed rooms to 1, and all others that exceed 1.
    fn scale_rows(&mut self, sums: &[f64]) {
        for (element, &sum) in sums.iter().enumerate() {
            let closed = self.piece_of[element] != NONE && self.closed[self.piece_of[element]];
            if sum > 0.0 && (closed || sum > 1.0) {
                self.scales[element] = 1.0 / sum;
                self.scaling = self.scaling.max((1.0 / sum - 1.0).abs());
            }
        }
    }

    /// Takes the means over the elements of every piece.
    fn average(&mut self, columns: &[Arc<Column>], areas: &[f64]) {
        let pieces = columns.len();
        for (sender, column) in columns.iter().enumerate() {
            for (element, factor) in column.iter().filter(|(element, _)| self.piece_of[*element] != NONE) {
                let receiver = self.piece_of[element];
                self.factors[receiver * pieces + sender] += areas[element] * self.scales[element] * factor;
            }
        }
        for (row, area) in self.factors.chunks_exact_mut(pieces.max(1)).zip(&self.areas) {
            row.iter_mut().for_each(|factor| *factor /= area);
        }
    }

    /// Finds what is lost of each row.
    fn lose(&mut self) {
        for (piece, row) in self.factors.chunks_exact(self.areas.len().max(1)).enumerate() {
            let lost = (1.0 - row.iter().sum::<f64>()).max(0.0);
            self.lost[piece] = if self.closed[piece] { 0.0 } else { lost };
        }
    }

    /// Makes the exchange areas symmetric and scales them.
    pub(super) fn symmetrise(&mut self) {
        let pieces = self.areas.len();
        let given = self.factors.clone();
        for k in 0..pieces {
            for j in 0..=k {
                let (forth, back) =
                    (self.areas[k] * given[k * pieces + j], self.areas[j] * given[j * pieces + k]);
                let exchange = f64::midpoint(forth, back);
                self.factors[k * pieces + j] = exchange;
                self.factors[j * pieces + k] = exchange;
            }
        }
        let scales = self.scale();
        for k in 0..pieces {
            for j in 0..pieces {
                let scale = scales[k] * scales[j];
                self.scaling = self.scaling.max((scale - 1.0).abs());
                self.factors[k * pieces + j] *= scale / self.areas[k];
            }
        }
        self.lose();
        let ratio = |(symmetric, given): (&f64, &f64)| if *given > 0.0 { symmetric / given } else { 0.0 };
        self.corrections = Some(self.factors.iter().zip(&given).map(ratio).collect());
    }

    /// The diagonal D for exchange areas that stand in `factors`.
    fn scale(&self) -> Vec<f64> {
        let pieces = self.areas.len();
        let mut scales = vec![1.0f64; pieces];
        for _ in 0..ROUNDS {
            let mut change = 0.0f64;
            let wanted: Vec<f64> = (0..pieces)
                .map(|k| {
                    let row = &self.factors[k * pieces..(k + 1) * pieces];
                    let sum: f64 = scales[k] * row.iter().zip(&scales).map(|(s, d)| s * d).sum::<f64>();
                    let wanted = if sum > 0.0 { self.areas[k] / sum } else { 1.0 };
                    if self.closed[k] { wanted } else { wanted.min(1.0) }
                })
                .collect();
            for (scale, wanted) in scales.iter_mut().zip(&wanted) {
                *scale *= wanted.sqrt();
                change = change.max((wanted - 1.0).abs());
            }
            if change <= 1e-14 {
                break;
            }
        }
        scales
    }

    /// The row of a piece.
    pub(super) fn row(&self, piece: usize) -> &[f64] {
        let pieces = self.areas.len();
        &self.factors[piece * pieces..(piece + 1) * pieces]
    }

    /// The elements of all pieces, and the piece of each.
    pub(super) fn pieced(&self) -> impl Iterator<Item = (usize, usize)> {
        self.piece_of.iter().copied().enumerate().filter(|(_, piece)| *piece != NONE)
    }

    /// What the factor from an element to a piece is multiplied by.
    pub(super) fn weight(&self, element: usize, sender: usize) -> f64 {
        let piece = self.piece_of[element];
        let correction = self.corrections.as_ref().filter(|_| piece != NONE);
        self.scales[element] * correction.map_or(1.0, |all| all[piece * self.areas.len() + sender])
    }

    /// Whether the factors from an element add to 1.
    pub(super) fn closes(&self, element: usize) -> bool {
        let piece = self.piece_of[element];
        piece != NONE && self.closed[piece]
    }
}
