//! The layout of the source: imports run one way, and no two types have one name, and `ARCHITECTURE.md` names files that exist.

#[path = "../../../tests/src/imports.rs"]
mod imports;
mod names;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 126] = [
    "compare", "compare/overlap",
    "scenes", "scenes/cornell_76", "scenes/gomes", "scenes/cornell_box", "scenes/barreto",
    "scenes/rooms", "scenes/shapes",
    "io", "io/source", "io/gltf", "io/gltf/write", "io/gltf/exposed", "io/gltf/read", "io/gltf/lit",
    "io/gltf/material", "io/gltf/accessor", "io/gltf/document", "io/gltf/container", "io/gltf/buffer",
    "io/collada", "io/collada/write", "io/collada/exposed", "io/collada/compose", "io/collada/model",
    "io/collada/patches", "io/collada/material", "io/collada/images", "io/collada/spectra",
    "io/collada/primitive", "io/collada/camera", "io/collada/walk", "io/collada/transform",
    "io/collada/file", "io/collada/lit_mesh", "io/collada/xml", "io/vs3", "io/surface",
    "io/surface/place", "io/surface/flaws", "io/surface/merge", "io/surface/split", "io/surface/finish",
    "io/surface/polygon", "io/save", "io/error",
    "viewer", "repair",
    "inspect", "inspect/openness", "inspect/cost", "inspect/junction", "inspect/overlap",
    "inspect/orientation", "inspect/surface",
    "table", "record",
    "picture", "picture/raster", "picture/painting", "picture/png", "picture/framing",
    "expose",
    "solve", "solve/refine", "solve/drive", "solve/direct", "solve/relax", "solve/relax/gather",
    "solve/relax/cg", "solve/relax/gmres", "solve/relax/gauss", "solve/relax/balance",
    "solve/relax/exchange", "solve/shoot", "solve/follow", "solve/run", "solve/progress",
    "solve/factors", "solve/hemicube", "solve/workers", "solve/occluders", "solve/interpolate",
    "solve/solution", "solve/ledger", "solve/shooters", "solve/rooms", "solve/light", "solve/state",
    "solve/fingerprint", "solve/magnitude", "solve/check", "solve/overlap", "solve/quality",
    "solve/options", "solve/norm",
    "mesh", "mesh/subdivide", "mesh/plan", "mesh/shadows", "mesh/spacing", "mesh/outline", "mesh/tree",
    "mesh/split", "mesh/triangulate", "mesh/divide", "mesh/lattice", "mesh/contacts", "mesh/frame",
    "mesh/refusal", "mesh/element",
    "image_file", "extent",
    "scene", "scene/middle", "scene/patch", "scene/texture", "scene/camera", "scene/asset",
    "scene/finding",
    "plane", "spectrum", "union_find", "predicates", "error",
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

/// The check sees two types of one name: here `Options`, met before.
#[test]
fn a_name_of_two_types_is_seen() {
    let mut known = BTreeSet::from(["Options".to_owned()]);
    assert_eq!(names::shared(&crate_file("src"), &mut known).len(), 1);
}

#[test]
fn every_file_that_the_page_names_exists() {
    let page =
        std::fs::read_to_string(crate_file("ARCHITECTURE.md")).expect("the page stands beside the code");
    let quoted =
        page.split('`').skip(1).step_by(2).filter(|name| name.ends_with(".rs") && name.contains('/'));
    let named: Vec<&str> = quoted.collect();
    assert!(named.len() > 15, "only {named:?}");
    for name in named {
        assert!(crate_file(name).is_file(), "there is no {name}");
    }
}
