//! Results to files, by extension, and data to stdout.
use super::{Failure, solve::Solve};
use radiosity::{
    Scene, Solution,
    expose::{self, Exposure},
    io::{self, Source, gltf},
    picture,
};
use std::{
    io::Write,
    path::{Path, PathBuf},
};

/// A file that a result can be written to.
#[derive(Debug)]
pub(super) struct Output {
    path: PathBuf,
    kind: Kind,
}

/// What the file will hold.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Picture,
    Collada,
    Glb,
    Json,
}

/// What was found, and what it was found from.
#[derive(Debug)]
pub(super) struct Findings<'s> {
    pub(super) arguments: &'s Solve,
    pub(super) source: &'s Source,
    pub(super) scene: &'s Scene,
    pub(super) solution: &'s Solution,
    pub(super) figures: &'s str,
}

impl Output {
    /// An output file: its extension must be known, and its folder must take new files, before anything is solved.
    pub(super) fn new(path: &Path) -> Result<Output, Failure> {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let kind = match extension.as_deref() {
            Some("png") => Kind::Picture,
            Some("dae") => Kind::Collada,
            Some("glb") => Kind::Glb,
            Some("json") => Kind::Json,
            _ => {
                let message =
                    format!("{}: unknown kind of file; name it .png, .dae, .glb or .json", path.display());
                return Err(Failure::usage(message));
            }
        };
        probe(path)?;
        Ok(Output { path: path.to_owned(), kind })
    }

    /// Writes the file, whole or not at all.
    pub(super) fn write(&self, findings: &Findings<'_>) -> Result<(), Failure> {
        let bytes = match self.kind {
            Kind::Picture => findings.picture()?,
            Kind::Collada => findings.collada()?,
            Kind::Glb => findings.glb()?,
            Kind::Json => findings.figures.as_bytes().to_vec(),
        };
        Ok(io::save(&self.path, &bytes)?)
    }
}

impl Findings<'_> {
    /// PNG of the scene from its first camera, or from a stated view when it has none.
    fn picture(&self) -> Result<Vec<u8>, Failure> {
        let camera = self.scene.cameras.first().cloned().unwrap_or_else(|| picture::framing(self.scene));
        let width = self.arguments.width;
        Ok(picture::draw(&self.solution.mesh, &self.colours(), &camera, self.exposure(), width))
    }

    /// The scene's own COLLADA with the unscaled radiosity at the vertices.
    fn collada(&self) -> Result<Vec<u8>, Failure> {
        Ok(self.source.with_light(self.scene, &self.solution.mesh, &self.colours())?.into_bytes())
    }

    /// glTF binary.
    fn glb(&self) -> Result<Vec<u8>, Failure> {
        Ok(gltf::glb(self.scene, &self.solution.mesh, &self.colours(), self.exposure())?)
    }

    /// Red, green and blue radiosity at the vertices.
    fn colours(&self) -> Vec<[f64; 3]> {
        expose::rgb(&self.solution.vertex_radiosity(), self.solution.bands)
    }

    /// As asked, or chosen from the light.
    fn exposure(&self) -> Exposure {
        let asked = self.arguments.exposure.and_then(Exposure::new);
        asked.unwrap_or_else(|| Exposure::automatic(self.scene, self.solution))
    }
}

/// Refuses a path that is a folder, or whose folder is missing or takes no files.
fn probe(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refused =
        |reason: String| Failure::internal(format!("{}: cannot be written: {reason}", path.display()));
    if path.is_dir() {
        return Err(refused("it is a folder; name a file".to_owned()));
    }
    if path.exists() && !path.is_file() {
        return Ok(());
    }
    match tempfile::tempfile_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => Err(refused(format!("{error}; check the folder and its permissions"))),
    }
}

/// Prints data on stdout. A reader that has gone away wants no more of it: that is no error.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let written = std::io::stdout().write_all(text.as_bytes()).and_then(|()| std::io::stdout().flush());
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::internal(format!("stdout cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}
