//! The binary glTF: its layout, and what a viewer finds in it.
use crate::samples::{file, node, record, scene};
use radiosity::expose::Exposure;
use radiosity::io::gltf::{Gltf, glb};
use radiosity::{Camera, Mesh, Scene};
use serde_json::Value;

struct Parts {
    document: Value,
    binary: Vec<u8>,
}

fn word(bytes: &[u8], at: usize) -> usize {
    usize::try_from(u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())).unwrap()
}

/// Takes a file apart along its lengths.
fn parts(bytes: &[u8]) -> Parts {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(bytes, 4), word(bytes, 8)), (2, bytes.len()));
    let json = word(bytes, 12);
    assert_eq!((&bytes[16..20], json % 4), (b"JSON".as_slice(), 0));
    let document = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    let Some(rest) = bytes.get(20 + json..).filter(|rest| !rest.is_empty()) else {
        return Parts { document, binary: Vec::new() };
    };
    assert_eq!((&rest[4..8], word(rest, 0)), (b"BIN\0".as_slice(), rest.len() - 8));
    Parts { document, binary: rest[8..].to_vec() }
}

impl Parts {
    /// The rows of a vector accessor.
    fn vectors(&self, name: &str) -> Vec<[f32; 3]> {
        let index = &self.document["meshes"][0]["primitives"][0]["attributes"][name];
        let accessor = &self.document["accessors"][usize::try_from(index.as_u64().unwrap()).unwrap()];
        let view =
            &self.document["bufferViews"][usize::try_from(accessor["bufferView"].as_u64().unwrap()).unwrap()];
        let number = |name: &str| usize::try_from(view[name].as_u64().unwrap()).unwrap();
        let bytes = &self.binary[number("byteOffset")..number("byteOffset") + number("byteLength")];
        let floats: Vec<f32> =
            bytes.chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect();
        let rows: Vec<[f32; 3]> = floats.chunks(3).map(|row| row.try_into().unwrap()).collect();
        assert_eq!(accessor["count"], rows.len());
        let bound = |name: &str| -> [f32; 3] { serde_json::from_value(accessor[name].clone()).unwrap() };
        for axis in 0..3 {
            let column = rows.iter().map(|row| row[axis]);
            assert_eq!(bound("min")[axis], column.clone().fold(f32::MAX, f32::min));
            assert_eq!(bound("max")[axis], column.fold(f32::MIN, f32::max));
        }
        rows
    }
}

fn written(text: &str, radiosity: f64) -> (Scene, Mesh, Parts) {
    let scene = scene(text);
    let record = record(&scene, [radiosity, 0.0, 2.0 * radiosity]);
    let bytes = glb(&record, Exposure::new(1.0).unwrap()).unwrap();
    let mesh = record.mesh();
    (scene, mesh, parts(&bytes))
}

#[test]
fn positions_and_light_come_back() {
    let text = file("", &node("n", "<translate>100 0 0</translate>", "square"));
    let (_, mesh, parts) = written(&text, 0.5);
    let middle = parts.document["nodes"][1]["translation"][0].as_f64().unwrap();
    let xs = parts.vectors("POSITION").into_iter().map(|row| f64::from(row[0]) + middle);
    assert!(xs.zip(&mesh.vertices).all(|(x, vertex)| x == vertex.x));
    assert!(parts.vectors("_RADIOSITY").iter().all(|row| *row == [0.5, 0.0, 1.0]));
    let [red, green, blue] = parts.vectors("COLOR_0")[0];
    assert!((f64::from(blue) - (1.0 - (-1.0_f64).exp())).abs() < 1e-7);
    assert!((f64::from(red) - f64::from(blue) / 2.0).abs() < 1e-7, "colours keep their shares");
    assert_eq!(green, 0.0);
}

#[test]
fn z_up_in_inches_becomes_y_up_in_metres() {
    let (_, _, parts) = written(&file("", &node("n", "", "square")), 1.0);
    let matrix: Vec<f64> = serde_json::from_value(parts.document["nodes"][0]["matrix"].clone()).unwrap();
    // Columns: x stays, y goes to −z, z goes to y.
    assert_eq!(matrix[..3], [0.0254, 0.0, 0.0]);
    assert_eq!(matrix[4..7], [0.0, 0.0, -0.0254]);
    assert_eq!(matrix[8..11], [0.0, 0.0254, 0.0]);
}

#[test]
fn light_beyond_single_precision_stays_finite() {
    let (_, _, parts) = written(&file("", &node("n", "", "square")), 1e300);
    assert!(parts.vectors("_RADIOSITY").iter().flatten().all(|number| number.is_finite()));
    assert_eq!(parts.vectors("COLOR_0")[0], [0.5, 0.0, 1.0]);
}

/// In single precision 1000000.01 is 1000000 and 1000000.06 is 1000000.0625, of which readers of digits take the digits that it needs.
#[test]
fn a_small_thing_far_away_keeps_its_shape_and_place() {
    for place in [1_000_000.01, 1_000_000.06, -16_777.3, 333.112] {
        let node =
            node("n", &format!("<translate>{place} 0 0</translate><scale>0.006 0.006 1</scale>"), "square");
        let scene = scene(&file("", &node).replace("0.0254", "1"));
        let bytes = glb(&record(&scene, [1.0; 3]), Exposure::new(1.0).unwrap()).unwrap();
        let again = Gltf::from_bytes("far.glb", bytes).scene().unwrap();
        let relative = again.patches[0].polygon.area() / (0.006 * 0.006) - 1.0;
        assert!(relative.abs() < 1e-5, "{relative}");
        let [x, wanted] = [&again, &scene].map(|scene| scene.extent()[0].x);
        assert!((x - wanted).abs() < 1e-7, "{x} {wanted}");
    }
}

