//! The repair of patches that overlap in one plane.
use crate::inspect::overlap::overlaps;
use crate::plane::Plane;
use crate::scene::{Scene, patch::Patch};
use formfactor::PlanarPolygon;
use polycsg::{Csg, Region};
use std::collections::{BTreeMap, HashSet};

/// Cuts patches that face the same way in one plane out of each other, so that no point is covered twice.
///
/// An emitter stays whole and is cut out of a patch that does not emit. Otherwise the smaller patch stays whole, and of equal
/// ones the first. Duplicates and patches that are covered completely are removed. The pieces of a patch get `.1`, `.2`, …
/// behind its name. All other patches stay as they are, bit for bit. Cuts are exact.
///
/// Returns the repaired scene, and a sentence for every patch that was changed.
#[must_use]
pub fn repair(scene: &Scene) -> (Scene, Vec<String>) {
    let mut covers: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for overlap in overlaps(scene) {
        let [a, b] = overlap.patches;
        let (upper, lower) = if rank(scene, a) <= rank(scene, b) { (a, b) } else { (b, a) };
        covers.entry(lower).or_default().push(upper);
    }
    let mut taken: HashSet<String> = scene.patches.iter().map(|patch| patch.name.clone()).collect();
    let (mut patches, mut changes) = (Vec::new(), Vec::new());
    for (index, patch) in scene.patches.iter().enumerate() {
        match covers.get(&index) {
            None => patches.push(patch.clone()),
            Some(upper) => {
                let polygons = cut(scene, index, upper);
                changes.push(change(scene, patch, upper, polygons.len()));
                patches.extend(named(patch, polygons, &mut taken));
            }
        }
    }
    (Scene { patches, ..scene.clone() }, changes)
}

/// Emitters first, then small before large, then in the order of the file.
fn rank(scene: &Scene, index: usize) -> (bool, u64, usize) {
    let patch = &scene.patches[index];
    // The bits of positive numbers are in the order of the numbers.
    (!patch.emits(), patch.polygon.area().to_bits(), index)
}

/// What the patches above leave of a patch.
fn cut(scene: &Scene, index: usize, upper: &[usize]) -> Vec<PlanarPolygon> {
    let polygon = &scene.patches[index].polygon;
    let plane = Plane::of(polygon);
    let above: Vec<&PlanarPolygon> = upper.iter().map(|&index| &scene.patches[index].polygon).collect();
    let regions: Vec<Region> = above.iter().map(|polygon| plane.region(polygon)).collect();
    let rest = (Csg::from(&plane.region(polygon)) - Csg::union(&regions)).evaluate();
    plane.lift(&rest, &[polygon])
}

fn change(scene: &Scene, patch: &Patch, upper: &[usize], pieces: usize) -> String {
    let names: Vec<&str> = upper.iter().map(|&index| scene.patches[index].name.as_str()).collect();
    let what = match pieces {
        0 => "covered wholly and removed".to_owned(),
        1 => "cut".to_owned(),
        pieces => format!("cut into {pieces} pieces"),
    };
    format!("{}: {what}, by {}", patch.name, names.join(", "))
}

/// The pieces under their names: the patch's own for a single one.
fn named(patch: &Patch, polygons: Vec<PlanarPolygon>, taken: &mut HashSet<String>) -> Vec<Patch> {
    let single = polygons.len() == 1;
    let piece = |(polygon, number): (PlanarPolygon, usize)| {
        let mut name = if single { patch.name.clone() } else { format!("{}.{number}", patch.name) };
        while !single && !taken.insert(name.clone()) {
            name.push('\'');
        }
        Patch { name, polygon, ..patch.clone() }
    };
    polygons.into_iter().zip(1..).map(piece).collect()
}
