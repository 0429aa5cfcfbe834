//! A progress bar on a terminal; nothing elsewhere.
use indicatif::{ProgressBar, ProgressStyle};
use radiosity::Progress;

/// Shows how many of the decades between all power and the tolerance are behind.
#[derive(Debug)]
pub(super) struct Bar {
    bar: ProgressBar,
    tolerance: f64,
}

/// Steps of the whole bar.
const STEPS: u64 = 1000;

impl Bar {
    /// A bar that is full when the unshot share is `tolerance`.
    pub(super) fn new(tolerance: f64) -> Bar {
        let style = ProgressStyle::with_template("{bar:40} {msg} [{elapsed}]")
            .unwrap_or(ProgressStyle::default_bar());
        Bar { bar: ProgressBar::new(STEPS).with_style(style), tolerance }
    }

    /// Shows where the solver stands: what is unshot, the bound and the ledger, each of the worst band.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the bar's steps")]
    pub(super) fn show(&self, progress: &Progress<'_>) {
        let done = progress.unshot.log10() / self.tolerance.log10();
        self.bar.set_position((done.clamp(0.0, 1.0) * STEPS as f64) as u64);
        let ledger = progress.ledger;
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let share = |values: &[f64]| {
            let shares = values.iter().zip(&ledger.emitted).filter(|(_, emitted)| **emitted > 0.0);
            100.0 * shares.map(|(value, emitted)| value / emitted).fold(0.0, f64::max)
        };
        let Progress { shots, products, unshot, bound, .. } = progress;
        self.bar.set_message(format!(
            "{shots} shots, {products} products, {unshot:.1e} unshot, bound {:.1e}, {:.0} % absorbed, {:.0} % escaped",
            largest(bound),
            share(&ledger.absorbed),
            share(&ledger.escaped),
        ));
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
