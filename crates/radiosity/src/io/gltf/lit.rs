//! The lit mesh's primitives: one of all plain patches, one for each picture.
use super::buffer::{Buffer, single};
use crate::expose::Exposure;
use crate::image_file::bytes;
use crate::record::Record;
use glam::DVec3;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What single precision holds.
const BRIGHTEST: f64 = f32::MAX as f64;

/// The primitives; material 0 is the plain one, material `1 + p` that of picture `p`.
pub(super) fn primitives(
    buffer: &mut Buffer,
    record: &Record,
    middle: DVec3,
    exposure: Exposure,
) -> Vec<Value> {
    let mut groups: BTreeMap<Option<usize>, Vec<[usize; 3]>> = BTreeMap::new();
    let place = |vertex: usize| rounded(record.vertices[vertex] - middle);
    for &[patch, a, b, c] in &record.elements {
        if has_area([a, b, c].map(place)) {
            groups.entry(record.patches[patch].picture).or_default().push([a, b, c]);
        }
    }
    // Exposed as it is written, so that the file says the same when it is exposed again.
    let light: Vec<[f64; 3]> = record.colours().into_iter().map(dimmed).collect();
    let received: Vec<[f64; 3]> = record.under_pictures().into_iter().map(dimmed).collect();
    let mut primitives = Vec::new();
    for (picture, triangles) in groups {
        let (used, indices) = own(&triangles);
        let pick = |values: &[[f64; 3]]| used.iter().map(|&vertex| values[vertex]).collect::<Vec<_>>();
        let points = used.iter().map(|&vertex| (record.vertices[vertex] - middle).to_array());
        let shown = pick(if picture.is_some() { &received } else { &light });
        let mut attributes = json!({
            "POSITION": buffer.rows(points),
            "COLOR_0": buffer.rows(shown.iter().map(|colour| exposure.intensity(*colour))),
            "_RADIOSITY": buffer.rows(pick(&light).into_iter()),
        });
        if picture.is_some() {
            let places = used.iter().map(|&vertex| record.places[vertex].to_array());
            attributes["TEXCOORD_0"] = buffer.rows(places).into();
            attributes["_IRRADIANCE"] = buffer.rows(shown.into_iter()).into();
        }
        let indices = buffer.indices(indices.into_iter());
        let material = picture.map_or(0, |picture| picture + 1);
        primitives.push(json!({"attributes": attributes, "indices": indices, "material": material}));
    }
    primitives
}

/// A number as it is written, in single precision.
fn held(number: f64) -> f64 {
    f64::from(single(number))
}

/// A colour as it is written: what is too bright for that keeps its shares.
fn dimmed(colour: [f64; 3]) -> [f64; 3] {
    let share = colour.into_iter().fold(BRIGHTEST, f64::max) / BRIGHTEST;
    colour.map(|part| held(part / share))
}

/// A point as it is written.
fn rounded(point: DVec3) -> DVec3 {
    DVec3::from(point.to_array().map(held))
}

/// Whether something is left of a triangle when it is written.
fn has_area([a, b, c]: [DVec3; 3]) -> bool {
    (b - a).cross(c - a) != DVec3::ZERO
}

/// The vertices that some triangles use, in order, and the triangles' corners counted among them.
fn own(triangles: &[[usize; 3]]) -> (Vec<usize>, Vec<usize>) {
    let mut used: Vec<usize> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let place = |vertex: &usize| used.partition_point(|known| known < vertex);
    let indices = triangles.iter().flatten().map(place).collect();
    (used, indices)
}

/// Unlit materials, and the pictures as they came.
pub(super) fn materials(document: &mut Value, buffer: &mut Buffer, record: &Record) {
    let unlit = json!({"KHR_materials_unlit": {}});
    let mut materials = vec![json!({"name": "radiosity", "extensions": unlit})];
    materials.extend((0..record.pictures.len()).map(|picture| {
        let texture = json!({"baseColorTexture": {"index": picture}});
        json!({"name": format!("picture-{picture}"), "pbrMetallicRoughness": texture, "extensions": unlit})
    }));
    document["materials"] = materials.into();
    if !record.pictures.is_empty() {
        document["images"] = record.pictures.iter().map(|address| picture(buffer, address)).collect();
        document["textures"] = (0..record.pictures.len()).map(|picture| json!({"source": picture})).collect();
    }
}

/// A picture's bytes in the binary chunk; one whose address cannot be resolved stays an address.
fn picture(buffer: &mut Buffer, address: &str) -> Value {
    let kind = address.strip_prefix("data:").and_then(|data| data.split_once(';')).map(|(kind, _)| kind);
    match (kind, bytes(address, None)) {
        (Some(kind), Ok(bytes)) => json!({"mimeType": kind, "bufferView": buffer.view(bytes)}),
        _ => json!({"uri": address}),
    }
}
