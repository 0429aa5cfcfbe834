//! `ARCHITECTURE.md` names files that exist, imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, named_on_page, shared_names};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 41] = [
    "tests", "report",
    "page", "page/overview", "page/chapter_solutions", "page/chapter_scenes", "page/chapter_axes", "page/chapter_matrices", "page/chapter_tables", "page/peers",
    "page/section", "page/work_precision", "page/plot", "page/marker", "page/axis", "page/style", "page/table", "page/escape",
    "measure", "measure/solutions", "measure/truth", "measure/mitsuba", "measure/path_tracer", "measure/published", "measure/left_out", "measure/stiff", "measure/booleans",
    "measure/matrices", "measure/rooms",
    "measure/error_image", "measure/stress", "measure/cases", "measure/test_scene", "measure/query",
    "clock", "results", "analysis", "methods", "plan", "machine", "rows",
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
