//! Scenes to files of any kind.
use super::collada::Collada;
use super::error::FileError;
use super::{gltf, obj, ply, save::save, stl};
use crate::scene::Scene;
use std::path::Path;

/// Writes a scene in the format of the file's extension: COLLADA (`.dae`), glTF (`.glb`), OBJ (`.obj`, with a file of materials and
/// pictures beside it), PLY (`.ply`) or STL (`.stl`). Where a format has no up axis, the scene is turned to that which readers take for
/// granted. COLLADA alone holds everything; returns what the others cannot hold of this scene, a
/// clause each.
///
/// # Errors
/// [`FileError::UnknownOutput`] for another extension, [`FileError::Size`] and [`FileError::Write`].
///
/// ```no_run
/// let scene = radiosity::scenes::scene("cornell-box").expect("a built-in scene");
/// let left_out = radiosity::io::save_scene(&scene, "box.glb")?;
/// assert!(left_out.is_empty());
/// # Ok::<(), radiosity::io::FileError>(())
/// ```
pub fn save_scene(scene: &Scene, path: impl AsRef<Path>) -> Result<Vec<&'static str>, FileError> {
    let path = path.as_ref();
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "dae" => save(path, Collada::of(scene).text().as_bytes())?,
        "glb" => save(path, &gltf::scene_glb(scene)?)?,
        "obj" => save_obj(scene, path)?,
        "ply" => save(path, &ply::ply(scene))?,
        "stl" => save(path, &stl::stl(scene)?)?,
        _ => return Err(FileError::UnknownOutput { path: path.into() }),
    }
    Ok(left_out(scene, &extension))
}

/// What the OBJ file names is written before it. Where there was no such file, pictures that stand there are not its own: none is lost.
fn save_obj(scene: &Scene, path: &Path) -> Result<(), FileError> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().replace(char::is_whitespace, "_");
    let files = obj::text(scene, &stem);
    let folder = path.parent().unwrap_or(Path::new(""));
    let is_foreign = |(name, bytes): &&(String, Vec<u8>)| {
        !path.exists() && std::fs::read(folder.join(name)).is_ok_and(|there| there != *bytes)
    };
    if let Some((name, _)) = files.pictures.iter().find(is_foreign) {
        let reason = "a picture stands there already that may belong to another file";
        let source = std::io::Error::new(std::io::ErrorKind::AlreadyExists, reason);
        return Err(FileError::Write { path: folder.join(name), source });
    }
    for (name, bytes) in &files.pictures {
        save(folder.join(name), bytes)?;
    }
    save(folder.join(&files.mtl.0), files.mtl.1.as_bytes())?;
    save(path, files.obj.as_bytes())
}

/// What a format cannot hold of a scene.
fn left_out(scene: &Scene, extension: &str) -> Vec<&'static str> {
    let has_bands = scene.bands != 3 || !scene.wavelengths.is_empty();
    let plain = matches!(extension, "ply" | "stl");
    let lossy = [
        (plain && scene.patches.iter().any(|patch| patch.emits()), "emitted light"),
        (plain && scene.patches.iter().any(|patch| patch.texture.is_some()), "textures"),
        (extension == "stl", "reflectances"),
        (plain, "names of patches"),
        (extension != "dae" && has_bands, "bands that are not red, green and blue"),
        (matches!(extension, "obj" | "ply" | "stl") && !scene.cameras.is_empty(), "cameras"),
        (matches!(extension, "obj" | "ply" | "stl") && scene.asset.unit != 1.0, "the unit"),
    ];
    lossy.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, what)| what).collect()
}
