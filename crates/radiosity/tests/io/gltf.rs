//! glTF files in: what they mean as patches, and what is refused.
use radiosity::glam::DVec3;
use radiosity::io::collada::Collada;
use radiosity::io::gltf::Gltf;
use radiosity::{Scene, scenes};
use serde_json::{Value, json};

/// A file of one buffer: four corners of the unit square, and two triangles of them as 16-bit indices.
fn square() -> Value {
    square_through([0, 1, 2, 0, 2, 3])
}

/// The same, with other indices.
fn square_through(indices: [u16; 6]) -> Value {
    let points = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mut bytes: Vec<u8> = points.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|index| index.to_le_bytes()));
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "square", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{
            "name": "m",
            "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1.0], "metallicFactor": 0.0},
            "emissiveFactor": [1.0, 0.5, 0.0],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4.0}},
        }],
        "extensionsUsed": ["KHR_materials_emissive_strength"],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 48},
            {"buffer": 0, "byteOffset": 48, "byteLength": 12},
        ],
        "buffers": [{"byteLength": 60, "uri": format!("data:application/octet-stream;base64,{}", base64(&bytes))}],
    })
}

fn base64(bytes: &[u8]) -> String {
    let digit = |value: u32| {
        let alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        char::from(alphabet[usize::try_from(value & 63).unwrap()])
    };
    assert_eq!(bytes.len() % 3, 0, "no padding is written");
    let word = |three: &[u8]| three.iter().fold(0_u32, |word, byte| word << 8 | u32::from(*byte));
    bytes.chunks(3).flat_map(|three| [18, 12, 6, 0].map(|shift| digit(word(three) >> shift))).collect()
}

fn read(document: &Value) -> Scene {
    Gltf::from_bytes("test.gltf", document.to_string()).scene().unwrap()
}

fn refusal(document: &Value) -> String {
    Gltf::from_bytes("test.gltf", document.to_string()).scene().unwrap_err().to_string()
}

#[test]
fn two_triangles_are_a_square_with_its_material() {
    let scene = read(&square());
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert_eq!(scene.patches.len(), 1);
    let patch = &scene.patches[0];
    assert_eq!(
        (patch.name.as_str(), patch.polygon.area(), patch.polygon.normal()),
        ("square", 1.0, DVec3::Z)
    );
    assert_eq!(patch.reflectance, [0.25, 0.5, 0.75]);
    assert_eq!(patch.emission, [4.0, 2.0, 0.0]);
    assert_eq!((scene.asset.up, scene.asset.unit), (DVec3::Y, 1.0));
}

