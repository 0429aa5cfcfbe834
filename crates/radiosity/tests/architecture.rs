//! The layout of the source: imports run one way, down the list below, and every name is imported from the module that
//! defines it.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use std::collections::BTreeSet;
use std::path::Path;

/// Each folder of `src` with its files and folders, from the top to the bottom: imports only run down. The file `mod` stands
/// above the others of its folder.
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
    let files = files(&source(), "");
    assert_eq!(listed(), files, "the list and src/ differ");
    let imports = files.iter().flat_map(|file| paths(file).into_iter().map(move |path| (file, path)));
    let wrong = imports.filter_map(|(file, path)| {
        let target = target(file, &path, &files);
        (!runs_down(file, &target))
            .then(|| format!("{file} imports {path}, but {target} does not stand below it"))
    });
    assert_eq!(wrong.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn an_import_that_runs_up_is_found() {
    let [(_, top), ..] = STREET;
    let [first, .., above, below] = top else { panic!("a street has three houses or more") };
    assert!(runs_down(above, below) && !runs_down(below, above) && !runs_down(below, first));
    let all = paths_of("use crate::{a::B, c::{self, d::E}};\nfn f() { super::super::g::h() }");
    assert_eq!(all, ["crate::a::B", "crate::c::self", "crate::c::d::E", "super::super::g::h"]);
}

fn source() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The files that the list names.
fn listed() -> BTreeSet<String> {
    let folders: BTreeSet<&str> = STREET.iter().map(|(folder, _)| *folder).collect();
    let all = STREET.iter().flat_map(|(folder, names)| names.iter().map(move |name| join(folder, name)));
    all.filter(|path| !folders.contains(path.as_str())).collect()
}

/// The files below a folder, without their ends; tests are left out.
fn files(folder: &Path, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let stem = join(name, entry.file_stem().unwrap().to_str().unwrap());
        if stem.ends_with("tests") {
            continue;
        }
        if entry.is_dir() {
            found.extend(files(&entry, &stem));
        } else if entry.extension().is_some_and(|end| end == "rs") {
            found.insert(stem);
        }
    }
    found
}

fn join(folder: &str, name: &str) -> String {
    if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") }
}

/// The paths from `crate` and `super` in a file, outside of its tests.
fn paths(file: &str) -> Vec<String> {
    let text = std::fs::read_to_string(source().join(file).with_extension("rs")).unwrap();
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
    paths_of(&lines.collect::<Vec<_>>().join("\n"))
}

fn paths_of(code: &str) -> Vec<String> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Vec::new();
    for root in ["crate::", "super::"] {
        for (at, _) in code.match_indices(root) {
            let before = &code[..at];
            if !before.ends_with("::") && !before.ends_with(is_word) {
                expand("", &code[at..], &mut found);
            }
        }
    }
    found
}

/// Appends the paths of a use tree: names joined by `::`, up to a group in braces, whose members are trees.
fn expand(prefix: &str, tree: &str, found: &mut Vec<String>) {
    let end = tree.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(tree.len());
    let path = format!("{prefix}{}", &tree[..end]);
    let Some(group) = tree[end..].strip_prefix('{') else {
        found.push(path.trim_end_matches(':').to_owned());
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, c) in group.char_indices() {
        let ends = (c == ',' || c == '}') && depth == 0;
        if ends && !group[start..at].trim().is_empty() {
            expand(&path, group[start..at].trim(), found);
        }
        match c {
            ',' if depth == 0 => start = at + 1,
            '{' => depth += 1,
            '}' if depth == 0 => return,
            '}' => depth -= 1,
            _ => {}
        }
    }
}

/// The file that a path leads to.
fn target(file: &str, path: &str, files: &BTreeSet<String>) -> String {
    // Where the path starts: the folder that the file's own names stand in.
    let mut here: Vec<&str> =
        file.split('/').filter(|name| *name != "mod" && *name != "lib" && *name != "main").collect();
    let mut names = path.split("::").peekable();
    if names.next_if_eq(&"crate").is_some() {
        here.clear();
    }
    while names.next_if_eq(&"super").is_some() {
        here.pop();
    }
    for name in names {
        let longer = here.iter().copied().chain([name]).collect::<Vec<_>>().join("/");
        if !files.iter().any(|known| *known == longer || known.starts_with(&format!("{longer}/"))) {
            break;
        }
        here.push(name);
    }
    let path = here.join("/");
    match path.as_str() {
        "" => STREET[0].1[0].to_owned(),
        _ if files.contains(&path) => path,
        _ => format!("{path}/mod"),
    }
}

/// Whether the first file stands above the second one in the folder where their ways part.
fn runs_down(from: &str, to: &str) -> bool {
    let (from, to): (Vec<&str>, Vec<&str>) = (from.split('/').collect(), to.split('/').collect());
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let folder = from[..same].join("/");
    let (_, names) = STREET.iter().find(|(known, _)| *known == folder).unwrap();
    let place = |path: &[&str]| names.iter().position(|name| Some(name) == path.get(same)).unwrap();
    place(&from) < place(&to)
}
