//! `ARCHITECTURE.md` names files that exist, what it says does not exist does not, and imports run one way.

#[path = "../../../tests/src/imports.rs"]
mod imports;

use std::fs;
use std::path::{Path, PathBuf};

/// The folders and files of `src` from the top down: each imports only from itself and from those below it.
const ORDER: [&str; 32] = [
    "fuzzing",
    "batch",
    "serde",
    "geo",
    "affine",
    "validate",
    "classify",
    "triangulate",
    "evaluate",
    "pipeline",
    "pipeline/scratch",
    "assemble/nest",
    "assemble/link",
    "assemble",
    "boundary/repair",
    "boundary/outline",
    "boundary",
    "boundary/select",
    "arrangement/labels",
    "arrangement",
    "contacts",
    "edges",
    "expression/bounds",
    "expression/winding",
    "expression/circuit",
    "expression",
    "spatial/ray_shooting",
    "spatial",
    "region",
    "predicates",
    "base",
    "error",
];

fn crate_file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn page() -> String {
    fs::read_to_string(crate_file("ARCHITECTURE.md")).expect("the page stands beside the code")
}

/// What stands between backticks and looks like a file.
fn named(page: &str) -> Vec<&str> {
    let quoted = page.split('`').skip(1).step_by(2);
    quoted.filter(|name| name.starts_with("src/") || name.ends_with(".rs") || name.ends_with(".md")).collect()
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn every_file_that_the_page_names_exists() {
    let page = page();
    let named = named(&page);
    assert!(named.len() > 30, "only {named:?}");
    for name in named {
        assert!(crate_file(name).exists(), "there is no {name}");
    }
}

#[test]
fn imports_run_one_way() {
    assert_eq!(imports::complaints(&crate_file("src"), &ORDER), Vec::<String>::new());
}

/// The reader sees every way to write an import that runs up.
#[test]
fn an_import_that_runs_up_is_seen() {
    let complaints = |text: &str| imports::upward(text, &["contacts".into(), "pair".into()], &ORDER).len();
    for forbidden in [
        "use crate::pipeline::scratch::Scratch;",
        "use crate::{\n    base::id::index,\n    boundary::{self, select},\n};",
        "use super::super::arrangement::{\n    Arrangement, Node as Kind,\n};",
        "fn f() -> crate::evaluate::Answer {}",
        "use crate::Region;",
        "use super::pair;\n#[cfg(test)]\nmod tests {\n    use super::super::super::arrangement::Node;\n}",
    ] {
        assert!(complaints(forbidden) >= 1, "{forbidden}");
    }
    assert_eq!(
        complaints("/// See [`crate::Region`].\nuse crate::{base::id, edges::Edges};\nuse super::*;"),
        0
    );
    assert_eq!(imports::upward("", &["attic".into()], &ORDER).len(), 1);
    assert_eq!(imports::complaints(&crate_file("src"), &[&ORDER[..], &["attic"]].concat()).len(), 1);
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
    let sources = sources(&crate_file("src"));
    assert!(sources.len() > 20, "only {sources:?}");
    for source in sources {
        let text = fs::read_to_string(&source).expect("a source file");
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        for line in code {
            let found = absent.iter().find(|word| line.contains(**word));
            assert!(found.is_none(), "{}: {line}", source.display());
        }
    }
}

/// Selecting, linking and nesting compare and copy points; a vector operation would be arithmetic on coordinates.
#[test]
fn three_stages_leave_coordinates_alone() {
    for stage in ["src/boundary/select.rs", "src/assemble/link.rs", "src/assemble/nest.rs"] {
        let text = fs::read_to_string(crate_file(stage)).expect("a stage");
        for arithmetic in [".x", ".y", "perp_dot", ".dot(", ".length", ".distance", "f64"] {
            assert!(!text.contains(arithmetic), "{stage} contains {arithmetic}");
        }
    }
}
