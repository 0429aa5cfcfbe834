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
        .current_dir(env!("CARGO_MANIFEST_DIR"))
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
