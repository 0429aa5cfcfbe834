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
        let output = factors(&text, &["--area", "1e-7", "--format", "view3d"]);
        let lines: Vec<&str> = output.lines().collect();
        assert_eq!(lines[0].len(), 30);
        assert_eq!(lines[0].split_whitespace().collect::<Vec<_>>(), ["View3D", "4.0.0", "0", "0", "0", "2"]);
        let numbers = |line: &str| -> Vec<f64> { line.split(' ').map(|n| n.parse().unwrap()).collect() };
        assert_eq!(numbers(lines[1]), [1.0, 1.0]);
        let (first, second) = (numbers(lines[2]), numbers(lines[3]));
        assert_eq!((first[0], second[1]), (0.0, 0.0));
        assert!((first[1] - expected).abs() < 1e-6 && (second[0] - expected).abs() < 1e-6, "{output}");
        assert_eq!((lines[1], lines[4]), ("1 1", "0.500 0.900"));
        assert!(lines[2].starts_with("0.000000 0."), "{output}");
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

/// A room of 2 by 3 by 2.5 whose long walls are one surface, one of them in two pieces.
const ROOM: &str = "\
C encl=1 list=0
F 3
V 1 0 0 0
V 2 2 0 0
V 3 2 3 0
V 4 0 3 0
V 5 0 0 2.5
V 6 2 0 2.5
V 7 2 3 2.5
V 8 0 3 2.5
V 9 0 1 0
V 10 0 1 2.5
S 1 1 2 3 4 0 0 .9 floor
S 2 2 1 5 6 0 0 .8 south
S 3 4 3 7 8 0 0 .7 north
S 4 3 2 6 7 0 0 .6 long
S 5 1 9 10 5 0 4 .5 west-1
S 6 9 4 8 10 0 4 .4 west-2
S 7 6 5 8 7 0 0 .3 roof
";

/// The rows of View3D's format, header first.
fn view3d(text: &str, arguments: &[&str]) -> (String, Vec<Vec<f64>>) {
    let output = factors(text, &[&["--area", "1e-4", "--format", "view3d"], arguments].concat());
    let (header, rest) = output.split_once('\n').unwrap();
    let numbers = |line: &str| line.split(' ').map(|n| n.parse().unwrap()).collect();
    (header.trim().to_owned(), rest.lines().map(numbers).collect())
}

#[test]
fn combined_surfaces_are_one_and_enclosures_are_closed() {
    let (header, lines) = view3d(ROOM, &[]);
    assert_eq!(header, "View3D 4.0.0 0 1 0 5");
    assert_eq!(lines[0], [6.0, 5.0, 5.0, 15.0, 6.0]);
    assert_eq!(lines[6], [0.9, 0.8, 0.7, 0.6, 0.3]);
    for row in &lines[1..6] {
        assert!((row.iter().sum::<f64>() - 1.0).abs() < 4e-6, "{row:?}");
    }
    // Long wall to long wall stands in the diagonal.
    let (header, apart) = view3d(&ROOM.replace("0 4 .", "0 0 .").replace("encl=1", "encl=0"), &[]);
    assert_eq!(header, "View3D 4.0.0 0 0 0 7");
    assert!((lines[4][3] - apart[4][4] - apart[4][5]).abs() < 3e-6, "{lines:?}");
    let (_, grouped) = view3d(&ROOM.replace("0 4 .", "0 0 ."), &["--group", "long,west-2, west-1"]);
    assert_eq!(grouped, lines);
}

#[test]
fn gray_surfaces_absorb_what_one_emits() {
    let (header, lines) = view3d(&ROOM.replace("list=0", "emit=1"), &[]);
    assert_eq!(header, "View3D 4.0.0 0 1 1 5");
    for (row, emittance) in lines[1..6].iter().zip(&lines[6]) {
        assert!((row.iter().sum::<f64>() - emittance).abs() < 4e-6, "{row:?}");
    }
    for (from, to) in [(0, 3), (1, 4), (3, 2)] {
        let [forth, back] =
            [(from, to), (to, from)].map(|(i, j): (usize, usize)| lines[0][i] * lines[i + 1][j]);
        assert!((forth - back).abs() < 2e-5, "{from} {to}");
    }
}

/// What a refused run says, and its code.
fn refused(text: &str, arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.vs3");
    std::fs::write(&file, text).unwrap();
    let (code, _, stderr) = radiosity(&[&["factors", file.to_str().unwrap()], arguments].concat());
    (code, stderr)
}

