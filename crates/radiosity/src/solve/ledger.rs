//! Where the power went, and how far the light is from the solution.
use super::{light::Light, shooters::Shooters};

/// Power per band, in W for lengths in m: emitted = absorbed + escaped + unshot + defect.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ledger {
    /// ΣAE.
    pub emitted: Vec<f64>,
    /// ΣA(1 − ρ)H.
    pub absorbed: Vec<f64>,
    /// Shot power that no element received: with the reciprocal form factors A_i F_ij / A_j, Σ(A_j − ΣA_i F_ij)ΔB_j.
    pub escaped: Vec<f64>,
    /// ΣAΔB, still to be shot.
    pub unshot: Vec<f64>,
    /// What the bookkeeping lost: rounding.
    pub defect: Vec<f64>,
}

impl Ledger {
    /// The ledger of a solution, finished or not.
    pub(super) fn new(light: &Light, shooters: &Shooters<'_>) -> Ledger {
        let kept: Vec<_> =
            light.irradiance.iter().zip(&light.reflectance).map(|(h, rho)| h * (1.0 - rho)).collect();
        let received = light.total(&light.irradiance);
        let mut ledger = Ledger {
            emitted: shooters.emitted.clone(),
            absorbed: light.total(&kept),
            escaped: shooters.sent.iter().zip(&received).map(|(sent, received)| sent - received).collect(),
            unshot: shooters.unshot(),
            defect: Vec::new(),
        };
        ledger.defect = (0..light.bands).map(|band| ledger.remainder(band)).collect();
        ledger
    }

    /// What is missing of the emitted power of a band.
    fn remainder(&self, band: usize) -> f64 {
        self.emitted[band] - self.absorbed[band] - self.escaped[band] - self.unshot[band]
    }
}

/// ‖r‖∞ / (1 − max ρ) per band: with B = E + ρFS for what the pieces have shot, S, the residual is ρF(PB − S), at
/// most max ρ times the largest radiosity still to be shot; ΣF <= 1 in every row.
pub(super) fn bound(light: &Light, shooters: &Shooters<'_>) -> Vec<f64> {
    let reflectance =
        |band| light.reflectance.iter().skip(band).step_by(light.bands).copied().fold(0.0, f64::max);
    let bound = |(band, peak): (usize, f64)| peak * reflectance(band) / (1.0 - reflectance(band));
    shooters.peak().into_iter().enumerate().map(bound).collect()
}
