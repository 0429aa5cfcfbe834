//! Scenes from files.
use super::Failure;
use radiosity::{Scene, io::Source};
use std::path::Path;

/// Reads a scene and its file; prints what the reader had to say on stderr.
pub(super) fn read(path: &Path) -> Result<(Scene, Source), Failure> {
    let (scene, source) = read_quietly(path)?;
    for warning in &scene.warnings {
        eprintln!("warning: {warning}");
    }
    Ok((scene, source))
}

/// Reads a scene and its file; what the reader had to say stays in the scene.
pub(super) fn read_quietly(path: &Path) -> Result<(Scene, Source), Failure> {
    let source = Source::open(path)?;
    Ok((source.scene()?, source))
}
