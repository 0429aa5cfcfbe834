//! What elements received: the rows of what solving found by columns.
use crate::solve::state::Column;
use std::sync::Arc;

/// A piece of a sender.
#[derive(Debug)]
pub(super) struct SentPiece {
    pub(super) sender: usize,
    /// What it sends on average, per band.
    pub(super) radiosity: Vec<f64>,
    /// How much of that elements did not receive when the run ended.
    pub(super) open: Vec<f64>,
    pub(super) column: Arc<Column>,
}

/// For each element the pieces that it sees, with the factors, those of one sender side by side.
#[derive(Debug)]
pub(super) struct Received {
    pieces: Vec<SentPiece>,
    rows: Vec<Vec<(u32, f64)>>,
    bands: usize,
}

impl Received {
    /// Takes O(factors), and 16 bytes for each, or up to twice as much as rows grow; columns take 12.
    pub(super) fn of(mut pieces: Vec<SentPiece>, elements: usize, bands: usize) -> Received {
        pieces.sort_by_key(|piece| piece.sender);
        let mut rows = vec![Vec::new(); elements];
        for (number, piece) in (0..).zip(&pieces) {
            piece.column.iter().for_each(|(element, factor)| rows[element].push((number, factor)));
        }
        Received { pieces, rows, bands }
    }

    /// Adds to what elements received, elements × bands, what was still open.
    pub(super) fn add_open(&self, light: &mut [f64]) {
        for (row, light) in self.rows.iter().zip(light.chunks_exact_mut(self.bands)) {
            for (piece, factor) in row {
                let open = &self.pieces[*piece as usize].open;
                light.iter_mut().zip(open).for_each(|(light, open)| *light += factor * open);
            }
        }
    }

    /// Calls back with what an element receives of each sender that it sees, per band, by ascending sender.
    pub(super) fn for_each(&self, element: usize, mut found: impl FnMut(usize, &[f64])) {
        let sender = |(piece, _): &(u32, f64)| self.pieces[*piece as usize].sender;
        let mut light = vec![0.0; self.bands];
        for seen in self.rows[element].chunk_by(|one, next| sender(one) == sender(next)) {
            light.fill(0.0);
            for (piece, factor) in seen {
                let radiosity = &self.pieces[*piece as usize].radiosity;
                light.iter_mut().zip(radiosity).for_each(|(light, sent)| *light += factor * sent);
            }
            found(sender(&seen[0]), &light);
        }
    }
}
