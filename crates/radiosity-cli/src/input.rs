//! Scenes and solutions from files, or from standard input.
use crate::failure::Failure;
use radiosity::inspect::in_one_line;
use radiosity::{Record, Scene, io::Source};
use serde::Deserialize;
use std::{io::Read, path::Path};

/// The name that stands for standard input and output.
pub(crate) const STREAM: &str = "-";

/// Reads a scene and its file; prints what the reader had to say on stderr, in a line.
pub(crate) fn read(path: &Path) -> Result<(Scene, Source), Failure> {
    let (scene, source) = read_quietly(path)?;
    if let Some(line) = in_one_line(&scene.warnings) {
        let more = match scene.warnings.len() {
            1 => String::new(),
            _ => format!("; `radiosity inspect {}` says where, and what to do", path.display()),
        };
        eprintln!("warning: {line}{more}");
    }
    Ok((scene, source))
}

/// Reads a scene and its file; what the reader had to say stays in the scene.
pub(crate) fn read_quietly(path: &Path) -> Result<(Scene, Source), Failure> {
    let source = if path == Path::new(STREAM) {
        Source::from_bytes("standard input", bytes(path)?)?
    } else {
        Source::open(path)?
    };
    Ok((source.scene()?, source))
}

/// The bytes of a file, or of standard input.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let read = if path == Path::new(STREAM) {
        std::io::stdin().read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
    };
    match read {
        Ok(_) => Ok(bytes),
        Err(error) => {
            let name = path.display();
            Err(Failure::internal(format!("{name}: cannot be read: {error}; check its name")))
        }
    }
}

/// A solution's file as `solve` writes it; its other fields are for people and programs.
#[derive(Deserialize)]
struct WrittenSolution {
    light: Record,
}

/// Reads a written solution.
pub(crate) fn solution(path: &Path) -> Result<Record, Failure> {
    let name = path.display();
    let written: WrittenSolution = serde_json::from_slice(&bytes(path)?).map_err(|error| {
        Failure::scene(format!("{name}: not a solution: {error}; write one: solve SCENE -o FILE.json"))
    })?;
    written.light.check().map_err(|reason| Failure::scene(format!("{name}: {reason}; solve again")))?;
    Ok(written.light)
}
