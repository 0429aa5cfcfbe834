//! Files written repaired: what is written is read again, until it needs no repair.
use super::error::FileError;
use super::save::save;
use super::scene_file::save_scene;
use super::source::Source;
use crate::repair::{Repaired, repair};
use crate::scene::{Scene, finding::Finding};
use std::path::Path;

/// So often a file is written at most. The first time leaves what rounding of its numbers makes: triangles without area, corners of two
/// pieces on either side of a place that the numbers do not hold. The second time mends that.
const ROUNDS: usize = 8;

/// What [`Source::save_repaired`] could not put into a file.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RepairedFile {
    /// What the format cannot hold, a clause each.
    pub left_out: Vec<&'static str>,
    /// What the written file still needs when it is read: a picture that reflects all light, which the format cannot lower.
    pub remaining: Vec<Finding>,
}

impl Source {
    /// Writes this file with the polygons of a repaired scene. A COLLADA file stays COLLADA, and glTF stays glTF: polygons that were cut,
    /// split or left out give way to their pieces, and everything else stays, see [`Collada::repaired`](super::collada::Collada::repaired)
    /// and [`Gltf::repaired`](super::gltf::Gltf::repaired); a file that goes to another folder takes the files that it names with it, inside.
    /// Other formats, and another extension than the file's own, are written anew by
    /// [`save_scene`].
    ///
    /// Formats round. So what is to be written is read again, seen by `sides` as [`needed_sides`](crate::needed_sides) and repaired, until
    /// that changes nothing.
    ///
    /// `before` must be this file's scene, seen by `sides`, and `after` that scene [repaired](crate::repair()).
    ///
    /// # Errors
    /// As [`Source::scene`] and [`save_scene`].
    pub fn save_repaired(
        &self,
        [before, after]: [&Scene; 2],
        sides: &dyn Fn(&Scene) -> Scene,
        path: impl AsRef<Path>,
    ) -> Result<RepairedFile, FileError> {
        let path = path.as_ref();
        let (mut written, left_out) = self.written([before, after], path)?;
        let mut remaining = Vec::new();
        for _ in 0..ROUNDS {
            let Some(source) = &written else { break };
            let before = sides(&source.scene()?);
            let Repaired { scene: after, repairs } = repair(&before);
            remaining = repairs;
            let (next, _) = source.written([&before, &after], path)?;
            if next.as_ref().is_some_and(|next| next.bytes() == source.bytes()) {
                break;
            }
            written = next;
        }
        if let Some(source @ (Source::Collada(_) | Source::Gltf(_))) = &written {
            save(path, source.bytes())?;
        }
        Ok(RepairedFile { left_out, remaining })
    }

    /// The file with the polygons of a repaired scene, and what its format cannot hold. What is written anew is at its path already; nothing
    /// is read of it where that is no file, but a pipe.
    fn written(
        &self,
        [before, after]: [&Scene; 2],
        path: &Path,
    ) -> Result<(Option<Source>, Vec<&'static str>), FileError> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let folder = path.parent().unwrap_or(Path::new(""));
        let source = match self {
            Self::Collada(file) if extension == "dae" => {
                Self::Collada(file.with_repaired(before, after)?.moved_to(folder)?)
            }
            Self::Gltf(file) if extension == file.extension() => {
                Self::Gltf(file.with_repaired(before, after)?.moved_to(folder)?)
            }
            _ => {
                let left_out = save_scene(after, path)?;
                return Ok((path.is_file().then(|| Source::open(path)).transpose()?, left_out));
            }
        };
        Ok((Some(source), Vec::new()))
    }
}
