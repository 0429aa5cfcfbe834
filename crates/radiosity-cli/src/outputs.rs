//! Results to files, by extension, and data to stdout.
use crate::failure::Failure;
use crate::input::STREAM;
use crate::json;
use crate::view_options::ViewOptions;
use radiosity::expose::Exposure;
use radiosity::io::{self, Source, collada::with_exposure, gltf, obj, ply};
use radiosity::picture::LinearFormat;
use radiosity::{Record, Scene, element_table, patch_table, viewer};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};

/// A file that a result can be written to.
#[derive(Debug)]
pub(crate) struct Output {
    path: PathBuf,
    kind: FileKind,
}

/// What the file will hold.
#[derive(Clone, Copy, Debug)]
enum FileKind {
    Picture,
    Linear(LinearFormat),
    Collada,
    Glb,
    Json,
    Page,
    Obj,
    Ply,
    Patches,
    Elements,
}

/// By the end of the file's name.
const KINDS: [(&str, FileKind); 11] = [
    (".elements.csv", FileKind::Elements),
    (".csv", FileKind::Patches),
    (".png", FileKind::Picture),
    (".exr", FileKind::Linear(LinearFormat::Exr)),
    (".hdr", FileKind::Linear(LinearFormat::Hdr)),
    (".dae", FileKind::Collada),
    (".glb", FileKind::Glb),
    (".json", FileKind::Json),
    (".html", FileKind::Page),
    (".obj", FileKind::Obj),
    (".ply", FileKind::Ply),
];

/// What outputs are written from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contents<'s> {
    pub(crate) view: &'s ViewOptions,
    pub(crate) record: &'s Record,
    /// The scene and its file, where they are at hand.
    pub(crate) source: Option<(&'s Source, &'s Scene)>,
    /// The solver's figures, where it has just run.
    pub(crate) figures: Option<&'s json::Figures<'s>>,
}

impl Output {
    /// The outputs of a command: their extensions must be known, and their folders must take new files, before anything is solved.
    /// What goes to stdout is of the kind that `format` names.
    pub(crate) fn all(paths: &[PathBuf], format: &str) -> Result<Vec<Output>, Failure> {
        if paths.iter().filter(|path| is_stream(path)).count() > 1 {
            return Err(Failure::usage("stdout takes one output; give -o - once"));
        }
        paths.iter().map(|path| Output::new(path, format)).collect()
    }

    /// One of these.
    pub(crate) fn new(path: &Path, format: &str) -> Result<Output, Failure> {
        let name = match is_stream(path) {
            true => format!(".{format}"),
            false => path.file_name().unwrap_or_default().to_string_lossy().to_lowercase(),
        };
        let found = KINDS.iter().find(|(end, _)| name.ends_with(end));
        let (_, kind) = *found.ok_or_else(|| {
            let ends: Vec<&str> = KINDS.iter().map(|(end, _)| *end).collect();
            let hint = if name.ends_with(".stl") { ", since STL holds no light" } else { "" };
            Failure::usage(format!(
                "{}: unknown kind of file; name it {}{hint}",
                path.display(),
                ends.join(", ")
            ))
        })?;
        if is_stream(path) && !matches!(kind, FileKind::Json | FileKind::Patches | FileKind::Elements) {
            refuse_terminal()?;
        }
        probe(path)?;
        Ok(Output { path: path.to_owned(), kind })
    }

    /// Whether it is for eyes alone.
    pub(crate) fn is_picture(&self) -> bool {
        matches!(self.kind, FileKind::Picture | FileKind::Linear(_))
    }

    /// Writes the file, whole or not at all.
    pub(crate) fn write(&self, contents: &Contents<'_>) -> Result<(), Failure> {
        save(&self.path, &self.bytes(contents)?)
    }

