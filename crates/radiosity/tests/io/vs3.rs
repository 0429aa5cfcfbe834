//! View3D's files in.
use radiosity::Scene;
use radiosity::glam::DVec3;
use radiosity::io::vs3::Vs3;

const SQUARES: &str = "\
T Two squares, one between them
C encl=0 list=3
F 3
! comment
V 1 0. 0. 0.
V 2 1. 0. 0.
V 3 1. 1. 0.
V 4 0. 1. 0.
V 5 0. 0. 1.
V 6 1. 0. 1.
V 7 1. 1. 1.
V 8 0. 1. 1.
V 9 .25 .25 0.
V 10 .75 .25 0.
V 11 .75 .75 0.
V 12 .25 .75 0.
S 1  1 2 3 4  0 0 0.50 low
S 2  7 6 5 8  0 0 0.90 high
S 3  9 10 11 0  1 0 0.25 inlay
N 4  9 11 12 0  1 0 0.25 hole
O 5  5 6 2 1
End of data
S 9 9 9
";

fn read(text: &str) -> Scene {
    Vs3::from_text("test.vs3", text).scene().unwrap()
}

#[test]
fn surfaces_are_patches_and_parts_are_cut_out_of_their_base() {
    let scene = read(SQUARES);
    let patches: Vec<_> = scene
        .patches
        .iter()
        .map(|patch| (patch.name.as_str(), patch.polygon.area(), patch.polygon.normal()))
        .collect();
    let expected = [
        ("low", 0.75, DVec3::Z),
        ("high", 1.0, DVec3::NEG_Z),
        ("inlay", 0.125, DVec3::Z),
        ("obstruction-5", 1.0, DVec3::Y),
    ];
    assert_eq!(patches, expected);
    assert_eq!(scene.patches[0].polygon.loops().count(), 2);
    let reflectances: Vec<f64> = scene.patches.iter().map(|patch| patch.reflectance[0]).collect();
    assert!(reflectances.iter().zip([0.5, 0.1, 0.75, 0.0]).all(|(r, expected)| (r - expected).abs() < 1e-15));
    assert!(scene.patches.iter().map(|patch| patch.only_blocks).eq([false, false, false, true]));
    assert_eq!((scene.bands, scene.warnings.len()), (1, 0));
}

#[test]
fn every_fault_is_named_with_its_line() {
    let cases = [
        ("V 2 1.", "V 2 x", "test.vs3:6: \"x\" is not a finite number"),
        ("V 2 1. 0. 0.", "V 2 1. 0.", "test.vs3:6: 4 values stand where 5 are needed"),
        ("V 2", "V 3", "test.vs3:6"),
        ("F 3", "F 3a", "test.vs3:3: \"3a\" stands where geometry 3 is needed"),
        ("S 1  1 2 3 4", "S 1  1 2 3 40", "test.vs3:17: index 40 is out of range"),
        ("S 1  1 2 3 4", "S 1  0 2 3 4", "test.vs3:17: index 0 is out of range"),
        ("0 0 0.50", "0 0 1.50", "an emittance from 0 to 1"),
        ("S 3  9 10 11 0  1", "S 3  9 10 11 0  7", "index 7 is out of range"),
        ("S 1  1 2 3 4", "S 1  1 2 1 2", "test.vs3:17: polygon 0"),
    ];
    for (from, to, message) in cases {
        assert!(SQUARES.contains(from), "{from}");
        let error =
            Vs3::from_text("test.vs3", SQUARES.replacen(from, to, 1)).scene().unwrap_err().to_string();
        assert!(error.contains(message), "{from} -> {to}: {error}");
    }
}

#[test]
fn a_surface_that_is_all_holes_is_nothing() {
    let text = SQUARES.replace("S 3  9 10 11 0  1", "S 3  1 2 3 4  1");
    assert!(read(&text).patches.iter().all(|patch| patch.name != "low"));
}

#[test]
fn a_vertex_21_decades_away_leaves_no_area() {
    let far = "V 1 1. 0. 1.\nV 2 0. .230957 1854.916382\nV 3 1. 1. 1.\nV 4 2217984.06 91. 2222222222222222222222.\n";
    let refused = Vs3::from_text("test.vs3", format!("{far}S 1 1 2 3 4 0 0 .5 spike\n")).scene().unwrap_err();
    assert!(refused.to_string().starts_with("test.vs3:5: polygon 0: "), "{refused}");
}

#[test]
fn a_corner_given_twice_is_one() {
    for corners in ["1 1 2 3", "1 2 2 3", "1 2 3 3", "1 2 3 1"] {
        let scene = read(&SQUARES.replace("S 2  7 6 5 8", &format!("S 2  {corners}")));
        let loops: Vec<usize> = scene.patches[1].polygon.loops().map(<[DVec3]>::len).collect();
        assert_eq!((loops, scene.patches[1].polygon.area()), (vec![3], 0.5), "{corners}");
    }
}
