//! `ARCHITECTURE.md` names files that exist, what it says does not exist does not, and imports run one way.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{IMPURE, complaints, named_on_page, occurrences, shared_names, upward};
use std::path::Path;

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 144] = [
    "approx", "approx/paraboloid", "approx/monte_carlo", "approx/single_plane", "approx/baum", "approx/hemicube",
    "approx/visibility_index", "approx/pietrek", "approx/wallace", "approx/exact", "approx/gather", "approx/disk",
    "approx/screen", "approx/ray", "approx/frame", "approx/parts", "approx/contour", "approx/delta", "approx/random",
    "approx/method",
    "matrix", "matrix/closure", "matrix/gray", "matrix/group", "matrix/threshold", "matrix/rows", "matrix/sparse",
    "area", "area/bounded", "area/part", "area/pair", "area/proven", "area/proven/sight", "area/proven/sector", "area/proven/factor",
    "area/proven/curtain", "area/proven/chart", "area/cubature", "area/queue", "area/integrand", "area/uncut", "area/plan", "area/events", "area/hollow", "area/swept", "area/contact", "area/contour", "area/kernel", "area/patch", "area/estimate", "area/point",
    "area/silhouettes", "area/clip", "area/lambert", "area/integral", "area/tolerance",
    "scene", "scene/blockers", "scene/sight", "scene/enclosure", "scene/surfaces", "scene/plates", "scene/coplanar", "scene/occluder", "scene/inside", "scene/apart", "scene/pool", "scene/looks", "scene/shaft",
    "scene/body", "scene/body/clearance", "scene/body/winding", "scene/body/lids", "scene/body/components", "scene/line", "scene/cap", "scene/shell", "scene/slab", "scene/tree",
    "complement", "hierarchy", "centroid", "visible_part", "pipeline", "buffers", "edge_moment", "far_centroid",
    "quick", "occluders", "quick/trace", "quick/uncovered", "quick/boundary", "quick/neighbours", "quick/seams", "quick/sides", "quick/inside", "quick/exact_side", "quick/contour", "quick/classify", "quick/target",
    "quick/clip", "quick/corners", "quick/horizon", "quick/slopes", "quick/cone", "quick/lanes", "quick/interval",
    "exact", "exact/whole", "exact/cubature", "exact/visible", "exact/shadows", "exact/project", "exact/cull",
    "exact/planarity", "exact/view", "exact/pyramid", "exact/projected_vertex", "exact/deviation", "exact/halves", "exact/horizon",
    "exact/lambert",
    "shapes", "shapes/pieces", "shapes/cell", "shapes/differential_area", "shapes/holes", "shapes/polygon", "shapes/plane", "shapes/convex", "shapes/loops", "shapes/extent",
    "numeric", "numeric/taylor", "numeric/predicates", "numeric/predicates/crossing", "numeric/predicates/height", "numeric/offset", "numeric/angle", "numeric/rounding", "numeric/gauss",
    "form_factor", "stats", "error",
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
fn an_import_that_runs_up_is_seen() {
    let complaints = |text: &str| upward(text, &["exact".into(), "view".into()], &ORDER).len();
    for forbidden in [
        "use crate::pipeline::past;",
        "use super::whole::unhidden;",
        "use crate::{quick::{self}, error::Error};",
        "use crate::Stats;",
    ] {
        assert_eq!(complaints(forbidden), 1, "{forbidden}");
    }
    assert_eq!(complaints("use super::lambert::{self, Direction};\nuse crate::stats::Stats;"), 0);
}

#[test]
fn every_file_that_the_page_names_exists() {
    let [named, missing] = named_on_page(package());
    assert!(named.len() > 30, "only {named:?}");
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn what_must_not_exist_does_not() {
    let mut found = occurrences(&package().join("src"), &IMPURE);
    // What an enclosure finds once is its own.
    found.retain(|line| !line.contains("scene/enclosure.rs: ") || !line.contains("OnceLock"));
    assert_eq!(found, Vec::<String>::new());
}

/// Exact integers and determinants are asked for in one place.
#[test]
fn only_predicates_decides_signs() {
    let asks = occurrences(&package().join("src"), &["orient2d", "orient3d", "integers("]);
    assert!(!asks.is_empty() && asks.iter().all(|line| line.contains("numeric/predicates/")), "{asks:?}");
}
