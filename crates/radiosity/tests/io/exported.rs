//! Files of real exporters (`tests/exported`, made by its `make.py`): each has the area, the lamps and the box that its recipe knows.
use radiosity::inspect::{Kind, in_one_line};
use radiosity::io::Source;
use radiosity::{Patch, Scene};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What the recipe knows of a file.
#[derive(Debug, Deserialize)]
struct Known {
    exporter: String,
    area: f64,
    low: [f64; 3],
    high: [f64; 3],
    /// Planar faces that emit.
    lit: usize,
    cameras: usize,
    /// Words of the one line that tells what was left out; without any there is no such line.
    notes: Vec<String>,
    /// Words of the refusal.
    error: Option<String>,
    /// Whether coordinates are rounded to some thousandths.
    coarse: bool,
    /// Sources of light that are no surfaces.
    lights: usize,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/exported")
}

fn known() -> BTreeMap<String, Known> {
    serde_json::from_str(&std::fs::read_to_string(folder().join("expected.json")).unwrap()).unwrap()
}

/// The patches that the exporter meant: a double-sided one once, and no lamps.
fn fronts(scene: &Scene) -> impl Iterator<Item = &Patch> {
    let fronts = scene.patches.iter().filter(|patch| !patch.name.trim_end_matches('\'').ends_with(".back"));
    fronts.filter(|patch| !is_lamp(patch))
}

/// Whether a patch is an area light: it is no geometry of its file.
fn is_lamp(patch: &Patch) -> bool {
    patch.origin.instance == usize::MAX
}

#[test]
fn files_of_real_exporters_are_read_right() {
    let known = known();
    assert!(known.len() >= 25, "{} files", known.len());
    let complaints: Vec<String> = known.iter().flat_map(|(file, known)| complaints(file, known)).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn complaints(file: &str, known: &Known) -> Vec<String> {
    let read = Source::open(folder().join(file)).and_then(|source| source.scene());
    let mut all = match (read, &known.error) {
        (Err(error), Some(words)) => refusal_complaints(&error.to_string(), words),
        (Err(error), None) => vec![error.to_string()],
        (Ok(_), Some(words)) => vec![format!("read, though it needs {words}")],
        (Ok(scene), None) => scene_complaints(&scene, known),
    };
    all.iter_mut().for_each(|complaint| *complaint = format!("{file} ({}): {complaint}", known.exporter));
    all
}

fn refusal_complaints(message: &str, words: &str) -> Vec<String> {
    let is_good = message.contains(words) && message.lines().count() == 1;
    if is_good { Vec::new() } else { vec![format!("{words} is not named in one line: {message}")] }
}

fn scene_complaints(scene: &Scene, known: &Known) -> Vec<String> {
    let mut all = Vec::new();
    let area: f64 = fronts(scene).map(|patch| patch.polygon.area()).sum();
    let tolerance = if known.coarse { 1e-3 } else { 1e-5 };
    if (area / known.area - 1.0).abs() > tolerance {
        all.push(format!("area {area} instead of {}", known.area));
    }
    let lit = fronts(scene).filter(|patch| patch.emits()).count();
    if lit != known.lit {
        all.push(format!("{lit} lit patches instead of {}", known.lit));
    }
    let [low, high] = scene.extent().map(|corner| corner.to_array());
    let size = known.high.iter().zip(known.low).map(|(high, low)| high - low).fold(0.0, f64::max);
    let far = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).any(|(a, b)| (a - b).abs() > tolerance * size);
    if far(low, known.low) || far(high, known.high) {
        all.push(format!("from {low:?} to {high:?} instead of {:?} to {:?}", known.low, known.high));
    }
    if scene.cameras.len() != known.cameras {
        all.push(format!("{} cameras instead of {}", scene.cameras.len(), known.cameras));
    }
    let areas = scene.patches.iter().filter(|patch| is_lamp(patch)).count();
    let lights = areas + scene.lamps.len() + scene.suns.len();
    if lights != known.lights {
        all.push(format!("{lights} lights instead of {}", known.lights));
    }
    all.extend(summary_complaints(scene, known));
    all
}

/// All that was left out is in one line, and nothing else is.
fn summary_complaints(scene: &Scene, known: &Known) -> Vec<String> {
    let line = in_one_line(&scene.warnings).unwrap_or_default();
    let is_quiet = known.notes.is_empty() && scene.warnings.iter().all(|warning| warning.kind == Kind::File);
    let missing = known.notes.iter().filter(|words| !line.contains(*words));
    let mut all: Vec<String> = missing.map(|words| format!("{words} is not named: {line}")).collect();
    if is_quiet && !line.is_empty() {
        all.push(format!("a warning of nothing: {line}"));
    }
    if line.lines().count() > 1 {
        all.push(format!("more than a line: {line}"));
    }
    all
}

/// Cut, with other bytes or with a piece of itself elsewhere: whatever comes back, it comes back, in one line.
#[test]
fn damaged_files_of_real_exporters_never_panic() {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        usize::try_from(state >> 33).unwrap() % below.max(1)
    };
    for file in known().into_keys() {
        let whole = std::fs::read(folder().join(&file)).unwrap();
        for round in 0..40 {
            let mut bytes = whole.clone();
            let (at, other) = (next(bytes.len()), next(bytes.len()));
            match round % 4 {
                0 => bytes.truncate(at),
                1 => bytes[at] = u8::try_from(next(256)).unwrap(),
                2 => bytes.copy_within(other..(other + next(12)).min(whole.len()), at.min(whole.len() - 12)),
                _ => drop(bytes.splice(at..(at + 1).min(whole.len()), *b" 9999999999 ")),
            }
            if let Err(error) = Source::from_bytes(file.as_str(), bytes).and_then(|source| source.scene()) {
                let message = error.to_string();
                assert!(message.starts_with(&file) && message.lines().count() == 1, "{message}");
            }
        }
    }
}