#[test]
fn what_cannot_be_done_is_refused_by_name() {
    let area = ["--area", "1e-3"];
    let open = ROOM.lines().filter(|line| !line.starts_with("S 7")).collect::<Vec<_>>().join("\n");
    let (code, stderr) = refused(&open, &area);
    assert_eq!(code, Some(3));
    assert!(stderr.contains("encl=1 in the file: row") && stderr.contains("is not closed"), "{stderr}");
    let (code, stderr) = refused(SQUARES, &[&area[..], &["--close"]].concat());
    assert_eq!(code, Some(3));
    assert!(stderr.contains("--close: row"), "{stderr}");
    let (code, stderr) = refused(&ROOM.replace("list=0", "emit=1").replace(" .9 ", " 0 "), &area);
    assert_eq!(code, Some(3));
    assert!(stderr.contains("emit=1: surface 0: its emittance"), "{stderr}");
    for (arguments, word) in [
        (&["--close"][..], "--area"),
        (&["--area", "1e-3", "--row", "floor", "--space", "sky"], "--area"),
        (&["--area", "1e-3", "--format", "npz"], "-o FILE.npz"),
        (&["--area", "1e-3", "--group", "floor,wall"], "no patch is named wall"),
        (&["--area", "1e-3", "--drop-below", "0"], "above 0"),
    ] {
        let (code, stderr) = refused(ROOM, arguments);
        assert_eq!(code, Some(2), "{arguments:?}");
        assert!(stderr.contains(word), "{arguments:?}: {stderr}");
    }
}

#[test]
fn what_escapes_has_a_name() {
    let csv = factors(SQUARES, &["--area", "1e-6", "--format", "csv", "--space", "sky"]);
    let sky: Vec<&str> = csv.lines().filter(|line| line.contains(",sky,")).collect();
    assert_eq!(sky.len(), 2, "{csv}");
    for line in sky {
        let fields: Vec<&str> = line.split(',').collect();
        // Blocks take a part of it.
        let value: f64 = fields[4].parse().unwrap();
        assert!(value > 0.5 && value < 1.0 - BLOCKED && fields[6] == "1", "{line}");
    }
}

#[test]
fn small_factors_go_on_request() {
    let entries = |more: &[&str]| {
        let csv = factors(
            &ROOM.replace("encl=1", "encl=0"),
            &[&["--area", "1e-6", "--format", "csv"], more].concat(),
        );
        let rows = csv.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        let number = |text: &String| text.parse::<f64>().unwrap();
        rows.map(|row| (number(&row[4]), number(&row[6]))).collect::<Vec<_>>()
    };
    let (all, few) = (entries(&[]), entries(&["--drop-below", "0.15"]));
    assert!(few.len() < all.len());
    assert!(few.iter().all(|(_, sum)| (sum - 1.0).abs() < 1e-5), "{few:?}");
}

#[test]
fn overlaps_are_named() {
    let text = ROOM.replace("S 7", "S 7 1 2 9 0 0 0 .5 rug\nS 8").replace("encl=1", "encl=0");
    let (code, stderr) = refused(&text, &["--area", "1e-3"]);
    assert_eq!(code, Some(0));
    assert!(
        stderr.contains("warning: floor and rug: they lie in one plane and cover each other"),
        "{stderr}"
    );
}

/// The data of an array of doubles in a `.npz` file.
fn doubles(file: &std::path::Path, name: &str) -> Vec<f64> {
    use std::io::Read;
    let mut archive = zip::ZipArchive::new(std::fs::File::open(file).unwrap()).unwrap();
    let mut bytes = Vec::new();
    archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    assert!(bytes.starts_with(b"\x93NUMPY\x01\x00") && bytes[10] == b'{');
    assert_eq!((start % 64, bytes[start - 1]), (0, b'\n'));
    bytes[start..].chunks(8).map(|number| f64::from_le_bytes(number.try_into().unwrap())).collect()
}

#[test]
fn npz_holds_the_matrix() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("room.vs3"), folder.path().join("room.npz"));
    std::fs::write(&scene, ROOM).unwrap();
    let [scene, file] = [&scene, &out].map(|path| path.to_str().unwrap());
    let (code, _, stderr) = radiosity(&["factors", scene, "--area", "1e-4", "--format", "npz", "-o", file]);
    assert_eq!(code, Some(0), "{stderr}");
    let (data, areas) = (doubles(&out, "data"), doubles(&out, "areas"));
    assert!((data.iter().sum::<f64>() - 5.0).abs() < 1e-12, "five rows that add to 1: {data:?}");
    assert_eq!(areas, [6.0, 5.0, 5.0, 15.0, 6.0]);
    assert_eq!(doubles(&out, "errors").len(), data.len());
    assert_eq!(doubles(&out, "emittances"), [0.9, 0.8, 0.7, 0.6, 0.3].map(|e: f64| 1.0 - (1.0 - e)));
}

