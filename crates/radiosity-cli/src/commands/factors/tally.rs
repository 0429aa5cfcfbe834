//! Progress and the time left: a bar on a terminal, lines in a pipe.
use crate::messages::say;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Lines in a pipe are so far apart.
const PAUSE: Duration = Duration::from_secs(5);

/// How far the pairs are.
#[derive(Debug)]
pub(super) struct Tally {
    bar: ProgressBar,
    rows: usize,
    /// Rows that are there, and the pairs of these.
    rows_there: usize,
    pairs_there: usize,
    /// The pairs that were there before.
    known: usize,
    started: Instant,
    said: Instant,
}

impl Tally {
    /// So many rows are to be found; some are known.
    pub(super) fn new(rows: usize, known: impl Iterator<Item = usize>) -> Tally {
        let style = ProgressStyle::with_template("{bar:40} {msg}").unwrap_or(ProgressStyle::default_bar());
        let bar = ProgressBar::new(pairs_from(0, rows) as u64).with_style(style);
        let now = Instant::now();
        let mut tally = Tally { bar, rows, rows_there: 0, pairs_there: 0, known: 0, started: now, said: now };
        known.for_each(|row| tally.count(row));
        tally.known = tally.pairs_there;
        if tally.rows_there > 0 {
            say!("going on: {} of {rows} rows are there", tally.rows_there);
        }
        tally
    }

    fn count(&mut self, row: usize) {
        self.rows_there += 1;
        self.pairs_there += self.rows - row - 1;
    }

    /// A row is found.
    pub(super) fn advance(&mut self, row: usize) {
        self.count(row);
        self.bar.set_position(self.pairs_there as u64);
        self.bar.set_message(self.line());
        if !std::io::stderr().is_terminal() && self.said.elapsed() >= PAUSE {
            say!("{}", self.line());
            self.said = Instant::now();
        }
    }

    /// How many rows are there, and how long the others will take if their pairs take as long.
    fn line(&self) -> String {
        let found = (self.pairs_there - self.known).max(1);
        let missing = pairs_from(0, self.rows) - self.pairs_there;
        let left = self.started.elapsed().as_secs_f64() * missing as f64 / found as f64;
        format!("{} of {} rows, {left:.0} s left", self.rows_there, self.rows)
    }

    /// All is done.
    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
    }

    /// It was stopped; what is there is in the journal, if there is one.
    pub(super) fn stop(&self, is_kept: bool) {
        self.bar.finish_and_clear();
        let next = if is_kept { "the same command goes on" } else { "give -o FILE to be able to go on" };
        say!("stopped: {} of {} rows are there; {next}", self.rows_there, self.rows);
    }
}

/// How many pairs the rows from one on have.
fn pairs_from(row: usize, rows: usize) -> usize {
    let count = rows.saturating_sub(row);
    count * count.saturating_sub(1) / 2
}
