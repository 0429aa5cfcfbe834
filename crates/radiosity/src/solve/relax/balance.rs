//! The balance of one band's light between pieces: x = e + ρ F x.
use super::exchange::Exchange;
use rayon::prelude::*;

/// e, ρ and F of one band.
#[derive(Debug)]
pub(super) struct Balance<'e> {
    pub(super) exchange: &'e Exchange,
    pub(super) emittance: Vec<f64>,
    pub(super) reflectance: Vec<f64>,
    /// 1 − ρ, to all its digits.
    absorptance: Vec<f64>,
    /// Of each piece's power per radiosity, what is received anywhere.
    received: Vec<f64>,
    /// And of that, what is absorbed.
    absorbed: Vec<f64>,
}

impl<'e> Balance<'e> {
    /// The balance of pieces that emit and absorb so much.
    pub(super) fn new(exchange: &'e Exchange, emittance: Vec<f64>, absorptance: Vec<f64>) -> Balance<'e> {
        let (mut received, mut absorbed) = (vec![0.0; emittance.len()], vec![0.0; emittance.len()]);
        for (piece, (area, kept)) in exchange.areas.iter().zip(&absorptance).enumerate() {
            for (sender, factor) in exchange.row(piece).iter().enumerate() {
                received[sender] += area * factor;
                absorbed[sender] += kept * area * factor;
            }
        }
        let reflectance = absorptance.iter().map(|kept| 1.0 - kept).collect();
        Balance { exchange, emittance, reflectance, absorptance, received, absorbed }
    }

    /// Power absorbed, and power that no piece receives, when the pieces send x.
    pub(super) fn spend(&self, x: &[f64]) -> [f64; 2] {
        let absorbed = self.absorbed.iter().zip(x).map(|(share, x)| share * x).sum();
        let missed = self.exchange.areas.iter().zip(&self.received).map(|(area, received)| area - received);
        [absorbed, missed.zip(x).map(|(missed, x)| missed * x).sum()]
    }

    /// (I − ρF) x, as ((1 − ρ) + ρ (1 − ΣF)) x_k + ρ Σ F_kj (x_k − x_j): where light is even nothing cancels, however near
    /// ρ is to 1.
    pub(super) fn apply(&self, x: &[f64]) -> Vec<f64> {
        let row = |(k, &here): (usize, &f64)| {
            let rho = self.reflectance[k];
            let factors = self.exchange.row(k).iter();
            let gain: f64 = factors.zip(x).map(|(factor, there)| factor * (here - there)).sum();
            self.kept(k) * here + rho * gain
        };
        x.par_iter().enumerate().with_min_len(16).map(row).collect()
    }

    /// e − (I − ρF) x.
    pub(super) fn residual(&self, x: &[f64]) -> Vec<f64> {
        self.emittance.iter().zip(self.apply(x)).map(|(e, applied)| e - applied).collect()
    }

    /// 1 − ρΣF of a piece: the share of light that is absorbed or lost.
    pub(super) fn kept(&self, piece: usize) -> f64 {
        self.absorptance[piece] + self.reflectance[piece] * self.exchange.lost[piece]
    }

    /// ‖r‖∞ / (1 − max ρΣF): how far x may be from the solution, anywhere, when its residual is nowhere larger than
    /// `residual`. (I − ρF)⁻¹ = Σ (ρF)ⁿ is no larger in this norm than the geometric series of max ρΣF.
    pub(super) fn bound(&self, residual: f64) -> f64 {
        let gap = (0..self.reflectance.len()).map(|piece| self.kept(piece)).fold(1.0, f64::min);
        if residual == 0.0 { 0.0 } else { residual / gap }
    }
}
