//! `ARCHITECTURE.md` names files that exist, imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, named_on_page, shared_names};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 46] = [
    "fuzzing",
    "arguments",
    "commands", "commands/overlay", "commands/pairs", "commands/dissolve", "commands/clip", "commands/repair",
    "commands/validate", "commands/area", "commands/files",
    "operands",
    "formats", "formats/geojson", "formats/geojson/reader", "formats/geojson/collection", "formats/geojson/schema",
    "formats/geojson/writer", "formats/geojson/feature",
    "formats/flatgeobuf", "formats/flatgeobuf/writer", "formats/flatgeobuf/reader", "formats/flatgeobuf/properties",
    "formats/flatgeobuf/shapes",
    "formats/geoparquet", "formats/geoparquet/writer", "formats/geoparquet/reader", "formats/geoparquet/geometries",
    "formats/geoparquet/metadata", "formats/geoparquet/damage",
    "formats/lines", "formats/wkb", "formats/values", "formats/writer", "formats/reader",
    "input", "output", "progress",
    "layer", "layer/columns", "layer/batch", "layer/crs", "layer/areas",
    "interrupt", "failure", "messages",
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
