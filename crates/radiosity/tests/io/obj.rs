//! OBJ and MTL files in: what they mean as patches, and what is refused.
use radiosity::Scene;
use radiosity::glam::DVec3;
use radiosity::io::obj::Obj;
use std::path::Path;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(text: &str) -> Scene {
    Obj::from_bytes("test.obj", text).unwrap().scene().unwrap()
}

fn refusal(text: &str) -> String {
    Obj::from_bytes("test.obj", text).and_then(|obj| obj.scene()).unwrap_err().to_string()
}

/// A folder with an OBJ file and a file of materials.
fn with_materials(mtl: &str, obj: &str) -> (tempfile::TempDir, Result<Scene, String>) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.mtl"), mtl).unwrap();
    std::fs::write(folder.path().join("a.obj"), obj).unwrap();
    let scene = Obj::open(folder.path().join("a.obj")).and_then(|obj| obj.scene());
    (folder, scene.map_err(|error| error.to_string()))
}

fn is_square(scene: &Scene) {
    assert_eq!(scene.patches.len(), 1);
    let polygon = &scene.patches[0].polygon;
    assert_eq!((polygon.area(), polygon.normal()), (1.0, DVec3::Z));
}

#[test]
fn a_face_may_be_written_in_many_ways() {
    for face in [
        "f 1 2 3 4",
        "f -4 -3 -2 -1",
        "f 1/1 2/1 3/1 4/1",
        "f 1//1 2//1 3//1 4//1",
        "f 1/1/1 2/1/1 3/1/1 4/1/1 # a square",
        "f 1 2 \\\n 3 4",
        "f 1 2 3\nf 1 3 4",
        "fo 1 2 3 4",
    ] {
        is_square(&read(&format!("{SQUARE}vt 0 0\nvn 0 0 1\n{face}\n")));
    }
    is_square(&read(
        &format!("\u{feff}# Büro\r\n{}\r\nf 1 2 3 4\r\n", SQUARE.replace('\n', "\r\n"))
            .replace('\u{feff}', ""),
    ));
}

#[test]
fn objects_and_groups_are_names() {
    let scene = read(&format!("{SQUARE}o left half\nf 1 2 3\ng right#2\nf 1 3 4\no left half\nf 4 3 1\n"));
    let names: Vec<&str> = scene.patches.iter().map(|patch| patch.name.as_str()).collect();
    assert_eq!(names, ["left half.1", "left half.2", "right#2"]);
}

