//! The program as a user meets it: exit codes, what is on stdout, what is written and what is not.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Small enough to be quick, and all that the Cornell box has: a split wall, a hole, blocks, colours.
const SOLVE: [&str; 6] = ["solve", "scenes/cornell-box.dae", "--elements", "300", "--tolerance", "1e-2"];

fn radiosity(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(arguments)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../radiosity"))
        .output()
        .expect("the program starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("one JSON object and nothing else on stdout")
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|n| n.as_f64().expect("a number")).collect()
}

/// A folder of its own, and the files in it.
struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Folder {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn put(&self, name: &str, text: &str) -> String {
        std::fs::write(self.path(name), text).expect("a temporary file");
        text_of(&self.path(name))
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("the folder");
        let mut names: Vec<_> =
            entries.map(|e| e.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

fn text_of(path: &Path) -> String {
    path.to_str().expect("a temporary path is UTF-8").to_owned()
}

#[test]
fn options_that_the_method_would_ignore_are_refused() {
    let solve = ["solve", "scenes/cornell-box.dae", "--json"];
    for unused in [["--elements", "300"], ["--shadows", "2"], ["--hemicube", "64"], ["--spread", "0.1"]] {
        let output = radiosity(&[&solve[..], &["--method", "hierarchical"], &unused].concat());
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(unused[0]), "{}", stderr(&output));
    }
    let shoot = radiosity(&[&solve[..], &["--error", "1%", "--method", "shoot"]].concat());
    assert_eq!(code(&shoot), 2);
    assert!(stderr(&shoot).contains("--method hierarchical"), "{}", stderr(&shoot));
    let both = radiosity(&[&solve[..], &["--error", "1%", "--elements", "300"]].concat());
    assert_eq!(code(&both), 2);
    assert!(stderr(&both).contains("--elements and --error"), "{}", stderr(&both));
}

#[test]
fn light_for_a_camera_says_what_it_sees() {
    let solve = ["solve", "scenes/cornell-box.dae", "--json", "--for-camera"];
    let corner = ["--camera", "278,273,-700,500,30,300,8", "--error", "10%"];
    let output = radiosity(&[&solve[..], &corner].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("light of what the camera sees within"), "{}", stderr(&output));
    let figures = json(&output);
    assert!(figures["transfers"]["occluded"].as_u64() > Some(0), "{}", figures["transfers"]);
    let patches = figures["patches"].as_array().expect("patches");
    let seen = patches.iter().filter(|patch| patch["in_view"] == true).map(|patch| patch["name"].as_str());
    let seen: Vec<&str> = seen.flatten().collect();
    assert!(seen.contains(&"floor") && !seen.contains(&"ceiling"), "{seen:?}");
    for (option, said) in [
        (["--method", "shoot"], "--for-camera needs --method hierarchical"),
        (["--elements", "300"], "--elements and --for-camera do not go together"),
        (["--camera", "nobody"], "no camera is named nobody"),
        (["--camera", "0,0,0,0,0,-1"], "it sees the front of no surface"),
    ] {
        let refused = radiosity(&[&solve[..], &option].concat());
        assert!(code(&refused) > 1 && stderr(&refused).contains(said), "{}", stderr(&refused));
    }
}

#[test]
fn a_scene_is_solved_by_levels_but_where_a_mesh_is_asked_for() {
    let cases: [(&[&str], bool); 4] = [
        (&["--quality", "draft"], true),
        (&["--error", "10%"], true),
        (&["--elements", "100"], false),
        (&["--method", "mesh", "--quality", "draft", "--tolerance", "0.5"], false),
    ];
    for (options, is_by_levels) in cases {
        let output = radiosity(&[&["solve", "scenes/cornell-box.dae", "--json"], options].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert_eq!(stderr(&output).contains("light within"), is_by_levels, "{options:?}");
        let floor = &json(&output)["patches"][0];
        assert_eq!(floor["estimate"].is_array(), is_by_levels, "{options:?}: {floor}");
    }
}

#[test]
fn solve_prints_the_figures_and_writes_every_kind_of_file() {
    let folder = Folder::new();
    let files: Vec<String> = ["a.png", "a.dae", "a.glb", "a.json", "a.csv", "a.elements.csv", "a.html"]
        .map(|n| text_of(&folder.path(n)))
        .to_vec();
    let mut arguments = SOLVE.to_vec();
    for file in &files {
        arguments.extend(["-o", file]);
    }
    arguments.extend(["--json", "-j", "2"]);
    let output = radiosity(&arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert_eq!(folder.names(), ["a.csv", "a.dae", "a.elements.csv", "a.glb", "a.html", "a.json", "a.png"]);
    assert!(std::fs::read(&files[0]).expect("a picture").starts_with(b"\x89PNG\r\n\x1a\n"));
    assert!(std::fs::read(&files[2]).expect("a GLB").starts_with(b"glTF"));
    let mut written: Value =
        serde_json::from_slice(&std::fs::read(&files[3]).expect("a solution")).expect("JSON");
    let light = written.as_object_mut().expect("an object").remove("light").expect("the light");
    assert_eq!(written, json(&output), "the figures stand beside the light");
    assert_eq!(light["elements"].as_array().expect("elements").len(), written["elements"]);

    let figures = json(&output);
    for key in ["scene", "elements", "shots", "seconds", "bound", "closure", "energy", "patches"] {
        assert!(!figures[key].is_null(), "{key} is missing");
    }
    for key in ["emitted", "absorbed", "escaped", "unshot", "defect"] {
        assert_eq!(numbers(&figures["energy"][key]).len(), 3, "{key}");
    }
    for (emitted, defect) in
        numbers(&figures["energy"]["emitted"]).iter().zip(numbers(&figures["energy"]["defect"]))
    {
        assert!(defect.abs() < 1e-9 * emitted);
    }
    let names: Vec<_> =
        figures["patches"].as_array().expect("patches").iter().map(|p| p["name"].clone()).collect();
    let expected = "floor ceiling back right left.1 left.2 light short-top short-1 short-2 short-3 short-4 \
                    tall-top tall-1 tall-2 tall-3 tall-4";
    assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
}

/// A solution in every kind of file.
fn solved(folder: &Folder, kinds: &[&str]) -> Vec<String> {
    let files: Vec<String> = kinds.iter().map(|kind| text_of(&folder.path(kind))).collect();
    let mut arguments = SOLVE.to_vec();
    files.iter().for_each(|file| arguments.extend(["-o", file]));
    let output = radiosity(&arguments);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    files
}

#[test]
fn a_recorded_run_is_kept_in_the_page_and_in_json_and_changes_nothing_else() {
    let folder = Folder::new();
    let solve = |name: &str, more: &[&str]| {
        let files = ["json", "html", "csv"].map(|end| text_of(&folder.path(&format!("{name}.{end}"))));
        let mut arguments = [&SOLVE[..], more].concat();
        files.iter().for_each(|file| arguments.extend(["-o", file]));
        let output = radiosity(&arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        files.map(|file| std::fs::read_to_string(file).expect("a file"))
    };
    let [plain, recorded] = [solve("plain", &[]), solve("recorded", &["--record"])];
    assert_eq!(plain[2], recorded[2], "another table");
    let [mut light, mut other] = [&plain[0], &recorded[0]]
        .map(|text| serde_json::from_str::<Value>(text).expect("JSON")["light"].take());
    let recording = other.as_object_mut().expect("an object").remove("recording").expect("the run");
    assert_eq!(light.as_object_mut().expect("an object").remove("recording"), None);
    assert!(light == other, "another light");
    let steps = recording["steps"].as_array().expect("steps");
    assert!(
        steps.len() > 20 && steps[0]["shooter"].is_array() && steps[steps.len() - 1]["kind"] == "solution"
    );
    assert!(!plain[1].contains("\"recording\":{") && recorded[1].contains("\"recording\":{"));
    // What was kept is there in a page that is made of it later.
    let [from, to] = ["recorded.json", "later.html"].map(|name| text_of(&folder.path(name)));
    assert_eq!(code(&radiosity(&["view", &from, "-o", &to])), 0);
    assert!(std::fs::read_to_string(&to).expect("a page").contains("\"recording\":{"));
    assert_eq!(code(&radiosity(&["solve", "scenes/cornell-box.dae", "--record", "--json"])), 2);
}

#[test]
fn tables_have_a_row_for_each_patch_and_element() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.csv", "a.elements.csv", "a.json"]);
    let [patches, elements] = [0, 1].map(|i| std::fs::read_to_string(&files[i]).expect("a table"));
    assert!(patches.starts_with("patch,area,reflectance.0,"));
    assert!(elements.starts_with("element,patch,x,y,z,area,irradiance.0,"));
    let written: Value =
        serde_json::from_slice(&std::fs::read(&files[2]).expect("a solution")).expect("JSON");
    assert_eq!(patches.lines().count(), 1 + 17);
    assert_eq!(elements.lines().count() as u64, 1 + written["elements"].as_u64().expect("a number"));
    let floor: Vec<&str> = patches.lines().nth(1).expect("the floor").split(',').collect();
    assert_eq!(floor[0], "floor");
    let mean = written["patches"][0]["radiosity"][0].as_f64().expect("a number");
    let header = patches.lines().next().expect("a header").split(',');
    let column = header.into_iter().position(|name| name == "radiosity.0").expect("a column");
    assert_eq!(floor[column].parse::<f64>().expect("a number"), mean);
}

#[test]
fn expose_on_a_written_solution_gives_what_solve_gives() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json", "a.png", "a.glb", "a.dae"]);
    let out = |name: &str| text_of(&folder.path(name));
    let expose = |from: &str, to: &str, more: &[&str]| {
        let output = radiosity(&[&["expose", from, "-o", to], more].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        std::fs::read(to).expect("an exposed solution")
    };
    let read = |file: &str| std::fs::read(file).expect("a file");
    assert_eq!(expose(&files[0], &out("b.png"), &["--auto"]), read(&files[1]));
    assert_eq!(expose(&files[0], &out("b.glb"), &[]), read(&files[2]));
    assert_ne!(expose(&files[0], &out("b.png"), &["-k", "0.01"]), read(&files[1]));
    // Exposed in place or from the solution: the same colours.
    let direct = expose(&files[0], &out("c.glb"), &["-k", "0.05"]);
    let in_place = expose(&files[2], &out("d.glb"), &["-k", "0.05"]);
    assert_eq!(direct.len(), in_place.len());
    let colours = expose(&files[3], &out("b.dae"), &["-k", "0.05"]);
    let (before, after) = (String::from_utf8(read(&files[3])), String::from_utf8(colours));
    assert_exposed(&before.expect("text"), &after.expect("text"));
}

/// The exposure is chosen once, from what the camera sees: pictures, scenes and pages have the same.
#[test]
fn solve_expose_and_view_choose_one_exposure() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json", "a.glb", "a.dae", "a.html"]);
    let out = |name: &str| text_of(&folder.path(name));
    let read = |file: &str| std::fs::read(file).expect("a file");
    let run = |arguments: &[&str]| {
        let output = radiosity(arguments);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    };
    run(&["view", &files[0], "-o", &out("b.html")]);
    assert_eq!(read(&out("b.html")), read(&files[3]));
    run(&["expose", &files[1], "-o", &out("b.glb")]);
    assert_eq!(read(&out("b.glb")), read(&files[1]), "a GLB is exposed as it was");
    let page = String::from_utf8(read(&files[3])).expect("text");
    let k = page.split("\"k\":").nth(1).and_then(|rest| rest.split(',').next()).expect("a number");
    run(&["expose", &files[2], "-o", &out("b.dae")]);
    run(&["expose", &files[2], "-o", &out("c.dae"), "-k", k]);
    assert_eq!(read(&out("b.dae")), read(&out("c.dae")));
    // Another view, another exposure.
    run(&["expose", &files[0], "-o", &out("c.html"), "--camera", "278,100,-10,278,0,100"]);
    assert_ne!(read(&out("c.html")), read(&files[3]));
}

/// Of every vertex colour the largest part is 1 - exp(-0.05 B), and the others keep their shares; all else is as it was.
fn assert_exposed(before: &str, after: &str) {
    let is_colour = |line: &str| line.starts_with("<float_array") && line.contains("lit-colours");
    let numbers = |line: &str| -> Vec<f64> {
        let text = line.split(['<', '>']).nth(2).expect("the element's text");
        text.split(' ').map(|number| number.parse().expect("a number")).collect()
    };
    let mut colours = 0;
    for (old, new) in before.lines().zip(after.lines()) {
        if !is_colour(old) {
            assert_eq!(old, new);
            continue;
        }
        colours += 1;
        for (light, colour) in numbers(old).chunks(3).zip(numbers(new).chunks(3)) {
            let most = light.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
            let share = (1.0 - (-0.05 * most).exp()) / most;
            assert!(light.iter().zip(colour).all(|(light, colour)| (colour - share * light).abs() < 1e-14));
        }
    }
    assert_eq!((before.lines().count(), colours), (after.lines().count(), 16));
}

#[test]
fn a_camera_may_be_named_or_given() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json", "a.png"]);
    let picture = |camera: &str| {
        let path = text_of(&folder.path("b.png"));
        let output = radiosity(&["expose", &files[0], "-o", &path, "--camera", camera]);
        (code(&output), std::fs::read(&path).unwrap_or_default(), stderr(&output))
    };
    assert_eq!(picture("camera").1, std::fs::read(&files[1]).expect("a picture"));
    let given = picture("278,273,-400,278,273,0,60");
    assert!(given.0 == 0 && given.1 != picture("camera").1);
    let unknown = picture("no-such-camera");
    assert!(unknown.0 == 2 && unknown.2.contains("the scene has camera"), "{}", unknown.2);
    assert_eq!(picture("0,0,0,0,1,0").0, 2, "straight up");
}

#[test]
fn inspect_tells_and_repairs() {
    let folder = Folder::new();
    let scene = String::from_utf8(radiosity(&["scene", "cornell-box"]).stdout).expect("text");
    // The ceiling without its hole: the emitter lies in it.
    let (start, end) = (scene.find("<h>").expect("a hole"), scene.find("</h>").expect("a hole"));
    let closed = folder.put("closed.dae", &format!("{}{}", &scene[..start], &scene[end + 4..]));
    let repaired = text_of(&folder.path("repaired.dae"));
    let output = radiosity(&["inspect", &closed, "--json", "--repair", "-o", &repaired]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let findings = json(&output)["findings"].clone();
    assert_eq!(findings.as_array().expect("findings").len(), 1);
    assert_eq!(
        (&findings[0]["kind"], &findings[0]["patches"][1]),
        (&"emitter-in-face".into(), &"light".into())
    );
    let again = json(&radiosity(&["inspect", &repaired, "--json"]));
    assert_eq!(again["findings"].as_array().expect("findings").len(), 0);
    let ceiling =
        |file: &str| json(&radiosity(&["inspect", file, "--json"]))["area"].as_f64().expect("an area");
    assert!((ceiling(&closed) - ceiling(&repaired) - 130.0 * 105.0).abs() < 1e-6);
}

#[test]
fn inspect_sums_up_by_kind_before_it_lists() {
    let folder = Folder::new();
    // A floor with an emitter in it, beside 24 small faces.
    let mut rows = vec![
        "V 1 0 0 0".to_owned(),
        "V 2 24 0 0".into(),
        "V 3 24 9 0".into(),
        "V 4 0 9 0".into(),
        "V 5 1 1 0".into(),
        "V 6 2 1 0".into(),
        "V 7 2 2 0".into(),
        "V 8 1 2 0".into(),
    ];
    rows.extend(
        (0..=24).flat_map(|i| [format!("V {} {i} 9 0", 9 + 2 * i), format!("V {} {i} 12 0", 10 + 2 * i)]),
    );
    rows.push("S 1 1 2 3 4 0 0 0.5 floor".into());
    rows.push("S 2 5 6 7 8 0 0 0.5 mat".into());
    rows.extend((0..24).map(|i| {
        let v = 9 + 2 * i;
        format!("S {} {v} {} {} {} 0 0 0.5 face{i}", 3 + i, v + 2, v + 3, v + 1)
    }));
    let file = folder.put("hall.vs3", &format!("T hall\nF 3\n{}\nEnd of Data\n", rows.join("\n")));
    let output = radiosity(&["inspect", &file]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let text = String::from_utf8(output.stdout).expect("text");
    let labels: Vec<&str> = text.lines().map(|line| line.split(' ').next().unwrap_or_default()).collect();
    let at = |label: &str| {
        labels.iter().position(|found| *found == label).unwrap_or_else(|| panic!("no {label}: {text}"))
    };
    assert!(
        at("findings") < at("matters") && at("matters") < at("harmless") && at("harmless") < at("finding"),
        "{text}"
    );
    assert!(text.contains("harmless   24 T-junctions: form factors do not mind"), "{text}");
    assert!(
        text.lines().next_back().is_some_and(|line| line.contains("t-junction: 14 more; --json lists them")),
        "{text}"
    );
    let all = json(&radiosity(&["inspect", &file, "--json"]));
    let count = |list: &str| all[list].as_array().expect("a list").len();
    assert!(count("findings") > 23 && count("summary") < 5, "{all}");
}

#[test]
fn view_writes_one_page_without_addresses() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json"]);
    let output = radiosity(&["view", &files[0]]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = std::fs::read_to_string(folder.path("a.html")).expect("a page");
    assert!(page.starts_with("<!doctype html>") && page.contains("short-top"));
    for address in ["http://", "https://", "src=", "@import"] {
        assert!(!page.contains(address), "{address}");
    }
}

#[test]
fn plot_writes_a_line_as_table_and_drawing() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json"]);
    let [table, drawing] = ["a.csv", "a.SVG"].map(|name| text_of(&folder.path(name)));
    let line = ["plot", &files[0], "--from", "0,0,280", "--to", "549.6,0,280"];
    let output = radiosity(&[&line[..], &["-o", &table, "-o", &drawing]].concat());
    assert_eq!((code(&output), output.stdout.len()), (0, 0), "{}", stderr(&output));
    let [rows, drawn] = [&table, &drawing].map(|file| std::fs::read_to_string(file).expect("a file"));
    assert!(rows.starts_with(
        "distance,x,y,z,patch,element,radiosity.0,radiosity.1,radiosity.2,element_radiosity.0,"
    ));
    assert!(rows.lines().skip(1).all(|row| row.contains(",floor,")) && rows.lines().count() > 20);
    assert!(drawn.starts_with("<svg xmlns") && drawn.matches("class=\"interpolated\"").count() == 3);
    let named = radiosity(&[&line[..], &["--on", "floor"]].concat());
    assert_eq!(String::from_utf8(named.stdout).expect("text"), rows, "the table goes to stdout");
}

#[test]
fn plot_says_why_there_is_no_line() {
    let folder = Folder::new();
    let files = solved(&folder, &["a.json"]);
    let file = text_of(&folder.path("a.svg"));
    let cases: [(&[&str], i32, &str); 7] = [
        (&["--from", "0,0,0", "--to", "1,0"], 2, "three numbers"),
        (&["--from", "9,0,9", "--to", "9,0,9"], 2, "no length"),
        (&["--from", "9,9,9", "--to", "99,9,9"], 2, "any patch"),
        (&["--from", "9,9,9", "--to", "99,9,9", "--on", "floor"], 2, "9.000e0 off its plane"),
        (&["--from", "9,0,9", "--to", "99,0,9", "--on", "flor"], 2, "no patch is named flor"),
        (&["--from", "0,0,559.2", "--to", "549.6,0,559.2"], 2, "name one of them"),
        (&["--from", "9,0,9", "--to", "99,0,9", "-o", "a.png"], 2, ".csv or .svg"),
    ];
    for (line, exit, says) in cases {
        let output = radiosity(&[&["plot", &files[0], "-o", &file], line].concat());
        assert_eq!(code(&output), exit, "{line:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(says), "{line:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty() && !folder.path("a.svg").exists());
    }
}

#[test]
fn what_is_no_solution_is_refused() {
    let folder = Folder::new();
    let page = text_of(&folder.path("a.png"));
    let files = solved(&folder, &["good.json"]);
    let good = std::fs::read_to_string(&files[0]).expect("a solution");
    let cases = [
        folder.put("text.json", "no JSON"),
        folder.put("other.json", "{}"),
        folder.put("cut.json", &good[..good.len() / 2]),
        folder.put("short.json", &good.replacen("\"bands\":3", "\"bands\":2", 1)),
        folder.put("index.json", &good.replacen("\"elements\":[[0,", "\"elements\":[[99,", 1)),
    ];
    for file in cases {
        let output = radiosity(&["expose", &file, "-o", &page]);
        assert_eq!(code(&output), 3, "{file}: {}", stderr(&output));
    }
}

#[test]
fn what_was_written_can_be_solved_again() {
    let folder = Folder::new();
    let lit = text_of(&folder.path("lit.dae"));
    let mut arguments = SOLVE.to_vec();
    arguments.extend(["-o", &lit]);
    assert_eq!(code(&radiosity(&arguments)), 0);
    let again = radiosity(&["factors", &lit, "--from", "278,200,100,0,1,0", "--json"]);
    assert_eq!(code(&again), 0, "{}", stderr(&again));
}

#[test]
fn threads_do_not_change_a_bit() {
    let run = |threads: &str| {
        let folder = Folder::new();
        let picture = text_of(&folder.path("a.png"));
        let mut arguments = SOLVE.to_vec();
        arguments.extend(["-o", &picture, "-j", threads]);
        assert_eq!(code(&radiosity(&arguments)), 0);
        std::fs::read(&picture).expect("a picture")
    };
    assert!(run("1") == run("3"));
}

#[test]
fn factors_are_named_bounded_and_summed() {
    let output = radiosity(&["factors", "scenes/cornell-box.dae", "--from", "278,200,100,0,1,0", "--json"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let figures = json(&output);
    let rows = figures["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 17);
    let sum: f64 = rows.iter().map(|row| row["form_factor"].as_f64().expect("a number")).sum();
    assert!((sum - figures["sum"].as_f64().expect("a number")).abs() < 1e-12);
    assert!(rows.iter().all(|row| row["error_bound"].as_f64().expect("a number") < 1e-9));

    let on_floor =
        ["factors", "scenes/cornell-box.dae", "--from", "278,0,100,0,1,0", "--on", "floor", "--json"];
    let rows = json(&radiosity(&on_floor));
    assert_eq!(rows["rows"][0]["form_factor"], 0.0, "the floor does not see itself");
}

#[test]
fn a_built_in_scene_goes_to_stdout_or_to_a_file() {
    let folder = Folder::new();
    let file = text_of(&folder.path("box.dae"));
    let to_stdout = radiosity(&["scene", "cornell-box"]);
    assert_eq!(code(&to_stdout), 0);
    assert_eq!(code(&radiosity(&["scene", "cornell-box", "-o", &file])), 0);
    assert_eq!(std::fs::read(&file).expect("the scene"), to_stdout.stdout);
    let unknown = radiosity(&["scene", "no-such-scene", "-o", &file]);
    assert_eq!(code(&unknown), 2);
    assert!(stderr(&unknown).contains("cornell-box"), "names what there is");
}

#[test]
fn wrong_usage_is_2() {
    let cases: [&[&str]; 8] = [
        &[],
        &["solve"],
        &["solve", "scenes/cornell-box.dae"],
        &["solve", "scenes/cornell-box.dae", "-o", "light.bmp"],
        &["solve", "scenes/cornell-box.dae", "--json", "--tolerance", "-1"],
        &["solve", "scenes/cornell-box.dae", "--json", "-j", "0"],
        &["factors", "scenes/cornell-box.dae", "--from", "1,2,3"],
        &["factors", "scenes/cornell-box.dae", "--from", "1,2,3,0,0,1", "--on", "no-such-patch"],
    ];
    for arguments in cases {
        let output = radiosity(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}: {}", stderr(&output));
        assert!(output.stdout.is_empty());
        assert!(!stderr(&output).is_empty());
    }
}

#[test]
fn files_that_cannot_be_read_or_written_are_1() {
    let missing = radiosity(&["solve", "no-such-file.dae", "--json"]);
    assert_eq!(code(&missing), 1);
    assert!(stderr(&missing).contains("no-such-file.dae"));
    let mut arguments = SOLVE.to_vec();
    arguments.extend(["-o", "no-such-folder/a.png"]);
    assert_eq!(code(&radiosity(&arguments)), 1);
}

#[test]
fn bad_scenes_are_3_and_leave_no_file() {
    let folder = Folder::new();
    let bad = folder.put("bad.dae", "<COLLADA version=\"1.4.1\"><library_geometries>");
    let picture = folder.path("a.png");
    let output = radiosity(&["solve", &bad, "-o", &text_of(&picture)]);
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    assert!(stderr(&output).contains("bad.dae:1"), "names file and line: {}", stderr(&output));
    assert_eq!(folder.names(), ["bad.dae"]);
}

/// Points are no surfaces: there is nothing that a sky could light.
#[test]
fn a_scene_without_patches_is_refused_with_its_file_and_what_was_left_out_of_it() {
    let folder = Folder::new();
    let cloud = folder.put(
        "cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
    );
    let output = radiosity(&["solve", &cloud, "--json"]);
    assert_eq!(code(&output), 3, "{}", stderr(&output));
    let said = stderr(&output);
    assert!(
        said.contains("cloud.ply: the scene has no patches") && said.contains("points have no area"),
        "{said}"
    );
    assert!(!said.contains("uniform sky"), "{said}");
}

/// The Cornell box with its lamp off, and its open side.
fn dark(folder: &Folder) -> String {
    let scene = String::from_utf8(radiosity(&["scene", "cornell-box"]).stdout).expect("text");
    folder.put("dark.dae", &scene.replace("17 12 4 1", "0 0 0 1"))
}

#[test]
fn a_scene_without_light_gets_a_sky_and_says_so_or_stays_dark_and_says_so() {
    let folder = Folder::new();
    let dark = dark(&folder);
    let lit = radiosity(&["solve", &dark, "--json", "--elements", "100"]);
    assert_eq!(code(&lit), 0, "{}", stderr(&lit));
    assert!(stderr(&lit).contains("a uniform sky"), "{}", stderr(&lit));
    assert!(json(&lit)["energy"]["emitted"][0].as_f64().expect("a number") > 0.0);
    let output = radiosity(&["solve", &dark, "--json", "--elements", "100", "--sky", "none"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(stderr(&output).contains("no light reaches any surface"));
    let figures = json(&output);
    assert!(figures["patches"].as_array().expect("patches").iter().all(|p| p["radiosity"][0] == 0.0));
}

#[test]
fn a_material_emits_what_the_command_line_says() {
    let folder = Folder::new();
    let (dark, lit) = (dark(&folder), "light=17,12,4");
    let by_option = radiosity(&["solve", &dark, "--json", "--elements", "200", "--emit", lit]);
    assert_eq!(code(&by_option), 0, "{}", stderr(&by_option));
    let box_file =
        folder.put("lit.dae", &String::from_utf8(radiosity(&["scene", "cornell-box"]).stdout).expect("text"));
    let by_file = radiosity(&["solve", &box_file, "--json", "--elements", "200"]);
    assert_eq!(json(&by_option)["patches"], json(&by_file)["patches"]);
    let unknown = radiosity(&["solve", &dark, "--json", "--emit", "lamp=1"]);
    assert_eq!(code(&unknown), 2);
    assert!(
        stderr(&unknown).contains("no material is named \"lamp\"; the scene has"),
        "{}",
        stderr(&unknown)
    );
}

#[test]
fn lumens_stand_beside_watts() {
    let folder = Folder::new();
    let dark = dark(&folder);
    let solve = |units: &str| {
        let output = radiosity(&[
            "solve",
            &dark,
            "--json",
            "--elements",
            "100",
            "--sky",
            "overcast=100",
            "--units",
            units,
        ]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        json(&output)
    };
    let (watts, lumens) = (solve("w"), solve("lm"));
    assert_eq!([&watts["units"], &lumens["units"]], ["W", "lm"]);
    assert_eq!(watts["patches"][0]["irradiance"], lumens["patches"][0]["irradiance"]);
    let lux = |figures: &serde_json::Value| figures["patches"][0]["illuminance"].as_f64().expect("a number");
    assert!((lux(&watts) / lux(&lumens) / 179.0 - 1.0).abs() < 1e-12);
}

#[test]
fn a_stopped_run_is_4_and_writes_its_result() {
    let folder = Folder::new();
    let picture = text_of(&folder.path("a.png"));
    let mut arguments = SOLVE.to_vec();
    arguments.extend(["-o", &picture, "--max-shots", "3", "--json"]);
    let output = radiosity(&arguments);
    assert_eq!(code(&output), 4, "{}", stderr(&output));
    assert_eq!(json(&output)["shots"], 3);
    assert_eq!(folder.names(), ["a.png", "a.png.state"]);
    assert!(stderr(&output).contains("continue with --resume"), "{}", stderr(&output));
    let state = text_of(&folder.path("a.png.state"));
    let resumed = radiosity(&[&SOLVE[..], &["--json", "--resume", &state]].concat());
    let whole = radiosity(&[&SOLVE[..], &["--json"]].concat());
    assert_eq!(code(&resumed), 0, "{}", stderr(&resumed));
    let light = |output| (json(output)["patches"].clone(), json(output)["energy"].clone());
    assert_eq!(light(&resumed), light(&whole));
}

/// A time that is over at once: what costs nothing is printed, and the exit code is that of a solve that ends early.
#[test]
fn what_there_is_no_time_for_is_left_out_and_said() {
    let inspected = radiosity(&["inspect", "scenes/cornell-box.dae", "--time", "1e-9"]);
    let (found, told) = (String::from_utf8_lossy(&inspected.stdout), stderr(&inspected));
    assert_eq!(code(&inspected), 4, "{told}");
    assert_eq!(told, "stopped: not all was looked at\n");
    assert!(found.contains("patches    17 with") && found.contains("not timed"), "{found}");
    let as_json = radiosity(&["inspect", "scenes/cornell-box.dae", "--time", "1e-9", "--json"]);
    let json: Value = serde_json::from_slice(&as_json.stdout).expect("JSON");
    assert!(json["stopped"] == true && json["opening"].is_null(), "{json}");
    let row = ["factors", "scenes/cornell-box.dae", "--area", "1e-3", "--row", "floor", "--time", "1e-9"];
    let unfound = radiosity(&row);
    let told = stderr(&unfound);
    assert!(code(&unfound) == 4 && told.contains("stopped: 0 of 1 rows are there"), "{told}");
    assert!(unfound.stdout.is_empty());
}
