//! STL files in: text and binary, and what is refused.
use radiosity::Scene;
use radiosity::glam::DVec3;
use radiosity::io::stl::Stl;

const HALVES: [[[f32; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
];

fn read(bytes: impl Into<Vec<u8>>) -> Scene {
    Stl::from_bytes("test.stl", bytes).scene().unwrap()
}

fn refusal(bytes: impl Into<Vec<u8>>) -> String {
    Stl::from_bytes("test.stl", bytes).scene().unwrap_err().to_string()
}

fn binary(start: &str, colour: u16) -> Vec<u8> {
    let mut bytes = format!("{start:<80}").into_bytes();
    bytes.extend(2_u32.to_le_bytes());
    for triangle in HALVES {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|number| number.to_le_bytes()));
        bytes.extend(colour.to_le_bytes());
    }
    bytes
}

fn text(name: &str) -> String {
    let facet = |triangle: [[f32; 3]; 3]| {
        let vertices: String = triangle.iter().map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).collect();
        format!("facet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    format!("solid {name}\n{}endsolid {name}\n", HALVES.map(facet).concat())
}

#[test]
fn text_and_bytes_are_one_square() {
    // A binary file may begin as a text does.
    for file in [
        binary("made by hand", 0),
        binary("solid", 0),
        text("").into_bytes(),
        text("a").to_uppercase().replace("SOLID", "solid").into_bytes(),
    ] {
        let scene = read(file);
        assert_eq!(scene.patches.len(), 1);
        let polygon = &scene.patches[0].polygon;
        assert_eq!((polygon.area(), polygon.normal(), scene.asset.up), (1.0, DVec3::Z, DVec3::Z));
        assert_eq!((&scene.patches[0].reflectance[..], scene.warnings.len()), (&[0.5; 3][..], 1));
    }
}

#[test]
fn solids_have_names() {
    let scene = read(text("left wall") + &text("roof"));
    let names: Vec<&str> = scene.patches.iter().map(|patch| patch.name.as_str()).collect();
    assert_eq!(names, ["left wall", "roof"]);
}

#[test]
fn colours_are_told() {
    let scene = read(binary("", 0x7c1f));
    assert!(
        scene.warnings.iter().any(|warning| warning.what.contains("colours of facets")),
        "{:?}",
        scene.warnings
    );
}

#[test]
fn every_fault_is_named_with_its_place() {
    for (from, to, expected) in [
        ("vertex 1 0 0", "vertex 1 0", "test.stl:5: 2 values stand where 3"),
        ("vertex 1 0 0", "vertex 1 0 x", "test.stl:5: \"x\" is not a finite number"),
        ("vertex 1 0 0", "vertex 1 0 inf", "test.stl:5: \"inf\" is not a finite number"),
        ("vertex 1 0 0\n", "", "test.stl:7: 2 values stand where 3"),
        ("outer loop", "loop", "test.stl:3: \"loop\" stands where"),
        ("endfacet\nendsolid a\n", "", "cut short"),
    ] {
        let message = refusal(text("a").replace(from, to));
        assert!(message.starts_with("test.stl:") && message.contains(expected), "{to}: {message}");
    }
    let mut wrong = binary("", 0);
    wrong[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(refusal(wrong).starts_with("test.stl: triangle 0: \"NaN\""));
    let whole = binary("", 0);
    for bytes in [&whole[..133], &whole[..84], b"hello", b""] {
        assert!(refusal(bytes).starts_with("test.stl: not STL: "), "{}", bytes.len());
    }
    let mut claims = whole.clone();
    claims[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(refusal(claims).contains("84 bytes and 50 for each triangle"));
}

#[test]
fn capitals_and_a_byte_order_mark_are_a_text_too() {
    for text in [text("a").to_uppercase(), format!("\u{feff}{}", text("a"))] {
        let scene = read(text.clone());
        assert_eq!((scene.patches.len(), scene.patches[0].polygon.area()), (1, 1.0));
        let piped = radiosity::io::Source::from_bytes("standard input", text).unwrap().scene().unwrap();
        assert_eq!(piped.patches.len(), 1);
    }
}

#[test]
fn what_holds_no_triangle_is_refused_with_the_reason() {
    let mut cut = binary("solid of a binary file", 0);
    cut.truncate(cut.len() - 1);
    assert!(
        refusal(cut)
            .starts_with("test.stl: not STL: its bytes are no text, and it has not the length of a binary")
    );
    assert!(refusal("solid a\nendsolid a\n").starts_with("test.stl: not STL: it has no facet"));
}
