//! Imports run one way, and what must not exist does not.
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Every file of `src`, folder after folder, from the bottom up: a file imports only from those before it.
const STREET: [(&str, &[&str]); 10] = [
    ("", &["error", "stats", "form_factor"]),
    ("numeric", &["gauss", "rounding", "offset", "predicates", "mod"]),
    ("shapes", &["extent", "loops", "polygon", "differential_area", "mod"]),
    (
        "exact",
        &[
            "lambert",
            "horizon",
            "deviation",
            "projected_vertex",
            "pyramid",
            "view",
            "planarity",
            "cull",
            "project",
            "shadows",
            "visible",
            "cubature",
            "whole",
            "mod",
        ],
    ),
    (
        "quick",
        &[
            "interval",
            "cone",
            "corners",
            "clip",
            "target",
            "classify",
            "contour",
            "hidden",
            "neighbours",
            "trace",
            "mod",
        ],
    ),
    ("", &["buffers", "pipeline", "visible_part", "hierarchy", "complement"]),
    ("scene", &["tree", "body", "shaft", "pool", "enclosure", "mod"]),
    ("area", &["cell", "rule", "contour", "events", "pair", "mod"]),
    (
        "approx",
        &[
            "method",
            "random",
            "delta",
            "contour",
            "parts",
            "frame",
            "ray",
            "screen",
            "disk",
            "gather",
            "exact",
            "wallace",
            "pietrek",
            "visibility_index",
            "hemicube",
            "baum",
            "single_plane",
            "monte_carlo",
            "paraboloid",
            "mod",
        ],
    ),
    ("", &["lib"]),
];

fn crate_file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The files below a folder, by their paths in it without `.rs`, and what is in them besides comments and tests.
fn sources(folder: &Path) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        if path.is_dir() {
            found.extend(sources(&path).into_iter().map(|(file, code)| (format!("{name}/{file}"), code)));
        } else {
            let text = fs::read_to_string(&path).expect("a source file");
            let code = text.split("#[cfg(test)]").next().expect("a first part");
            let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            found.insert(name, lines.map(|line| format!("{line}\n")).collect());
        }
    }
    found
}

/// The street's files from the bottom up, as [`sources`] names them.
fn street() -> Vec<String> {
    let name = |folder: &str, file: &&str| {
        if folder.is_empty() { (*file).to_owned() } else { format!("{folder}/{file}") }
    };
    STREET.iter().flat_map(|(folder, files)| files.iter().map(|file| name(folder, file))).collect()
}

/// The paths of a use tree at the start of a text: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn tree(text: &str) -> Vec<String> {
    let text = text.trim_start();
    let is_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    let (stem, rest) = text.split_at(text.find(|c| !is_path(c)).unwrap_or(text.len()));
    if !rest.starts_with('{') {
        return vec![stem.to_owned()];
    }
    let (mut depth, mut branches, mut start) = (0, Vec::new(), 1);
    for (at, c) in rest.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => (),
        }
        if (c == ',' && depth == 1) || depth == 0 {
            branches.extend(tree(&rest[start..at]));
            start = at + 1;
        }
        if depth == 0 {
            break;
        }
    }
    branches.into_iter().map(|branch| format!("{stem}{branch}")).collect()
}

/// The files that a file names by `crate::` and `super::`.
fn imports(file: &str, code: &str, files: &[String]) -> Vec<String> {
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let above = if file.ends_with("/mod") { "" } else { folder };
    let mut found = Vec::new();
    for (root, base) in [("crate::", ""), ("super::", above)] {
        for (at, _) in code.match_indices(root) {
            for path in tree(&code[at + root.len()..]) {
                assert!(!path.starts_with("super"), "{file}: {path}");
                let whole = format!("{base}/{}", path.replace("::", "/"));
                found.push(module_of(whole.trim_start_matches('/'), files));
            }
        }
    }
    found
}

/// The file of the module that a path begins with; `lib` for a name of the crate's root.
fn module_of(path: &str, files: &[String]) -> String {
    let mut module = path;
    loop {
        let names = [module.to_owned(), format!("{module}/mod")];
        if let Some(file) = names.into_iter().find(|name| files.contains(name)) {
            return file;
        }
        match module.rsplit_once('/') {
            Some((shorter, _)) => module = shorter,
            None => return "lib".to_owned(),
        }
    }
}

#[test]
fn imports_run_one_way() {
    let (street, sources) = (street(), sources(&crate_file("src")));
    let (mut listed, found): (Vec<String>, Vec<String>) = (street.clone(), sources.keys().cloned().collect());
    listed.sort();
    assert_eq!(listed, found, "the list and src differ");
    let floor = |file: &str| street.iter().position(|name| name == file).expect("a listed file");
    for (file, code) in &sources {
        for import in imports(file, code, &street) {
            assert!(floor(&import) < floor(file), "{file} imports from {import}, which is not below it");
        }
    }
}

#[test]
fn the_reader_of_imports_finds_what_runs_up() {
    let files = street();
    let found = |file: &str, code: &str| imports(file, code, &files);
    assert_eq!(
        found("exact/view", "use crate::pipeline;\nuse super::whole::unhidden;"),
        ["pipeline", "exact/whole"]
    );
    assert_eq!(
        found("quick/mod", "use crate::{exact::{self, view::View}, Stats};"),
        ["exact/mod", "exact/view", "lib"]
    );
    assert_eq!(found("approx/disk", "map(super::parts::Part::area)"), ["approx/parts"]);
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
    for (file, code) in sources(&crate_file("src")) {
        for line in code.lines() {
            let found = absent.iter().find(|word| line.contains(**word));
            assert!(found.is_none(), "{file}: {line}");
        }
    }
}

/// Exact integers and determinants are asked for in one file.
#[test]
fn only_predicates_decides_signs() {
    for (file, code) in sources(&crate_file("src")) {
        let asks = ["orient2d", "orient3d", "integers", "Integer"].iter().any(|name| code.contains(name));
        assert!(!asks || file == "numeric/predicates", "{file}");
    }
}
