//! What people expect of any program: pipes, lists, numbers below zero, nothing left behind.

use serde_json::Value;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn radiosity(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // One that refuses its arguments does not read.
    let _ = program.stdin.take().expect("a pipe").write_all(input);
    program.wait_with_output().expect("the program ends")
}

fn done(output: Output) -> Vec<u8> {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

#[test]
fn scenes_and_results_go_through_pipes() {
    let folder = folder();
    let run = |arguments: &[&str], input: &[u8]| done(radiosity(folder.path(), arguments, input));
    let scene = run(&["scene", "wall"], b"");
    let solve = ["solve", "-", "--quality", "draft", "-o", "-"];
    let solution = run(&solve, &scene);
    let light: Value = serde_json::from_slice(&solution).expect("everything, as JSON");
    assert_eq!(light["light"]["patches"].as_array().map(Vec::len), Some(3));
    for (format, start) in [
        ("png", &b"\x89PNG"[..]),
        ("glb", b"glTF"),
        ("ply", b"ply\n"),
        ("obj", b"#"),
        ("dae", b"<?xml"),
        ("html", b"<!"),
    ] {
        let written = run(&[&solve[..], &["--format", format]].concat(), &scene);
        assert!(written.starts_with(start), "{format}");
    }
    assert!(run(&["expose", "-", "-o", "-"], &solution).starts_with(b"\x89PNG"));
    assert!(run(&["view", "-"], &solution).starts_with(b"<!"));
    assert!(
        String::from_utf8_lossy(&run(&["inspect", "-"], &scene)).contains("patches    3 with 12 vertices")
    );
    assert!(
        String::from_utf8_lossy(&run(&["factors", "-", "--format", "csv", "-o", "-"], &scene))
            .starts_with("from_number")
    );
    assert_eq!(std::fs::read_dir(folder.path()).expect("the folder").count(), 0, "nothing is written beside");
}

#[test]
fn stdout_takes_one_result() {
    let folder = folder();
    let scene = done(radiosity(folder.path(), &["scene", "wall"], b""));
    for more in [&["-o", "-"][..], &["--json"], &["--snapshot-every", "1"], &["--format", "xyz"]] {
        let message =
            refused(&radiosity(folder.path(), &[&["solve", "-", "-o", "-"][..], more].concat(), &scene));
        assert!(message.contains("stdout") || message.contains("unknown kind"), "{message}");
    }
}

#[test]
fn scenes_are_listed_and_written_by_the_extension() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    let list = String::from_utf8(done(run(&["scene", "--list"]))).expect("text");
    assert!(list.lines().count() >= 16 && list.lines().all(|line| line.len() > 20), "{list}");
    assert!(list.lines().any(|line| line.starts_with("cornell-box ")));
    for (name, start) in [
        ("a.glb", &b"glTF"[..]),
        ("a.obj", b"#"),
        ("a.ply", b"ply\n"),
        ("a.stl", b"radiosity"),
        ("a.dae", b"<?xml"),
    ] {
        let output = run(&["scene", "perforated", "-o", name]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        done(output);
        assert!(std::fs::read(folder.path().join(name)).expect("written").starts_with(start), "{name}");
        assert_eq!(
            told.contains("has no place for emitted light"),
            matches!(name, "a.ply" | "a.stl"),
            "{name}: {told}"
        );
        let inspected = String::from_utf8(done(run(&["inspect", name]))).expect("text");
        assert!(inspected.starts_with("patches"), "{inspected}");
    }
    assert!(folder.path().join("a.mtl").exists());
    assert!(refused(&run(&["scene", "wall", "-o", "wall.xyz"])).contains("name it .dae, .glb"));
    assert!(refused(&run(&["scene"])).contains("--list"));
}

#[test]
fn a_number_below_zero_is_a_value() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    for arguments in [
        ["solve", "a.dae", "--json", "--tolerance", "-1"],
        ["solve", "a.dae", "--json", "--time", "-0.5"],
        ["solve", "a.dae", "--json", "-k", "-1e3"],
        ["solve", "a.dae", "--json", "--elements", "-5"],
        ["expose", "a.json", "-oa.png", "-k", "-2"],
        ["factors", "a.dae", "--json", "--area", "-1"],
        ["solve", "a.dae", "--json", "--error", "-1%"],
        ["solve", "a.dae", "--json", "--sky", "-.5,"],
        ["solve", "a.dae", "--json", "--time", "-inf"],
        ["solve", "a.dae", "--json", "-k", "-1x"],
    ] {
        let message = refused(&run(&arguments));
        assert!(message.contains(&format!("invalid value '{}'", arguments[4])), "{message}");
    }
    done(run(&["scene", "wall", "-o", "wall.dae"]));
    let places = run(&["factors", "wall.dae", "--from", "-0.1,0.5,0.5,1,0,0"]);
    assert!(places.status.success(), "{}", String::from_utf8_lossy(&places.stderr));
}