    /// What the file will hold.
    pub(crate) fn bytes(&self, contents: &Contents<'_>) -> Result<Vec<u8>, Failure> {
        Ok(match self.kind {
            FileKind::Picture => contents.picture()?,
            FileKind::Linear(format) => contents.linear_picture(format)?,
            FileKind::Collada => contents.collada()?,
            FileKind::Glb => contents.glb()?,
            FileKind::Json => contents.json().into_bytes(),
            FileKind::Page => viewer::page(contents.record, contents.exposure()?).into_bytes(),
            FileKind::Obj => obj::lit(contents.record, contents.exposure()?).into_bytes(),
            FileKind::Ply => ply::lit(contents.record, contents.exposure()?),
            FileKind::Patches => patch_table(contents.record).into_bytes(),
            FileKind::Elements => element_table(contents.record).into_bytes(),
        })
    }
}

/// Whether a path stands for stdout.
pub(crate) fn is_stream(path: &Path) -> bool {
    path == Path::new(STREAM)
}

/// Writes bytes to a file, whole or not at all, or to stdout.
pub(crate) fn save(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stream(path) { print_bytes(bytes) } else { Ok(io::save(path, bytes)?) }
}

/// What is not for people would only upset their terminal.
fn refuse_terminal() -> Result<(), Failure> {
    if std::io::stdout().is_terminal() {
        return Err(Failure::usage("stdout is a terminal; send it to a file or to another program"));
    }
    Ok(())
}

impl Contents<'_> {
    /// As asked, or chosen from what the camera sees.
    fn exposure(&self) -> Result<Exposure, Failure> {
        Ok(self.view.exposure(self.record, &self.view.camera(self.record)?))
    }

    /// PNG as the camera sees it.
    fn picture(&self) -> Result<Vec<u8>, Failure> {
        let (record, view) = (self.record, self.view);
        Ok(record.draw(&view.camera(record)?, self.exposure()?, view.width))
    }

    /// Radiance as the camera sees it.
    fn linear_picture(&self, format: LinearFormat) -> Result<Vec<u8>, Failure> {
        let camera = self.view.camera(self.record)?;
        self.record.draw_linear(&camera, format, self.view.width).map_err(Failure::internal)
    }

    /// The scene's own COLLADA with the unscaled radiosity at the vertices.
    fn collada(&self) -> Result<Vec<u8>, Failure> {
        let (source, scene) = self.source.ok_or_else(|| {
            Failure::usage(
                "only solve writes COLLADA, into the scene's own file; expose then turns it into colours",
            )
        })?;
        let text = source.with_light(scene, &self.record.mesh(), &self.record.colours())?;
        Ok(with_exposure(&text, self.exposure()?).into_bytes())
    }

    /// glTF binary.
    fn glb(&self) -> Result<Vec<u8>, Failure> {
        Ok(gltf::glb(self.record, self.exposure()?)?)
    }

    /// The figures and the light.
    fn json(&self) -> String {
        json::line(&json::SolutionFile { figures: self.figures, light: self.record })
    }
}

/// Refuses a path that is a folder, or whose folder is missing or takes no files.
pub(crate) fn probe(path: &Path) -> Result<(), Failure> {
    let refused =
        |reason: String| Failure::internal(format!("{}: cannot be written: {reason}", path.display()));
    if path.is_dir() {
        return Err(refused("it is a folder; name a file".to_owned()));
    }
    if is_stream(path) || (path.exists() && !path.is_file()) {
        return Ok(());
    }
    match tempfile::tempfile_in(folder(path)) {
        Ok(_) => Ok(()),
        Err(error) => Err(refused(format!("{error}; check the folder and its permissions"))),
    }
}

/// The folder of a file.
pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Prints text on stdout.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// Writes data to stdout. A reader that has gone away wants no more of it: that is no error.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let written = std::io::stdout().write_all(bytes).and_then(|()| std::io::stdout().flush());
    match written {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::internal(format!("stdout cannot be written: {error}")))
        }
        _ => Ok(()),
    }
}
