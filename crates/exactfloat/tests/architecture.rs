//! `ARCHITECTURE.md` names files that exist, what it says does not exist does not, and imports run one way.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{IMPURE, complaints, named_on_page, occurrences, shared_names};
use std::path::Path;

/// Every file of `src` from the top down.
const ORDER: [&str; 6] = ["determinant", "wide", "fixed", "ratio", "integers", "double_double"];

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
    assert!(named.len() > 5, "only {named:?}");
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn what_must_not_exist_does_not() {
    assert_eq!(occurrences(&package().join("src"), &IMPURE), Vec::<String>::new());
}
