//! A progress bar on a terminal; nothing elsewhere.
use indicatif::{ProgressBar, ProgressStyle};

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

    /// Shows where the solver stands.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the bar's steps")]
    pub(super) fn show(&self, shots: usize, unshot: f64) {
        let done = unshot.log10() / self.tolerance.log10();
        self.bar.set_position((done.clamp(0.0, 1.0) * STEPS as f64) as u64);
        self.bar.set_message(format!("{} shots, {:.2e} unshot", shots, unshot));
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}
