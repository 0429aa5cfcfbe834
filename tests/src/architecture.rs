//! The laws of a crate's layout. Each crate's `tests/architecture.rs` includes this file by its path, so that no published
//! crate depends on this package.
//!
//! Imports run one way: an order names the folders and files of `src` from the top down, as `folder`, `file` or
//! `folder/file`. Where several entries fit a path, the longest one counts. A path may lead down or stay within its entry.
//! `lib.rs` only re-exports, so it is left out, and no name is imported from it.
#![allow(dead_code, reason = "not every crate has every law")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// A module, from the root down.
type Module = Vec<String>;

/// What is wrong with the imports below `src`: paths that lead up or to `lib.rs`, files that the order does not name, and
/// entries that name nothing.
pub(crate) fn complaints(src: &Path, order: &[&str]) -> Vec<String> {
    let exists = |entry: &&&str| src.join(entry).is_dir() || src.join(entry).with_extension("rs").is_file();
    let missing = order.iter().filter(|entry| !exists(entry)).map(|entry| format!("there is no {entry}"));
    let files = sources(src);
    let found = files.iter().flat_map(|file| {
        let text = fs::read_to_string(file).expect("a source file");
        let module = module_of(file.strip_prefix(src).expect("below src"));
        upward(&text, &module, order)
    });
    missing.chain(found).collect()
}

/// What is wrong with the paths in the text of a module.
pub(crate) fn upward(text: &str, module: &[String], order: &[&str]) -> Vec<String> {
    let rank = |path: &[String]| {
        let fits = |entry: &str| entry.split('/').zip(path).filter(|(a, b)| a == b).count();
        let whole = (0..order.len()).filter(|&i| fits(order[i]) == order[i].split('/').count());
        whole.max_by_key(|&i| fits(order[i]))
    };
    let name = module.join("/");
    let Some(own) = rank(module) else { return vec![format!("the order does not name {name}")] };
    let complaint = |path: Module| match rank(&path) {
        None => Some(format!("{name} takes {} from lib.rs", path.join("::"))),
        Some(other) if other < own => Some(format!("{name} imports {} from above", path.join("::"))),
        Some(_) => None,
    };
    paths(text, module).into_iter().filter_map(complaint).collect()
}

/// All paths that start with `crate` or `super`, in `use` and elsewhere, seen from the root. What stands behind `mod tests {` in
/// a file is read as a module inside of it.
pub(crate) fn paths(text: &str, module: &[String]) -> Vec<Module> {
    let code: Vec<&str> =
        text.lines().map(|line| line.split_once("//").map_or(line, |(code, _)| code)).collect();
    let code = code.join("\n");
    let tests = code.find("\nmod tests {").unwrap_or(code.len());
    let mut found = Vec::new();
    for start in [code.match_indices("crate::"), code.match_indices("super::")].into_iter().flatten() {
        let before = code[..start.0].chars().next_back();
        if !before.is_some_and(|c| c.is_alphanumeric() || "_:$".contains(c)) {
            let own = module.iter().cloned().chain((start.0 > tests).then(|| "tests".to_owned()));
            read(&code[start.0..], own.collect(), &mut found);
        }
    }
    found
}

/// Reads one path, or a tree of them, that is relative to a module; returns what follows.
fn read<'t>(text: &'t str, mut path: Module, found: &mut Vec<Module>) -> &'t str {
    let mut text = text.trim_start();
    if let Some(group) = text.strip_prefix('{') {
        text = group;
        while !text.trim_start().starts_with('}') {
            text = read(text, path.clone(), found).trim_start_matches(|c| c != ',' && c != '}');
            text = text.strip_prefix(',').unwrap_or(text);
        }
        return &text.trim_start()[1..];
    }
    let end = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
    match &text[..end] {
        "crate" => path.clear(),
        "super" => drop(path.pop()),
        "self" | "" => {}
        name => path.push(name.to_owned()),
    }
    match text[end..].trim_start().strip_prefix("::") {
        Some(rest) => read(rest, path, found),
        None => {
            found.push(path);
            &text[end..]
        }
    }
}

/// The module of a file below `src`.
fn module_of(file: &Path) -> Module {
    let names = file.with_extension("");
    let names = names.iter().map(|name| name.to_string_lossy().into_owned());
    names.filter(|name| name != "mod").collect()
}

/// All files below a folder but `lib.rs` and `main.rs`.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let files = paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] });
    files.filter(|file| !file.ends_with("src/lib.rs") && !file.ends_with("src/main.rs")).collect()
}

/// What a library that only computes does not contain: state, clocks, files, printing, and whose order is not its input's.
pub(crate) const IMPURE: [&str; 13] = [
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

/// Where some words stand below a folder, comments left out.
pub(crate) fn occurrences(src: &Path, words: &[&str]) -> Vec<String> {
    let of_file = |file: PathBuf| {
        let text = fs::read_to_string(&file).expect("a source file");
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        let found = code.filter(|line| words.iter().any(|word| line.contains(word)));
        found.map(|line| format!("{}: {line}", file.display())).collect::<Vec<_>>()
    };
    sources(src).into_iter().flat_map(of_file).collect()
}

/// The names that two types below a folder share, those of tests left out.
pub(crate) fn shared_names(src: &Path) -> Vec<String> {
    let mut known = BTreeSet::new();
    let mut shared = Vec::new();
    for file in sources(src) {
        let text = fs::read_to_string(&file).expect("a source file");
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let names = code.lines().filter_map(type_name).map(str::to_owned);
        shared.extend(names.filter(|name| !known.insert(name.clone())));
    }
    shared
}

/// The name of the type that a line declares at the top of its file.
pub(crate) fn type_name(line: &str) -> Option<&str> {
    let visibilities = ["pub ", "pub(crate) ", "pub(super) "];
    let line = visibilities.iter().find_map(|start| line.strip_prefix(start)).unwrap_or(line);
    let rest = ["struct ", "enum ", "trait ", "type "].iter().find_map(|kind| line.strip_prefix(kind))?;
    rest.split(|c: char| !c.is_alphanumeric()).next()
}

/// The files and folders between backticks on the page `ARCHITECTURE.md` of a package, and those of them that do not exist.
pub(crate) fn named_on_page(package: &Path) -> [Vec<String>; 2] {
    let page = fs::read_to_string(package.join("ARCHITECTURE.md")).expect("the page stands beside the code");
    let quoted = page.split('`').skip(1).step_by(2);
    let is_path =
        |name: &&str| name.contains('/') && ["/", ".rs", ".md", ".svg"].iter().any(|end| name.ends_with(end));
    let named: Vec<String> = quoted.filter(is_path).map(str::to_owned).collect();
    let exists = |name: &&String| package.join(name).exists() || package.join("src").join(name).exists();
    let missing = named.iter().filter(|name| !exists(name)).cloned().collect();
    [named, missing]
}
