//! `factors` as its users call it: points, rows, matrices, and View3D's format in and out.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use serde_json::Value;
use std::process::Command;

/// Unit squares that face each other at distance 1, and a quarter of a square half-way between them.
const SQUARES: &str = "\
T Two squares with a square obstruction in between
F 3
V 1 0 0 0
V 2 1 0 0
V 3 1 1 0
V 4 0 1 0
V 5 0 0 1
V 6 1 0 1
V 7 1 1 1
V 8 0 1 1
V 9 0 0 .5
V 10 .5 0 .5
V 11 .5 .5 .5
V 12 0 .5 .5
S 1 1 2 3 4 0 0 0.50 low
S 2 7 6 5 8 0 0 0.90 high
O 3 9 10 11 12
End of data
";
/// F(low -> high), computed by Gauss rules of two orders on cells cut at the visual events, with and without what is in
/// between.
const BLOCKED: f64 = 0.149_868_671_773_790;
const FREE: f64 = 0.199_824_895_698_387_4;

fn radiosity(arguments: &[&str]) -> (Option<i32>, String, String) {
    let program = env!("CARGO_BIN_EXE_radiosity");
    let output = Command::new(program)
        .args(arguments)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../radiosity"))
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// What `factors` prints of the squares.
fn factors(text: &str, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("squares.vs3");
    std::fs::write(&file, text).unwrap();
    let (code, stdout, stderr) = radiosity(&[&["factors", file.to_str().unwrap()], arguments].concat());
    assert_eq!(code, Some(0), "{stderr}");
    stdout
}

#[test]
fn view3d_files_go_in_and_view3d_output_comes_out() {
    for (text, expected) in [(SQUARES.to_owned(), BLOCKED), (SQUARES.replace("O 3", "! 3"), FREE)] {
        let output = factors(&text, &["--area", "1e-8", "--format", "view3d"]);
        let lines: Vec<&str> = output.lines().collect();
        assert_eq!(lines[0].len(), 30);
        assert_eq!(lines[0].split_whitespace().collect::<Vec<_>>(), ["View3D", "4.0", "0", "0", "0", "2"]);
        let numbers = |line: &str| -> Vec<f64> { line.split(' ').map(|n| n.parse().unwrap()).collect() };
        assert_eq!(numbers(lines[1]), [1.0, 1.0]);
        let (first, second) = (numbers(lines[2]), numbers(lines[3]));
        assert_eq!((first[0], second[1]), (0.0, 0.0));
        assert!((first[1] - expected).abs() < 1e-8 && (second[0] - expected).abs() < 1e-8, "{output}");
        assert_eq!(numbers(lines[4]), [0.5, 0.9]);
        assert_eq!(lines.len(), 5);
    }
}

/// Three triangles, the last between the others and with a vertex in common with the first, of which View3D 4.0 says
/// 1.3115 (uDALES, issue 359). By Monte Carlo with 40 million rays F(source -> receiver) is 0.753721 ± 0.000068, and
/// 0.763915 ± 0.000067 without the third.
const TRIANGLES: &str = "\
F 3
V 1 2217.833008 1853.818848 0
V 2 2217.506348 1853.365601 0
V 3 2217.833008 1853.818848 66.900002
V 4 2218.230957 1854.916382 0
V 5 2218.230957 1854.916382 66.900002
V 6 2201.107910 1845.251709 66.900002
V 7 2217.864990 1854.129883 0
V 8 2217.864990 1854.129883 66.900002
S 1 1 2 3 0 0 0 0.5 source
S 2 4 5 6 0 0 0 0.5 receiver
S 3 7 1 8 0 0 0 0.5 obstructor
End
";

#[test]
fn a_shared_vertex_does_not_matter() {
    let to_receiver = |text: &str| {
        let output = factors(text, &["--row", "source", "--area", "1e-5", "--json"]);
        let row = serde_json::from_str::<Value>(&output).unwrap()["rows"][0].clone();
        let mut factors = row["factors"].as_array().unwrap().iter();
        factors.find(|factor| factor["name"] == "receiver").unwrap()["form_factor"].as_f64().unwrap()
    };
    assert!((to_receiver(TRIANGLES) - 0.753_721).abs() < 3.0 * 0.000_068);
    assert!((to_receiver(&TRIANGLES.replace("S 3", "! 3")) - 0.763_915).abs() < 3.0 * 0.000_067);
}

#[test]
fn a_closed_room_has_rows_of_one() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("room.dae");
    let file = file.to_str().unwrap();
    assert_eq!(radiosity(&["scene", "furnace", "-o", file]).0, Some(0));
    for area in [&["--area", "1e-9"][..], &[]] {
        let (code, stdout, _) = radiosity(&[&["factors", file, "--json"], area].concat());
        assert_eq!(code, Some(0));
        let rows = serde_json::from_str::<Value>(&stdout).unwrap()["rows"].as_array().unwrap().clone();
        assert_eq!(rows.len(), 6);
        for row in &rows {
            assert!((row["sum"].as_f64().unwrap() - 1.0).abs() < 2e-9, "{row}");
            assert_eq!(row["area"], 1.0);
        }
    }
}

