//! Scenes with dirt, on the command line.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use radiosity::formfactor::PlanarPolygon;
use radiosity::io::collada::Collada;
use radiosity::{Patch, Scene, scenes};
use std::path::PathBuf;
use std::process::{Command, Output};

fn radiosity(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_radiosity")).args(arguments).output().unwrap()
}

/// The file of a furnace with one wall twice and a lamp in its floor.
fn dirty(folder: &tempfile::TempDir) -> PathBuf {
    let furnace = scenes::scene("furnace").unwrap();
    let mut patches = furnace.patches.clone();
    patches.push(Patch { name: "again".into(), ..patches[3].clone() });
    let floor = &patches[0].polygon;
    let corners: Vec<_> = floor.loops().next().unwrap().to_vec();
    let middle = corners.iter().sum::<radiosity::glam::DVec3>() / 4.0;
    let small =
        PlanarPolygon::new([corners.iter().map(|corner| middle.lerp(*corner, 0.5)).collect::<Vec<_>>()])
            .unwrap();
    patches.push(Patch { name: "small".into(), polygon: small, ..patches[0].clone() });
    let path = folder.path().join("dirty.dae");
    std::fs::write(&path, Collada::of(&Scene { patches, ..furnace }).text()).unwrap();
    path
}

#[test]
fn dirt_is_counted_in_a_line_and_in_json() {
    let folder = tempfile::tempdir().unwrap();
    let file = dirty(&folder);
    let run = radiosity(&["solve", file.to_str().unwrap(), "--quality", "draft", "--json"]);
    let told = String::from_utf8(run.stderr).unwrap();
    assert!(run.status.success(), "{told}");
    let lines: Vec<&str> = told.lines().filter(|line| line.starts_with("warning:")).collect();
    assert_eq!(
        lines,
        ["warning: repaired: 1 duplicate removed, 1 overlap cut; inspect lists them, --strict refuses them"]
    );
    let figures: serde_json::Value = serde_json::from_slice(&run.stdout).unwrap();
    let repairs = figures["repairs"].as_array().unwrap();
    let counts: Vec<_> = repairs
        .iter()
        .map(|kind| (kind["kind"].as_str().unwrap(), kind["count"].as_u64().unwrap()))
        .collect();
    assert_eq!(counts, [("duplicate", 1), ("overlap", 1)]);
}

#[test]
fn strict_refuses_and_lists_all_findings() {
    let folder = tempfile::tempdir().unwrap();
    let file = dirty(&folder);
    let run = radiosity(&["solve", file.to_str().unwrap(), "--strict", "--json"]);
    let told = String::from_utf8(run.stderr).unwrap();
    assert_eq!((run.status.code(), run.stdout.len()), (Some(3), 0), "{told}");
    assert!(
        told.contains("1 duplicate, 1 overlap") && told.contains("again") && told.contains("small"),
        "{told}"
    );
    // What was written repaired is taken.
    let clean = folder.path().join("clean.dae");
    let run = radiosity(&["inspect", file.to_str().unwrap(), "--repair", "-o", clean.to_str().unwrap()]);
    assert!(run.status.success());
    let run = radiosity(&["solve", clean.to_str().unwrap(), "--strict", "--quality", "draft", "--json"]);
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}