/// A closed room full of small boxes, for which the matrix takes a while.
fn crowded() -> String {
    let mut text = String::from("F 3\n");
    let (mut vertices, mut surfaces) = (0, 0);
    let mut faces = String::new();
    let mut add = |low: [f64; 3], high: [f64; 3], inside: bool| {
        for corner in 0..8 {
            let at = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
            text += &format!("V {} {} {} {}\n", vertices + corner + 1, at(0), at(1), at(2));
        }
        for quad in [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]] {
            let mut quad = quad.map(|corner| vertices + corner + 1);
            if !inside {
                quad.reverse();
            }
            surfaces += 1;
            let [a, b, c, d] = quad;
            faces += &format!("S {surfaces} {a} {b} {c} {d} 0 0 .9 f{surfaces}\n");
        }
        vertices += 8;
    };
    add([0.0; 3], [10.0; 3], true);
    for i in 0..4_u32 {
        let low = [1.0 + 3.0 * f64::from(i % 3), 1.0 + 3.0 * f64::from(i / 3), 1.0 + 0.7 * f64::from(i)];
        add(low, low.map(|x| x + 1.3), false);
    }
    text + &faces
}

/// Runs until it has ended by itself or the journal has so many bytes, and is killed then; whether it ended.
#[cfg(unix)]
fn killed_at(scene: &str, out: &std::path::Path, bytes: u64, jobs: &str) -> bool {
    let mut child = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args([
            "-j",
            jobs,
            "factors",
            scene,
            "--area",
            "1e-5",
            "--format",
            "csv",
            "-o",
            out.to_str().unwrap(),
        ])
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let journal = format!("{}.rows", out.display());
    loop {
        if child.try_wait().unwrap().is_some() {
            return true;
        }
        if std::fs::metadata(&journal).is_ok_and(|file| file.len() > bytes) {
            child.kill().unwrap();
            child.wait().unwrap();
            return false;
        }
    }
}

#[cfg(unix)]
#[test]
fn a_killed_run_goes_on_and_ends_with_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("crowded.vs3");
    std::fs::write(&scene, crowded()).unwrap();
    let scene = scene.to_str().unwrap();
    let [whole, killed] = ["whole.csv", "killed.csv"].map(|name| folder.path().join(name));
    assert!(killed_at(scene, &whole, u64::MAX, "1"));
    assert!(!folder.path().join("whole.csv.rows").exists(), "a run that ends needs no journal");
    assert!(!killed_at(scene, &killed, 1000, "2"), "it ended before it was killed");
    let rows = folder.path().join("killed.csv.rows");
    // A kill may cut a row short.
    let cut = std::fs::read(&rows).unwrap();
    std::fs::write(&rows, &cut[..cut.len() - 3]).unwrap();
    let again =
        radiosity(&["factors", scene, "--area", "1e-5", "--format", "csv", "-o", killed.to_str().unwrap()]);
    assert!(again.2.contains("going on: ") && again.0 == Some(0), "{}", again.2);
    assert_eq!(std::fs::read(&killed).unwrap(), std::fs::read(&whole).unwrap());
}

#[test]
fn a_run_that_takes_too_long_stops_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("crowded.vs3"), folder.path().join("out.csv"));
    std::fs::write(&scene, crowded()).unwrap();
    let [scene, file] = [&scene, &out].map(|path| path.to_str().unwrap());
    let (code, _, stderr) =
        radiosity(&["factors", scene, "--area", "1e-7", "--time", "0.05", "--format", "csv", "-o", file]);
    assert_eq!(code, Some(4), "{stderr}");
    assert!(stderr.contains("stopped: ") && stderr.contains("the same command goes on"), "{stderr}");
    assert!(!out.exists(), "a file is whole or not there");
}

#[test]
fn files_that_are_no_journals_stay() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, out, notes] = ["room.vs3", "out.csv", "out.csv.rows"].map(|name| folder.path().join(name));
    std::fs::write(&scene, ROOM).unwrap();
    std::fs::write(&notes, "my notes").unwrap();
    let run = |more: &[&str]| {
        let named = [&scene, &out].map(|path| path.to_str().unwrap());
        radiosity(&[&["factors", named[0], "-o", named[1]], more].concat())
    };
    assert_eq!(run(&[]).0, Some(0), "rows from middles need no journal");
    let (code, _, stderr) = run(&["--area", "1e-3"]);
    assert_eq!(code, Some(1));
    assert!(stderr.contains("out.csv.rows: no journal of rows"), "{stderr}");
    assert_eq!(std::fs::read(&notes).unwrap(), b"my notes");
}