#[test]
fn a_row_is_that_row_of_the_matrix() {
    let matrix: Value = serde_json::from_str(&factors(SQUARES, &["--area", "1e-6", "--json"])).unwrap();
    let row: Value =
        serde_json::from_str(&factors(SQUARES, &["--row", "high", "--area", "1e-6", "--json"])).unwrap();
    assert_eq!(matrix["rows"].as_array().unwrap().len(), 2, "what only blocks has no row");
    assert_eq!(row["rows"][0], matrix["rows"][1]);
    assert_eq!((&row["rows"][0]["from"], &row["rows"][0]["number"]), (&"high".into(), &2.into()));
}

#[test]
fn tables_name_and_number_both_ends() {
    let csv = factors(SQUARES, &["--format", "csv"]);
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["from_number", "from", "to_number", "to", "form_factor", "error", "row_sum"]);
    assert_eq!(lines[1][..4], ["1", "low", "2", "high"]);
    let text = factors(SQUARES, &[]);
    assert!(text.contains("from 1 low") && text.contains("2 high") && text.contains("sum"));
}

#[test]
fn from_the_middle_the_factor_is_the_closed_form() {
    // The middle of the lower square sees the upper one, without the obstruction, as four corners:
    // F = 4/2π · (a/√(1+a²) · atan(a/√(1+a²)) · 2) with a = 1/2.
    let free = SQUARES.replace("O 3", "! 3");
    let row: Value = serde_json::from_str(&factors(&free, &["--row", "low", "--json"])).unwrap();
    let side = 0.5 / 1.25_f64.sqrt();
    let expected = 4.0 / std::f64::consts::TAU * 2.0 * side * side.atan();
    let found = row["rows"][0]["sum"].as_f64().unwrap();
    assert!((found - expected).abs() < 1e-14, "{found} {expected}");
}

#[test]
fn wrong_usage_is_2() {
    let cases: [&[&str]; 5] = [
        &["--format", "view3d"],
        &["--format", "view3d", "--area", "1e-3", "--row", "floor"],
        &["--row", "no-such-patch"],
        &["--area", "0"],
        &["--on", "floor"],
    ];
    for arguments in cases {
        let (code, stdout, stderr) = radiosity(&[&["factors", "scenes/cornell-box.dae"], arguments].concat());
        assert_eq!(code, Some(2), "{arguments:?}: {stderr}");
        assert!(stdout.is_empty() && !stderr.is_empty());
    }
}

#[test]
fn every_shell_is_completed() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let (code, script, _) = radiosity(&["completions", shell]);
        assert_eq!(code, Some(0));
        assert!(script.contains("radiosity") && script.contains("inspect"), "{shell}");
    }
}
