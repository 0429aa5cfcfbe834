//! Which sides of double-sided surfaces are kept, in glTF as exporters write it.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use radiosity::glam::DVec3;
use radiosity::io::collada::Collada;
use radiosity::io::gltf::Gltf;
use radiosity::{Camera, Quality, Scene, needed_sides, one_sided, repair, solve};
use serde_json::{Value, json};
use std::ops::ControlFlow;

/// A mesh of quadrilaterals, with or without emission.
struct Mesh {
    name: &'static str,
    quads: Vec<[[f32; 3]; 4]>,
    emits: bool,
}

/// A box, its faces turned out, or in.
fn block(name: &'static str, low: [f32; 3], high: [f32; 3], turned_in: bool) -> Mesh {
    let corner =
        |code: usize| std::array::from_fn(|axis| if code >> axis & 1 == 1 { high[axis] } else { low[axis] });
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let quads = sides.map(|side| {
        let mut side = side.map(corner);
        if turned_in {
            side.reverse();
        }
        side
    });
    Mesh { name, quads: quads.to_vec(), emits: false }
}

/// A level square that faces down.
fn panel(name: &'static str, [x, y]: [f32; 2], size: f32, z: f32, emits: bool) -> Mesh {
    Mesh {
        name,
        quads: vec![[[x, y, z], [x, y + size, z], [x + size, y + size, z], [x + size, y, z]]],
        emits,
    }
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digit = |group: u32, k: u32| char::from(DIGITS[(group >> (18 - 6 * k) & 63) as usize]);
    assert!(bytes.len() % 3 == 0, "whole groups");
    let groups = bytes.chunks(3).map(|b| u32::from(b[0]) << 16 | u32::from(b[1]) << 8 | u32::from(b[2]));
    groups.flat_map(|group| (0..4).map(move |k| digit(group, k))).collect()
}

fn scene(meshes: &[Mesh]) -> Scene {
    file(meshes).scene().unwrap()
}

/// A glTF file of meshes with double-sided materials.
fn file(meshes: &[Mesh]) -> Gltf {
    let (mut bytes, mut accessors, mut views) = (Vec::new(), Vec::new(), Vec::new());
    for mesh in meshes {
        let corners: Vec<[f32; 3]> =
            mesh.quads.iter().flat_map(|[a, b, c, d]| [a, b, c, a, c, d]).copied().collect();
        let start = bytes.len();
        corners.iter().flatten().for_each(|number| bytes.extend(number.to_le_bytes()));
        let bound = |pick: fn(f32, f32) -> f32| {
            corners.iter().copied().reduce(|a, b| std::array::from_fn(|k| pick(a[k], b[k])))
        };
        accessors.push(
            json!({"bufferView": views.len(), "componentType": 5126, "count": corners.len(), "type": "VEC3",
            "min": bound(f32::min), "max": bound(f32::max)}),
        );
        views.push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start}));
    }
    let each = |value: &dyn Fn(usize, &Mesh) -> Value| {
        meshes.iter().enumerate().map(|(k, mesh)| value(k, mesh)).collect::<Vec<_>>()
    };
    let document = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": (0..meshes.len()).collect::<Vec<_>>()}],
        "nodes": each(&|k, mesh| json!({"name": mesh.name, "mesh": k})),
        "meshes": each(&|k, _| json!({"primitives": [{"attributes": {"POSITION": k}, "material": k}]})),
        "materials": each(&|_, mesh| json!({"doubleSided": true, "emissiveFactor": if mesh.emits { [1, 1, 1] } else { [0, 0, 0] }})),
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{}", base64(&bytes))}],
    });
    Gltf::from_bytes("sides.gltf", document.to_string())
}

/// The names of a body's patches that are kept, by side, and which of them emit.
fn kept(scene: &Scene, body: &str) -> [[usize; 2]; 2] {
    let needed = needed_sides(scene);
    let of_body = || needed.patches.iter().filter(|patch| patch.name.starts_with(body));
    let count = |is_back: bool, emits: bool| {
        of_body().filter(|patch| patch.is_back == is_back && (!emits || patch.emits())).count()
    };
    [[count(false, false), count(true, false)], [count(false, true), count(true, true)]]
}

