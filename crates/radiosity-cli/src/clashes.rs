//! Outputs that would cost something else: an input, another output, the materials of another file.
use crate::failure::Failure;
use crate::outputs::{folder, is_stream};
use radiosity::Scene;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

/// Refuses outputs one of which is an input, or two of which are one file. Links lead to what they name.
pub(crate) fn refuse<'p>(
    inputs: impl IntoIterator<Item = &'p Path>,
    outputs: impl IntoIterator<Item = &'p Path>,
) -> Result<(), Failure> {
    let read: Vec<PathBuf> = inputs.into_iter().filter_map(place).collect();
    let mut written: Vec<PathBuf> = Vec::new();
    for (here, path) in outputs.into_iter().filter_map(|path| Some((place(path)?, path))) {
        let why = match (read.contains(&here), written.contains(&here)) {
            (true, _) => "it is an input, which would be lost; name another output",
            (_, true) => "two outputs go to this file, and one of them would be lost; name two files",
            _ => {
                written.push(here);
                continue;
            }
        };
        return Err(Failure::usage(format!("{}: {why}", path.display())));
    }
    Ok(())
}

/// Refuses outputs that are pictures on the patches of a scene, as their bytes tell.
pub(crate) fn refuse_pictures<'p>(
    scene: &Scene,
    outputs: impl IntoIterator<Item = &'p Path>,
) -> Result<(), Failure> {
    let textures = || scene.patches.iter().filter_map(|patch| patch.texture.as_ref());
    let is_shown = |path: &&Path| {
        let length = path.metadata().map_or(0, |found| found.len());
        let is_as_long = textures().any(|texture| texture.image.bytes.len() as u64 == length);
        // Other files, which may be large, are not read.
        is_as_long
            && std::fs::read(path).is_ok_and(|bytes| textures().any(|texture| texture.image.bytes == bytes))
    };
    match outputs.into_iter().filter(|path| place(path).is_some()).find(is_shown) {
        Some(path) => Err(Failure::usage(format!(
            "{}: it is a picture of the scene, which would be lost; name another output",
            path.display()
        ))),
        None => Ok(()),
    }
}

/// Refuses to write an OBJ file whose file of materials, which goes beside it, stands there already: unless the OBJ file that is
/// replaced names it, it belongs to another one, whose materials would be lost. It must not be the scene's own.
pub(crate) fn refuse_materials_of_others(output: &Path, scene: Option<&Path>) -> Result<(), Failure> {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy().replace(char::is_whitespace, "_");
    let materials = output.with_file_name(format!("{stem}.mtl"));
    if !is_obj(output) || !materials.exists() {
        return Ok(());
    }
    let reader = scene.filter(|scene| is_obj(scene) && names(scene, &materials));
    let reason = match reader {
        Some(scene) => format!("{} reads it", scene.display()),
        None if names(output, &materials) => return Ok(()),
        None => "it stands there already and belongs to another file".to_owned(),
    };
    let (materials, output) = (materials.display(), output.display());
    Err(Failure::usage(format!(
        "{materials}: {output} needs a file of this name, but {reason}; name another output"
    )))
}

fn is_obj(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("obj"))
}

/// Whether an OBJ file names a file of materials. One that cannot be read names none.
fn names(obj: &Path, materials: &Path) -> bool {
    let (Ok(file), wanted) = (File::open(obj), place(materials)) else { return false };
    let is_wanted = |name: &str| place(&obj.with_file_name(name)) == wanted;
    BufReader::new(file).split(b'\n').map_while(Result::ok).any(|line| {
        let line = String::from_utf8_lossy(&line);
        let rest = line.trim_start_matches('\u{feff}').trim().strip_prefix("mtllib");
        rest.is_some_and(|rest| is_wanted(rest.trim()) || rest.split_whitespace().any(is_wanted))
    })
}

/// Where a path leads; nothing for streams and devices, which hold nothing that could be lost.
fn place(path: &Path) -> Option<PathBuf> {
    if is_stream(path) || (path.exists() && !path.is_file()) {
        return None;
    }
    let new = || Some(folder(path).canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(new)
}
