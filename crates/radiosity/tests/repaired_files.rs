//! Files with every kind of dirt, in nodes of any pose: what is written repaired needs no repair, and is repaired as it is.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod random;

use base64::{Engine, engine::general_purpose::STANDARD};
use radiosity::glam::{DMat4, DQuat, DVec3};
use radiosity::io::Source;
use radiosity::{Repaired, Scene, needed_sides, repair};
use random::Random;
use serde_json::{Value, json};
use std::path::Path;

/// Turned in any way, of a size from a millimetre to a kilometre, some sizes away from the origin.
fn pose(random: &mut Random) -> DMat4 {
    let turn = DQuat::from_scaled_axis(random.place(6.0));
    let size = 10_f64.powf(random.within(-3.0, 3.0));
    let way = random.place(8.0 * size);
    DMat4::from_scale_rotation_translation(DVec3::splat(size), turn, way)
}

/// Outlines, counter-clockwise seen from the front, of a node's mesh.
type Outlines = Vec<Vec<DVec3>>;

/// A level rectangle that faces up.
fn level([x0, y0, x1, y1]: [f64; 4], z: f64) -> Vec<DVec3> {
    [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, z)).to_vec()
}

/// A box, turned out.
fn block(low: DVec3, high: DVec3) -> Outlines {
    let corner = |code: usize| {
        let pick = |axis: usize| if code >> axis & 1 == 1 { high[axis] } else { low[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    sides.iter().map(|side| side.map(corner).to_vec()).collect()
}

/// A kind of dirt: its name, and how the meshes of some nodes get it.
type Family = (&'static str, fn(&mut Random) -> Vec<Outlines>);

const FAMILIES: [Family; 8] = [
    ("overlap", |random| {
        let mut rectangle = || {
            let [x, y] = [random.next(), random.next()];
            vec![level([x, y, x + 0.1 + random.next(), y + 0.1 + random.next()], 0.0)]
        };
        (0..6).map(|_| rectangle()).collect()
    }),
    ("interpenetration", |random| {
        let mut solid = || {
            let low = DVec3::new(random.next(), random.next(), 0.0);
            block(low, low + DVec3::new(0.3 + random.next(), 0.3 + random.next(), 1.0))
        };
        let solids = [solid(), solid(), solid()];
        [vec![vec![level([-1.0, -1.0, 3.0, 3.0], 0.0)]], solids.to_vec()].concat()
    }),
    ("doubled faces", |random| {
        let solid = block(DVec3::ZERO, DVec3::new(1.0, 0.2 + random.next(), 0.3));
        vec![[solid.clone(), vec![solid[1].clone()]].concat(), vec![solid[3].clone()]]
    }),
    ("slivers", |random| {
        let width = 1e-15 * random.next();
        let thin = vec![DVec3::ZERO, DVec3::X, DVec3::X + width * DVec3::Y];
        let flat = vec![DVec3::ZERO, DVec3::Y, 2.0 * DVec3::Y];
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0), thin, flat], vec![level([1.0, 0.0, 2.0, 1.0], 0.0)]]
    }),
    ("T-junctions", |random| {
        let share = 0.2 + 0.6 * random.next();
        let halves = [level([1.0, 0.0, 2.0, share], 0.0), level([1.0, share, 2.0, 1.0], 0.0)];
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0)], halves.to_vec(), vec![level([0.5, 0.5, 1.5, 0.7], 0.0)]]
    }),
    ("cracks", |random| {
        let mut off = || 3e-7 * (random.next() - 0.5);
        let tiles =
            (0..3).map(|k| vec![level([f64::from(k) + off(), off(), f64::from(k + 1) + off(), 1.0], off())]);
        tiles.collect()
    }),
    ("bent faces", |random| {
        let mut bent = level([0.0, 0.0, 1.0, 1.0], 0.0);
        bent[2].z = 0.1 * random.next();
        vec![vec![bent, level([1.0, 0.0, 2.0, 1.0], 0.0)], vec![level([0.5, 0.0, 1.5, 1.0], 0.0)]]
    }),
    ("thin strips", |random| {
        let width = 10_f64.powf(-7.0 + 3.0 * random.next());
        let lid = level([0.2 * random.next(), width, 1.0 - width, 1.0 - width], 0.0);
        vec![vec![level([0.0, 0.0, 1.0, 1.0], 0.0)], vec![lid]]
    }),
];

/// A node with a mesh, in its own coordinates.
struct Node {
    pose: DMat4,
    mesh: Outlines,
}

/// The meshes of a family, somewhere, each in a node of its own.
fn nodes(random: &mut Random, family: fn(&mut Random) -> Vec<Outlines>) -> Vec<Node> {
    let meshes = family(random);
    let all = pose(random);
    let mut node = |mesh: &Outlines| {
        // About as large as the whole: what is a million times larger holds no such corners.
        let pose = all
            * DMat4::from_rotation_translation(DQuat::from_scaled_axis(random.place(6.0)), random.place(4.0));
        let local = pose.inverse() * all;
        let turned =
            |outline: &Vec<DVec3>| outline.iter().map(|point| local.transform_point3(*point)).collect();
        Node { pose, mesh: mesh.iter().map(turned).collect() }
    };
    meshes.iter().map(&mut node).collect()
}

fn words(numbers: impl IntoIterator<Item = f64>) -> String {
    numbers.into_iter().map(|number| format!("{number:?} ")).collect()
}

