//! What all formats have in common: files told apart, scenes written and read, bytes of no meaning refused.
use crate::samples::{fans, file, node};
use radiosity::io::{FileError, Source, save_scene};
use radiosity::{Scene, scenes};

fn area(scene: &Scene) -> f64 {
    scene.patches.iter().map(|patch| patch.polygon.area()).sum()
}

/// Scenes with holes, emitters, pictures of none, spectra and millimetres.
#[test]
fn built_in_scenes_survive_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["cornell-box", "perforated", "small-occluders", "cornell-76", "sphere-lamp"] {
        let scene = scenes::scene(name).unwrap();
        for format in ["dae", "glb", "obj", "ply", "stl"] {
            let path = folder.path().join(format!("{name}.{format}"));
            let left_out = save_scene(&scene, &path).unwrap();
            let again = Source::open(&path).unwrap().scene().unwrap();
            let unit = if format == "glb" { scene.asset.unit } else { 1.0 };
            let share = area(&again) / (unit * unit * area(&scene));
            assert!((share - 1.0).abs() < 1e-5, "{name}.{format}: {share}");
            if matches!(format, "dae" | "glb") {
                assert_eq!(again.cameras.len(), scene.cameras.len());
            }
            if scene.bands == 3 && matches!(format, "dae" | "glb" | "obj") {
                same_surfaces(&scene, &again, &format!("{name}.{format}"));
            }
            assert_eq!(
                left_out.is_empty(),
                matches!(format, "dae") || (format == "glb" && scene.bands == 3),
                "{left_out:?}"
            );
        }
    }
}

/// The same patches in the same order, up to the triangles of those with holes.
fn same_surfaces(before: &Scene, after: &Scene, file: &str) {
    if before.patches.iter().all(|patch| patch.polygon.loops().count() == 1) {
        assert_eq!(before.patches.len(), after.patches.len(), "{file}");
        for (a, b) in before.patches.iter().zip(&after.patches) {
            assert_eq!(a.name, b.name, "{file}");
            let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-6 * a.abs());
            assert!(
                near(&a.reflectance, &b.reflectance) && near(&a.emission, &b.emission),
                "{file}: {a:?} {b:?}"
            );
        }
    }
    let emitted = |scene: &Scene| scene.patches.iter().filter(|patch| patch.emits()).count();
    assert!(emitted(after) >= emitted(before), "{file}");
}

#[test]
fn a_kind_that_no_scene_is_written_in_is_refused() {
    let scene = scenes::scene("cube").unwrap();
    let folder = tempfile::tempdir().unwrap();
    let refused = save_scene(&scene, folder.path().join("cube.fbx")).unwrap_err();
    assert!(
        matches!(refused, FileError::UnknownOutput { .. }) && refused.to_string().contains(".glb"),
        "{refused}"
    );
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn what_the_bytes_say_counts_before_the_name() {
    let text = scenes::write_scene("cube").unwrap();
    for name in ["cube.dae", "cube.obj", "cube", "standard input"] {
        let scene = Source::from_bytes(name, text.as_bytes()).unwrap().scene().unwrap();
        assert_eq!(scene.patches.len(), scenes::scene("cube").unwrap().patches.len());
    }
}

/// A generator of bytes.
fn noise(seed: u64, count: usize) -> Vec<u8> {
    let mut state = seed | 1;
    let next = |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state.to_le_bytes()[3]
    };
    (0..count).map(next).collect()
}

#[test]
fn bytes_of_no_meaning_are_refused_in_one_line_that_names_the_file() {
    for end in ["dae", "gltf", "glb", "obj", "ply", "stl", "none"] {
        for (seed, count) in [(3, 0), (5, 1), (7, 83), (11, 1000), (13, 5000)] {
            let name = format!("noise.{end}");
            let read =
                Source::from_bytes(name.as_str(), noise(seed, count)).and_then(|source| source.scene());
            let message = read.unwrap_err().to_string();
            assert!(message.starts_with(&name) && message.lines().count() == 1, "{count} bytes: {message}");
        }
    }
}

