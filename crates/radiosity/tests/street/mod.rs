//! Whether the imports of a crate run one way, down a street of files and folders.
//!
//! Tests are not read: they may use all of their crate.
use std::collections::BTreeSet;
use std::path::Path;

/// Each folder of `src` with its files and folders, from the top to the bottom: imports only run down. The file `mod` stands
/// above the others of its folder.
pub(crate) type Street<'s> = &'s [(&'s str, &'s [&'s str])];

/// What is wrong: files that the street does not name or that it names in vain, and imports that do not run down.
pub(crate) fn complaints(src: &Path, street: Street<'_>) -> Vec<String> {
    let (listed, files) = (listed(street), files(src, ""));
    let amiss = listed
        .symmetric_difference(&files)
        .map(|file| format!("{file} is not both in the street and in src/"));
    let known = files.iter().filter(|file| listed.contains(*file));
    let imports = known.flat_map(|file| {
        let text = std::fs::read_to_string(src.join(file).with_extension("rs")).expect("a source file");
        upward(&text, file, &files, street)
    });
    amiss.chain(imports).collect()
}

/// The names that two types of a crate have in common.
pub(crate) fn shared_names(src: &Path) -> Vec<String> {
    let (mut names, mut shared) = (BTreeSet::new(), Vec::new());
    for file in files(src, "") {
        let text = std::fs::read_to_string(src.join(&file).with_extension("rs")).expect("a source file");
        for line in text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default().lines() {
            let mut words =
                line.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
            let kind = words.find(|word| !["pub", "crate", "super"].contains(word)).unwrap_or_default();
            let name = words.next().unwrap_or_default();
            let is_type = ["struct", "enum", "trait", "type"].contains(&kind);
            if is_type && !line.starts_with(' ') && !names.insert(name.to_owned()) {
                shared.push(format!("{file}: {name}"));
            }
        }
    }
    shared
}

/// The paths in a file's text that do not run down.
pub(crate) fn upward(text: &str, file: &str, files: &BTreeSet<String>, street: Street<'_>) -> Vec<String> {
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let lines: Vec<&str> = code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let wrong = paths(&lines.join("\n")).into_iter().filter_map(|path| {
        let target = target(file, &path, files, street);
        (!runs_down(file, &target, street))
            .then(|| format!("{file} imports {path}, but {target} does not stand below it"))
    });
    wrong.collect()
}

// The files that the list names.
pub(crate) fn listed(street: Street<'_>) -> BTreeSet<String> {
    let folders: BTreeSet<&str> = street.iter().map(|(folder, _)| *folder).collect();
    let all = street.iter().flat_map(|(folder, names)| names.iter().map(move |name| join(folder, name)));
    all.filter(|path| !folders.contains(path.as_str())).collect()
}

/// The files below a folder, without their ends; tests are left out.
fn files(folder: &Path, name: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in std::fs::read_dir(folder)
        .expect("a folder of sources")
        .map(|entry| entry.expect("a folder of sources").path())
    {
        let stem = join(
            name,
            entry.file_stem().expect("a folder of sources").to_str().expect("a folder of sources"),
        );
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

/// The paths from `crate` and `super`.
pub(crate) fn paths(code: &str) -> Vec<String> {
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
fn target(file: &str, path: &str, files: &BTreeSet<String>, street: Street<'_>) -> String {
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
        "" => street[0].1[0].to_owned(),
        _ if files.contains(&path) => path,
        _ => format!("{path}/mod"),
    }
}

/// Whether the first file stands above the second one in the folder where their ways part.
pub(crate) fn runs_down(from: &str, to: &str, street: Street<'_>) -> bool {
    let (from, to): (Vec<&str>, Vec<&str>) = (from.split('/').collect(), to.split('/').collect());
    let same = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let folder = from[..same].join("/");
    let (_, names) = street.iter().find(|(known, _)| *known == folder).expect("a folder of sources");
    let place = |path: &[&str]| {
        names.iter().position(|name| Some(name) == path.get(same)).expect("a folder of sources")
    };
    place(&from) < place(&to)
}
