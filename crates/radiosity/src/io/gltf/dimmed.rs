//! Materials that reflect all light, dimmed as reading does.
use super::read::ReadPrimitive;
use crate::repair::BRIGHTEST;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Lowers the base colours of the primitives, given by instance and index. Those without a material get one.
pub(super) fn dim(document: &mut Value, primitives: &[ReadPrimitive], dimmed: &BTreeSet<[usize; 2]>) {
    let is_dimmed = |read: &&ReadPrimitive| dimmed.contains(&[read.origin.instance, read.origin.primitive]);
    let mut plain = None;
    let mut materials = BTreeSet::new();
    for read in primitives.iter().filter(is_dimmed) {
        let mesh = index(&document["nodes"][read.node]["mesh"]).unwrap_or_default();
        let own = index(&document["meshes"][mesh]["primitives"][read.origin.primitive]["material"]);
        let material = own.unwrap_or_else(|| *plain.get_or_insert_with(|| add_material(document)));
        document["meshes"][mesh]["primitives"][read.origin.primitive]["material"] = material.into();
        materials.insert(material);
    }
    materials.into_iter().for_each(|material| lower(&mut document["materials"][material]));
}

fn index(value: &Value) -> Option<usize> {
    usize::try_from(value.as_u64()?).ok()
}

/// A material that says nothing; returns its index.
fn add_material(document: &mut Value) -> usize {
    if document["materials"].is_null() {
        document["materials"] = json!([]);
    }
    let Some(materials) = document["materials"].as_array_mut() else { return 0 };
    materials.push(json!({}));
    materials.len() - 1
}

/// Red, green and blue of a base colour, which is white where it is not told.
fn lower(material: &mut Value) {
    let surface = &mut material["pbrMetallicRoughness"];
    let old = |band: usize| surface["baseColorFactor"][band].as_f64().unwrap_or(1.0);
    let factor = [old(0).min(BRIGHTEST), old(1).min(BRIGHTEST), old(2).min(BRIGHTEST), old(3)];
    surface["baseColorFactor"] = json!(factor);
}