#[test]
fn the_inside_of_a_closed_body_is_left_out() {
    for (turned_in, sides) in [(false, [6, 0]), (true, [0, 6])] {
        let scene = scene(&[
            block("block", [0.0; 3], [1.0, 2.0, 3.0], turned_in),
            panel("sheet", [3.0, 0.0], 1.0, 0.0, false),
        ]);
        assert_eq!(scene.patches.len(), 14);
        assert_eq!(kept(&scene, "block")[0], sides);
        assert_eq!(kept(&scene, "sheet")[0], [1, 1]);
    }
}

#[test]
fn a_room_with_a_lamp_keeps_both_sides_whichever_way_it_is_turned() {
    for turned_in in [false, true] {
        let lamp = panel("lamp", [1.0, 1.0], 1.0, 2.5, true);
        let scene = scene(&[
            block("room", [0.0; 3], [3.0; 3], turned_in),
            lamp,
            block("table", [1.0, 1.0, 0.0], [2.0, 2.0, 1.0], false),
        ]);
        assert_eq!(kept(&scene, "room")[0], [6, 6]);
        assert_eq!(kept(&scene, "table")[0], [6, 0]);
    }
}

/// A floor that is cut around a table touches it at the edges of its foot: the table stays a body of its own.
#[test]
fn a_body_that_stands_in_a_cut_stays_closed() {
    let floor = panel("floor", [0.0; 2], 3.0, 0.0, false);
    let file = file(&[floor, block("table", [1.0, 1.0, 0.0], [2.0, 2.0, 1.0], false)]);
    let before = needed_sides(&file.scene().unwrap());
    let repaired = repair(&before).scene;
    assert!(area_of(&repaired, "floor") < area_of(&before, "floor"));
    let read = Gltf::from_bytes("repaired.gltf", file.repaired(&before, &repaired).unwrap()).scene().unwrap();
    assert_eq!(kept(&read, "table")[0], [6, 0]);
    assert!(repair(&needed_sides(&read)).repairs.is_empty());
}

fn area_of(scene: &Scene, body: &str) -> f64 {
    let of_body = scene.patches.iter().filter(|patch| patch.name.starts_with(body));
    of_body.map(|patch| patch.polygon.area()).sum()
}

/// COLLADA: what is said of a primitive counts before what is said of its geometry, as repaired files have it.
#[test]
fn a_primitive_says_for_itself_whether_it_has_two_sides() {
    let flag = |value: u8| {
        format!("<extra><technique profile=\"any\"><double_sided>{value}</double_sided></technique></extra>")
    };
    for (of_primitive, of_geometry, sides) in [
        (String::new(), flag(1), 2),
        (flag(0), flag(1), 1),
        (flag(1), flag(0), 2),
        (String::new(), flag(0), 1),
    ] {
        let text = format!(
            r##"<COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 1 0 0 0 1 0</float_array></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>{of_primitive}</triangles></mesh>{of_geometry}</geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"##
        );
        assert_eq!(Collada::from_text("sides.dae", text).scene().unwrap().patches.len(), sides);
    }
}

#[test]
fn an_open_box_keeps_both_sides() {
    let mut open = block("box", [0.0; 3], [1.0; 3], false);
    open.quads.pop();
    assert_eq!(kept(&scene(&[open]), "box")[0], [5, 5]);
}

#[test]
fn a_lamp_shines_away_from_the_wall_behind_it() {
    let room = || block("room", [0.0; 3], [3.0; 3], true);
    let emitting =
        |height: f32| kept(&scene(&[room(), panel("lamp", [1.0, 1.0], 1.0, height, true)]), "lamp")[1];
    // On the ceiling, and a hand's breadth below it; far below it, it has two sides.
    assert_eq!([emitting(3.0), emitting(2.97), emitting(2.0)], [[1, 0], [1, 0], [1, 1]]);
    // Turned the wrong way round its second side is that to the room.
    let mut turned = panel("lamp", [1.0, 1.0], 1.0, 2.97, true);
    turned.quads[0].reverse();
    assert_eq!(kept(&scene(&[room(), turned]), "lamp")[1], [0, 1]);
}