#[test]
fn utf_16_is_the_same_scene_and_is_written_in_utf_8() {
    let text = file("", &node("wände", "", "square")).replace("encoding=\"utf-8\"", "encoding=\"UTF-16\"");
    let bytes: Vec<u8> = [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let source = Source::from_bytes("wide.dae", bytes).unwrap();
    let scene = source.scene().unwrap();
    assert_eq!(scene.patches[0].name, "wände");
    let mesh = fans(&scene);
    let colours = vec![[0.5; 3]; mesh.vertices.len()];
    let lit = source.with_light(&scene, &mesh, &colours).unwrap();
    assert!(lit.starts_with("<?xml version=\"1.0\" encoding=\"utf-8\"?>"), "{}", &lit[..60]);
    assert!(Source::from_bytes("lit.dae", lit).unwrap().scene().is_ok());
}

/// Empty primitives, cameras that do not exist or have no view, and attributes that may be left out.
#[test]
fn collada_without_what_no_light_depends_on_is_read() {
    let good = file("", &node("n", "", "square"));
    let read = |text: String| Source::from_bytes("test.dae", text).unwrap().scene().unwrap();
    let camera = |optics: &str| {
        format!(
            "<library_cameras><camera id=\"c\">{optics}</camera></library_cameras><library_visual_scenes>"
        )
    };
    let look = "<node><instance_camera url=\"#c\"/></node></visual_scene>";
    for (from, to, warnings) in [
        (
            "<polylist material=\"m\" count=\"1\">",
            "<triangles count=\"0\"/><polylist count=\"0\"><p/></polylist><polylist material=\"m\">",
            0,
        ),
        (
            "<polylist material=\"m\" count=\"1\">",
            "<tristrips count=\"0\"><input semantic=\"VERTEX\" source=\"#square-v\" offset=\"0\"/></tristrips><polylist material=\"m\">",
            0,
        ),
        ("<asset><unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis></asset>", "", 0),
        (" id=\"n\" name=\"n\"", "", 0),
        (" count=\"4\" stride=\"3\"", "", 0),
        ("offset=\"0\"/>", "offset=\"0\"/><input semantic=\"NORMAL\" source=\"#none\" offset=\"0\"/>", 0),
        ("offset=\"0\"/>", "offset=\"0\"/><input semantic=\"NORMAL\" source=\"#square-p\" offset=\"0\"/>", 0),
        ("</visual_scene>", look, 1),
    ] {
        assert!(good.contains(from), "{from}");
        let scene = read(good.replace(from, to));
        assert_eq!((scene.patches.len(), scene.patches[0].polygon.area()), (1, 1.0), "{to}");
        assert_eq!(scene.warnings.len(), warnings, "{to}: {:?}", scene.warnings);
    }
    for optics in [
        "",
        "<optics/>",
        "<optics><technique_common><perspective><yfov>0</yfov></perspective></technique_common></optics>",
    ] {
        let text = good.replace("</visual_scene>", look).replace("<library_visual_scenes>", &camera(optics));
        let scene = read(text);
        assert_eq!((scene.patches.len(), scene.cameras.len(), scene.warnings.len()), (1, 0, 1), "{optics}");
    }
}

/// A square on the ground, whatever axis points up, is on the ground when it is read again, and faces up.
#[test]
fn up_stays_up_in_every_format() {
    use radiosity::glam::DVec3;
    use radiosity::{Patch, formfactor::PlanarPolygon};
    let folder = tempfile::tempdir().unwrap();
    for up in [DVec3::X, DVec3::Y, DVec3::Z] {
        let [u, v] = [DVec3::new(up.z, up.x, up.y), DVec3::new(up.y, up.z, up.x)];
        let base = 0.1 * up;
        let square = PlanarPolygon::new([[base, base + u, base + u + v, base + v]]).unwrap();
        assert_eq!(square.normal(), up);
        let patches = vec![Patch::new("ground", square, vec![0.5; 3], vec![0.0; 3])];
        let mut scene = Scene { patches, bands: 3, ..Scene::default() };
        scene.asset.up = up;
        for format in ["dae", "glb", "obj", "ply", "stl"] {
            let path = folder.path().join(format!("up.{format}"));
            let left_out = save_scene(&scene, &path).unwrap();
            assert!(!left_out.iter().any(|what| what.contains("up")), "{left_out:?}");
            let again = Source::open(&path).unwrap().scene().unwrap();
            let (polygon, up) = (&again.patches[0].polygon, again.asset.up);
            assert!(polygon.normal().distance(up) < 1e-6, "{format}: {} is not {up}", polygon.normal());
            assert!(polygon.loops().flatten().all(|point| (point.dot(up) - 0.1).abs() < 1e-6), "{format}");
        }
    }
}
