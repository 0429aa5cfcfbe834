//! `ARCHITECTURE.md` names files that exist, what it says does not exist does not, and imports run one way.

#[path = "../../../tests/src/architecture.rs"]
mod architecture;

use architecture::{IMPURE, complaints, named_on_page, occurrences, shared_names, upward};
use std::{fs, path::Path};

/// The folders and files of `src` from the top down: each imports only from itself and from those below it.
const ORDER: [&str; 40] = [
    "fuzzing",
    "batch",
    "relate",
    "serde",
    "geo",
    "affine",
    "validate",
    "flaw",
    "classify",
    "triangulate",
    "evaluate",
    "pipeline",
    "pipeline/scratch",
    "assemble/tests",
    "assemble/nest",
    "assemble/positive",
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
    "expression/apart",
    "expression/simple_ring",
    "expression/circuit",
    "expression",
    "region/prepared",
    "spatial/ray_shooting",
    "spatial",
    "region",
    "predicates",
    "base",
    "limits",
    "error",
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

/// The reader sees every way to write an import that runs up.
#[test]
fn an_import_that_runs_up_is_seen() {
    let count = |text: &str| upward(text, &["contacts".into(), "pair".into()], &ORDER).len();
    for forbidden in [
        "use crate::pipeline::scratch::Scratch;",
        "use crate::{\n    base::id::index,\n    boundary::{self, select},\n};",
        "use super::super::arrangement::{\n    Arrangement, Node as Kind,\n};",
        "fn f() -> crate::evaluate::Answer {}",
        "use crate::Region;",
        "use super::pair;\n#[cfg(test)]\nmod tests {\n    use super::super::super::arrangement::Node;\n}",
    ] {
        assert!(count(forbidden) >= 1, "{forbidden}");
    }
    assert_eq!(count("/// See [`crate::Region`].\nuse crate::{base::id, edges::Edges};\nuse super::*;"), 0);
    assert_eq!(upward("", &["attic".into()], &ORDER).len(), 1);
    assert_eq!(complaints(&package().join("src"), &[&ORDER[..], &["attic"]].concat()).len(), 1);
}

#[test]
fn every_file_that_the_page_names_exists() {
    let [named, missing] = named_on_page(package());
    assert!(named.len() > 30, "only {named:?}");
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn what_must_not_exist_does_not() {
    assert_eq!(occurrences(&package().join("src"), &IMPURE), Vec::<String>::new());
}

/// Selecting, linking and nesting compare and copy points; a vector operation would be arithmetic on coordinates.
#[test]
fn three_stages_leave_coordinates_alone() {
    for stage in ["src/boundary/select.rs", "src/assemble/link.rs", "src/assemble/nest.rs"] {
        let text = fs::read_to_string(package().join(stage)).expect("a stage");
        for arithmetic in [".x", ".y", "perp_dot", ".dot(", ".length", ".distance", "f64"] {
            assert!(!text.contains(arithmetic), "{stage} contains {arithmetic}");
        }
    }
}
