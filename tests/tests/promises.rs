//! Every promise that `tests/PROMISES.md` lists stands beside tests that exist.
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Each promise with the tests beside it, as `(file, function)`; a file once named in a row need not be named again.
fn promises(page: &str) -> Vec<(&str, Vec<(&str, &str)>)> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| ")?.strip_suffix(" |")?.split_once(" | "));
    let rows = rows.filter(|(_, tests)| tests.contains("::"));
    rows.map(|(promise, tests)| (promise, named(tests))).collect()
}

/// What stands between backticks: `file.rs::function`, or `function` of the file before.
fn named(tests: &str) -> Vec<(&str, &str)> {
    let quoted = tests.split('`').skip(1).step_by(2);
    let mut file = "";
    let mut pairs = Vec::new();
    for name in quoted {
        let (named, test) = name.split_once("::").unwrap_or((file, name));
        file = named;
        pairs.push((file, test));
    }
    pairs
}

/// The names of a file's tests that run without being asked for.
fn tests_of(file: &str) -> BTreeSet<String> {
    let text = fs::read_to_string(root().join(file)).unwrap_or_else(|e| panic!("{file}: {e}"));
    if file.ends_with(".py") {
        let functions =
            text.lines().filter_map(|line| line.trim_start().strip_prefix("def ")?.split_once('('));
        return functions.map(|(name, _)| name.to_owned()).filter(|name| name.starts_with("test_")).collect();
    }
    let text = text.replace("#[tokio::test]", "#[test]");
    let parts = text.split("#[test]").skip(1);
    let runs = parts.filter(|part| !part.split("fn ").next().is_some_and(|head| head.contains("#[ignore")));
    let name = |part: &str| {
        part.split_once("fn ").and_then(|(_, rest)| rest.split_once('(')).map(|n| n.0.to_owned())
    };
    runs.filter_map(name).collect()
}

#[test]
fn every_test_beside_a_promise_exists() {
    let page =
        fs::read_to_string(root().join("tests/PROMISES.md")).expect("the page stands beside the tests");
    let promises = promises(&page);
    assert!(promises.len() > 40, "only {} promises were found", promises.len());
    for (promise, tests) in promises {
        assert!(!tests.is_empty(), "{promise}: no test");
        for (file, test) in tests {
            assert!(tests_of(file).contains(test), "{promise}: {file} has no test {test}");
        }
    }
}
