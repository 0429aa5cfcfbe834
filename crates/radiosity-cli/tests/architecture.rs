//! The layout of the source: imports run one way, and no two types have one name.

#[path = "../../../tests/src/imports.rs"]
mod imports;
#[path = "../../radiosity/tests/names/mod.rs"]
mod names;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 23] = [
    "arguments",
    "commands", "commands/compare", "commands/expose", "commands/factors", "commands/factors/format",
    "commands/factors/matrix", "commands/inspect", "commands/report", "commands/scene",
    "commands/solve", "commands/solve/interrupt", "commands/solve/solve_outputs",
    "commands/solve/progress", "commands/solve/steps", "commands/solve/options", "commands/view",
    "outputs", "view_options", "input", "json", "parse", "failure",
];

fn crate_file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
fn imports_run_one_way() {
    assert_eq!(imports::complaints(&crate_file("src"), &ORDER), Vec::<String>::new());
}

#[test]
fn no_two_types_have_one_name() {
    assert_eq!(names::shared(&crate_file("src"), &mut BTreeSet::new()), Vec::<String>::new());
}
