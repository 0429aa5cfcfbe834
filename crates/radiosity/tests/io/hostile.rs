//! Bad files: a typed error that names the line, or a stated result; never a panic, never endless.
use crate::samples::{file, geometry, node, polylist, primitive, refusal};
use radiosity::io::FileError;
use radiosity::io::collada::Collada;
use radiosity::scenes;

/// A good file with a change.
fn changed(from: &str, to: &str) -> String {
    let good = file("", &node("n", "<translate>0 0 0</translate>", "square"));
    assert!(good.contains(from), "{from}");
    good.replace(from, to)
}

#[test]
fn every_fault_is_named_with_its_line_and_its_mend() {
    let cases = [
        ("<COLLADA", "</COLLADA", "not well-formed"),
        ("</visual_scene>", "", "not well-formed"),
        ("version=\"1.4.1\"", "version=\"1.3.0\"", "1.3.0"),
        ("version=\"1.4.1\"", "", "attribute version"),
        ("0 0 0 1 0 0", "0 0 0 1 0 NaN", "\"NaN\" is not a finite number"),
        ("0 0 0 1 0 0", "0 0 0 1 0 INF", "\"INF\" is not a finite number"),
        ("0 0 0 1 0 0", "0 0 0 1 0 1e400", "not a finite number"),
        ("0 0 0 1 0 0", "0 0 0 1 0 oops", "\"oops\" is not a finite number"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 4</p>", "index 4 is out of range"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 -1</p>", "\"-1\" is not a whole number"),
        ("<p>0 1 2 3</p>", "<p>0 1 2 99999999999999999999999</p>", "not a whole number"),
        ("<p>0 1 2 3</p>", "<p>0 1 2</p>", "3 values stand where 4 are needed"),
        ("<vcount>4</vcount>", "<vcount>18446744073709551615 5</vcount>", "values stand"),
        ("<vcount>4</vcount>", "", "<vcount>"),
        ("count=\"4\" stride=\"3\"", "count=\"5\" stride=\"3\"", "values stand"),
        ("count=\"4\" stride=\"3\"", "count=\"18446744073709551615\" stride=\"3\"", "values stand"),
        ("count=\"4\" stride=\"3\"", "count=\"4\" stride=\"18446744073709551615\"", "values stand"),
        ("count=\"4\" stride=\"3\"", "count=\"4\" stride=\"0\"", "values stand"),
        ("offset=\"0\"", "offset=\"18446744073709551615\"", "offset is too large"),
        ("offset=\"0\"", "offset=\"3\"", "values stand where"),
        ("\"#square-v\"", "\"#nothing\"", "names no <vertices>"),
        ("\"#square-p\"", "\"#square-v\"", "names no <source>"),
        ("\"#square\"", "\"other.dae#square\"", "another file"),
        ("target=\"#grey\"", "target=\"#blue\"", "names no <material>"),
        ("url=\"#grey-fx\"", "url=\"#blue-fx\"", "names no <effect>"),
        ("0.25 0.5 0.75 1", "0.25 0.5", "2 values stand"),
        ("0.25 0.5 0.75 1", "0.25 -0.5 0.75 1", "negative"),
        ("<translate>0 0 0</translate>", "<translate>0 0</translate>", "2 values stand where 3"),
        ("<translate>0 0 0</translate>", "<rotate>0 0 0 90</rotate>", "no direction"),
        ("<translate>0 0 0</translate>", "<lookat>0 0 0 0 0 1 0 0 1</lookat>", "no direction"),
        ("<translate>0 0 0</translate>", "<skew>1 1 0 0 0 1 0</skew>", "not read"),
        ("<translate>0 0 0</translate>", "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1</matrix>", "last row"),
        ("<translate>0 0 0</translate>", "<scale>1e300 1 1</scale><scale>1e300 1 1</scale>", "not finite"),
        ("<translate>0 0 0</translate>", "<scale>1e100 1e100 1</scale>", "polygon 0"),
    ];
    for (from, to, expected) in cases {
        let message = refusal(&changed(from, to));
        assert!(message.contains(expected), "{to}: {message}");
        let place = message.strip_prefix("test.dae:").unwrap_or_else(|| panic!("{message}"));
        assert!(place.starts_with(|c: char| c.is_ascii_digit()), "{message}");
    }
}

