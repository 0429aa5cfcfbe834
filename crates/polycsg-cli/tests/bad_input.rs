//! Bad input: a message that names file, feature and what to do, an exit code, and nothing written.
mod program;

use program::{Folder, code, document, numbered, parcels, piped, polycsg, printed, stderr, stdout};
use serde_json::Value;
#[cfg(unix)]
use std::{
    io::Write,
    process::{Child, ChildStdin, Command, Stdio},
};

const SQUARE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}"#;

/// Every command that writes refuses a file, says what is wrong, and leaves the old output alone.
fn assert_refused(folder: &Folder, file: &str, expected: &str) {
    let out = folder.put("out.geojson", "old");
    let before = folder.names();
    let mask = folder.path("mask.geojson");
    for job in [
        vec!["repair", file],
        vec!["clip", file, "--by", &mask],
        vec!["dissolve", file],
        vec!["overlay", file, &mask, "--op", "intersection"],
        vec!["overlay", &mask, file, "--op", "union"],
    ] {
        let output = polycsg(&[&job[..], &["-o", &out]].concat());
        assert_eq!(code(&output), 3, "{job:?}: {}", stderr(&output));
        let message = stderr(&output);
        assert!(message.contains(expected) && message.contains(file), "{job:?}: {message}");
        assert_eq!(std::fs::read_to_string(&out).expect("the old file"), "old");
        assert_eq!(folder.names(), before, "{job:?} left something behind");
    }
}