#[test]
fn a_full_run_leaves_no_state() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    done(run(&["scene", "wall", "-o", "wall.dae"]));
    let stopped = run(&["solve", "wall.dae", "--method", "shoot", "--max-shots", "1", "-o", "a.json"]);
    assert_eq!(stopped.status.code(), Some(4));
    let state = folder.path().join("a.json.state");
    assert!(state.exists());
    done(run(&["solve", "wall.dae", "--method", "shoot", "-o", "a.json"]));
    assert!(!state.exists(), "the state of an earlier run is of no use any more");
    std::fs::write(&state, "my notes").expect("a file");
    done(run(&["solve", "wall.dae", "--method", "shoot", "-o", "a.json"]));
    assert_eq!(std::fs::read(&state).expect("still there"), b"my notes");
}

/// Named beside the first output of the run that was stopped; the run that goes on names others, or in another order.
#[test]
fn a_full_run_leaves_no_state_whatever_its_outputs_are_called() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    let names = |end: &str| {
        let all = std::fs::read_dir(folder.path()).expect("a folder");
        all.filter(|entry| entry.as_ref().expect("an entry").file_name().to_string_lossy().ends_with(end))
            .count()
    };
    done(run(&["scene", "wall", "-o", "wall.dae"]));
    let solve = |more: &[&str]| run(&[&["solve", "wall.dae", "--method", "shoot"], more].concat());
    let stop =
        || assert_eq!(solve(&["--max-shots", "1", "-o", "a.json", "-o", "a.png"]).status.code(), Some(4));
    for more in [&["-o", "a.png", "-o", "a.json"][..], &["--resume", "a.json.state", "-o", "b.json"]] {
        stop();
        assert_eq!(names(".state"), 1);
        done(solve(more));
        assert_eq!(names(".state"), 0, "{more:?}");
    }
    stop();
    done(solve(&["--resume", "a.json.state", "--json"]));
    assert_eq!(names(".state"), 1, "a run that writes no file takes none away");
}

#[test]
fn a_stopped_run_without_a_file_says_that_it_cannot_go_on() {
    let folder = folder();
    let scene = done(radiosity(folder.path(), &["scene", "wall"], b""));
    let solve = ["solve", "-", "--method", "shoot", "--max-shots", "1"];
    for (output, is_lost) in [(&["--json"][..], true), (&["-o", "-"], true), (&["-o", "a.json"], false)] {
        let stopped = radiosity(folder.path(), &[&solve, output].concat(), &scene);
        assert_eq!(stopped.status.code(), Some(4));
        let told = String::from_utf8_lossy(&stopped.stderr).into_owned();
        assert_eq!(told.contains("no state was written"), is_lost, "{told}");
        assert_eq!(told.contains("continue with --resume a.json.state"), !is_lost, "{told}");
    }
}

