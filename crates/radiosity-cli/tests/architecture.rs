//! `ARCHITECTURE.md` names files that exist, imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, named_on_page, shared_names};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 36] = [
    "arguments",
    "commands", "commands/compare", "commands/expose", "commands/factors", "commands/factors/format", "commands/factors/npz",
    "commands/factors/matrix", "commands/factors/pairs", "commands/factors/tally",
    "commands/factors/journal", "commands/factors/row", "commands/factors/names", "commands/inspect", "commands/view", "commands/patience", "commands/plot", "commands/report", "commands/scene",
    "commands/solve", "commands/solve/interrupt", "commands/solve/solve_outputs",
    "commands/solve/progress", "commands/solve/steps", "commands/solve/options", "commands/solve/lights",
    "clashes", "outputs", "view_options", "input", "waiting", "json", "digits", "parse", "failure", "messages",
];

fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn imports_run_one_way() {
    assert_eq!(complaints(&package().join("src"), &ORDER), Vec::<String>::new());
}

#[test]
fn no_two_types_have_one_name() {
    assert_eq!(shared_names(&package().join("src")), Vec::<String>::new());
}

#[test]
fn every_file_that_the_page_names_exists() {
    let [named, missing] = named_on_page(package());
    assert!(named.len() > 8, "only {named:?}");
    assert_eq!(missing, Vec::<String>::new());
}
