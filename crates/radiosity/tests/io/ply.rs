//! PLY files in: text and both orders of bytes, colours, strips, and what is refused.
use radiosity::Scene;
use radiosity::glam::DVec3;
use radiosity::io::ply::Ply;

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

fn read(bytes: impl Into<Vec<u8>>) -> Scene {
    Ply::from_bytes("test.ply", bytes).scene().unwrap()
}

fn refusal(bytes: impl Into<Vec<u8>>) -> String {
    Ply::from_bytes("test.ply", bytes).scene().unwrap_err().to_string()
}

fn header(writing: &str, of_vertex: &str, faces: &str) -> String {
    format!(
        "ply\nformat {writing} 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
         {of_vertex}{faces}end_header\n"
    )
}

const FACE: &str = "element face 1\nproperty list uchar int vertex_indices\n";

fn text() -> String {
    let points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    format!("{}{points}4 0 1 2 3\n", header("ascii", "", FACE))
}

fn is_square(scene: &Scene) {
    assert_eq!(scene.patches.len(), 1);
    let polygon = &scene.patches[0].polygon;
    assert_eq!((polygon.area(), polygon.normal()), (1.0, DVec3::Z));
}

#[test]
fn text_and_both_orders_of_bytes_are_one_square() {
    is_square(&read(text()));
    is_square(&read(text().replace('\n', "\r\n")));
    for (name, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut bytes = header(name, "", FACE).into_bytes();
        let float = |number: f32| if is_big { number.to_be_bytes() } else { number.to_le_bytes() };
        let index = |number: i32| if is_big { number.to_be_bytes() } else { number.to_le_bytes() };
        bytes.extend(SQUARE.iter().flatten().flat_map(|number| float(*number)));
        bytes.push(4);
        bytes.extend((0..4).flat_map(index));
        is_square(&read(bytes));
    }
}

#[test]
fn colours_are_reflectances() {
    let plain = read(text());
    assert_eq!(plain.patches[0].reflectance, [0.5; 3]);
    let colour = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let faces = format!(
        "{}0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 188\n",
        header("ascii", "", &format!("{FACE}{colour}"))
    );
    let [red, green, blue] = read(faces).patches[0].reflectance[..] else { panic!("three bands") };
    assert!((red, green) == (1.0, 0.0) && (blue - 0.503).abs() < 1e-3, "{red} {green} {blue}");
    let linear = colour.replace("uchar", "float");
    let points = "0 0 0 0.2 0 0\n1 0 0 0.4 0 0\n1 1 0 0.4 0 1\n0 1 0 0.2 0 1\n";
    let vertices = format!("{}{points}4 0 1 2 3\n", header("ascii", &linear, FACE));
    let mean: Vec<f64> = read(vertices).patches[0].reflectance.clone();
    assert!((mean[0] - 0.3).abs() < 1e-15 && mean[1..] == [0.0, 0.5], "{mean:?}");
}

#[test]
fn strips_are_triangles() {
    let strip = "element tristrips 1\nproperty list int int vertex_indices\n";
    let scene =
        read(format!("{}0 0 0\n1 0 0\n1 1 0\n0 1 0\n9 0 1 3 2 -1 0 3 1 -1\n", header("ascii", "", strip)));
    let area: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    assert_eq!(area, 1.5, "{:?}", scene.patches);
    let down = scene.patches.iter().filter(|patch| patch.polygon.normal().z < 0.0).count();
    assert_eq!(down, 1, "the second strip is turned");
}

#[test]
fn points_and_other_elements_are_told() {
    let cloud = read(format!("{}0 0 0\n1 0 0\n1 1 0\n0 1 0\n", header("ascii", "", "")));
    assert!(cloud.patches.is_empty() && cloud.warnings[0].what.contains("points have no area"));
    let edges = format!(
        "{FACE}element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty list uchar float weights\n"
    );
    let scene =
        read(format!("{}0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n0 1 2 .5 .5\n", header("ascii", "", &edges)));
    is_square(&scene);
    assert!(scene.warnings[0].to_string().contains("edge"), "{:?}", scene.warnings);
}

#[test]
fn every_fault_is_named_with_its_place() {
    for (from, to, expected) in [
        ("format ascii", "format telegraph", "test.ply:2: \"telegraph\" stands where ascii"),
        ("element vertex 4", "element vertex many", "test.ply:4: \"many\" is not a whole number"),
        ("element vertex 4", "element vertex 18446744073709551615", "test.ply:"),
        ("property float x", "property quaternion x", "test.ply:5: \"quaternion\" stands where a type"),
        ("end_header", "end", "test.ply:10: \"end\" stands where"),
        ("4 0 1 2 3", "4 0 1 2", "cut short"),
        ("4 0 1 2 3", "4 0 1 2 9", "face 0: index 9 is out of range: there are 4"),
        ("4 0 1 2 3", "4 0 1 2 -1", "face 0: \"-1\" is not a whole number"),
        ("4 0 1 2 3", "4 0 1 2 1.5", "\"1.5\" is not a whole number"),
        ("4 0 1 2 3", "-4 0 1 2 3", "test.ply:15: \"-4\" is not a whole number"),
        ("1 1 0\n", "1 one 0\n", "test.ply:13: \"one\" is not a finite number"),
        ("1 1 0\n", "1 nan 0\n", "not a finite number"),
    ] {
        assert!(text().contains(from), "{from}");
        let message = refusal(text().replace(from, to));
        assert!(message.starts_with("test.ply:") && message.contains(expected), "{to}: {message}");
        assert_eq!(message.lines().count(), 1);
    }
    for bytes in ["", "ply", "plymouth", "hello"] {
        assert!(refusal(bytes).starts_with("test.ply: not PLY: "), "{bytes:?}");
    }
    let mut short = header("binary_little_endian", "", FACE).into_bytes();
    short.extend([0; 20]);
    assert!(refusal(short).contains("test.ply: vertex 1: it is cut short"));
}

/// Rows of nothing take no bytes, so any number may be claimed; lists may claim any length.
#[test]
fn claims_of_nothing_end_at_once() {
    let huge = format!(
        "{}0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
        header("ascii", "", &format!("{FACE}element void 18446744073709551615\n"))
    );
    is_square(&read(huge));
    let mut list =
        header("binary_little_endian", "", "element face 1\nproperty list uint double vertex_indices\n")
            .into_bytes();
    list.extend(SQUARE.iter().flatten().flat_map(|number| number.to_le_bytes()));
    list.extend([0xff; 4]);
    assert!(refusal(list).contains("face 0: it is cut short"));
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    is_square(&read(format!("\u{feff}{}", text())));
    let source = radiosity::io::Source::from_bytes("standard input", format!("\u{feff}{}", text()));
    is_square(&source.unwrap().scene().unwrap());
}

#[test]
fn vertices_without_an_axis_are_refused_by_its_name() {
    let refused = refusal(text().replace("property float z\n", "property float height\n"));
    assert_eq!(refused, "test.ply: vertex: it has no property z; export the file again");
}

/// A square of two triangles beside one of four corners, which faces another way.
#[test]
fn triangles_are_joined_beside_other_faces() {
    let header = header("ascii", "", "element face 3\nproperty list uchar int vertex_indices\n")
        .replace("vertex 4", "vertex 6");
    let points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n";
    let scene = read(format!("{header}{points}3 0 1 2\n4 1 0 4 5\n3 0 2 3\n"));
    assert_eq!(scene.patches.len(), 2);
    assert!(scene.patches.iter().all(|patch| patch.polygon.area() == 1.0));
}