#[test]
fn what_is_no_polygon_is_named_by_file_and_feature() {
    let folder = Folder::new();
    folder.put("mask.geojson", SQUARE);
    let feature = |geometry: &str| {
        format!(
            r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{}},"geometry":{SQUARE}}},
            {{"type":"Feature","id":"it","properties":{{}},"geometry":{geometry}}}]}}"#
        )
    };
    let ring =
        |point: &str| format!(r#"{{"type":"Polygon","coordinates":[[[0,0],[1,0],{point},[0,1],[0,0]]]}}"#);
    for (name, content, expected) in [
        (
            "a.geojson",
            feature(r#"{"type":"Point","coordinates":[0,0]}"#),
            "feature 1 (id \"it\"): a Point is no Polygon",
        ),
        (
            "a.geojson",
            feature(r#"{"type":"GeometryCollection","geometries":[]}"#),
            "feature 1 (id \"it\"): a GeometryCollection",
        ),
        ("a.geojson", feature(&ring("[1]")), "feature 1"),
        ("a.geojson", feature(&ring("[1,null]")), "feature 1"),
        ("a.geojson", feature(&ring("[1,1e999]")), "feature 1"),
        ("a.geojson", feature("{"), "feature 1"),
        ("a.geojson", feature(r#"{"type":"Polygon"}"#), "feature 1"),
        ("a.geojson", feature(SQUARE).replace("]}", "]"), "line"),
        ("a.geojson", feature(SQUARE) + "x", "trailing characters"),
        ("a.geojson", r#"{"type":"FeatureCollection"}"#.into(), "no member `features`"),
        ("a.geojson", r#"{"type":"Topology","objects":{}}"#.into(), ""),
        ("a.geojson", "{}".into(), "this is no GeoJSON"),
        ("a.geojson", String::new(), "EOF"),
        ("a.geojson", "[".repeat(1 << 16), ""),
        (
            "a.wkt",
            "POLYGON((0 0,1 0,1 1,0 0))\nLINESTRING(0 0,1 1)".into(),
            "feature 1 (line 2): a LineString is no Polygon",
        ),
        ("a.wkt", "POLYGON((0 0,1 0,1 1,0 0)".into(), "feature 0 (line 1)"),
        ("a.wkt", "POLYGON((0 0,1 0,nan 1,0 0))".into(), "feature 0"),
        ("a.wkt", "POLYGON((0 0,1 0,1e400 1,0 0))".into(), "feature 0"),
        ("a.wkb", "0103".into(), "feature 0 (line 1): this is no WKB"),
        ("a.wkb", "010".into(), "the line is cut short"),
        ("a.wkb", "01zz".into(), "column 3: there is no hexadecimal digit"),
        ("a.wkb", "0101000000000000000000F03F000000000000F03F".into(), "a Point is no Polygon"),
        ("a.wkb", "01030000000000000000".into(), "1 bytes too many"),
        ("a.wkb", "0103000000FFFFFFFF".into(), "this is no WKB"),
        ("a.wkb", format!("0106000000010000000101000000{}", "00".repeat(16)), "this is no WKB"),
        // A MultiPolygon Z of a polygon that says it has no z.
        (
            "a.wkb",
            format!("01EE0300000100000001030000000100000004000000{}", "00".repeat(96)),
            "a part of a MultiPolygon is no Polygon of its dimension",
        ),
        (
            "a.wkb",
            format!("01030000000100000004000000{}000000000000F87F{}", "00".repeat(8), "00".repeat(48)),
            "ring 0, vertex 0: a coordinate is NaN",
        ),
        ("a.fgb", "fgb".into(), "the file is cut short"),
        ("a.fgb", "something else".into(), "this is no FlatGeobuf"),
        ("a.parquet", "PAR1 or not".into(), "this is no Parquet"),
    ] {
        assert_refused(&folder, &folder.put(name, content), expected);
    }
}

#[test]
fn a_number_that_is_none_is_a_flaw_and_cannot_be_repaired() {
    let folder = Folder::new();
    let file = folder.put("a.wkt", "POLYGON((0 0,1 0,1 1,0 0))\nPOLYGON((0 0,1 0,inf 1,0 0))");
    let output = polycsg(&["validate", &file]);
    let found = (code(&output), String::from_utf8_lossy(&output.stdout).into_owned());
    if found.0 == 4 {
        assert!(
            found.1.starts_with("feature 1: ring 0, vertex 2: a coordinate is NaN or infinite"),
            "{}",
            found.1
        );
    } else {
        assert_eq!(found.0, 3, "{}", stderr(&output));
    }
    assert_eq!(code(&polycsg(&["repair", &file])), 3);
}

#[test]
fn flaws_are_named_as_the_library_names_them() {
    let folder = Folder::new();
    for (wkt, flaw) in [
        (
            "POLYGON((0 0,4 4,4 0,0 4,0 0))",
            "ring 0, vertex 0: the edge from there crosses or covers another edge",
        ),
        ("POLYGON((0 0,4 0,4 4,0 4,0 0),(5 1,6 1,6 2,5 1))", "ring 1: a hole lies outside of its polygon"),
        ("POLYGON((0 0,4 0,0 0))", "ring 0: it has fewer than 3 vertices"),
        ("POLYGON((1 1,1 1,1 1,1 1))", "ring 0: all of its vertices are equal"),
        ("POLYGON((0 0,4 0,4 4,2 2,0 4,2 2,0 0))", "ring 0"),
        (
            "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0)),((1 1,2 1,2 2,1 1)))",
            "ring 1: a polygon lies inside another",
        ),
        ("MULTIPOLYGON(((0 0,4 0,4 4,0 0)),((4 4,4 0,8 0,4 4)))", "crosses or covers another edge"),
        ("POLYGON((0 0,4 0,4 4,0 4,0 0),(0 2,2 0,4 2,2 4,0 2))", "they cut the interior in parts"),
    ] {
        let output = polycsg(&["validate", &folder.put("a.wkt", wkt)]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(code(&output), 4, "{wkt}");
        assert!(text.starts_with("feature 0: ") && text.contains(flaw), "{wkt}: {text}");
    }
}

/// Whatever is left of a file, fewer features are never taken for all of them.
#[test]
fn files_that_are_cut_short_or_damaged_are_refused() {
    let folder = Folder::new();
    let source = folder.put("a.geojson", document(&numbered("n", parcels(2, 0.0, 1.0, 1))));
    for format in ["geojson", "fgb", "parquet"] {
        let whole = folder.path(&format!("whole.{format}"));
        printed(&["repair", &source, "-o", &whole]);
        let bytes = std::fs::read(&whole).expect("a file");
        let cut = folder.path(&format!("cut.{format}"));
        for length in (0..bytes.len() - 2).step_by(7) {
            std::fs::write(&cut, &bytes[..length]).expect("a file");
            let output = polycsg(&["repair", &cut, "--to", "wkt"]);
            assert_eq!(code(&output), 3, "{length} bytes of {format}: {}", stderr(&output));
        }
        for place in (0..bytes.len()).step_by(11) {
            let mut damaged = bytes.clone();
            damaged[place] ^= 0xff;
            std::fs::write(&cut, &damaged).expect("a file");
            let output = polycsg(&["repair", &cut, "--to", "wkt"]);
            assert!(matches!(code(&output), 0 | 3), "byte {place} of {format}: {}", stderr(&output));
        }
    }
}

#[test]
fn what_cannot_be_written_is_an_error_and_leaves_nothing() {
    let folder = Folder::new();
    let file = folder.put("a.geojson", document(&numbered("n", parcels(30, 0.0, 1.0, 1))));
    let none = folder.path("none/out.geojson");
    for to in ["geojson", "wkt", "wkb", "flatgeobuf", "geoparquet"] {
        for out in ["/dev/full", &none, &folder.path("")] {
            let output = polycsg(&["repair", &file, "--to", to, "-o", out]);
            assert_eq!(code(&output), 1, "{to} {out}: {}", stderr(&output));
            assert!(stderr(&output).contains("cannot be written"), "{}", stderr(&output));
        }
    }
    assert_eq!(folder.names(), ["a.geojson"]);
    let output = polycsg(&["repair", &folder.path("missing.geojson"), "-o", &folder.path("b.geojson")]);
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("check its name"), "{}", stderr(&output));
    assert_eq!(folder.names(), ["a.geojson"]);
}

#[test]
fn wrong_usage_is_said_before_anything_is_read() {
    let folder = Folder::new();
    let file = folder.put("a.geojson", SQUARE);
    for (arguments, expected) in [
        (vec!["area", "a.shp"], "unknown format"),
        (vec!["area", "-"], "--from"),
        (vec!["clip", "-", "--by", "-", "--from", "wkt"], "both inputs are stdin"),
        (vec!["dissolve", &file, "--by", "name"], "there is no column \"name\""),
        (vec!["repair", &file, "-o", "x.shp"], "--to"),
        (vec!["overlay", &file, &file], "--op"),
    ] {
        let output = polycsg(&arguments);
        assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(expected), "{arguments:?}: {}", stderr(&output));
    }
}

#[test]
fn an_input_may_be_the_output_and_a_pipe_may_be_both() {
    let folder = Folder::new();
    let file = folder.put("a.geojson", document(&numbered("n", parcels(3, 0.0, 1.0, 1))));
    let expected = printed(&["dissolve", &file, "--by", "kind"]);
    let text = std::fs::read(&file).expect("a file");
    assert_eq!(stdout(piped(&["dissolve", "-", "--by", "kind", "--from", "geojson"], &text)), expected);
    printed(&["dissolve", &file, "--by", "kind", "-o", &file]);
    assert_eq!(std::fs::read_to_string(&file).expect("a file"), expected);
    let parquet = folder.path("a.parquet");
    printed(&["repair", &file, "-o", &parquet]);
    let bytes = std::fs::read(&parquet).expect("a file");
    let output = piped(&["repair", "-", "--from", "geoparquet", "--to", "geojson"], &bytes);
    let values = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
    assert_eq!(values(&stdout(output)), values(&expected));
}

#[test]
fn what_is_lost_is_said_once() {
    let folder = Folder::new();
    let wkt = "POLYGON Z((0 0 1,1 0 1,1 1 1,0 0 1))\n".repeat(2000);
    let output = polycsg(&["area", &folder.put("z.wkt", wkt)]);
    assert_eq!(stderr(&output).matches("feature 0 has Z or M").count(), 1);
    let named = folder.put("a.geojson", document(&numbered("n", parcels(1, 0.0, 1.0, 1))));
    let output = polycsg(&["repair", &named, "--to", "wkt"]);
    assert!(stderr(&output).contains("WKT has no columns: left out are kind, n"), "{}", stderr(&output));
    let foreign = format!(r#"{{"type":"Feature","properties":{{}},"title":"x","geometry":{SQUARE}}}"#);
    let output = polycsg(&["repair", &folder.put("f.geojson", foreign)]);
    assert!(stderr(&output).contains("feature 0: its member \"title\" is left out"), "{}", stderr(&output));
}

/// A copy of a pipe that finds no room is not the pipe's fault.
#[cfg(unix)]
#[test]
fn a_folder_for_copies_that_is_not_there_is_named() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_polycsg"));
    command.args(["area", "-", "--from", "geojson"]).env("TMPDIR", "/nowhere").stdin(Stdio::null());
    let output = command.output().expect("it starts");
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).contains("it is copied to /nowhere first"), "{}", stderr(&output));
}

/// A command whose input comes through a pipe.
#[cfg(unix)]
fn begun(name: &str, out: &str) -> (Child, ChildStdin) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_polycsg"));
    command.args([name, "-", "--from", "wkt", "-o", out]).stdin(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("it starts");
    let pipe = child.stdin.take().expect("a pipe");
    (child, pipe)
}

#[cfg(unix)]
const LINE: &[u8] = b"POLYGON((0 0,1 0,1 1,0 0))\n";

/// It has begun when it has taken more than a pipe holds.
#[cfg(unix)]
fn fill(pipe: &mut ChildStdin) {
    pipe.write_all(&LINE.repeat(20_000)).expect("it reads");
}

#[cfg(unix)]
fn send(signal: &str, child: &Child) {
    let sent = Command::new("kill").args([signal, &child.id().to_string()]).status();
    assert!(sent.expect("kill").success());
}

/// While it waits for a pipe that says nothing more, it sees no signal.
#[cfg(unix)]
#[test]
fn signals_end_it_while_it_waits_and_leave_nothing() {
    for signal in ["-INT", "-TERM"] {
        let folder = Folder::new();
        let (mut child, mut pipe) = begun("repair", &folder.path("out.wkt"));
        fill(&mut pipe);
        send(signal, &child);
        assert_eq!(child.wait().expect("it ends").code(), Some(130), "{signal}");
        assert_eq!(folder.names(), Vec::<String>::new(), "{signal}");
        drop(pipe);
    }
}

/// A dissolve has nothing to write before it has read everything: however it ends till then, as for want of memory, no file is left.
#[cfg(unix)]
#[test]
fn a_dissolve_that_is_killed_while_it_reads_leaves_nothing() {
    let folder = Folder::new();
    let (mut child, mut pipe) = begun("dissolve", &folder.path("out.wkt"));
    fill(&mut pipe);
    send("-KILL", &child);
    assert_eq!(child.wait().expect("it ends").code(), None);
    assert_eq!(folder.names(), Vec::<String>::new());
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_it_and_leaves_nothing() {
    let folder = Folder::new();
    let (child, mut pipe) = begun("repair", &folder.path("out.wkt"));
    fill(&mut pipe);
    send("-INT", &child);
    while pipe.write_all(LINE).is_ok() {}
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(code(&output), 130, "{}", stderr(&output));
    assert_eq!(folder.names(), Vec::<String>::new());
}

#[test]
fn more_threads_than_a_machine_has_use_for_are_not_started() {
    let folder = Folder::new();
    let file = folder.put("a.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 0))\n");
    let output = polycsg(&["-j", "60000", "area", &file]);
    assert!(stderr(&output).contains("-j 60000"));
    assert_eq!(code(&output), 0);
}

/// Messages go to a full disk, or nowhere: the output is written, and the exit code is that of the command.
#[cfg(target_os = "linux")]
#[test]
fn messages_that_cannot_be_written_cost_nothing() {
    let folder = Folder::new();
    let file = folder.put("a.wkt", "POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))\n");
    let out = folder.path("out.wkt");
    for (command, code) in [("validate \"$1\"", 4), ("repair \"$1\" -o \"$2\"", 0), ("area \"$1.wkt\"", 1)] {
        for stderr in ["2> /dev/full", "2>&-"] {
            let script = format!("exec \"$0\" {command} {stderr}");
            let run =
                Command::new("sh").args(["-c", &script, env!("CARGO_BIN_EXE_polycsg"), &file, &out]).status();
            assert_eq!(run.expect("a shell").code(), Some(code), "{command} {stderr}");
        }
    }
    assert!(std::fs::read_to_string(&out).expect("written").contains("POLYGON"));
}