/// The same file, its grey with spectra.
fn with_spectra(own: &str, root: &str) -> String {
    let extra = |body: &str| format!("<extra><technique profile=\"radiosity\">{body}</technique></extra>");
    changed(
        "</profile_COMMON></effect>\n<effect id=\"lamp-fx\">",
        &format!("</profile_COMMON>{}</effect>\n<effect id=\"lamp-fx\">", extra(own)),
    )
    .replace("</COLLADA>", &format!("{}</COLLADA>", extra(root)))
}

#[test]
fn spectra_are_read_and_their_faults_named() {
    let good =
        with_spectra("<reflectance>.1 .2 .3 .4</reflectance>", "<wavelengths>400 500 600 700</wavelengths>");
    let scene = Collada::from_text("test.dae", good).scene().unwrap();
    assert_eq!(scene.patches[0].reflectance, [0.1, 0.2, 0.3, 0.4]);
    assert_eq!((scene.patches[0].emission.as_slice(), scene.bands), ([0.0; 4].as_slice(), 4));
    assert_eq!(scene.wavelengths, [400.0, 500.0, 600.0, 700.0]);
    for (own, root, expected) in [
        ("<emission>1 2</emission>", "", "<reflectance> is missing"),
        ("<reflectance/>", "", "0 values stand"),
        ("<reflectance>.1 .2</reflectance><emission>1</emission>", "", "<emission>: 1 values stand where 2"),
        ("<reflectance>.1 -.2</reflectance>", "", "negative"),
        ("<reflectance>.1 x</reflectance>", "", "\"x\" is not a finite number"),
        (
            "<reflectance>.1 .2</reflectance>",
            "<wavelengths>400</wavelengths>",
            "<wavelengths>: 1 values stand where 2",
        ),
    ] {
        let message = refusal(&with_spectra(own, root));
        assert!(message.starts_with("test.dae:") && message.contains(expected), "{own}: {message}");
    }
}

#[test]
fn empty_and_foreign_files_are_refused() {
    for text in ["", " ", "<a/>", "COLLADA", "<COLLADA version=\"1.4.1\"/>", "\u{0}"] {
        assert!(refusal(text).starts_with("test.dae:"), "{text:?}");
    }
    let bomb =
        "<!DOCTYPE a [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><COLLADA version=\"1.4.1\">&b;</COLLADA>";
    assert!(refusal(bomb).contains("not well-formed"));
}

#[test]
fn a_missing_file_and_bytes_that_are_no_text_are_typed_errors() {
    assert!(matches!(Collada::open("/nowhere/scene.dae"), Err(FileError::Read { .. })));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("latin.dae");
    std::fs::write(&path, b"<COLLADA>\xe9</COLLADA>").unwrap();
    assert!(matches!(Collada::open(&path), Err(FileError::Encoding { position: 9, .. })));
}

#[test]
fn a_node_that_instances_itself_is_refused() {
    let direct = r##"<node id="a"><instance_node url="#a"/></node>"##;
    assert!(refusal(&file("", direct)).contains("instances itself"));
    let round = r##"<node id="a"><instance_node url="#b"/></node><node id="b"><node><instance_node url="#a"/></node></node>"##;
    assert!(refusal(&file("", round)).contains("instances itself"));
}

/// Each node of a chain instances the next one twice: the number of visits doubles with every link.
#[test]
fn instances_that_multiply_without_bound_end() {
    let link = |i: usize| {
        let door = format!("<instance_node url=\"#n{}\"/>", i + 1);
        format!("<node id=\"n{i}\">{door}{door}</node>")
    };
    let chain: String = (0..40).map(link).collect();
    let message = refusal(&file("", &format!("{chain}<node id=\"n40\"/>")));
    assert!(message.contains("more than 1000000 nodes"), "{message}");
    let long: String =
        (0..100).map(|i| format!("<node id=\"n{i}\"><instance_node url=\"#n{}\"/></node>", i + 1)).collect();
    assert!(refusal(&file("", &format!("{long}<node id=\"n100\"/>"))).contains("nested"));
}

