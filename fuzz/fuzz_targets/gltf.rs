//! Any bytes as a glTF file, or a file of any buffers: a scene or a typed error; a scene whose numbers can be used, and
//! that is the same when it is written and read, as COLLADA and, its triangles, as GLB.
#![no_main]
use arbitrary::Arbitrary;
use fuzz::{survives_lighting, survives_repair, survives_writing, within_memory};
use libfuzzer_sys::fuzz_target;
use radiosity::io::{Source, gltf::Gltf};
use serde_json::{Value, json};

#[derive(Arbitrary, Debug)]
enum Input<'a> {
    Bytes(&'a [u8]),
    File(File),
}

#[derive(Arbitrary, Debug)]
struct File {
    /// On a small lattice, so that faces in one plane are likely.
    points: Vec<[u8; 3]>,
    any: Vec<u8>,
    views: Vec<[u8; 3]>,
    accessors: Vec<Accessor>,
    primitives: Vec<Primitive>,
    nodes: Vec<Node>,
    /// The lens of the camera of every node.
    lens: Option<[f32; 3]>,
    is_two_sided: bool,
}

#[derive(Arbitrary, Debug)]
struct Accessor {
    view: Option<u8>,
    offset: u8,
    kind: u8,
    count: u16,
    shape: u8,
    is_normalized: bool,
    sparse: Option<[u8; 3]>,
}

#[derive(Arbitrary, Debug)]
struct Primitive {
    position: u8,
    normal: Option<u8>,
    indices: Option<u8>,
    mode: u8,
}

#[derive(Arbitrary, Debug)]
struct Node {
    name: String,
    translation: [i8; 3],
    scale: [f32; 3],
    children: Vec<u8>,
}

fuzz_target!(|input: Input| {
    let bytes = match input {
        Input::Bytes(bytes) => bytes.to_vec(),
        Input::File(file) => container(&file),
    };
    let length = bytes.len();
    let file = Gltf::from_bytes("fuzz.glb", bytes);
    match within_memory(length, || file.scene()) {
        Err(e) => assert!(e.to_string().contains("fuzz.glb"), "which file? {e}"),
        Ok(scene) => {
            for patch in &scene.patches {
                assert!(patch.polygon.area() > 0.0, "{} has no area", patch.name);
                assert!(patch.reflectance.iter().chain(&patch.emission).all(|value| value.is_finite()));
            }
            survives_lighting(&scene);
            survives_repair(&Source::Gltf(file), &scene);
            // What a picture reflects on the whole is summed over the pieces of a surface.
            if scene.patches.iter().all(|patch| patch.texture.is_none()) {
                survives_writing(&scene);
            }
        }
    }
});

/// The header, the document and the binary chunk: view 0 and accessor 0 are the points.
fn container(file: &File) -> Vec<u8> {
    let lattice = file.points.iter().flatten().flat_map(|c| f32::from(c % 4).to_le_bytes());
    let mut binary: Vec<u8> = lattice.chain(file.any.iter().copied()).collect();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut text = document(file, binary.len()).to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let chunk = |name: &[u8; 4], bytes: &[u8]| [&length(bytes.len())[..], name, bytes].concat();
    let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", &binary)].concat();
    [b"glTF", &length(2)[..], &length(12 + chunks.len()), &chunks].concat()
}

fn length(bytes: usize) -> [u8; 4] {
    u32::try_from(bytes).expect("a small file").to_le_bytes()
}

fn document(file: &File, bytes: usize) -> Value {
    let mut views = vec![json!({"buffer": 0, "byteLength": 12 * file.points.len().max(1)})];
    views.extend(file.views.iter().map(|[offset, length, stride]| {
        json!({"buffer": 0, "byteOffset": offset, "byteLength": u16::from(*length) + 1, "byteStride": 4 + stride % 60})
    }));
    let lattice = json!({"bufferView": 0, "componentType": 5126, "count": file.points.len(), "type": "VEC3",
        "min": [0, 0, 0], "max": [3, 3, 3]});
    let accessors: Vec<Value> =
        std::iter::once(lattice).chain(file.accessors.iter().map(|a| accessor(a, views.len()))).collect();
    let count = accessors.len();
    let primitives: Vec<Value> = file.primitives.iter().map(|p| primitive(p, count)).collect();
    let count = file.nodes.len();
    let mut nodes: Vec<Value> = file.nodes.iter().enumerate().map(|(at, n)| node(n, at, count)).collect();
    let lens = file.lens.filter(|lens| lens.iter().all(|number| number.is_finite()));
    if lens.is_some() {
        nodes.iter_mut().for_each(|node| node["camera"] = 0.into());
    }
    let [fov, aspect, near] = lens.unwrap_or([1.0; 3]);
    json!({
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": bytes}],
        "bufferViews": views,
        "accessors": accessors,
        "materials": [{"doubleSided": file.is_two_sided}],
        "meshes": [{"primitives": primitives}],
        "cameras": [{"type": "perspective",
            "perspective": {"yfov": fov, "aspectRatio": aspect, "znear": near}}],
        "nodes": nodes,
        "scenes": [{"nodes": if count > 0 { vec![0] } else { vec![] }}],
    })
}

fn accessor(accessor: &Accessor, views: usize) -> Value {
    let kinds = [5120, 5121, 5122, 5123, 5125, 5126];
    let shapes = ["SCALAR", "VEC2", "VEC3", "VEC4"];
    let mut value = json!({
        "byteOffset": accessor.offset,
        "componentType": kinds[usize::from(accessor.kind % 6)],
        "count": u64::from(accessor.count).pow(1 + u32::from(accessor.shape / 128)),
        "type": shapes[usize::from(accessor.shape % 4)],
        "normalized": accessor.is_normalized,
        "min": [0, 0, 0],
        "max": [3, 3, 3],
    });
    if let Some(view) = accessor.view {
        value["bufferView"] = (usize::from(view) % views).into();
    }
    if let Some([count, indices, values]) = accessor.sparse {
        value["sparse"] = json!({
            "count": count,
            "indices": {"bufferView": usize::from(indices) % views, "componentType": 5121},
            "values": {"bufferView": usize::from(values) % views},
        });
    }
    value
}

fn primitive(primitive: &Primitive, accessors: usize) -> Value {
    let pick = |index: u8| usize::from(index) % accessors;
    let mut value = json!({
        "attributes": {"POSITION": pick(primitive.position)},
        "mode": primitive.mode % 7,
        "material": 0,
    });
    if let Some(normal) = primitive.normal {
        value["attributes"]["NORMAL"] = pick(normal).into();
    }
    if let Some(indices) = primitive.indices {
        value["indices"] = pick(indices).into();
    }
    value
}

fn node(node: &Node, at: usize, nodes: usize) -> Value {
    let mut children: Vec<usize> = node
        .children
        .iter()
        .map(|child| at + 1 + usize::from(*child))
        .filter(|child| *child < nodes)
        .collect();
    children.dedup();
    let mut value = json!({"name": node.name, "mesh": 0, "translation": node.translation});
    if node.scale.iter().all(|factor| factor.is_finite()) {
        value["scale"] = json!(node.scale);
    }
    if !children.is_empty() {
        value["children"] = json!(children);
    }
    value
}
