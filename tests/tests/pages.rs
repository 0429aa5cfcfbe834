//! The pages at the root name what exists, and stay short.
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The targets of a page's links that are no addresses, and what stands between backticks and looks like a path.
fn paths(text: &str) -> Vec<&str> {
    let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    let links = links.map(|target| target.split('#').next().unwrap_or(target));
    let quoted = text.split('`').skip(1).step_by(2);
    let quoted = quoted.filter(|name| {
        let is_path = name.chars().all(|c| c.is_ascii_alphanumeric() || "./_-".contains(c));
        is_path && name.contains('/') && [".md", ".rs", "/"].iter().any(|end| name.ends_with(end))
    });
    links.filter(|target| !target.is_empty() && !target.contains(':')).chain(quoted).collect()
}

#[test]
fn every_path_on_a_page_exists() {
    let pages = [
        "README.md",
        "ARCHITECTURE.md",
        "CONTRIBUTING.md",
        "docs/certified.md",
        "docs/cluster.md",
        "docs/glossary.md",
        "docs/releasing.md",
        "crates/exactfloat/README.md",
        "crates/polycsg/README.md",
        "crates/polycsg/docs/benchmarks.md",
        "crates/polycsg-cli/README.md",
        "crates/formfactor/README.md",
        "crates/formfactor/docs/benchmarks.md",
        "crates/radiosity/README.md",
        "crates/radiosity/docs/benchmarks.md",
        "crates/radiosity-cli/README.md",
        "crates/radiosity-report/README.md",
        "engines/ballista/README.md",
        "engines/datafusion/README.md",
        "tests/peers/README.md",
    ];
    let mut found = 0;
    for name in pages {
        let text = page(name);
        for path in paths(&text) {
            // From the page, its crate, or the root.
            let mut folders = Path::new(name).ancestors().skip(1).map(|folder| root().join(folder));
            assert!(
                folders.any(|folder| folder.join(path).exists()),
                "{name} names {path}, which does not exist"
            );
            found += 1;
        }
    }
    assert!(found > 50, "only {found} paths were found");
}

/// What a newcomer reads first: within a screen or two.
#[test]
fn the_first_pages_are_short() {
    let packages = [
        "exactfloat",
        "polycsg",
        "polycsg-cli",
        "formfactor",
        "radiosity",
        "radiosity-cli",
        "radiosity-report",
    ];
    let readmes = packages.map(|package| format!("crates/{package}/README.md"));
    let root = ["CONTRIBUTING.md", "README.md", "ARCHITECTURE.md", "fuzz/README.md", "tests/peers/README.md"];
    for name in root.into_iter().map(str::to_owned).chain(readmes) {
        let words = page(&name).split_whitespace().count();
        assert!(words <= 600, "{name} has {words} words");
    }
}

/// Packages need one another in the versions that they are released with.
#[test]
fn all_packages_have_one_version() {
    let manifest = page("Cargo.toml");
    let version = manifest.lines().find_map(|line| line.strip_prefix("version = ")).expect("a version");
    let own = manifest.lines().filter(|line| line.contains("path = \"crates/"));
    let own: Vec<&str> = own.collect();
    assert!(own.len() >= 5, "only {own:?}");
    for line in own {
        assert!(line.contains(&format!("version = {version}")), "{line}");
    }
}
