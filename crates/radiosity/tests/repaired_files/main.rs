//! Files with every kind of dirt, in nodes of any pose: what is written repaired needs no repair, and is repaired as it is.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod families;
mod files;
#[path = "../random/mod.rs"]
mod random;
mod shapes;
mod solids;

use families::FAMILIES;
use files::{collada, gltf};
use radiosity::io::Source;
use radiosity::{Repaired, Scene, needed_sides, repair};
use random::Random;
use shapes::nodes;
use solids::solids;
use std::{collections::BTreeMap, path::Path};

/// So many scenes of solids are looked at.
const SOLIDS: u64 = 60;

/// Repairs a file as `inspect --repair` does; returns what was repaired.
fn write_repaired(source: &Source, path: &Path) -> Repaired {
    let before = needed_sides(&source.scene().unwrap());
    let repaired = repair(&before);
    let written = source.save_repaired([&before, &repaired.scene], &needed_sides, path).unwrap();
    assert!(written.remaining.is_empty(), "{:?}", written.remaining);
    repaired
}

/// The area of each material.
fn areas(scene: &Scene) -> BTreeMap<&str, f64> {
    let mut areas = BTreeMap::new();
    for patch in &scene.patches {
        *areas.entry(&*patch.material).or_default() += patch.polygon.area();
    }
    areas
}

/// By how much the areas of materials differ at most, as a share of all.
fn difference(before: &Scene, after: &Scene) -> f64 {
    let [before, after] = [before, after].map(areas);
    let area = |areas: &BTreeMap<&str, f64>, name: &str| areas.get(name).copied().unwrap_or_default();
    let names = before.keys().chain(after.keys());
    let worst = names.map(|name| (area(&before, name) - area(&after, name)).abs()).fold(0.0, f64::max);
    worst / before.values().sum::<f64>()
}

/// Whether a file, written repaired, needs no repair, written repaired again has the same bytes, and has the areas of the repaired scene.
fn stays(name: &str, bytes: Vec<u8>, extension: &str) -> Result<(), String> {
    let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [once, twice] = folders.each_ref().map(|folder| folder.path().join(format!("repaired.{extension}")));
    let first = write_repaired(&Source::from_bytes(name, bytes).unwrap(), &once);
    let second = write_repaired(&Source::open(&once).unwrap(), &twice);
    let off = difference(&first.scene, &second.scene);
    match [&once, &twice].map(|path| std::fs::read(path).unwrap()) {
        _ if !second.repairs.is_empty() => Err(format!("{name}: {:?}", second.repairs)),
        [before, after] if before != after => Err(format!("{name}: written again it is another")),
        _ if off > 1e-5 => Err(format!("{name}: areas differ by {off:e}")),
        _ => Ok(()),
    }
}

#[test]
fn what_is_written_repaired_needs_no_repair() {
    let mut broken = Vec::new();
    for (seed, (family, meshes)) in (0..6).flat_map(|seed| FAMILIES.map(|family| (seed, family))) {
        let mut random = Random(seed);
        let meshes = meshes(&mut random);
        let nodes = nodes(&mut random, &meshes);
        let text = ["dae", "glb", "obj", "stl"].map(|to| ("dae", collada(&nodes, false), to));
        let two_sided = ("dae", collada(&nodes, true), "dae");
        let single = [false, true].map(|two_sided| ("gltf", gltf(&nodes, two_sided), "gltf"));
        for (from, bytes, to) in text.into_iter().chain([two_sided]).chain(single) {
            let name = format!("{family} {seed} to {to}.{from}");
            broken.extend(stays(&name, bytes, to).err());
        }
    }
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
}

/// Closed bodies of double-sided materials: what was cut open does not get its inner sides back.
#[test]
fn inner_sides_of_cut_solids_stay_away() {
    let mut broken = Vec::new();
    for seed in 0..SOLIDS {
        let mut random = Random(seed);
        let solids = solids(&mut random);
        let nodes = nodes(&mut random, &solids);
        for (name, bytes, to) in [
            (format!("{seed}.dae"), collada(&nodes, true), "dae"),
            (format!("{seed}.gltf"), gltf(&nodes, true), "gltf"),
            (format!("{seed} to glb.dae"), collada(&nodes, true), "glb"),
        ] {
            broken.extend(stays(&name, bytes, to).err());
        }
    }
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
}
