//! The layout of the source: imports run one way, down the list below, and every name is imported from the module that
//! defines it.
mod street;

use std::path::Path;
use street::{complaints, listed, shared_names, upward};

/// Each folder of `src`, from the top to the bottom.
const STREET: [(&str, &[&str]); 14] = [
    (
        "",
        &[
            "lib",
            "scenes",
            "io",
            "viewer",
            "compare",
            "repair",
            "inspect",
            "table",
            "record",
            "picture",
            "expose",
            "solve",
            "mesh",
            "image_file",
            "extent",
            "scene",
            "plane",
            "spectrum",
            "union_find",
            "predicates",
            "error",
        ],
    ),
    ("scenes", &["mod", "cornell_76", "gomes", "cornell_box", "barreto", "rooms", "shapes"]),
    ("io", &["mod", "source", "gltf", "collada", "vs3", "surface", "save", "error"]),
    (
        "io/gltf",
        &[
            "mod",
            "write",
            "exposed",
            "read",
            "lit",
            "material",
            "accessor",
            "document",
            "container",
            "buffer",
        ],
    ),
    (
        "io/collada",
        &[
            "mod",
            "write",
            "exposed",
            "compose",
            "model",
            "patches",
            "material",
            "images",
            "spectra",
            "primitive",
            "camera",
            "walk",
            "transform",
            "file",
            "lit_mesh",
            "xml",
        ],
    ),
    ("io/surface", &["mod", "place", "flaws", "merge", "split", "finish", "polygon"]),
    ("viewer", &["mod"]),
    ("compare", &["mod", "overlap"]),
    ("inspect", &["mod", "openness", "cost", "junction", "overlap", "orientation", "surface"]),
    ("picture", &["mod", "raster", "painting", "png", "framing"]),
    (
        "solve",
        &[
            "mod",
            "refine",
            "drive",
            "direct",
            "relax",
            "shoot",
            "follow",
            "run",
            "progress",
            "factors",
            "hemicube",
            "workers",
            "occluders",
            "interpolate",
            "solution",
            "ledger",
            "shooters",
            "rooms",
            "light",
            "state",
            "fingerprint",
            "magnitude",
            "check",
            "overlap",
            "quality",
            "options",
            "norm",
        ],
    ),
    ("solve/relax", &["mod", "gather", "cg", "gmres", "gauss", "balance", "exchange"]),
    (
        "mesh",
        &[
            "mod",
            "subdivide",
            "plan",
            "shadows",
            "spacing",
            "outline",
            "tree",
            "split",
            "triangulate",
            "divide",
            "lattice",
            "contacts",
            "frame",
            "refusal",
            "element",
        ],
    ),
    ("scene", &["mod", "middle", "patch", "texture", "camera", "asset", "finding"]),
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

/// Every way to write an import that runs up is seen, and so is a file that the street does not name.
#[test]
fn an_import_that_runs_up_is_seen() {
    let count = |text: &str| upward(text, "mesh/divide", &listed(&STREET), &STREET).len();
    for forbidden in [
        "use crate::solve::run::Run;",
        "use crate::{\n    error::Error,\n    io::{self, source},\n};",
        "use super::super::record::{\n    Record, PatchRecord as Patch,\n};",
        "use super::subdivide::Subdivision;",
        "fn f() -> super::Refusal {}",
        "use crate::Scene;",
    ] {
        assert!(count(forbidden) > 0, "{forbidden}");
    }
    assert_eq!(
        count(
            "/// See [`crate::Scene`].\nuse crate::{error::Error, scene::Scene};\nuse super::frame::Frame;"
        ),
        0
    );
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    assert!(!complaints(&src, &STREET[..5]).is_empty());
}

#[test]
fn every_file_that_the_page_names_exists() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let page =
        std::fs::read_to_string(root.join("ARCHITECTURE.md")).expect("the page stands beside the code");
    let quoted =
        page.split('`').skip(1).step_by(2).filter(|name| name.ends_with(".rs") && name.contains('/'));
    let named: Vec<&str> = quoted.collect();
    assert!(named.len() > 15, "only {named:?}");
    for name in named {
        assert!(root.join(name).is_file(), "there is no {name}");
    }
}
