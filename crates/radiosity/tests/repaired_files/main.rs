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
use radiosity::{Quality, Repaired, Scene, Sky, SkyKind, needed_sides, repair, solve};
use random::Random;
use shapes::nodes;
use solids::solids;
use std::{collections::BTreeMap, ops::ControlFlow, path::Path};

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

/// By how much the area of a material grows at most, as a share of all; that of all in one where names are lost.
fn growth(before: &Scene, after: &Scene, is_named: bool) -> f64 {
    let [before, after] = [before, after]
        .map(areas)
        .map(|areas| if is_named { areas } else { BTreeMap::from([("", areas.into_values().sum())]) });
    let growth = |(name, area): (&&str, &f64)| area - before.get(name).copied().unwrap_or_default();
    after.iter().map(growth).fold(0.0, f64::max) / before.values().sum::<f64>()
}

/// Whether a file, written repaired, needs no repair, written repaired again has the same bytes, and has no more area than the repaired
/// scene, and no less where it `keeps_all`.
fn stays(name: &str, bytes: Vec<u8>, extension: &str, keeps_all: bool) -> Result<(), String> {
    let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [once, twice] = folders.each_ref().map(|folder| folder.path().join(format!("repaired.{extension}")));
    let first = write_repaired(&Source::from_bytes(name, bytes).unwrap(), &once);
    let second = write_repaired(&Source::open(&once).unwrap(), &twice);
    let is_named = name.ends_with(extension);
    let grown = growth(&first.scene, &second.scene, is_named);
    let shrunk = growth(&second.scene, &first.scene, is_named);
    match [&once, &twice].map(|path| std::fs::read(path).unwrap()) {
        _ if !second.repairs.is_empty() => Err(format!("{name}: {:?}", second.repairs)),
        [before, after] if before != after => Err(format!("{name}: written again it is another")),
        _ if grown > 1e-5 => Err(format!("{name}: the area grew by {grown:e}")),
        _ if keeps_all && shrunk > 1e-5 => Err(format!("{name}: the area shrank by {shrunk:e}")),
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
            // A two-sided body is closed when its doubled face is gone; and single precision may make one plane of two.
            let keeps_all = from == "dae" && family != "doubled faces";
            broken.extend(stays(&name, bytes, to, keeps_all).err());
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
            broken.extend(stays(&name, bytes, to, true).err());
        }
    }
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
}

/// Under a sky: the same power falls on each material before the file is written and when it is read again, within the estimates.
#[test]
fn the_light_of_a_repaired_file_is_that_of_the_repaired_scene() {
    for seed in 0..4 {
        let mut random = Random(seed);
        let solids = solids(&mut random);
        let nodes = nodes(&mut random, &solids);
        for (extension, bytes) in [("dae", collada(&nodes, true)), ("gltf", gltf(&nodes, true))] {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join(format!("repaired.{extension}"));
            let before = write_repaired(&Source::from_bytes(extension, bytes).unwrap(), &path).scene;
            let after = needed_sides(&Source::open(&path).unwrap().scene().unwrap());
            let [before, after] = [before, after].map(powers);
            assert!(before.keys().eq(after.keys()), "{seed}: {before:?} {after:?}");
            for (material, [power, estimate]) in before {
                let [other, other_estimate] = after[&material];
                let off = (power - other).abs();
                assert!(off <= estimate + other_estimate, "{seed} {extension}, {material}: {power} {other}");
            }
        }
    }
}

/// The power that falls on each material from a sky, and the estimate of its error.
fn powers(mut scene: Scene) -> BTreeMap<String, [f64; 2]> {
    scene.sky = Some(Sky { radiance: vec![1.0; scene.bands], kind: SkyKind::Uniform });
    let solution = solve(&scene, &Quality::Draft.options(), |_| ControlFlow::Continue(())).unwrap();
    let means = solution.patch_means(&solution.irradiance, scene.patches.len());
    let mut powers: BTreeMap<String, [f64; 2]> = BTreeMap::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        let own =
            [means[index][0], solution.patch_estimate(index)[0]].map(|value| value * patch.polygon.area());
        let sum = powers.entry(patch.material.to_string()).or_default();
        sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
    }
    powers
}
