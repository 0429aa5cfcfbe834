//! Mitsuba's path tracer, where the Python of this machine has it.
use radiosity::{Method, Options, Scene, solve};
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::ops::ControlFlow;
use std::process::{Command, Stdio};

/// Reads a request and writes what faces receive.
const SCRIPT: &str = include_str!("mitsuba_faces.py");

/// Surfaces, and how many paths start on each face, one run after the other.
#[derive(Debug, Serialize)]
struct Request {
    faces: Vec<Shape>,
    others: Vec<Shape>,
    paths: Vec<u32>,
}

/// Triangles of one material.
#[derive(Debug, Serialize)]
struct Shape {
    corners: Vec<[f64; 9]>,
    reflectance: [f64; 3],
    emission: [f64; 3],
}

/// The mean irradiance of every face, and what that took.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Traced {
    pub(crate) irradiance: Vec<[f64; 3]>,
    pub(crate) cpu: f64,
    pub(crate) wall: f64,
}

/// Whether there is a Python with Mitsuba.
pub(crate) fn is_present() -> bool {
    let import = Command::new("python3").args(["-c", "import mitsuba"]).stderr(Stdio::null()).status();
    import.is_ok_and(|status| status.success())
}

/// What the patches of each face receive, by so many paths in each run; nothing where Mitsuba fails.
pub(crate) fn trace(scene: &Scene, faces: &[&[usize]], paths: Vec<u32>) -> Option<Vec<Traced>> {
    let triangles = triangles(scene)?;
    let shape = |patches: &[usize]| Shape {
        corners: patches.iter().flat_map(|patch| triangles[*patch].iter().copied()).collect(),
        reflectance: three(&scene.patches[patches[0]].reflectance),
        emission: three(&scene.patches[patches[0]].emission),
    };
    let is_other = |patch: &usize| !faces.iter().any(|face| face.contains(patch));
    let others = (0..scene.patches.len()).filter(is_other).map(|patch| shape(&[patch])).collect();
    let request = Request { faces: faces.iter().map(|face| shape(face)).collect(), others, paths };
    let mut python = Command::new("python3")
        .args(["-c", SCRIPT])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .ok()?;
    python.stdin.take()?.write_all(&serde_json::to_vec(&request).ok()?).ok()?;
    let output = python.wait_with_output().ok()?;
    let lines = output.stdout.split(|byte| *byte == b'\n').filter(|line| !line.is_empty());
    let traced: Vec<Traced> = lines.map(serde_json::from_slice).collect::<Result<_, _>>().ok()?;
    (traced.len() == request.paths.len()).then_some(traced)
}

/// The triangles of every patch: those of the coarsest mesh.
fn triangles(scene: &Scene) -> Option<Vec<Vec<[f64; 9]>>> {
    let options = Options { max_shots: 0, gather: false, method: Method::Shoot, ..Options::mesh(1) };
    let mesh = solve(scene, &options, |_| ControlFlow::Continue(())).ok()?.mesh;
    let mut of_patch = vec![Vec::new(); scene.patches.len()];
    for element in &mesh.elements {
        let [a, b, c] = element.corners.map(|corner| mesh.vertices[corner].to_array());
        of_patch[element.patch].push([a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]]);
    }
    Some(of_patch)
}

fn three(bands: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|band| bands[band.min(bands.len() - 1)])
}
