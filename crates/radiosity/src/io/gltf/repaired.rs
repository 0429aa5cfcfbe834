//! The file with its polygons repaired: primitives without the triangles that were cut, and primitives of the pieces.
use super::buffer::{Buffer, container};
use super::document::Prepared;
use super::read::ReadPrimitive;
use crate::io::error::FileError;
use crate::io::surface::changes::{Changes, CutPiece, Pieces};
use crate::io::surface::{polygon::Corner, split::split};
use base64::{Engine, engine::general_purpose::STANDARD};
use glam::DVec2;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// The new file: binary where the old one was.
pub(super) fn repaired(
    (mut document, blob): Prepared,
    primitives: &[ReadPrimitive],
    changes: &Changes<'_>,
) -> Result<Vec<u8>, FileError> {
    let mut added = Added::new(&document, blob);
    for read in primitives {
        let origin = read.origin;
        let changed = changes.get(&origin.instance).and_then(|primitives| primitives.get(&origin.primitive));
        let Some(pieces) = changed else { continue };
        let mesh = own_mesh(&mut document, read.node);
        let old = document["meshes"][mesh]["primitives"][origin.primitive].clone();
        let rest = added.rest(&old, read, pieces);
        let new = added.pieces(&old, read, pieces);
        let Some(list) = document["meshes"][mesh]["primitives"].as_array_mut() else { continue };
        match (rest, new) {
            (Some(rest), new) => {
                list[origin.primitive] = rest;
                list.extend(new);
            }
            (None, Some(new)) => list[origin.primitive] = new,
            (None, None) => {
                list[origin.primitive]["indices"] = added.buffer.indices(std::iter::empty()).into()
            }
        }
    }
    added.close(document)
}

/// The mesh of a node, which no other node has: a copy where another one does.
fn own_mesh(document: &mut Value, node: usize) -> usize {
    let mesh = document["nodes"][node]["mesh"].clone();
    let index = mesh.as_u64().and_then(|index| usize::try_from(index).ok()).unwrap_or_default();
    let nodes = document["nodes"].as_array().into_iter().flatten();
    if nodes.filter(|other| other["mesh"] == mesh).count() < 2 {
        return index;
    }
    let copy = document["meshes"][index].clone();
    let Some(meshes) = document["meshes"].as_array_mut() else { return index };
    meshes.push(copy);
    let last = meshes.len() - 1;
    document["nodes"][node]["mesh"] = last.into();
    last
}

/// The data that are added to a file: behind its binary chunk, or as a buffer of their own.
struct Added {
    buffer: Buffer,
    /// How many views the file has.
    views: usize,
    is_binary: bool,
    /// Whether the first buffer is the binary chunk.
    is_chunk: bool,
    chunk: Option<Vec<u8>>,
}

impl Added {
    fn new(document: &Value, blob: Option<Vec<u8>>) -> Added {
        let all = |name: &str| document[name].as_array().cloned().unwrap_or_default();
        let (views, accessors) = (all("bufferViews"), all("accessors"));
        let is_binary = blob.is_some();
        let is_chunk = is_binary && document["buffers"][0]["uri"].is_null();
        let (mut bytes, chunk) = if is_chunk { (blob.unwrap_or_default(), None) } else { (Vec::new(), blob) };
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let count = views.len();
        Added { buffer: Buffer { bytes, views, accessors }, views: count, is_binary, is_chunk, chunk }
    }

    /// The primitive without the triangles that were cut; `None` where none is left.
    fn rest(&mut self, old: &Value, read: &ReadPrimitive, pieces: &Pieces<'_>) -> Option<Value> {
        let gone: BTreeSet<usize> = pieces
            .of_polygon
            .keys()
            .filter_map(|number| read.members.get(number))
            .flatten()
            .copied()
            .collect();
        let kept = read.triangles.iter().enumerate().filter(|(index, _)| !gone.contains(index));
        let kept: Vec<usize> = kept.flat_map(|(_, triangle)| *triangle).collect();
        if kept.is_empty() {
            return None;
        }
        let mut rest = old.clone();
        rest["indices"] = self.buffer.indices(kept.into_iter()).into();
        rest["mode"] = 4.into();
        Some(rest)
    }

    /// A primitive of the pieces' triangles, with the material of the old one.
    fn pieces(&mut self, old: &Value, read: &ReadPrimitive, pieces: &Pieces<'_>) -> Option<Value> {
        let (inverse, mirrored) = (read.world.inverse(), read.world.determinant() < 0.0);
        let (mut points, mut normals, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for piece in pieces.all() {
            let normal = read.world.transpose().transform_vector3(piece.normal).normalize_or_zero();
            for mut triangle in triangles(piece) {
                if mirrored {
                    triangle.reverse();
                }
                points.extend(triangle.map(|corner| inverse.transform_point3(corner.point).to_array()));
                normals.extend([normal.to_array(); 3]);
                places.extend(
                    triangle.map(|corner| read.laid.inverse().transform_point2(corner.place).to_array()),
                );
            }
        }
        if points.is_empty() {
            return None;
        }
        let mut attributes: BTreeMap<&str, usize> = BTreeMap::new();
        attributes.insert("POSITION", self.buffer.rows(points.into_iter()));
        for name in old["attributes"].as_object()?.keys() {
            if name == "NORMAL" {
                attributes.insert(name, self.buffer.rows(normals.iter().copied()));
            } else if name.starts_with("TEXCOORD_") {
                attributes.insert(name, self.buffer.rows(places.iter().copied()));
            }
        }
        let mut new = json!({"attributes": attributes});
        if !old["material"].is_null() {
            new["material"] = old["material"].clone();
        }
        Some(new)
    }

    /// The whole file.
    fn close(self, mut document: Value) -> Result<Vec<u8>, FileError> {
        let Added { buffer: Buffer { bytes, mut views, accessors }, views: old, is_binary, is_chunk, chunk } =
            self;
        let count = document["buffers"].as_array().map_or(0, Vec::len);
        let own = if is_chunk { 0 } else { count };
        views[old..].iter_mut().for_each(|view| view["buffer"] = own.into());
        document["bufferViews"] = views.into();
        document["accessors"] = accessors.into();
        let length = bytes.len();
        if is_chunk {
            document["buffers"][0]["byteLength"] = length.into();
            return container(&document, bytes);
        }
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes));
        let buffer = json!({"byteLength": length, "uri": uri});
        match document["buffers"].as_array_mut() {
            Some(buffers) => buffers.push(buffer),
            None => document["buffers"] = json!([buffer]),
        }
        if is_binary {
            container(&document, chunk.unwrap_or_default())
        } else {
            Ok(document.to_string().into_bytes())
        }
    }
}

/// A piece cut into triangles, with places in its picture.
fn triangles(piece: &CutPiece<'_>) -> Vec<[Corner; 3]> {
    let place = |point| piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
    let corner = |&point: &_| Corner { point, place: place(point), ..Corner::default() };
    split(&piece.loops.iter().map(|ring| ring.iter().map(corner).collect()).collect())
}
