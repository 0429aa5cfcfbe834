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
        ("F 3", "F 2", "test.vs3:3: \"2\" stands where geometry 3 or 3a is needed"),
        ("S 1  1 2 3 4", "S 1  1 2 3 40", "test.vs3:17: index 40 is out of range"),
        ("S 1  1 2 3 4", "S 1  0 2 3 4", "test.vs3:17: index 0 is out of range"),
        ("0 0 0.50", "0 0 1.50", "an emittance from 0 to 1"),
        ("S 3  9 10 11 0  1", "S 3  9 10 11 0  7", "index 7 is out of range"),
        ("0 0 0.90", "0 2 0.90", "test.vs3:18: \"cmb 2\" stands where 0 or the number of an earlier surface"),
        ("encl=0", "encl=yes", "test.vs3:2: \"yes\" is not a whole number"),
        ("encl=0", "encl", "test.vs3:2: "),
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

/// A room of 2 by 3, 2.5 high, with a sloping roof whose corners stand in two geometries.
const ROOM: &str = "\
C encl=1, emit=0 eps=1e-5 maxU=12 list=2
F 3
V 1 0 0 0
V 2 2 0 0
V 3 2 3 0
V 4 0 3 0
V 5 0 0 2
V 6 2 0 2
V 7 2 3 3
V 8 0 3 3
S 1 1 2 3 4 0 0 .9 floor
S 2 2 1 5 6 0 0 .9 south
S 3 4 3 7 8 0 0 .9 north
S 4 3 2 6 7 0 3 .9 east
S 5 1 4 8 5 0 3 .8 west
S 6 6 5 8 7 0 0 .9 roof
";
const IN_PLANES: &str = "\
F 3a
S 1 R 0 0 .9 floor
  0 0 0 180 0 2 3
S 2 r 0 0 .9 south  ! faces north
  2 0 0  0 90  ! across to the west
  2 2
S 3 R 0 0 .9 north
  0 3 0 180 90 2 3
S 4 Q 0 3 .9 east
  2 3 0 270 90
  0 0 3 0 3 2 0 3
S 5 Q 0 3 .8 west
  0 0 0 90 90 0 0 3 0 3 3 0 2
S 6 Q 0 0 .9 roof
  2 0 2 0 161.565051177078 0 0 2 0 2 3.16227766016838 0 3.16227766016838
O 7 T
  1 1 1 0 0  0 0 .5 0 0 .5
end
";

#[test]
fn surfaces_in_their_own_planes_are_the_same_room() {
    let [room, planes] = [ROOM, IN_PLANES].map(read);
    assert_eq!((planes.patches.len(), planes.warnings.len()), (7, 0), "{:?}", planes.warnings);
    for (one, other) in room.patches.iter().zip(&planes.patches) {
        let [corners, others] = [one, other].map(|patch| patch.polygon.loops().flatten().collect::<Vec<_>>());
        let is_near = |corner: &&DVec3| others.iter().any(|other| other.distance(**corner) < 1e-12);
        assert!(corners.iter().all(is_near), "{}: {corners:?} and {others:?}", one.name);
        assert!(one.polygon.normal().distance(other.polygon.normal()) < 1e-12, "{}", one.name);
        assert_eq!((&one.name, &one.reflectance), (&other.name, &other.reflectance));
    }
    // Right angles leave walls in the planes of the axes, to the last bit.
    assert!(planes.patches[4].polygon.loops().flatten().all(|corner| corner.x == 0.0));
    assert_eq!(planes.patches[6].polygon.normal(), DVec3::Z);
    assert_eq!(planes.patches[6].polygon.area(), 0.125);
}

#[test]
fn faults_of_surfaces_in_planes_are_named() {
    let cases = [
        ("S 2 r", "S 2 X", "test.vs3:4: \"X\" stands where R, T or Q is needed"),
        ("  2 2\n", "", "test.vs3:4: 5 values stand where 7 are needed"),
        ("180 0 2 3", "180 x 2 3", "test.vs3:3: \"x\" is not a finite number"),
        ("S 5 Q 0 3", "S 5 Q 0 4", "test.vs3:12: \"cmb 4\""),
    ];
    for (from, to, message) in cases {
        assert!(IN_PLANES.contains(from), "{from}");
        let text = IN_PLANES.replacen(from, to, 1);
        let error = Vs3::from_text("test.vs3", text).scene().unwrap_err().to_string();
        assert!(error.contains(message), "{from} -> {to}: {error}");
    }
}

#[test]
fn what_a_file_asks_for_is_told() {
    let request = |text: &str| Vs3::from_text("test.vs3", text).request().unwrap();
    let asked = request(ROOM);
    assert!(asked.closes && !asked.emittances);
    assert_eq!(asked.combined, [0, 1, 2, 2, 2, 5].map(Some));
    assert!(request(&ROOM.replace("emit=0", "emit = 1")).emittances);
    assert_eq!(request(SQUARES).combined, [Some(0), Some(1), Some(2), None, None]);
    let scene = read(&ROOM.replace("list=2", "row=3 out=1 col=0"));
    let warnings: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 2);
    assert!(
        warnings[0].contains("line 1: row=3 is not done") && warnings[1].contains("out=1"),
        "{warnings:?}"
    );
}

#[test]
fn a_quadrangle_that_is_not_planar_is_two_triangles() {
    let scene = read(&ROOM.replace("V 7 2 3 3", "V 7 2 3 3.25"));
    let names: Vec<&str> = scene.patches.iter().map(|patch| patch.name.as_str()).collect();
    assert_eq!(names, ["floor", "south", "north", "east", "west", "roof", "roof'"]);
    let warnings: Vec<String> = scene.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].starts_with("line 16: roof is not planar by "), "{warnings:?}");
    assert_eq!(scene.warnings[0].patches, ["roof", "roof'"]);
}

#[test]
fn a_text_without_a_surface_is_refused() {
    for text in ["", "random words\n", "T a title\nF 3\nV 1 0 0 0\nEnd\n"] {
        let refused = Vs3::from_text("test.vs3", text).scene().unwrap_err().to_string();
        assert!(refused.starts_with("test.vs3: not View3D: it has no surface"), "{refused}");
    }
}
