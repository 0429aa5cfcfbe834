//! Imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, shared_names};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists.
#[rustfmt::skip]
const ORDER: [&str; 37] = [
    "functions",
    "join", "join/rule", "join/exec", "join/probe", "join/overlaid", "join/condition", "join/sides", "join/collect", "join/build", "join/tree",
    "aggregate", "aggregate/function", "aggregate/accumulator", "aggregate/groups", "aggregate/evaluate", "aggregate/components",
    "aggregate/group", "aggregate/outline", "aggregate/covered", "aggregate/state",
    "scalar", "scalar/function", "scalar/overlay", "scalar/relate", "scalar/pairs", "scalar/touch", "scalar/side", "scalar/measure",
    "validity", "column", "column/write", "column/read", "column/features", "column/encoding", "page", "error",
];

fn sources() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

#[test]
fn imports_run_one_way() {
    assert_eq!(complaints(&sources(), &ORDER), Vec::<String>::new());
}

#[test]
fn no_two_types_have_one_name() {
    assert_eq!(shared_names(&sources()), Vec::<String>::new());
}
