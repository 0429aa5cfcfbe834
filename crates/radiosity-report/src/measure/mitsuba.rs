//! Mitsuba 3, where the user's Python has it: a path tracer that others wrote, from its wheel, by one call.
use radiosity::{Mesh, Scene};
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::process::{Command, Stdio};

/// Reads a scene on stdin and writes what its patches receive.
const SCRIPT: &str = include_str!("irradiance_meters.py");
/// Names the interpreter.
const PYTHON: &str = "PYTHON";

/// What the script is asked.
#[derive(Serialize)]
struct Request {
    paths: Vec<u32>,
    patches: Vec<MeteredPatch>,
}

/// A patch in red, green and blue.
#[derive(Serialize)]
struct MeteredPatch {
    triangles: Vec<[[f64; 3]; 3]>,
    reflectance: [f64; 3],
    radiance: [f64; 3],
}

/// What it answers.
#[derive(Deserialize)]
struct Reply {
    runs: Vec<MeteredRun>,
}

/// What every patch receives, found by so many paths each, and the seconds of CPU that it took.
#[derive(Debug, Deserialize)]
pub(crate) struct MeteredRun {
    pub(crate) seconds: f64,
    pub(crate) irradiance: Vec<[f64; 3]>,
}

/// A run for each number of paths; nothing where the interpreter has no such module.
pub(crate) fn runs(scene: &Scene, paths: &[u32]) -> Option<Vec<MeteredRun>> {
    runs_by(&std::env::var(PYTHON).unwrap_or_else(|_| "python3".to_owned()), scene, paths)
}

fn runs_by(python: &str, scene: &Scene, paths: &[u32]) -> Option<Vec<MeteredRun>> {
    let mesh = Mesh::even(scene, 1).ok()?;
    let colour = |bands: &[f64]| [0, 1, 2].map(|band: usize| bands[band.min(bands.len() - 1)]);
    let mut patches: Vec<MeteredPatch> = (scene.patches.iter())
        .map(|patch| MeteredPatch {
            triangles: Vec::new(),
            reflectance: colour(&patch.reflectance),
            radiance: colour(&patch.emission),
        })
        .collect();
    for (index, element) in mesh.elements.iter().enumerate() {
        let corners = mesh.triangle(index).map(|corner| corner.to_array());
        patches[element.patch].triangles.push(corners);
    }
    let reply: Reply =
        serde_json::from_slice(&answer(python, &Request { paths: paths.to_vec(), patches })?).ok()?;
    let whole = |run: &MeteredRun| run.irradiance.len() == scene.patches.len() && run.seconds > 0.0;
    (reply.runs.len() == paths.len() && reply.runs.iter().all(whole)).then_some(reply.runs)
}

/// What the script prints.
fn answer(python: &str, request: &Request) -> Option<Vec<u8>> {
    let mut child = Command::new(python)
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    // A script that ends early reads nothing: its answer is then missing, too.
    let _ = child.stdin.take()?.write_all(serde_json::to_string(request).ok()?.as_bytes());
    let output = child.wait_with_output().ok()?;
    output.status.success().then_some(output.stdout)
}

#[cfg(test)]
mod tests {
    use super::*;
    use radiosity::scenes;

    #[test]
    fn without_an_interpreter_or_with_another_answer_there_is_no_run() {
        let scene = scenes::scene("furnace").unwrap();
        for python in ["no-such-interpreter", "true", "false", "echo"] {
            assert!(runs_by(python, &scene, &[4]).is_none(), "{python}");
        }
    }

    /// Radiosity and irradiance are 1 everywhere. Checks nothing where Python has no Mitsuba.
    #[test]
    fn a_furnace_is_1_by_mitsuba_too() {
        let scene = scenes::scene("furnace").unwrap();
        let Some(runs) = runs(&scene, &[64, 4096]) else {
            return eprintln!("no mitsuba: nothing was measured by it");
        };
        let off =
            |run: &MeteredRun| run.irradiance.iter().flatten().map(|h| (h - 1.0).abs()).fold(0.0, f64::max);
        assert!(off(&runs[1]) < 0.03 && off(&runs[0]) < 0.3, "{runs:?}");
        assert!(runs[1].seconds > runs[0].seconds);
    }
}