#[test]
fn materials_are_kd_and_ke() {
    let mtl = "newmtl a b\nKd 0.25 0.5 0.75\nKe 4 2 1\nnewmtl grey\nKd 0.3\n";
    let (_folder, scene) =
        with_materials(mtl, &format!("mtllib a.mtl\n{SQUARE}usemtl a b\nf 1 2 3\nusemtl grey\nf 1 3 4\n"));
    let scene = scene.unwrap();
    assert_eq!(
        (&scene.patches[0].reflectance[..], &scene.patches[0].emission[..]),
        (&[0.25, 0.5, 0.75][..], &[4.0, 2.0, 1.0][..])
    );
    assert_eq!(scene.patches[1].reflectance, [0.3; 3]);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

/// Two texels beside each other; the face shows the right one only.
#[test]
fn pictures_are_scaled_and_moved() {
    let (folder, scene) = with_materials(
        "newmtl m\nKd 1 1 1\nmap_Kd -s 0.25 1 1 -o 0.5 0 -blendu off two texels.png\n",
        &format!("mtllib a.mtl\n{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n"),
    );
    assert!(scene.unwrap().warnings[0].what.contains("texture"), "there is no picture yet");
    let path = folder.path().join("two texels.png");
    let pixels: image::RgbImage =
        image::ImageBuffer::from_fn(2, 1, |x, _| image::Rgb([if x == 1 { 255 } else { 0 }; 3]));
    pixels.save(&path).unwrap();
    let scene = Obj::open(folder.path().join("a.obj")).unwrap().scene().unwrap();
    assert_eq!(scene.patches[0].reflectance, [1.0; 3]);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn what_is_not_read_is_counted() {
    let text = format!(
        "mtllib none.mtl\n{SQUARE}v 0 0 1 1 0 0\nf 1 2 3 4\nl 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nnonsense 3\nvn nan nan nan\n"
    );
    let scene = read(&text);
    is_square(&scene);
    let all: Vec<(&str, usize)> =
        scene.warnings.iter().map(|warning| (warning.what.as_str(), warning.places.len())).collect();
    for (words, count) in [
        ("file of materials", 1),
        ("vertex colours", 1),
        ("lines and points", 3),
        ("free-form", 1),
        ("not OBJ's", 1),
        ("without a material", 1),
        ("normals that cannot be read", 1),
    ] {
        assert!(all.iter().any(|(what, found)| what.contains(words) && *found == count), "{words}: {all:?}");
    }
}

#[test]
fn every_fault_is_named_with_its_line() {
    for (statement, expected) in [
        ("f 1 2 5", "index 5 is out of range: there are 4"),
        ("f 1 2 0", "index 0 is out of range"),
        ("f 1 2 -5", "index -5 is out of range: there are 4"),
        ("f 1 2 99999999999999999999", "\"99999999999999999999\" stands where a vertex"),
        ("f 1 2 -9223372036854775808", "out of range"),
        ("f 1/1 2/1 3/1", "index 1 is out of range: there are 0"),
        ("f a b c", "\"a\" stands where a vertex as 1"),
        ("f / / /", "\"/\" stands where a vertex"),
        ("v 1 2", "2 values stand where 3"),
        ("v 1 2 oops", "\"oops\" is not a finite number"),
        ("v 1 2 1e999", "not a finite number"),
    ] {
        let message = refusal(&format!("{SQUARE}{statement}\n"));
        assert!(message.starts_with("test.obj:5: ") && message.contains(expected), "{message}");
        assert_eq!(message.lines().count(), 1);
    }
    for bytes in ["", "hello\n", "# nothing\n", "f\0"] {
        assert!(refusal(bytes).starts_with("test.obj: not OBJ: "), "{bytes:?}");
    }
}

#[test]
fn a_fault_of_the_materials_names_both_files() {
    for (line, expected) in
        [("Kd 1 -1 0", "negative"), ("Kd 1 2", "2 values stand"), ("Ke spectral x.rfl", "a colour in red")]
    {
        let (_folder, scene) = with_materials(
            &format!("newmtl m\n{line}\n"),
            &format!("{SQUARE}mtllib a.mtl\nusemtl m\nf 1 2 3\n"),
        );
        let message = scene.unwrap_err();
        assert!(message.contains("a.obj:5: a.mtl:2: ") && message.contains(expected), "{message}");
    }
}

/// What a scene may name, a device, need not end.
#[cfg(unix)]
#[test]
fn what_never_ends_is_not_read() {
    let (_folder, scene) = with_materials("", &format!("mtllib /dev/zero\n{SQUARE}f 1 2 3 4\n"));
    let scene = scene.unwrap();
    assert!(
        scene.warnings[0].to_string().contains("not a regular file") || !Path::new("/dev/zero").exists(),
        "{:?}",
        scene.warnings
    );
}

/// A hostile address is as long as the file: it is no name.
#[test]
fn a_fault_of_embedded_materials_is_told_without_their_bytes() {
    let refused = refusal(&format!("mtllib data:;base64,bmV3bXRsIG0KS2QgLTEK\n{SQUARE}f 1 2 3\n"));
    assert_eq!(refused, "test.obj:1: embedded:2: the colour -1 is negative; give 0 or more");
}

/// As programs on Windows name it, with folders that are not here.
#[test]
fn a_file_of_materials_is_found_by_names_of_windows() {
    for name in [".\\a.mtl", "\"a.mtl\"", "C:\\Users\\me\\my scene\\a.mtl", "..\\gone\\a.mtl"] {
        let text = format!("mtllib {name}\n{SQUARE}usemtl m\nf 1 2 3 4\n");
        let (_folder, scene) = with_materials("newmtl m\nKd 0.25 0.5 0.75\n", &text);
        let scene = scene.unwrap();
        assert_eq!(scene.patches[0].reflectance, [0.25, 0.5, 0.75], "{name}: {:?}", scene.warnings);
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
    }
}
