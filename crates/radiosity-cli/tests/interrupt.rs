//! Ctrl-C, a second Ctrl-C, and kill -9, against the program.
#![cfg(unix)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// A solve of some seconds, writing into a folder.
fn start(folder: &Path, more: &[&str]) -> Child {
    let mut arguments = vec!["solve", "scenes/cornell-box.dae", "--elements", "1200", "--tolerance", "1e-4"];
    arguments.extend(more);
    Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .args(arguments)
        .arg("-o")
        .arg(folder.join("light.json"))
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../radiosity"))
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts")
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("kill").args([name, &child.id().to_string()]).status().expect("kill is there");
    assert!(sent.success());
}

/// Waits until a file is there, or the program has ended.
fn wait_for(path: &Path, child: &mut Child) {
    let start = Instant::now();
    while !path.exists() && child.try_wait().expect("a child").is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "nothing was written");
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn state_of(folder: &Path) -> PathBuf {
    folder.join("light.json.state")
}

/// Radiosities, and all else that does not depend on the clock.
fn figures(folder: &Path) -> serde_json::Value {
    let text = std::fs::read(folder.join("light.json")).expect("figures");
    let mut figures: serde_json::Value = serde_json::from_slice(&text).expect("whole JSON");
    figures["seconds"] = 0.into();
    figures
}

fn end(mut child: Child) -> ExitStatus {
    child.wait().expect("a child")
}

#[test]
fn after_ctrl_c_a_run_goes_on_and_ends_with_the_same_bits() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut child = start(folder.path(), &["--snapshot-every", "0.2"]);
    wait_for(&state_of(folder.path()), &mut child);
    signal(&child, "-INT");
    assert_eq!(end(child).code(), Some(130));
    figures(folder.path());
    let state = state_of(folder.path());
    let state = state.to_str().expect("UTF-8");
    assert!(end(start(folder.path(), &["--resume", state])).success());
    let resumed = figures(folder.path());

    let whole = tempfile::tempdir().expect("a folder");
    assert!(end(start(whole.path(), &["--snapshot-every", "0.2"])).success());
    assert_eq!(resumed, figures(whole.path()));
    assert!(!state_of(whole.path()).exists(), "a run that ends needs no state");
}

#[test]
fn killed_at_any_moment_it_leaves_whole_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut read = 0;
    for delay in [0, 3, 11, 23, 41, 67] {
        let mut child = start(folder.path(), &["--snapshot-every", "0.001"]);
        wait_for(&state_of(folder.path()), &mut child);
        std::thread::sleep(Duration::from_millis(delay));
        child.kill().expect("a child");
        end(child);
        figures(folder.path());
        let state = std::fs::read(state_of(folder.path())).expect("a state");
        assert!(radiosity::State::from_bytes(&state).is_ok(), "killed after {delay} ms");
        read += 1;
    }
    assert_eq!(read, 6);
}

/// The system refuses to write on in the middle of a file, as a full disk does: the exit code says so, what stood there
/// before still stands, and nothing is left behind.
#[test]
fn a_write_that_fails_half_way_leaves_what_was_there() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("light.json");
    std::fs::write(&path, "what was there").expect("a file");
    // No file beyond 16 blocks; a signal that nobody ignores would end the program instead.
    let script = "trap '' XFSZ; ulimit -f 16; exec \"$@\"";
    let output = Command::new("sh")
        .args(["-c", script, "sh", env!("CARGO_BIN_EXE_radiosity")])
        .args(["solve", "scenes/cornell-box.dae", "--quality", "draft", "--max-shots", "1", "-o"])
        .arg(&path)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../radiosity"))
        .output()
        .expect("the program starts");
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("light.json: cannot be written"), "{message}");
    assert_eq!(std::fs::read_to_string(&path).expect("a file"), "what was there");
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1);
}
