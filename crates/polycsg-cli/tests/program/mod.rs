//! The program, files for it, and what it writes.
#![allow(dead_code, reason = "not every test needs all of it")]

use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The program with arguments; it must not have panicked.
pub(crate) fn polycsg(arguments: &[&str]) -> Output {
    ran(Command::new(env!("CARGO_BIN_EXE_polycsg"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .expect("it starts"))
}

/// The program with something on its stdin.
pub(crate) fn piped(arguments: &[&str], stdin: &[u8]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_polycsg"));
    let pipes = command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("it starts");
    let (mut pipe, bytes) = (child.stdin.take().expect("a pipe"), stdin.to_vec());
    // It may end before it has read all.
    let writer = std::thread::spawn(move || drop(pipe.write_all(&bytes)));
    let output = child.wait_with_output().expect("it ends");
    writer.join().expect("a thread");
    ran(output)
}

fn ran(output: Output) -> Output {
    assert!(!stderr(&output).contains("panicked"), "{}", stderr(&output));
    output
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What a run that must end well has printed.
pub(crate) fn stdout(output: Output) -> String {
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    String::from_utf8(output.stdout).expect("text")
}

/// What a run that must end well prints.
pub(crate) fn printed(arguments: &[&str]) -> String {
    stdout(polycsg(arguments))
}

/// The features of a document, a line each.
pub(crate) fn lines(document: &str) -> Vec<String> {
    let lines = document.lines().filter(|line| line.contains("\"Feature\""));
    lines.map(|line| line.trim_end_matches(',').to_owned()).collect()
}

pub(crate) fn sorted(mut lines: Vec<String>) -> Vec<String> {
    lines.sort();
    lines
}

/// The areas that `area` prints.
pub(crate) fn areas(file: &str) -> Vec<f64> {
    let text = printed(&["area", file]);
    text.lines().map(|line| line.split('\t').nth(1).expect("an area").parse().expect("a number")).collect()
}

/// A folder of its own, and the files in it.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder(tempfile::tempdir().expect("a temporary folder"))
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().expect("a temporary path is UTF-8").to_owned()
    }

    pub(crate) fn put(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        std::fs::write(self.path(name), content).expect("a temporary file");
        self.path(name)
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).expect("the folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

pub(crate) fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// Numbers that are the same in every run.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// At least 0 and below 1.
    pub(crate) fn share(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, usize::try_from(self.bits() % (i as u64 + 1)).expect("small"));
        }
    }
}

pub(crate) type Ring = Vec<[f64; 2]>;

/// A document of features, each of one polygon.
pub(crate) fn document(features: &[(Value, Vec<Ring>)]) -> String {
    let mut text = String::from("{\"type\":\"FeatureCollection\",\"features\":[");
    for (i, (properties, rings)) in features.iter().enumerate() {
        let rings: Vec<Ring> =
            rings.iter().map(|ring| ring.iter().chain(ring.first()).copied().collect()).collect();
        let geometry = json!({ "type": "Polygon", "coordinates": rings });
        let feature = json!({ "type": "Feature", "properties": properties, "geometry": geometry });
        let _ = write!(text, "{}\n{feature}", if i == 0 { "" } else { "," });
    }
    text + "\n]}\n"
}

/// A grid whose inner vertices are moved, each cell a polygon: neighbours share their borders.
pub(crate) fn parcels(count: usize, origin: f64, size: f64, seed: u64) -> Vec<Ring> {
    let mut random = Random::new(seed);
    let corners: Vec<Vec<[f64; 2]>> = (0..=count)
        .map(|i| {
            let mut corner = |j: usize| {
                let [x, y] = [i, j].map(|k| origin + size * (k as f64 + 0.3 * (random.share() - 0.5)));
                [x, y]
            };
            (0..=count).map(&mut corner).collect()
        })
        .collect();
    let cell =
        |i: usize, j: usize| vec![corners[i][j], corners[i + 1][j], corners[i + 1][j + 1], corners[i][j + 1]];
    (0..count * count).map(|k| cell(k / count, k % count)).collect()
}

/// Octagons anywhere, over one another.
pub(crate) fn octagons(count: usize, span: f64, radius: f64, seed: u64) -> Vec<Ring> {
    let mut random = Random::new(seed);
    let octagon = |_| {
        let [x, y, turn] = [span * random.share(), span * random.share(), random.share()];
        let corner = |k: u32| (f64::from(k) + turn) * std::f64::consts::FRAC_PI_4;
        (0..8).map(|k| [x + radius * corner(k).cos(), y + radius * corner(k).sin()]).collect()
    };
    (0..count).map(octagon).collect()
}

/// Rings as features with a number each.
pub(crate) fn numbered(name: &str, rings: Vec<Ring>) -> Vec<(Value, Vec<Ring>)> {
    let feature = |(i, ring): (usize, Ring)| (json!({ name: i, "kind": format!("k{}", i % 5) }), vec![ring]);
    rings.into_iter().enumerate().map(feature).collect()
}