fn collada(nodes: &[Node]) -> Vec<u8> {
    let (mut geometries, mut placed) = (String::new(), String::new());
    for (k, Node { pose, mesh }) in nodes.iter().enumerate() {
        let points: Vec<DVec3> = mesh.iter().flatten().copied().collect();
        let (count, counts) =
            (points.len(), mesh.iter().map(|outline| format!("{} ", outline.len())).collect::<String>());
        let corners: String = (0..count).map(|corner| format!("{corner} ")).collect();
        geometries += &format!(
            r##"<geometry id="g{k}"><mesh><source id="p{k}"><float_array id="a{k}" count="{}">{}</float_array>
<technique_common><accessor source="#a{k}" count="{count}" stride="3"/></technique_common></source>
<vertices id="v{k}"><input semantic="POSITION" source="#p{k}"/></vertices>
<polylist count="{}"><input semantic="VERTEX" source="#v{k}" offset="0"/><vcount>{counts}</vcount><p>{corners}</p></polylist></mesh></geometry>"##,
            3 * count,
            words(points.iter().flat_map(DVec3::to_array)),
            mesh.len()
        );
        let matrix = words(pose.transpose().to_cols_array());
        placed += &format!(
            r##"<node name="n{k}"><matrix>{matrix}</matrix><instance_geometry url="#g{k}"/></node>"##
        );
    }
    format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries>{geometries}</library_geometries>
<library_visual_scenes><visual_scene id="s">{placed}</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##
    ).into_bytes()
}

/// The same in single precision, of triangles, with double-sided materials or without.
fn gltf(nodes: &[Node], two_sided: bool) -> Vec<u8> {
    let (mut bytes, mut accessors, mut views) = (Vec::new(), Vec::new(), Vec::new());
    for Node { mesh, .. } in nodes {
        let fan = |outline: &Vec<DVec3>| {
            outline.windows(2).skip(1).flat_map(|ends| [outline[0], ends[0], ends[1]]).collect::<Vec<_>>()
        };
        let corners: Vec<[f32; 3]> =
            mesh.iter().flat_map(fan).map(|point| point.as_vec3().to_array()).collect();
        let start = bytes.len();
        corners.iter().flatten().for_each(|number| bytes.extend(number.to_le_bytes()));
        accessors.push(
            json!({"bufferView": views.len(), "componentType": 5126, "count": corners.len(), "type": "VEC3"}),
        );
        views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start}));
    }
    let each = |value: &dyn Fn(usize) -> Value| (0..nodes.len()).map(value).collect::<Vec<_>>();
    let document = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": each(&|k| k.into())}],
        "nodes": each(&|k| json!({"name": format!("n{k}"), "mesh": k, "matrix": nodes[k].pose.to_cols_array()})),
        "meshes": each(&|k| json!({"primitives": [{"attributes": {"POSITION": k}, "material": 0}]})),
        "materials": [{"doubleSided": two_sided}], "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", STANDARD.encode(&bytes))}],
    });
    document.to_string().into_bytes()
}

/// Repairs a file as `inspect --repair` does; returns what was repaired.
fn write_repaired(source: &Source, path: &Path) -> Repaired {
    let before = needed_sides(&source.scene().unwrap());
    let repaired = repair(&before);
    let written = source.save_repaired([&before, &repaired.scene], &needed_sides, path).unwrap();
    assert!(written.remaining.is_empty(), "{:?}", written.remaining);
    repaired
}

fn area(scene: &Scene) -> f64 {
    scene.patches.iter().map(|patch| patch.polygon.area()).sum()
}

/// Whether a file, written repaired, needs no repair, and written repaired again has the same bytes. A repaired file of doubles has the
/// area of the repaired scene. That of single precision, whose polygons have two sides here, need not: both sides have one outline, so that
/// where a solid stands on a two-sided ground both are cut; a solid that was cut open has inner sides again; and rounding may make one plane
/// of two.
fn stays(name: &str, bytes: Vec<u8>, extension: &str, is_double: bool) -> Result<(), String> {
    let folders = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let [once, twice] = folders.each_ref().map(|folder| folder.path().join(format!("repaired.{extension}")));
    let first = write_repaired(&Source::from_bytes(name, bytes).unwrap(), &once);
    let second = write_repaired(&Source::open(&once).unwrap(), &twice);
    let grown = area(&second.scene) / area(&first.scene) - 1.0;
    match [&once, &twice].map(|path| std::fs::read(path).unwrap()) {
        _ if !second.repairs.is_empty() => Err(format!("{name}: {:?}", second.repairs)),
        [before, after] if before != after => Err(format!("{name}: written again it is another")),
        _ if is_double && grown.abs() > 1e-5 => Err(format!("{name}: the area grew by {grown:e}")),
        _ => Ok(()),
    }
}

#[test]
fn what_is_written_repaired_needs_no_repair() {
    let mut broken = Vec::new();
    for (seed, (family, meshes)) in (0..6).flat_map(|seed| FAMILIES.map(|family| (seed, family))) {
        let nodes = nodes(&mut Random(seed), meshes);
        let text = ["dae", "glb", "obj", "stl"].map(|to| ("dae", collada(&nodes), to));
        let single = [false, true].map(|two_sided| ("gltf", gltf(&nodes, two_sided), "gltf"));
        for (from, bytes, to) in text.into_iter().chain(single) {
            let name = format!("{family} {seed} to {to}.{from}");
            broken.extend(stays(&name, bytes, to, from == "dae").err());
        }
    }
    assert!(broken.is_empty(), "{} broken:\n{}", broken.len(), broken.join("\n"));
}
