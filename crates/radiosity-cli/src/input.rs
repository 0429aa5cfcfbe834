//! Scenes from files.
use crate::failure::Failure;
use radiosity::{Record, Scene, io::Source};
use serde::Deserialize;
use std::path::Path;

/// Reads a scene and its file; prints what the reader had to say on stderr.
pub(crate) fn read(path: &Path) -> Result<(Scene, Source), Failure> {
    let (scene, source) = read_quietly(path)?;
    for warning in &scene.warnings {
        eprintln!("warning: {warning}");
    }
    Ok((scene, source))
}

/// Reads a scene and its file; what the reader had to say stays in the scene.
pub(crate) fn read_quietly(path: &Path) -> Result<(Scene, Source), Failure> {
    let source = Source::open(path)?;
    Ok((source.scene()?, source))
}

/// A solution's file as `solve` writes it; its other fields are for people and programs.
#[derive(Deserialize)]
struct WrittenSolution {
    light: Record,
}

/// Reads a written solution.
pub(crate) fn solution(path: &Path) -> Result<Record, Failure> {
    let name = path.display();
    let text = std::fs::read(path)
        .map_err(|error| Failure::internal(format!("{name}: cannot be read: {error}; check its name")))?;
    let written: WrittenSolution = serde_json::from_slice(&text).map_err(|error| {
        Failure::scene(format!("{name}: not a solution: {error}; write one: solve SCENE -o FILE.json"))
    })?;
    written.light.check().map_err(|reason| Failure::scene(format!("{name}: {reason}; solve again")))?;
    Ok(written.light)
}