#[test]
fn nodes_move_what_hangs_on_them() {
    let mut document = square();
    document["nodes"] = json!([
        {"children": [1], "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1]},
        {"name": "square", "mesh": 0, "scale": [2, 1, 1], "translation": [0, 0, 3]},
    ]);
    let outline = read(&document).patches[0].polygon.loops().next().unwrap().to_vec();
    // Stretched along x, lifted, a quarter turn about z, moved along x.
    let expected = [[5.0, 0.0, 3.0], [5.0, 2.0, 3.0], [4.0, 2.0, 3.0], [4.0, 0.0, 3.0]].map(DVec3::from);
    let first = outline.iter().position(|point| *point == expected[0]).unwrap();
    assert!((0..4).all(|i| outline[(first + i) % 4] == expected[i]), "{outline:?}");
}

#[test]
fn a_mirror_keeps_the_outside_outside() {
    let mut document = square();
    document["nodes"][0]["scale"] = json!([-1, 1, 1]);
    assert_eq!(read(&document).patches[0].polygon.normal(), DVec3::Z);
}

#[test]
fn a_double_sided_material_makes_two_patches() {
    let mut document = square();
    document["materials"][0]["doubleSided"] = json!(true);
    let scene = read(&document);
    let names: Vec<_> = scene.patches.iter().map(|patch| patch.name.as_str()).collect();
    assert_eq!(names, ["square", "square.back"]);
    assert_eq!(scene.patches[1].polygon.normal(), DVec3::NEG_Z);
}

#[test]
fn strips_and_fans_are_triangles_too() {
    for mode in [5, 6] {
        let mut document = square();
        let primitive = &mut document["meshes"][0]["primitives"][0];
        primitive["mode"] = json!(mode);
        primitive.as_object_mut().unwrap().remove("indices");
        let scene = read(&document);
        // As a strip the corners of the square make two triangles that overlap; as a fan they are the square.
        let areas: Vec<f64> = scene.patches.iter().map(|patch| patch.polygon.area()).collect();
        assert_eq!(areas, if mode == 6 { vec![1.0] } else { vec![0.5, 0.5] }, "{mode}");
    }
}

#[test]
fn every_second_triangle_of_a_strip_is_turned() {
    let mut document = square_through([0, 1, 3, 2, 0, 0]);
    document["meshes"][0]["primitives"][0]["mode"] = json!(5);
    document["accessors"][1]["count"] = json!(4);
    let patches = read(&document).patches;
    let faces: Vec<(f64, f64)> = patches.iter().map(|p| (p.polygon.area(), p.polygon.normal().z)).collect();
    assert_eq!(faces, [(1.0, 1.0)]);
}

#[test]
fn what_is_not_read_draws_a_warning() {
    let mut document = square();
    document["materials"][0]["alphaMode"] = json!("BLEND");
    document["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(json!({"attributes": {"POSITION": 0}, "mode": 1}));
    document["cameras"] =
        json!([{"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}}]);
    document["nodes"][0]["camera"] = json!(0);
    let warnings = read(&document).warnings.iter().map(|warning| format!("{warning}\n")).collect::<String>();
    for word in ["transparency", "lines and points have no area", "perspective"] {
        assert!(warnings.contains(word), "{word}: {warnings}");
    }
}

#[test]
fn every_fault_is_named_with_its_part() {
    let change = |path: &str, value: Value| {
        let mut document = square();
        *document.pointer_mut(path).expect(path) = value;
        refusal(&document)
    };
    let cases = [
        (change("/asset/version", json!("1.0")), "glTF 1.0"),
        (change("/asset/version", json!("3.0")), "asset"),
        (change("/accessors/1/count", json!(7)), "buffer view 1"),
        (change("/accessors/0/count", json!(1_u64 << 40)), "buffer view 0"),
        (change("/accessors/0/count", json!(3)), "mesh 0, primitive 0"),
        (change("/accessors/0/type", json!("VEC2")), "accessor 0"),
        (change("/bufferViews/1/byteOffset", json!(4_294_967_295_u64)), "buffer view 1"),
        (change("/buffers/0/uri", json!("data:;base64,AAAA")), "buffer 0"),
        (change("/buffers/0/uri", json!("missing.bin")), "buffer 0"),
        (change("/nodes/0/mesh", json!(9)), "nodes[0].mesh"),
    ];
    for (message, part) in cases {
        assert!(message.starts_with("test.gltf: ") && message.contains(part), "{message}");
    }
}

#[test]
fn what_no_light_depends_on_may_be_missing() {
    let expected = read(&square());
    let same = |change: &dyn Fn(&mut Value)| {
        let mut document = square();
        change(&mut document);
        let scene = read(&document);
        assert_eq!((scene.patches.len(), scene.patches[0].polygon.area()), (1, 1.0), "{document}");
        assert_eq!(scene.patches[0].reflectance, expected.patches[0].reflectance);
        scene.warnings.iter().map(|warning| warning.what.clone()).collect::<Vec<_>>()
    };
    let remove = |document: &mut Value, key: &str| document.as_object_mut().unwrap().remove(key).map(|_| ());
    for key in ["scene", "scenes"] {
        assert_eq!(same(&|document| remove(document, key).unwrap()), Vec::<String>::new());
    }
    for key in ["min", "max"] {
        assert_eq!(
            same(&|document| remove(&mut document["accessors"][0], key).unwrap()),
            Vec::<String>::new()
        );
    }
    let cameras = [json!(null), json!([]), json!([{"type": "perspective"}]), json!([{"type": "fisheye"}])];
    for cameras in cameras {
        let what = same(&|document| {
            document["cameras"] = cameras.clone();
            document["nodes"][0]["camera"] = json!(0);
            if cameras.is_null() {
                remove(document, "cameras").unwrap();
            }
        });
        assert!(what.len() == 1 && what[0].contains("camera"), "{what:?}");
    }
    let empty = [json!({"attributes": {}}), json!({"attributes": {"NORMAL": 0}})];
    for primitive in empty {
        let what = same(&|document| {
            document["meshes"][0]["primitives"].as_array_mut().unwrap().push(primitive.clone())
        });
        assert!(what.len() == 1 && what[0].contains("without positions"), "{what:?}");
    }
    let nothing = json!({"bufferView": 1, "componentType": 5123, "count": 0, "type": "SCALAR"});
    same(&|document| {
        document["accessors"].as_array_mut().unwrap().push(nothing.clone());
        let primitive = json!({"attributes": {"POSITION": 0}, "indices": 2});
        document["meshes"][0]["primitives"].as_array_mut().unwrap().push(primitive);
    });
}

#[test]
fn a_required_extension_is_refused_by_name_unless_it_is_of_materials() {
    let needing = |extension: &str| {
        let mut document = square();
        document["extensionsUsed"] = json!([extension]);
        document["extensionsRequired"] = json!([extension]);
        document
    };
    for extension in
        ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing", "NO_such_thing"]
    {
        let message = refusal(&needing(extension));
        assert!(message.contains(extension) && message.contains("is not read; export"), "{message}");
    }
    for extension in
        ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials_transmission", "KHR_texture_basisu"]
    {
        assert_eq!(read(&needing(extension)).patches.len(), 1);
    }
    let noted = read(&needing("KHR_materials_transmission"));
    assert!(noted.warnings[0].what.contains("KHR_materials_transmission"), "{:?}", noted.warnings);
}

/// Single precision holds no 0.8; the document does.
#[test]
fn numbers_of_the_document_keep_their_digits() {
    let mut document = square();
    document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.8, 0.1, 0.7, 1.0]);
    document["nodes"][0]["translation"] = json!([0.1, 0.2, 0.3]);
    let scene = read(&document);
    assert_eq!(scene.patches[0].reflectance, [0.8, 0.1, 0.7]);
    assert_eq!(scene.extent()[0], DVec3::new(0.1, 0.2, 0.3));
}

#[test]
fn a_node_that_contains_itself_is_refused() {
    let mut document = square();
    document["nodes"][0]["children"] = json!([0]);
    assert!(refusal(&document).contains("node 0"));
}

#[test]
fn damaged_files_are_refused_or_read_but_never_worse() {
    let text = square().to_string();
    let step = 7;
    for cut in (0..text.len()).step_by(step) {
        let _ = Gltf::from_bytes("cut.gltf", &text.as_bytes()[..cut]).scene();
        let mut bytes = text.clone().into_bytes();
        bytes[cut] = b'9';
        let _ = Gltf::from_bytes("changed.gltf", bytes).scene();
    }
}

#[test]
fn a_damaged_container_is_refused() {
    let document = square().to_string().into_bytes();
    let length = |bytes: usize| u32::try_from(bytes).unwrap().to_le_bytes();
    let whole = |version: u32, document_length: usize, kind: &[u8]| {
        let total = length(20 + document.len());
        let parts = [b"glTF", &version.to_le_bytes()[..], &total, &length(document_length), kind, &document];
        Gltf::from_bytes("box.glb", parts.concat())
    };
    assert!(whole(2, document.len(), b"JSON").scene().is_ok());
    for damaged in [
        whole(1, document.len(), b"JSON"),
        whole(2, document.len() + 1, b"JSON"),
        whole(2, document.len(), b"BIN\0"),
    ] {
        assert!(damaged.scene().unwrap_err().to_string().starts_with("box.glb: "));
    }
    // A header that is all there is, and that claims less than itself.
    for length in 4..20 {
        let bytes = [&b"glTF\x02\0\0\0\x01\0\0\0\0\0\0\0JSON"[..length]].concat();
        assert!(Gltf::from_bytes("box.glb", bytes).scene().is_err());
    }
}

/// A scene written as a lit GLB of its patches' outlines, then read.
#[test]
fn a_written_file_has_the_same_areas() {
    let before = scenes::scene("cornell-box").unwrap();
    let solution =
        radiosity::solve(&before, &radiosity::Options::default(), |_| std::ops::ControlFlow::Continue(()))
            .unwrap();
    let record = radiosity::Record::new("box", &before, &solution);
    let bytes = radiosity::io::gltf::glb(&record, record.exposure()).unwrap();
    let after = Gltf::from_bytes("box.glb", bytes).scene().unwrap();
    // Its light stands in colours at the vertices, which are no reflectance.
    assert!(
        after.warnings.iter().all(|warning| warning.what.contains("vertex colours")),
        "{:?}",
        after.warnings
    );
    let area = |scene: &Scene| scene.patches.iter().map(|patch| patch.polygon.area()).sum::<f64>();
    // Millimetres there, metres here, single precision in between.
    assert!((area(&after) * 1e6 / area(&before) - 1.0).abs() < 1e-6);
    assert!(after.cameras[0].position.distance(before.cameras[0].position * 1e-3) < 1e-6);
}

/// A name of any characters is written into COLLADA and comes back; where XML has no character, another one stands.
#[test]
fn names_of_any_unicode_survive() {
    for (name, expected) in [
        ("déjà vu 漢字 🦀 \u{202e}ylf\u{200b}", "déjà vu 漢字 🦀 \u{202e}ylf\u{200b}"),
        ("a\tb\nc\rd", "a\tb\nc\rd"),
        ("<node name=\"n\">&amp;]]>", "<node name=\"n\">&amp;]]>"),
        ("bell\u{7} and \u{ffff}", "bell\u{fffd} and \u{fffd}"),
        (" \n", "node-0"),
        ("../../etc/passwd", "../../etc/passwd"),
    ] {
        let mut document = square();
        document["nodes"][0]["name"] = name.into();
        let before = read(&document);
        let after = Collada::of(&before).scene().unwrap();
        assert_eq!(after.patches[0].name, expected);
        assert_eq!(after.patches[0].reflectance, before.patches[0].reflectance);
    }
}

/// Zeros that no buffer holds: as many as the file has bytes.
#[test]
fn rows_without_data_are_bounded_by_the_file() {
    let mut document = square();
    document["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let indices = json!({"bufferView": 1, "componentType": 5123});
    document["accessors"][0]["sparse"] = json!({"count": 1, "indices": indices, "values": {"bufferView": 0}});
    assert_eq!(read(&document).patches.len(), 0, "all corners lie in one point");
    for count in [1 << 24, u32::MAX] {
        document["accessors"][0]["count"] = count.into();
        let message = refusal(&document);
        assert!(message.contains("accessor 0") && message.contains("60 rows without data"), "{message}");
    }
}

/// Zeros, by the standard; the other rows are those of a sparse accessor.
#[test]
fn an_accessor_without_a_view_is_zeros() {
    let mut document = square();
    document["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({"componentType": 5126, "count": 4, "type": "VEC3"}));
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(2);
    assert_eq!(read(&document).patches.len(), 1);
    document["accessors"][0] = json!({
        "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0],
        "sparse": {"count": 3, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}},
    });
    // The second to fourth of the indices, and of the corners.
    let views = document["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": 50, "byteLength": 6}));
    views.push(json!({"buffer": 0, "byteOffset": 12, "byteLength": 36}));
    let sparse = read(&document);
    assert!(sparse.patches.iter().any(|patch| patch.polygon.loops().flatten().any(|p| *p == DVec3::ZERO)));
}

#[test]
fn a_file_that_needs_a_later_version_is_refused_in_a_line() {
    let mut document = square();
    document["asset"]["minVersion"] = json!("2.0");
    assert_eq!(read(&document).patches.len(), 1);
    for version in ["2.1", "3.0", "?"] {
        document["asset"]["minVersion"] = json!(version);
        let refused = refusal(&document);
        assert!(
            refused.starts_with(&format!("test.gltf: glTF {version}, the least (minVersion)")),
            "{refused}"
        );
        assert_eq!(refused.lines().count(), 1);
    }
}

/// A file and its buffer in one folder, repaired into another one.
#[test]
fn what_a_file_names_goes_with_it_to_another_folder() {
    use radiosity::io::Source;
    let folder = tempfile::tempdir().unwrap();
    let mut document = square();
    let address = document["buffers"][0]["uri"].as_str().unwrap().to_owned();
    let bytes = base64_decoded(address.split_once(',').unwrap().1);
    document["buffers"][0]["uri"] = json!("a b.bin");
    std::fs::write(folder.path().join("a b.bin"), bytes).unwrap();
    let path = folder.path().join("a.gltf");
    std::fs::write(&path, document.to_string()).unwrap();
    std::fs::create_dir(folder.path().join("other")).unwrap();
    let source = Source::open(&path).unwrap();
    let scene = source.scene().unwrap();
    for (target, is_inside) in [("b.gltf", false), ("other/a.gltf", true)] {
        let target = folder.path().join(target);
        source.save_repaired([&scene, &scene], &|scene| scene.clone(), &target).unwrap();
        let text = std::fs::read_to_string(&target).unwrap();
        assert_eq!(text.contains("data:"), is_inside, "{text}");
        assert_eq!(Source::open(&target).unwrap().scene().unwrap().patches.len(), 1);
    }
}

fn base64_decoded(text: &str) -> Vec<u8> {
    use ::base64::{Engine, engine::general_purpose::STANDARD};
    STANDARD.decode(text).unwrap()
}

/// A picture over the square, twice as wide or within its rim.
#[test]
fn a_picture_that_is_clamped_is_noted_where_that_matters() {
    use ::base64::{Engine, engine::general_purpose::STANDARD};
    let picture = scenes::scene("chessboard").unwrap().patches[0].texture.clone().unwrap().image;
    let mut document = square();
    document["bufferViews"]
        .as_array_mut()
        .unwrap()
        .push(json!({"buffer": 0, "byteOffset": 0, "byteLength": 48, "byteStride": 12}));
    let places = json!({"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"});
    document["accessors"].as_array_mut().unwrap().push(places);
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    document["images"] =
        json!([{"uri": format!("data:image/png;base64,{}", STANDARD.encode(&picture.bytes))}]);
    document["textures"] = json!([{"source": 0, "sampler": 0}]);
    for (mode, scale, is_noted) in
        [(10497, 2.0, false), (33071, 2.0, true), (33648, 2.0, true), (33071, 1.0, false)]
    {
        document["samplers"] = json!([{"wrapS": mode, "wrapT": 10497}]);
        document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({
            "index": 0, "extensions": {"KHR_texture_transform": {"scale": [scale, 1]}},
        });
        let scene = read(&document);
        assert!(scene.patches[0].texture.is_some());
        let noted = scene.warnings.iter().any(|note| note.what.contains("sampler clamps or mirrors"));
        assert_eq!(noted, is_noted, "{mode} {scale}: {:?}", scene.warnings);
    }
}