#[test]
fn what_was_left_out_is_told_in_one_line_and_in_the_json() {
    let folder = folder();
    let text = "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\nl 2 3\np 1\ncurv 0 1 1 2\n";
    std::fs::write(folder.path().join("a.obj"), text).expect("a file");
    let output = radiosity(folder.path(), &["solve", "a.obj", "--json", "--quality", "draft"], b"");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines: Vec<&str> = told.lines().filter(|line| line.contains("left out")).collect();
    assert!(
        lines.len() == 1 && lines[0].contains("(3 times)") && lines[0].contains("inspect a.obj"),
        "{told}"
    );
    let figures: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let places = |index: usize| figures["warnings"][index]["places"].as_array().map(Vec::len);
    assert_eq!((0..4).filter_map(places).collect::<Vec<_>>(), [1, 3, 1, 1], "{figures}");
}

/// At draft small form factors are taken roughly, which leaves the closure open; not for whoever asks for a bound.
#[test]
fn a_tolerance_takes_no_form_factor_roughly() {
    let folder = folder();
    done(radiosity(folder.path(), &["scene", "cornell-box", "-o", "box.dae"], b""));
    let closure = |more: &[&str]| {
        let draft = ["solve", "box.dae", "--quality", "draft", "--elements", "200", "--json"];
        let figures = done(radiosity(folder.path(), &[&draft, more].concat(), b""));
        serde_json::from_slice::<Value>(&figures).expect("JSON")["closure"].clone()
    };
    assert!(closure(&[]).is_null());
    assert!(closure(&["--tolerance", "0.01"]).is_number());
}

#[test]
fn digits_are_those_of_the_file() {
    let folder = folder();
    let run =
        |arguments: &[&str]| String::from_utf8(done(radiosity(folder.path(), arguments, b""))).expect("text");
    let facet = |corners: &str| format!("facet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n");
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
    let mut bytes = ply.as_bytes().to_vec();
    for number in [0.1_f32, 0.2, 0.0, 0.9, 0.2, 0.0, 0.1, 0.7, 0.0] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend([3, 0, 1, 2]);
    std::fs::write(folder.path().join("a.ply"), bytes).expect("a file");
    let said = run(&["inspect", "a.ply"]);
    assert!(
        said.contains("[0.1, 0.2, 0] to [0.9, 0.7, 0]; the unit is 1 m") && said.contains("area 0.2\n"),
        "{said}"
    );
    let text = facet("vertex 0.1 0 0\nvertex 0.4 0 0\nvertex 0.1 0.7 0\n");
    std::fs::write(folder.path().join("a.stl"), format!("solid\n{text}endsolid\n")).expect("a file");
    assert!(run(&["inspect", "a.stl"]).contains("[0.1, 0, 0] to [0.4, 0.7, 0]"));
}

/// A hilly ground of so many squares each way, cut in triangles that no plane joins.
fn ground(count: usize) -> String {
    let row = |i: usize| (0..=count).map(move |j| (i, j));
    let vertex = |(i, j): (usize, usize)| format!("v {i} {j} {}\n", (i * i * 7 + i * j * 5 + j * j * 3) % 11);
    let number = |i: usize, j: usize| i * (count + 1) + j + 1;
    let square = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        format!("f {a} {b} {c}\nf {a} {c} {d}\n")
    };
    let vertices: String = (0..=count).flat_map(row).map(vertex).collect();
    let inner = (0..count).flat_map(row).filter(|(_, j)| *j < count);
    vertices + &inner.map(square).collect::<String>()
}

/// Half a million triangles take more than the moment that any file is given.
#[test]
fn a_file_that_takes_longer_to_read_than_there_is_time_is_not_waited_for() {
    let folder = folder();
    std::fs::write(folder.path().join("ground.obj"), ground(500)).expect("a file");
    let commands: [&[&str]; 3] = [
        &["inspect", "ground.obj"],
        &["solve", "ground.obj", "-o", "light.json"],
        &["factors", "ground.obj", "--area", "1e-3", "--row", "patch.1"],
    ];
    for command in commands {
        let late = radiosity(folder.path(), &[command, &["--time", "0.1"]].concat(), b"");
        let told = String::from_utf8_lossy(&late.stderr).into_owned();
        assert_eq!(late.status.code(), Some(4), "{command:?}: {told}");
        assert!(told.contains("the time was up before the scene was read"), "{command:?}: {told}");
    }
    let names: Vec<_> = std::fs::read_dir(folder.path()).expect("a folder").collect();
    assert_eq!(names.len(), 1);
}

