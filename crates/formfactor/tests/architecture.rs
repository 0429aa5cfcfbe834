//! `ARCHITECTURE.md` names files that exist, what it says does not exist does not, and imports run one way.

#[path = "../../../tests/src/imports.rs"]
mod imports;

use std::fs;
use std::path::{Path, PathBuf};

/// Every file of `src` from the top down: each imports only from those below it, so that no circle of files exists. A
/// folder's own entry is its `mod.rs`.
#[rustfmt::skip]
const ORDER: [&str; 75] = [
    "approx", "approx/paraboloid", "approx/monte_carlo", "approx/single_plane", "approx/baum", "approx/hemicube",
    "approx/visibility_index", "approx/pietrek", "approx/wallace", "approx/exact", "approx/gather", "approx/disk",
    "approx/screen", "approx/ray", "approx/frame", "approx/parts", "approx/contour", "approx/delta", "approx/random",
    "approx/method",
    "area", "area/pair", "area/events", "area/contour", "area/rule", "area/cell",
    "scene", "scene/enclosure", "scene/pool", "scene/shaft", "scene/body", "scene/tree",
    "complement", "hierarchy", "visible_part", "pipeline", "buffers",
    "quick", "quick/trace", "quick/neighbours", "quick/inside", "quick/contour", "quick/classify", "quick/target",
    "quick/clip", "quick/corners", "quick/cone", "quick/interval",
    "exact", "exact/whole", "exact/cubature", "exact/visible", "exact/shadows", "exact/project", "exact/cull",
    "exact/planarity", "exact/view", "exact/pyramid", "exact/projected_vertex", "exact/deviation", "exact/horizon",
    "exact/lambert",
    "shapes", "shapes/differential_area", "shapes/polygon", "shapes/loops", "shapes/extent",
    "numeric", "numeric/predicates", "numeric/offset", "numeric/rounding", "numeric/gauss",
    "form_factor", "stats", "error",
];

fn crate_file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The files below a folder with their text, comments left out.
fn sources(folder: &Path) -> Vec<(PathBuf, String)> {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let code = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a source file");
        let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        (path, lines.map(|line| format!("{line}\n")).collect())
    };
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![code(path)] }).collect()
}

#[test]
fn every_file_that_the_page_names_exists() {
    let page = fs::read_to_string(crate_file("ARCHITECTURE.md")).expect("the page stands beside the code");
    let quoted = page.split('`').skip(1).step_by(2);
    let named: Vec<&str> =
        quoted.filter(|name| [".rs", ".md", ".svg", "/"].iter().any(|end| name.ends_with(end))).collect();
    assert!(named.len() > 30, "only {named:?}");
    for name in named {
        assert!(crate_file(name).exists() || crate_file("src").join(name).exists(), "there is no {name}");
    }
}

#[test]
fn imports_run_one_way() {
    assert_eq!(imports::complaints(&crate_file("src"), &ORDER), Vec::<String>::new());
    let listed = sources(&crate_file("src")).len() - 1;
    assert_eq!(listed, ORDER.len(), "the order lists every file but lib.rs");
}

#[test]
fn an_import_that_runs_up_is_seen() {
    let complaints = |text: &str| imports::upward(text, &["exact".into(), "view".into()], &ORDER).len();
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
fn what_must_not_exist_does_not() {
    let absent = [
        "HashMap",
        "HashSet",
        "thread_local",
        "static mut",
        "lazy_static",
        "OnceLock",
        "std::time",
        "std::env",
        "std::fs",
        "std::io",
        "println!",
        "thread::current",
        "unsafe ",
    ];
    for (source, code) in sources(&crate_file("src")) {
        for line in code.lines() {
            let found = absent.iter().find(|word| line.contains(**word));
            assert!(found.is_none(), "{}: {line}", source.display());
        }
    }
}

/// Exact integers and determinants are asked for in one file.
#[test]
fn only_predicates_decides_signs() {
    for (source, code) in sources(&crate_file("src")) {
        let asks = ["orient2d", "orient3d", "integers("].iter().any(|name| code.contains(name));
        assert!(!asks || source.ends_with("numeric/predicates.rs"), "{}", source.display());
    }
}
