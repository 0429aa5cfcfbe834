//! What shows on a terminal how far a command is, and nothing elsewhere.
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A bar that goes when its work is done.
pub(crate) struct Progress(ProgressBar);

impl Progress {
    /// Of the bytes of a file; a length of 0 is an unknown one.
    pub(crate) fn of_bytes(name: &str, length: u64) -> Progress {
        let known = "{msg} {bar:40} {percent} % [{elapsed}]";
        Progress::new(name, length, if length > 0 { known } else { "{msg} {bytes} [{elapsed}]" })
    }

    /// Of so many features.
    pub(crate) fn of_features(name: &str, count: u64) -> Progress {
        Progress::new(name, count, "{msg} {bar:40} {human_pos} of {human_len} features [{elapsed}]")
    }

    fn new(name: &str, length: u64, template: &str) -> Progress {
        let style = ProgressStyle::with_template(template).unwrap_or(ProgressStyle::default_bar());
        let bar = ProgressBar::new(length).with_style(style).with_message(name.to_owned());
        bar.enable_steady_tick(Duration::from_millis(500)); // one large evaluation moves nothing but the clock
        Progress(bar)
    }

    /// Some more are done.
    pub(crate) fn add(&self, count: usize) {
        self.0.inc(count as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