/// Both take far longer: none of what they do before a row is found, nor rows that have not begun, goes on when the time is up.
#[test]
fn factors_of_a_large_scene_end_in_time() {
    let folder = folder();
    std::fs::write(folder.path().join("ground.obj"), ground(100)).expect("a file");
    for more in [&["--area", "1e-3"][..], &[]] {
        let start = Instant::now();
        let late = radiosity(folder.path(), &[&["factors", "ground.obj", "--time", "4"], more].concat(), b"");
        let told = String::from_utf8_lossy(&late.stderr).into_owned();
        assert_eq!(late.status.code(), Some(4), "{more:?}: {told}");
        assert!(start.elapsed() < Duration::from_secs(10), "{more:?}: {:?}", start.elapsed());
        assert!(late.stdout.is_empty());
    }
}

/// The solution comes through a pipe that nobody closes.
#[test]
fn view_does_not_wait_for_longer_than_there_is_time() {
    let mut program = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(["view", "-", "--time", "0.6"])
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let pipe = program.stdin.take().expect("a pipe");
    let (start, mut ended) = (Instant::now(), None);
    while ended.is_none() && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(20));
        ended = program.try_wait().expect("a child");
    }
    drop(pipe);
    let _ = program.wait();
    assert_eq!(ended.and_then(|status| status.code()), Some(4));
}

#[test]
fn a_run_that_was_stopped_before_light_was_looked_for_does_not_call_the_scene_dark() {
    let folder = folder();
    std::fs::write(folder.path().join("ground.obj"), ground(5)).expect("a file");
    let solve = ["solve", "ground.obj", "--method", "mesh", "--json", "--sky"];
    let told = |more: &[&str]| {
        let output = radiosity(folder.path(), &[&solve, more].concat(), b"");
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let (code, stopped) = told(&["uniform", "--time", "1e-9"]);
    assert!(code == Some(4) && !stopped.contains("dark"), "{stopped}");
    let (code, dark) = told(&["none"]);
    assert!(code == Some(0) && dark.contains("so the scene is dark"), "{dark}");
}

/// `--emit` names a material.
#[test]
fn a_scene_without_materials_is_not_told_to_let_one_emit() {
    let folder = folder();
    let text = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    std::fs::write(folder.path().join("a.stl"), text).expect("a file");
    let face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\n";
    std::fs::write(folder.path().join("a.obj"), format!("mtllib a.mtl\n{face}")).expect("a file");
    std::fs::write(folder.path().join("a.mtl"), "newmtl wall\nKd 0.5 0.5 0.5\n").expect("a file");
    // Names a material that is nowhere.
    std::fs::write(folder.path().join("b.obj"), face).expect("a file");
    for (name, has_materials) in [("a.stl", false), ("a.obj", true), ("b.obj", false)] {
        for more in
            [&["solve", name, "--json"][..], &["solve", name, "--json", "--sky", "none"], &["inspect", name]]
        {
            let output = radiosity(folder.path(), more, b"");
            let told = [&output.stderr[..], &output.stdout].concat();
            let told = String::from_utf8_lossy(&told).into_owned();
            done(output);
            assert_eq!(told.contains("--emit"), has_materials, "{more:?}: {told}");
            assert!(told.contains("--sky"), "{more:?}: {told}");
        }
    }
}

/// What is shown is cut further than what is solved for; the page and the JSON count the pieces.
#[test]
fn the_last_line_counts_elements_as_the_page_does() {
    let folder = folder();
    done(radiosity(folder.path(), &["scene", "cornell-box", "-o", "box.dae"], b""));
    let output = radiosity(folder.path(), &["solve", "box.dae", "--quality", "draft", "--json"], b"");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let figures: Value = serde_json::from_slice(&done(output)).expect("JSON");
    let shown = figures["elements"].as_u64().expect("a number");
    assert!(told.contains(&format!(" elements shown as {shown}, ")), "{told}");
}

#[test]
fn more_threads_than_a_machine_has_use_for_are_not_started() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let output = radiosity(folder.path(), &["-j", "60000", "scene", "cube", "-o", "cube.dae"], b"");
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("-j 60000"));
    assert!(folder.path().join("cube.dae").exists());
}

