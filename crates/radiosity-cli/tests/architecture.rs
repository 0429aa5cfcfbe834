//! The layout of the source: imports run one way, down the list below, and every name is imported from the module that
//! defines it.
#[path = "../../radiosity/tests/street/mod.rs"]
mod street;

use std::path::Path;
use street::{complaints, shared_names};

/// Each folder of `src`, from the top to the bottom.
const STREET: [(&str, &[&str]); 4] = [
    ("", &["main", "arguments", "commands", "outputs", "view_options", "input", "json", "parse", "failure"]),
    ("commands", &["mod", "compare", "expose", "factors", "inspect", "report", "scene", "solve", "view"]),
    ("commands/factors", &["mod", "format", "matrix"]),
    ("commands/solve", &["mod", "interrupt", "solve_outputs", "progress", "steps", "options"]),
];

#[test]
fn imports_run_one_way() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    assert_eq!(complaints(&src, &STREET), Vec::<String>::new());
}

#[test]
fn no_two_types_have_one_name() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    assert_eq!(shared_names(&src), Vec::<String>::new());
}
