//! From what the pieces send to what every element receives.
use super::exchange::Exchange;
use crate::solve::{light::Light, state::Column};
use rayon::prelude::*;
use std::sync::Arc;

/// Elements that one thread gathers for at a time.
const CHUNK: usize = 512;

/// H of every element and band: Σ F_ij x_j. Where the exchange areas were made symmetric, the factors of an element are
/// corrected as the means of its piece were, and its piece's elements receive together what the piece receives.
pub(super) fn gather(exchange: &Exchange, columns: &[Arc<Column>], light: &Light, x: &[f64]) -> Vec<f64> {
    let bands = light.bands;
    let mut irradiance = vec![0.0; light.areas.len() * bands];
    irradiance.par_chunks_mut(CHUNK * bands).enumerate().for_each(|(chunk, irradiance)| {
        let start = chunk * CHUNK;
        let mut sums = vec![0.0; irradiance.len() / bands];
        let end = start + sums.len();
        for (sender, column) in columns.iter().enumerate() {
            let shot = &x[sender * bands..][..bands];
            for (element, factor) in column.from(start).take_while(|(element, _)| *element < end) {
                let factor = factor * exchange.weight(element, sender);
                sums[element - start] += factor;
                let received = irradiance[(element - start) * bands..].iter_mut();
                received.zip(shot).for_each(|(h, x)| *h += factor * x);
            }
        }
        for (index, received) in irradiance.chunks_exact_mut(bands).enumerate() {
            if exchange.closes(start + index) && sums[index] > 0.0 {
                received.iter_mut().for_each(|h| *h /= sums[index]);
            }
        }
    });
    if exchange.corrections.is_some() {
        level(exchange, light, x, &mut irradiance);
    }
    irradiance
}

/// Scales the irradiance within each piece so that its mean is what the exchange gives the piece.
fn level(exchange: &Exchange, light: &Light, x: &[f64], irradiance: &mut [f64]) {
    let (pieces, bands) = (exchange.areas.len(), light.bands);
    let mut found = vec![0.0; pieces * bands];
    for (element, piece) in exchange.pieced() {
        for band in 0..bands {
            found[piece * bands + band] += light.areas[element] * irradiance[element * bands + band];
        }
    }
    let scale = |at: usize| {
        let (piece, band) = (at / bands, at % bands);
        let sent = x[band..].iter().step_by(bands);
        let given: f64 = exchange.row(piece).iter().zip(sent).map(|(factor, x)| factor * x).sum();
        if found[at] > 0.0 { given * exchange.areas[piece] / found[at] } else { 1.0 }
    };
    let scales: Vec<f64> = (0..pieces * bands).into_par_iter().map(scale).collect();
    for (element, piece) in exchange.pieced() {
        for band in 0..bands {
            irradiance[element * bands + band] *= scales[piece * bands + band];
        }
    }
}