#[test]
fn what_single_precision_cannot_hold_is_still_a_file() {
    let huge = "<scale>1e200 1e200 1</scale>";
    let camera = Camera {
        name: "far".into(),
        position: [0.0, 0.0, 1e200].into(),
        direction: [0.0, 0.0, -1.0].into(),
        up: [0.0, 1.0, 0.0].into(),
        vertical_fov: 1.0,
        aspect: 1.0,
    };
    let mut scene = scene(&file("", &node("n", huge, "square")));
    scene.cameras.push(camera);
    for unit in [1e-300, 1.0, 1e300] {
        scene.asset.unit = unit;
        let bytes = glb(&record(&scene, [1.0; 3]), Exposure::new(1.0).unwrap()).unwrap();
        let again = Gltf::from_bytes("far.glb", bytes).scene().unwrap();
        assert_eq!(again.cameras.len(), 1, "with the unit {unit}");
    }
}

#[test]
fn a_scene_without_patches_is_still_a_file() {
    let (_, _, parts) = written(&file("", ""), 1.0);
    assert!(parts.document.get("meshes").is_none() && parts.binary.is_empty());
}

/// A triangle that is thinner than single precision tells has no area in the file, and what has none is left out.
#[test]
fn a_scene_of_which_nothing_is_left_is_still_a_file() {
    let scene = scene(&file("", &node("n", "", "square")));
    let mut record = record(&scene, [1.0; 3]);
    record.vertices.iter_mut().for_each(|vertex| vertex.x *= 1e-60);
    let bytes = glb(&record, Exposure::new(1.0).unwrap()).unwrap();
    let parts = parts(&bytes);
    assert!(parts.document.get("meshes").is_none() && parts.binary.is_empty());
    assert!(Gltf::from_bytes("nothing.glb", bytes).scene().unwrap().patches.is_empty());
}

#[test]
fn a_textured_patch_shows_its_picture_under_what_falls_on_it() {
    let scene = radiosity::scenes::scene("chessboard").unwrap();
    let options = radiosity::Options { max_shots: 3, ..radiosity::Options::mesh(300) };
    let solution = radiosity::solve(&scene, &options, |_| std::ops::ControlFlow::Continue(())).unwrap();
    let record = radiosity::Record::new("chessboard", &scene, &solution);
    record.check().unwrap();
    let document = parts(&glb(&record, record.exposure()).unwrap()).document;
    let primitives = document["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 2);
    assert!(primitives[0]["attributes"]["TEXCOORD_0"].is_null());
    assert!(!primitives[1]["attributes"]["TEXCOORD_0"].is_null());
    // In a picture too: of the eight fields along the front edge every second one is much darker.
    let camera = Camera {
        name: "above".into(),
        position: [0.0, -1.75, 10.0].into(),
        direction: [0.0, 0.0, -1.0].into(),
        up: [0.0, 1.0, 0.0].into(),
        vertical_fov: 2.0 * 0.025_f64.atan(),
        aspect: 8.0,
    };
    let file = record.draw(&camera, Exposure::new(0.2).unwrap(), 64);
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut pixels).unwrap();
    let field = |i: usize| u32::from(pixels[3 * (4 * 64 + 8 * i + 4)]);
    for i in 0..7 {
        let (dark, light) = if i % 2 == 0 { (field(i), field(i + 1)) } else { (field(i + 1), field(i)) };
        assert!(2 * dark < light, "field {i}: {dark} {light}");
    }
    assert_eq!(document["images"][0]["mimeType"], "image/png");
    assert!(document["images"][0]["bufferView"].is_u64());
    // And it reads back as a textured scene.
    let bytes = glb(&record, record.exposure()).unwrap();
    let again = radiosity::io::gltf::Gltf::from_bytes("chessboard.glb", bytes).scene().unwrap();
    let texture = again.patches.iter().find_map(|patch| patch.texture.as_ref()).unwrap();
    assert_eq!(texture.image.bytes, scene.patches[0].texture.as_ref().unwrap().image.bytes);
}

/// Needs node and its package `gltf-validator` (`npm install gltf-validator`, NODE_PATH set); without them the test says so
/// and checks nothing.
#[test]
fn the_validator_has_nothing_to_say() {
    let node = |script: &str, file: &str| {
        std::process::Command::new("node")
            .args(["-e", script, file])
            .output()
            .ok()
            .filter(|o| o.status.success())
    };
    if node("require('gltf-validator')", "").is_none() {
        eprintln!("no gltf-validator: the files were not checked");
        return;
    }
    let script = "require('gltf-validator').validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))\
                  .then(report => console.log(JSON.stringify(report.issues)))";
    let folder = tempfile::tempdir().unwrap();
    for name in ["cornell-box", "chessboard"] {
        let scene = radiosity::scenes::scene(name).unwrap();
        let options = radiosity::Options { max_shots: 3, ..radiosity::Options::mesh(300) };
        let solution = radiosity::solve(&scene, &options, |_| std::ops::ControlFlow::Continue(())).unwrap();
        let record = radiosity::Record::new(name, &scene, &solution);
        let path = folder.path().join("light.glb");
        std::fs::write(&path, glb(&record, record.exposure()).unwrap()).unwrap();
        let output = node(script, path.to_str().unwrap()).expect("the validator ends");
        let issues: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(
            (&issues["numErrors"], &issues["numWarnings"]),
            (&0.into(), &0.into()),
            "{name}: {issues}"
        );
    }
}