#[test]
fn deep_nesting_does_not_overflow_the_stack() {
    let depth = 100_000;
    let nodes = format!("{}{}{}", "<node>".repeat(depth), node("n", "", "square"), "</node>".repeat(depth));
    assert_eq!(Collada::from_text("test.dae", file("", &nodes)).scene().unwrap().patches.len(), 1);
}

#[test]
fn a_bent_polygon_that_crosses_itself_is_cut_or_left_out() {
    for indices in ["0 2 1 3", "0 1 0 2", "0 1 2 1", "1 3 0 2"] {
        let bent = geometry("g", "0 0 0 2 0 0.3 2 2 0.5 0 2 0", &polylist("g", "4", indices));
        let text = file(&format!("<library_geometries>{bent}</library_geometries>"), &node("n", "", "g"));
        let scene = Collada::from_text("test.dae", text).scene().unwrap();
        assert!(!scene.warnings.is_empty(), "{indices}");
    }
}

/// Planar within rounding, but a line once it lies in a coordinate plane.
#[test]
fn a_vertex_too_far_for_the_others_leaves_no_area() {
    let body = "<ph><p>0 1 2 3</p><h>4 5 6 7</h></ph>";
    let points = "0 0 2 4 0 0 4 4 0 0 4 1e53 1 1 0 2 1 0 2 2 0 0 1 0";
    let far = geometry("g", points, &primitive("polygons", "g", body));
    let text = file(&format!("<library_geometries>{far}</library_geometries>"), &node("n", "", "g"));
    if let Ok(scene) = Collada::from_text("test.dae", text).scene() {
        assert!(scene.patches.iter().all(|patch| patch.polygon.area() > 0.0));
    }
}

#[test]
fn a_triangle_of_70_decades_leaves_no_area() {
    let points = "-5.086274911196319e-43 -4.1199620001044244e-41 6.4738333862115e-42 \
                  8.097930455802617e-11 -1.4138011574421075e-9 -4.042764593945319e-10 \
                  1.6917295008726363e26 -1.6917295008726363e26 -1.0633290716972123e27";
    let far = geometry("far", points, &primitive("triangles", "far", "<p>0 1 2</p>"));
    let text = file(&format!("<library_geometries>{far}</library_geometries>"), &node("n", "", "far"));
    let scene = Collada::from_text("test.dae", text).scene().unwrap();
    assert!(scene.patches.iter().all(|patch| patch.polygon.area() > 0.0));
    assert_eq!(scene.patches.len() + scene.warnings.len(), 1);
}

#[test]
fn holes_of_too_few_points_are_left_out() {
    let body = "<ph><p>0 1 2 3</p><h>0 0 0</h><h></h></ph>";
    let holed = geometry("g", "0 0 0 1 0 0 1 1 0 0 1 0", &primitive("polygons", "g", body));
    let text = file(&format!("<library_geometries>{holed}</library_geometries>"), &node("n", "", "g"));
    assert_eq!(Collada::from_text("test.dae", text).scene().unwrap().patches[0].polygon.area(), 1.0);
}

/// A step of xorshift: enough to damage files.
fn next(state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    usize::try_from(*state >> 33).unwrap()
}

/// Truncated and damaged files: whatever comes back, it comes back.
#[test]
fn damaged_files_never_panic() {
    let good = scenes::write_scene("cornell-box").unwrap();
    for end in (0..good.len()).step_by(good.len() / 200) {
        let cut = Collada::from_text("test.dae", &good[..end]);
        assert!(cut.scene().is_err());
    }
    let mut state = 0x9e37_79b9_7f4a_7c15;
    let words = [
        "0",
        "-1",
        "1e309",
        "NaN",
        "99999999999",
        "<",
        ">",
        "\"",
        "#",
        "</node>",
        "<node>",
        "",
        "&#0;",
        "3 3",
    ];
    for _ in 0..1000 {
        let mut text = good.clone();
        for _ in 0..=next(&mut state) % 3 {
            let at = next(&mut state) % text.len();
            let end = (at + next(&mut state) % 4).min(text.len());
            text.replace_range(at..end, words[next(&mut state) % words.len()]);
        }
        let damaged = Collada::from_text("test.dae", text);
        if let Ok(scene) = damaged.scene() {
            assert!(scene.patches.iter().all(|patch| patch.polygon.area().is_finite()));
        }
    }
}