#[test]
fn a_mark_before_the_text_of_obj_and_mtl_loses_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let text = "\u{feff}mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl lamp\nf 1 2 3\n";
    std::fs::write(folder.path().join("a.obj"), text).expect("a file");
    std::fs::write(folder.path().join("a.mtl"), "\u{feff}newmtl lamp\nKe 1 1 1\n").expect("a file");
    let output = done(radiosity(folder.path(), &["inspect", "a.obj"], b""));
    let text = String::from_utf8_lossy(&output);
    assert!(text.lines().any(|line| line.starts_with("emitter")), "{text}");
}

/// What stands in the files before and after.
fn unchanged(folder: &Path, files: &[&str], arguments: &[&str]) -> String {
    let read =
        || files.iter().map(|file| std::fs::read(folder.join(file)).expect("a file")).collect::<Vec<_>>();
    let count = || std::fs::read_dir(folder).expect("a folder").count();
    let before = (read(), count());
    let message = refused(&radiosity(folder, arguments, b""));
    assert!(before == (read(), count()), "{arguments:?}");
    assert_eq!(message.lines().count(), 1, "{message}");
    message
}

#[cfg(unix)]
#[test]
fn an_output_that_is_an_input_is_refused() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    for name in ["a.dae", "a.obj", "a.glb"] {
        done(run(&["scene", "wall", "-o", name]));
        std::os::unix::fs::symlink(name, folder.path().join(format!("to-{name}"))).expect("a link");
    }
    done(run(&["solve", "a.dae", "--quality", "draft", "-o", "a.json", "-o", "a.png"]));
    let cases: [&[&str]; 11] = [
        &["solve", "a.obj", "-o", "a.obj"],
        &["solve", "a.glb", "-o", "./a.glb"],
        &["solve", "a.glb", "-o", "b.png", "-o", "to-a.glb"],
        &["solve", "to-a.dae", "-o", "a.dae"],
        &["solve", "a.dae", "--json", "--steps", "a.dae"],
        &["solve", "a.dae", "-o", "a.obj", "--photometry", "lamp=a.obj"],
        &["solve", "a.dae", "--resume", "a.json", "-o", "a.json"],
        &["factors", "a.dae", "-o", "a.dae"],
        &["inspect", "a.obj", "--repair", "-o", "a.obj"],
        &["view", "a.json", "-o", "a.json"],
        &["expose", "a.glb", "-o", "a.glb"],
    ];
    for arguments in cases {
        let message = unchanged(folder.path(), &["a.dae", "a.obj", "a.glb", "a.json"], arguments);
        let is_kind = arguments[0] == "view" && message.contains("name it .html");
        assert!(message.contains("it is an input") || is_kind, "{arguments:?}: {message}");
    }
    for name in ["a.dae", "a.glb"] {
        done(run(&["inspect", name, "--repair", "-o", name]));
    }
}

#[test]
fn outputs_that_are_one_file_are_refused() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    done(run(&["scene", "wall", "-o", "a.dae"]));
    let cases: [&[&str]; 4] = [
        &["-o", "q.json", "--steps", "q.json"],
        &["-o", "q.json", "-o", "q.json"],
        &["-o", "q.json", "-o", "./q.json"],
        &["-o", "q.json", "--steps", "q.json.state"],
    ];
    for outputs in cases {
        let message = unchanged(folder.path(), &["a.dae"], &[&["solve", "a.dae"], outputs].concat());
        assert!(message.contains("two outputs go to this file"), "{message}");
    }
    if cfg!(unix) {
        let null = ["-o", "/dev/null", "--format", "json", "--steps", "/dev/null"];
        assert!(
            !String::from_utf8_lossy(&run(&[&["solve", "a.dae"], &null[..]].concat()).stderr)
                .contains("two outputs")
        );
    }
}

