//! The file with its polygons repaired: primitives without the triangles that were cut, and primitives of the pieces. Those of one side have
//! a material that is not double-sided.
use super::buffer::{Buffer, container};
use super::document::Prepared;
use super::read::ReadPrimitive;
use crate::io::error::FileError;
use crate::io::surface::changes::{Changes, CutPiece, Pieces, Side};
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
        let one_sided = one_sided(&mut document, &old, pieces);
        let rest = added.rest(&old, read, pieces);
        let mut new: Vec<Value> = rest.into_iter().collect();
        new.extend(added.whole(&one_sided, read, pieces, Side::Front));
        new.extend(added.whole(&one_sided, read, pieces, Side::Back));
        new.extend(added.pieces(&old, read, pieces, Side::OfMaterial));
        new.extend(added.pieces(&one_sided, read, pieces, Side::Front));
        new.extend(added.pieces(&one_sided, read, pieces, Side::Back));
        let Some(list) = document["meshes"][mesh]["primitives"].as_array_mut() else { continue };
        let mut new = new.into_iter();
        match new.next() {
            Some(first) => list[origin.primitive] = first,
            None => list[origin.primitive]["indices"] = added.buffer.indices(std::iter::empty()).into(),
        }
        list.extend(new);
    }
    added.close(document)
}

/// The primitive with a copy of its material that is not double-sided, where some of its polygons are to have one side.
fn one_sided(document: &mut Value, old: &Value, pieces: &Pieces<'_>) -> Value {
    let mut new = old.clone();
    let is_asked =
        pieces.of_polygon.values().any(|new| new.whole.is_some() || new.pieces.iter().any(is_one_sided));
    let material = old["material"].as_u64().and_then(|index| usize::try_from(index).ok());
    if let (true, Some(index), Some(materials)) = (is_asked, material, document["materials"].as_array_mut()) {
        let mut copy = materials[index].clone();
        copy["doubleSided"] = false.into();
        let known = materials.iter().position(|other| *other == copy);
        new["material"] = known.unwrap_or(materials.len()).into();
        materials.extend(known.is_none().then_some(copy));
    }
    new
}

fn is_one_sided(piece: &CutPiece<'_>) -> bool {
    piece.side != Side::OfMaterial
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

    /// The primitive without the triangles that were cut or that have one side; `None` where none is left.
    fn rest(&mut self, old: &Value, read: &ReadPrimitive, pieces: &Pieces<'_>) -> Option<Value> {
        let gone: BTreeSet<usize> = members(read, pieces.of_polygon.keys().copied()).collect();
        let kept = read.triangles.iter().enumerate().filter(|(index, _)| !gone.contains(index));
        self.indexed(old, kept.flat_map(|(_, triangle)| *triangle).collect())
    }

    /// A primitive of the triangles of which one side is left, seen from there.
    fn whole(
        &mut self,
        one_sided: &Value,
        read: &ReadPrimitive,
        pieces: &Pieces<'_>,
        side: Side,
    ) -> Option<Value> {
        let is_back = side == Side::Back;
        let turn = |[a, b, c]: [usize; 3]| if is_back { [c, b, a] } else { [a, b, c] };
        let triangles = members(read, pieces.whole(side)).map(|index| turn(read.triangles[index]));
        let mut whole = self.indexed(one_sided, triangles.flatten().collect())?;
        if is_back && !whole["attributes"]["NORMAL"].is_null() {
            let turned = read.normals.iter().map(|normal| (-normal.as_dvec3()).to_array());
            whole["attributes"]["NORMAL"] = self.buffer.rows(turned).into();
        }
        Some(whole)
    }

    /// The primitive with other triangles of its vertices; `None` for none.
    fn indexed(&mut self, old: &Value, indices: Vec<usize>) -> Option<Value> {
        if indices.is_empty() {
            return None;
        }
        let mut new = old.clone();
        new["indices"] = self.buffer.indices(indices.into_iter()).into();
        new["mode"] = 4.into();
        Some(new)
    }

    /// A primitive of the triangles of the pieces with these sides, with the material of `old`.
    fn pieces(
        &mut self,
        old: &Value,
        read: &ReadPrimitive,
        pieces: &Pieces<'_>,
        side: Side,
    ) -> Option<Value> {
        let (inverse, mirrored) = (read.world.inverse(), read.world.determinant() < 0.0);
        let (mut points, mut normals, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for piece in pieces.of_side(side) {
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

/// The triangles of some polygons, given by their first ones.
fn members(read: &ReadPrimitive, polygons: impl Iterator<Item = usize>) -> impl Iterator<Item = usize> {
    polygons.filter_map(|polygon| read.members.get(&polygon)).flatten().copied()
}

/// A piece cut into triangles, with places in its picture.
fn triangles(piece: &CutPiece<'_>) -> Vec<[Corner; 3]> {
    let place = |point| piece.texture.map_or(DVec2::ZERO, |texture| texture.place(point));
    let corner = |&point: &_| Corner { point, place: place(point), ..Corner::default() };
    split(&piece.loops.iter().map(|ring| ring.iter().map(corner).collect()).collect())
}
