//! Where the power went, and how far the light is from the solution.
use super::{light::Light, shooters::Shooters};

/// Power per band, in W for lengths in m: emitted = absorbed + escaped + unshot + defect.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Ledger {
    /// Emitted power: ΣAE, the power of the lamps, and what the scene receives straight from the sun and the sky.
    pub emitted: Vec<f64>,
    /// Absorbed power, ΣA(1 − ρ)H.
    pub absorbed: Vec<f64>,
    /// Shot power that no element received: with the reciprocal form factors A_i F_ij / A_j, Σ(A_j − ΣA_i F_ij)ΔB_j; and that of lamps.
    pub escaped: Vec<f64>,
    /// Power still to be shot, ΣAΔB.
    pub unshot: Vec<f64>,
    /// The remainder: rounding errors.
    pub defect: Vec<f64>,
}

impl Ledger {
    /// The ledger of a solution, finished or not.
    pub(super) fn new(light: &Light, shooters: &Shooters<'_>) -> Ledger {
        let kept: Vec<_> =
            light.irradiance.iter().zip(&light.reflectance).map(|(h, rho)| h * (1.0 - rho)).collect();
        let received = light.total(&light.irradiance);
        let own = light.total(&light.emittance);
        // What the lights have given: all but what patches emit.
        let lights: Vec<f64> = light.emitted.iter().zip(own).map(|(emitted, own)| emitted - own).collect();
        let sent = shooters.sent.iter().zip(lights).map(|(sent, lights)| sent + lights);
        let mut ledger = Ledger {
            emitted: light.emitted.clone(),
            absorbed: light.total(&kept),
            escaped: sent.zip(&received).map(|(sent, received)| sent - received).collect(),
            unshot: shooters.unshot(),
            defect: Vec::new(),
        };
        ledger.defect = (0..light.bands).map(|band| ledger.remainder(band)).collect();
        ledger
    }

    /// The ledger before anything was shot.
    pub(super) fn dark(light: &Light) -> Ledger {
        let none = vec![0.0; light.bands];
        Ledger {
            emitted: light.emitted.clone(),
            absorbed: none.clone(),
            escaped: none.clone(),
            unshot: light.emitted.clone(),
            defect: none,
        }
    }

    /// What is missing of the emitted power of a band.
    pub(super) fn remainder(&self, band: usize) -> f64 {
        self.emitted[band] - self.absorbed[band] - self.escaped[band] - self.unshot[band]
    }
}

/// 1 − max ρΣF per band: the smallest share of the light on an element that is absorbed or leaves. The row sums ΣF
/// where they are known, and 1 otherwise.
pub(super) fn gaps(light: &Light, sums: Option<&[f64]>) -> Vec<f64> {
    let mut gaps = vec![1.0f64; light.bands];
    for (element, reflectance) in light.reflectance.chunks_exact(light.bands).enumerate() {
        let missed = sums.map_or(0.0, |sums| (1.0 - sums[element]).max(0.0));
        gaps.iter_mut().zip(reflectance).for_each(|(gap, rho)| *gap = gap.min(1.0 - rho + rho * missed));
    }
    gaps
}

/// ‖r‖∞ / (1 − max ρΣF) per band: with B = E + ρFS for what the pieces have shot, S, the residual is ρF(PB − S), at
/// most max ρ times the largest radiosity still to be shot, `peaks`, as ΣF <= 1 in every row. Infinite where a patch
/// reflects all light; 0 where nothing emits.
pub(super) fn bound(light: &Light, peaks: &[f64], gaps: &[f64]) -> Vec<f64> {
    let reflectance =
        |band| light.reflectance.iter().skip(band).step_by(light.bands).copied().fold(0.0, f64::max);
    let bound = |(band, peak): (usize, &f64)| {
        let residual = peak * reflectance(band);
        if residual == 0.0 { 0.0 } else { residual / gaps[band] }
    };
    peaks.iter().enumerate().map(bound).collect()
}