/// An OBJ file is written with materials of its name beside it.
#[test]
fn materials_of_other_files_stay() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    let put = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    put("a.mtl", "newmtl mine\nKd 0.1 0.2 0.3\n");
    put("b.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl mine\nf 1 2 3\n");
    for arguments in [&["scene", "wall", "-o", "a.obj"][..], &["inspect", "b.obj", "--repair", "-o", "a.obj"]]
    {
        let message = unchanged(folder.path(), &["a.mtl", "b.obj"], arguments);
        assert!(message.starts_with("error: a.mtl: a.obj needs a file of this name"), "{message}");
    }
    // A file that names them is replaced with them.
    for _ in 0..2 {
        done(run(&["scene", "wall", "-o", "c.obj"]));
    }
    assert!(folder.path().join("c.mtl").exists());
}

/// The chessboard's picture stands beside its OBJ file.
#[test]
fn pictures_beside_obj_files_stay() {
    let folder = folder();
    let run = |arguments: &[&str]| radiosity(folder.path(), arguments, b"");
    for _ in 0..2 {
        done(run(&["scene", "chessboard", "-o", "a.obj"]));
    }
    let listed =
        std::fs::read_dir(folder.path()).expect("a folder").map(|entry| entry.expect("one").file_name());
    let pictures: Vec<String> = listed.filter_map(|name| name.into_string().ok()).collect();
    let picture = pictures.iter().find(|name| name.ends_with(".png")).expect("a picture").as_str();
    let message = unchanged(folder.path(), &["a.obj", picture], &["solve", "a.obj", "-o", picture]);
    assert!(message.contains("it is a picture of the scene"), "{message}");
    let other = picture.replacen('a', "b", 1);
    std::fs::write(folder.path().join(&other), "mine").expect("a file");
    let refused = run(&["scene", "chessboard", "-o", "b.obj"]);
    let message = String::from_utf8_lossy(&refused.stderr);
    assert!(refused.status.code() == Some(1) && message.contains("may belong to another file"), "{message}");
    assert_eq!(std::fs::read(folder.path().join(&other)).expect("the file"), b"mine");
    assert!(!folder.path().join("b.obj").exists() && !folder.path().join("b.mtl").exists());
}

/// Messages go to a full disk, or to a reader that has gone: the result is written, and the exit code is that of the run.
#[cfg(target_os = "linux")]
#[test]
fn messages_that_cannot_be_written_cost_nothing() {
    let folder = folder();
    done(radiosity(folder.path(), &["scene", "wall", "-o", "a.dae"], b""));
    let stopped = "solve a.dae --method shoot --max-shots 1 -o a.json";
    for (line, code) in
        [("solve a.dae -o a.json", 0), (stopped, 4), ("solve none.dae -o b.json", 1), ("solve a.dae", 2)]
    {
        for stderr in ["2> /dev/full", "2>&-"] {
            let script = format!("exec \"$0\" {line} {stderr}");
            let shell = Command::new("sh")
                .args(["-c", &script, env!("CARGO_BIN_EXE_radiosity")])
                .current_dir(folder.path())
                .status();
            assert_eq!(shell.expect("a shell").code(), Some(code), "{line} {stderr}");
            let _ = std::fs::remove_file(folder.path().join("b.json"));
            let is_written = std::fs::remove_file(folder.path().join("a.json")).is_ok();
            assert_eq!(is_written, line.ends_with("-o a.json"), "{line} {stderr}");
        }
    }
    let full = Command::new("sh")
        .args(["-c", "exec \"$0\" scene wall > /dev/full", env!("CARGO_BIN_EXE_radiosity")])
        .output();
    let full = full.expect("a shell");
    assert_eq!(full.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&full.stderr).starts_with("error: stdout cannot be written"));
}
