//! `radiosity report` and `radiosity compare` as a user meets them.
use std::path::Path;
use std::process::{Command, Output};

fn radiosity(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_radiosity"));
    command.args(arguments).current_dir(folder).output().expect("the program starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Solutions of a room, each of so many elements.
fn solved(folder: &Path, elements: &[&str]) {
    assert_eq!(code(&radiosity(folder, &["scene", "colour-bleeding", "-o", "room.dae"])), 0);
    for count in elements {
        let name = format!("{count}.json");
        let output =
            radiosity(folder, &["solve", "room.dae", "--elements", count, "--passes", "0", "-o", &name]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
    }
}

#[test]
fn compare_prints_norms_and_the_worst_element_and_fails_above_what_was_asked() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = folder.path();
    solved(at, &["60", "200"]);
    let same = radiosity(at, &["compare", "60.json", "60.json", "--fail-above", "0"]);
    assert_eq!(code(&same), 0, "{}", stderr(&same));
    let other = radiosity(at, &["compare", "60.json", "200.json", "--json"]);
    let found: serde_json::Value = serde_json::from_slice(&other.stdout).expect("one JSON object");
    assert_eq!((code(&other), found["bands"].as_array().map(Vec::len)), (0, Some(3)));
    let l2 = found["bands"][0]["l2"].as_f64().expect("a number");
    assert!(l2 > 1e-4 && l2 < 0.3, "{found}");
    let worst = &found["worst"];
    let place = worst["place"].as_array().expect("a place");
    assert!(worst["patch"].is_string() && worst["element"].is_u64() && place.len() == 3, "{found}");
    let above = radiosity(at, &["compare", "60.json", "200.json", "--fail-above", "1e-6"]);
    assert_eq!(code(&above), 5);
    assert!(String::from_utf8_lossy(&above.stdout).contains("worst: element "));
    assert_eq!(code(&radiosity(at, &["compare", "60.json", "200.json", "--fail-above", "0.9"])), 0);
}

#[test]
fn compare_says_what_is_not_a_solution_and_what_is_not_of_one_scene() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = folder.path();
    solved(at, &["60"]);
    assert_eq!(code(&radiosity(at, &["compare", "60.json", "none.json"])), 1);
    assert_eq!(code(&radiosity(at, &["compare", "60.json", "room.dae"])), 3);
    assert_eq!(code(&radiosity(at, &["scene", "furnace", "-o", "f.dae"])), 0);
    assert_eq!(code(&radiosity(at, &["solve", "f.dae", "--elements", "12", "-o", "f.json"])), 0);
    let output = radiosity(at, &["compare", "60.json", "f.json"]);
    assert_eq!(code(&output), 3);
    assert!(stderr(&output).contains("is not the same in both"), "{}", stderr(&output));
    for above in ["-1", "NaN", "inf", "much"] {
        assert_eq!(code(&radiosity(at, &["compare", "60.json", "60.json", "--fail-above", above])), 2);
    }
}

#[test]
fn report_refuses_before_it_measures() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let at = folder.path();
    let unknown = radiosity(at, &["report", "nowhere", "-o", "out"]);
    assert_eq!(code(&unknown), 2);
    assert!(stderr(&unknown).contains("small-occluders"), "{}", stderr(&unknown));
    assert_eq!(code(&radiosity(at, &["report", "nowhere.dae", "-o", "out"])), 1);
    std::fs::write(at.join("peers"), "{}\n").expect("a file");
    let bad = radiosity(at, &["report", "furnace", "-o", "out", "--peers", "peers"]);
    assert_eq!(code(&bad), 3);
    assert!(stderr(&bad).contains("line 1"), "{}", stderr(&bad));
    assert!(!at.join("out").exists(), "nothing is made for what is refused");
    assert_eq!(code(&radiosity(at, &["report", "furnace", "-o", "peers"])), 1);
    assert_eq!(code(&radiosity(at, &["report", "furnace"])), 2);
}