#[test]
fn a_closed_lamp_shines_outwards_unless_somebody_is_in_it() {
    let mut bulb = block("bulb", [0.0; 3], [1.0; 3], false);
    bulb.emits = true;
    let mut scene = scene(&[bulb]);
    assert_eq!(kept(&scene, "bulb"), [[6, 0], [6, 0]]);
    let (direction, up) = (DVec3::X, DVec3::Z);
    let camera = |x: f64| Camera {
        name: "eye".into(),
        position: DVec3::new(x, 0.4, 0.6),
        direction,
        up,
        vertical_fov: 1.0,
        aspect: 1.0,
    };
    scene.cameras = vec![camera(-3.0)];
    assert_eq!(kept(&scene, "bulb")[0], [6, 0]);
    scene.cameras = vec![camera(0.3)];
    assert_eq!(kept(&scene, "bulb")[0], [6, 6]);
}

#[test]
fn one_side_is_that_of_the_file() {
    let scene = scene(&[block("block", [0.0; 3], [1.0; 3], true)]);
    let one = one_sided(&scene);
    assert!(
        one.patches.iter().map(|patch| &patch.name).eq(scene
            .patches
            .iter()
            .step_by(2)
            .map(|patch| &patch.name))
    );
    let middle = DVec3::splat(0.5);
    let turned_in = |patch: &radiosity::Patch| {
        let corner = patch.polygon.loops().next().unwrap()[0];
        patch.polygon.normal().dot(middle - corner) > 0.0
    };
    assert!(one.patches.iter().all(turned_in));
}

/// The two sides of everything, and those that are needed: the same power falls on each patch within the estimates, of half the patches.
/// The table stands on the floor, so the floor of one is cut where that of the other is dark: powers are compared and not means.
#[test]
fn the_light_of_a_room_of_sheets_and_solids_is_that_of_its_two_sides() {
    let lamp = panel("lamp", [1.0, 1.0], 1.0, 2.0, true);
    let room = block("room", [0.0; 3], [3.0; 3], true);
    let all = scene(&[room, lamp, block("table", [0.5, 1.5, 0.0], [1.5, 2.5, 0.75], false)]);
    let needed = needed_sides(&all);
    assert_eq!([all.patches.len(), needed.patches.len()], [26, 20]);
    let light = |scene: &Scene| {
        let scene = repair(scene).scene;
        let solution = solve(&scene, &Quality::Draft.options(), |_| ControlFlow::Continue(())).unwrap();
        let means = solution.patch_means(&solution.irradiance, scene.patches.len());
        let of = |(index, patch): (usize, &radiosity::Patch)| {
            let powers = [means[index][0], solution.patch_estimate(index)[0]];
            (patch.name.clone(), powers.map(|value| value * patch.polygon.area()))
        };
        scene.patches.iter().enumerate().map(of).collect::<Vec<_>>()
    };
    let (all, needed) = (light(&all), light(&needed));
    for (name, [power, estimate]) in &needed {
        let (_, [other, other_estimate]) = all.iter().find(|(other, _)| other == name).unwrap();
        assert!((power - other).abs() <= estimate + other_estimate, "{name}: {power} {other}");
    }
}

/// A rug on a floor, level and tilted, in single precision: the file without overlaps has none, and hardly more bytes.
#[test]
fn a_repaired_gltf_file_has_no_overlaps_left() {
    for tilt in [0.0, 0.3] {
        let place = |x: f32, y: f32| [x, y, tilt * x + 0.7 * tilt * y];
        let sheet = |name, [x0, y0, x1, y1]: [f32; 4]| Mesh {
            name,
            quads: vec![[place(x0, y0), place(x1, y0), place(x1, y1), place(x0, y1)]],
            emits: false,
        };
        let file = file(&[
            sheet("floor", [0.1, 0.1, 3.3, 2.7]),
            sheet("rug", [0.7, 0.9, 1.3, 3.1]),
            sheet("mat", [2.1, 0.3, 2.9, 1.1]),
        ]);
        let before = needed_sides(&file.scene().unwrap());
        let repaired = repair(&before);
        assert!(!repaired.repairs.is_empty());
        let bytes = file.repaired(&before, &repaired.scene).unwrap();
        let read = needed_sides(&Gltf::from_bytes("repaired.gltf", bytes).scene().unwrap());
        assert!(repair(&read).repairs.is_empty(), "{tilt}: {:?}", repair(&read).repairs);
        let area = |scene: &Scene| scene.patches.iter().map(|patch| patch.polygon.area()).sum::<f64>();
        assert!((area(&read) / area(&repaired.scene) - 1.0).abs() < 1e-6);
    }
}
