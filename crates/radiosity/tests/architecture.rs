//! `ARCHITECTURE.md` names files that exist, imports run one way, and no two types have one name.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{complaints, named_on_page, shared_names, type_name};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 283] = [
    "compare", "compare/overlap",
    "scenes", "scenes/cornell_76", "scenes/gomes", "scenes/cornell_box", "scenes/barreto",
    "scenes/rooms", "scenes/shapes",
    "io", "io/repaired_file", "io/source", "io/scene_file", "io/format", "io/gltf", "io/gltf/compose", "io/gltf/write", "io/gltf/exposed", "io/gltf/repaired", "io/gltf/embedded", "io/gltf/dimmed", "io/gltf/read", "io/gltf/lights", "io/gltf/lit",
    "io/gltf/material", "io/gltf/accessor", "io/gltf/document", "io/gltf/prepare", "io/gltf/container", "io/gltf/buffer",
    "io/obj", "io/obj/write", "io/obj/read", "io/obj/material", "io/obj/statements",
    "io/ply", "io/ply/write", "io/ply/read", "io/ply/body", "io/ply/header", "io/stl", "io/stl/write", "io/stl/binary", "io/stl/text", "io/stl/solid",
    "io/collada", "io/collada/repaired", "io/collada/kept", "io/collada/pieces", "io/collada/outlines", "io/collada/dimmed", "io/collada/vertices", "io/collada/write", "io/collada/embedded", "io/collada/splice", "io/collada/exposed", "io/collada/compose", "io/collada/light_text", "io/collada/model",
    "io/collada/patches", "io/collada/unread", "io/collada/material", "io/collada/images", "io/collada/lights", "io/collada/spectra",
    "io/collada/primitive", "io/collada/camera", "io/collada/walk", "io/collada/transform",
    "io/collada/file", "io/collada/lit_mesh", "io/collada/encoding", "io/vs3", "io/vs3/rows", "io/vs3/request", "io/vs3/blast", "io/vs3/fields", "io/surface",
    "io/surface/changes", "io/surface/sidedness", "io/surface/place", "io/surface/planar", "io/surface/flaws", "io/surface/merge", "io/surface/split", "io/surface/finish", "io/surface/lamps",
    "io/surface/polygon", "io/photometry", "io/photometry/ies", "io/photometry/ldt", "io/photometry/angles", "io/upright", "io/words", "io/save", "io/error",
    "viewer", "profile", "profile/chart", "profile/scale", "profile/line", "profile/data", "profile/error",
    "inspect", "inspect/openness", "inspect/cost", "inspect/overlap",
    "inspect/orientation", "inspect/summary", "inspect/surface",
    "sides", "sides/sight", "repair", "repair/solids", "repair/sections", "bodies", "repair/cut", "repair/necks", "repair/junctions", "repair/slivers", "repair/reflectance",
    "repair/findings", "repair/weld",
    "table", "record", "recording/recorder", "recording", "recording/packed",
    "picture", "picture/raster", "picture/painting", "picture/linear", "picture/png", "picture/framing",
    "expose",
    "solve", "solve/levels", "solve/levels/rounds", "solve/levels/refinement", "solve/levels/run", "solve/levels/allowance", "solve/levels/in_view", "solve/levels/tally", "solve/levels/importance", "solve/levels/stand", "solve/levels/output", "solve/levels/parting", "solve/levels/pieces", "solve/levels/cutting", "solve/levels/borders", "solve/levels/vertices", "solve/levels/corners", "solve/levels/evenness", "solve/levels/links", "solve/levels/closed_rooms", "solve/levels/totals", "solve/levels/measure", "solve/levels/screen", "solve/levels/nearby", "solve/levels/parabola", "solve/levels/look",
    "solve/levels/shaft", "solve/levels/asked", "solve/levels/estimate", "solve/levels/reflections", "solve/levels/errors", "solve/levels/members", "solve/levels/cluster_budget", "solve/levels/budget", "solve/levels/curvatures", "solve/levels/hidden", "solve/levels/direct", "solve/levels/gradients", "solve/levels/equilibrium", "solve/levels/firm", "solve/levels/roots", "solve/levels/cluster_links", "solve/levels/seen", "solve/levels/cluster_views", "solve/levels/shadow", "solve/levels/clusters", "solve/levels/cluster", "solve/levels/ways", "solve/levels/flow", "solve/levels/link",
    "solve/levels/tiling", "solve/levels/base", "solve/levels/line_tree", "solve/levels/plates", "solve/levels/boxes", "solve/refine", "solve/drive", "solve/final_gather", "solve/final_gather/shown", "solve/final_gather/bisection", "solve/final_gather/known", "solve/final_gather/tears", "solve/final_gather/received", "solve/final_gather/outlook", "solve/final_gather/senders", "solve/receivers", "solve/relax", "solve/relax/bounces", "solve/relax/gather",
    "solve/relax/cg", "solve/relax/gmres", "solve/relax/gauss", "solve/relax/balance",
    "solve/relax/exchange", "solve/shoot", "solve/follow", "solve/batches", "solve/pace", "solve/run", "solve/progress",
    "solve/factors", "solve/rough", "solve/patch_clusters", "solve/ball", "solve/hemicube", "solve/workers", "solve/occluders", "solve/lights", "solve/lights/beam", "solve/lights/dome", "solve/lights/cubature", "solve/interpolate",
    "solve/solution", "solve/ledger", "solve/shooters", "solve/rooms", "solve/light", "solve/state",
    "solve/levels/transfer", "solve/levels/tile",
    "solve/fingerprint", "solve/magnitude", "solve/check", "solve/overlap", "solve/quality",
    "solve/options", "solve/norm",
    "mesh", "mesh/subdivide", "mesh/plan", "mesh/shadows", "mesh/cover", "mesh/convex", "mesh/conform", "mesh/guests", "mesh/spacing", "mesh/outline", "mesh/tree",
    "mesh/split", "mesh/triangulate", "mesh/divide", "mesh/lines", "mesh/flat_index", "mesh/lattice", "mesh/contacts", "mesh/frame",
    "mesh/refusal", "mesh/element",
    "image_file", "coplanar", "extent",
    "scene", "scene/middle", "scene/patch", "scene/lamp", "scene/photometry", "scene/sky", "scene/units", "scene/texture", "scene/camera", "scene/asset",
    "scene/finding",
    "plane", "spectrum", "union_find", "escape", "predicates", "error",
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

/// The reader of names sees every way to declare a type.
#[test]
fn names_of_types_are_seen() {
    let lines =
        ["pub struct A {", "pub(crate) enum A {", "trait A: B {", "type A = B;", "struct A<'a>(&'a str);"];
    assert!(lines.iter().all(|line| type_name(line) == Some("A")));
    assert_eq!(type_name("    type Output = A;"), None);
}

#[test]
fn every_file_that_the_page_names_exists() {
    let [named, missing] = named_on_page(package());
    assert!(named.len() > 15, "only {named:?}");
    assert_eq!(missing, Vec::<String>::new());
}
