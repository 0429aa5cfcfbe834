//! A benchmark of form factors and whole solutions: the error of every method against its time, on every scene, as one page.
//!
//! [`report()`] measures what a [`Plan`] says; the [`Report`] is written as an HTML page, as JSON lines and as Markdown tables.
//! The rows are the same in every run on every machine, but for the times.
//!
//! ```text
//! report      measured, then written
//! page        one HTML file: chapters, plots, tables
//! analysis    slopes, floors, times to an error, and who wins where
//! measure     what is measured, and how
//! methods     the methods, each over the range of its settings
//! clock       jobs in turns: process CPU time and wall time
//! results     what was measured: rows, images, the machine
//! plan        what to measure
//! ```
mod analysis;
mod clock;
mod machine;
mod measure;
mod methods;
mod page;
mod plan;
mod report;
mod results;
mod rows;

pub use page::peers::Peers;
pub use plan::Plan;
pub use report::report;
pub use results::Report;

#[cfg(test)]
mod tests;
