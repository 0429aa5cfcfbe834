//! The names of a crate's types, for `tests/architecture.rs`.
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The names that two types below a folder share, those of tests left out; `known` are the names met before.
pub(crate) fn shared(folder: &Path, known: &mut BTreeSet<String>) -> Vec<String> {
    let mut shared = Vec::new();
    for path in
        fs::read_dir(folder).expect("a folder of sources").map(|entry| entry.expect("an entry").path())
    {
        if path.is_dir() {
            shared.extend(self::shared(&path, known));
            continue;
        }
        let text = fs::read_to_string(&path).unwrap_or_default();
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let twice = code.lines().filter_map(type_name).filter(|name| !known.insert((*name).to_owned()));
        shared.extend(twice.map(|name| format!("{}: {name}", path.display())));
    }
    shared
}

/// The name of the type that a line declares at the top of its file.
fn type_name(line: &str) -> Option<&str> {
    let visibilities = ["pub ", "pub(crate) ", "pub(super) "];
    let line = visibilities.iter().find_map(|start| line.strip_prefix(start)).unwrap_or(line);
    let rest = ["struct ", "enum ", "trait ", "type "].iter().find_map(|kind| line.strip_prefix(kind))?;
    rest.split(|c: char| !c.is_alphanumeric()).next()
}
