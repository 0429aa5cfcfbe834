//! Which format a file has: by what its first bytes say, by its name, and by what its lines look like.
use super::error::FileError;
use std::path::Path;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Collada,
    Gltf,
    Obj,
    Ply,
    Stl,
    Vs3,
}

/// How files of formats begin that are not read, so that they are refused by name.
const FOREIGN: [(&[u8], &str); 14] = [
    (b"Kaydara FBX", "FBX"),
    (b"; FBX", "FBX"),
    (b"BLENDER", "a Blender file"),
    (b"\x28\xb5\x2f\xfd", "a compressed file (Zstandard, as Blender writes)"),
    (b"\x1f\x8b", "a compressed file (gzip)"),
    (b"PK\x03\x04", "an archive (zip; USDZ, 3MF and ZAE are such)"),
    (b"DRACO", "Draco compression"),
    (b"#usda", "USD"),
    (b"PXR-USDC", "USD"),
    (b"#VRML", "VRML"),
    (b"ISO-10303-21", "STEP or IFC"),
    (b"\x4d\x4d", "3D Studio (.3ds)"),
    (b"#!radiance", "a Radiance picture"),
    (b"%PDF", "PDF"),
];

impl Format {
    /// The format of a file.
    pub(super) fn of(name: &str, bytes: &[u8]) -> Result<Format, FileError> {
        let foreign = FOREIGN.iter().find(|(start, _)| bytes.starts_with(start));
        if let Some((_, feature)) = foreign.filter(|_| !is_binary_stl(bytes)) {
            let (file, feature) = (name.to_owned(), (*feature).to_owned());
            let repair = "export the scene as COLLADA, glTF 2.0, OBJ, PLY or STL";
            return Err(FileError::Unread { file, feature, repair });
        }
        let known = by_start(bytes).or_else(|| by_name(name)).or_else(|| by_lines(bytes));
        known.ok_or_else(|| FileError::Unknown { file: name.to_owned() })
    }
}

/// What the first bytes leave no doubt of.
fn by_start(bytes: &[u8]) -> Option<Format> {
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    match start {
        [b'g', b'l', b'T', b'F', ..] | [b'{', ..] => Some(Format::Gltf),
        [b'p', b'l', b'y', b'\n' | b'\r', ..] => Some(Format::Ply),
        [b'<', ..] | [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [0, b'<', ..] => Some(Format::Collada),
        _ => None,
    }
}

fn by_name(name: &str) -> Option<Format> {
    let extension = Path::new(name).extension()?.to_string_lossy().to_lowercase();
    match extension.as_str() {
        "dae" => Some(Format::Collada),
        "gltf" | "glb" => Some(Format::Gltf),
        "obj" => Some(Format::Obj),
        "ply" => Some(Format::Ply),
        "stl" => Some(Format::Stl),
        "vs3" => Some(Format::Vs3),
        _ => None,
    }
}

/// For what comes through a pipe: the words that lines of each format begin with.
fn by_lines(bytes: &[u8]) -> Option<Format> {
    if is_binary_stl(bytes) {
        return Some(Format::Stl);
    }
    let text = std::str::from_utf8(bytes).ok()?;
    let text = text.trim_start_matches('\u{feff}');
    let start = text.trim_start().get(..5).unwrap_or_default();
    if start.eq_ignore_ascii_case("solid") && text.to_ascii_lowercase().contains("facet") {
        return Some(Format::Stl);
    }
    let counts = |words: &[&str], count: usize| words.len() == count;
    text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>()).find_map(|words| {
        match words.first() {
            Some(&"mtllib" | &"usemtl" | &"vn" | &"vt") => Some(Format::Obj),
            Some(&"v") if !counts(&words, 5) => Some(Format::Obj),
            Some(&"F" | &"f")
                if words.get(1).is_some_and(|word| word.starts_with('3')) && counts(&words, 2) =>
            {
                Some(Format::Vs3)
            }
            Some(&"V") => Some(Format::Vs3),
            _ => None,
        }
    })
}

/// Whether the length is that of a binary STL file.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| <[u8; 4]>::try_from(count).ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contents_come_before_names_and_names_before_looks() {
        let of = |name: &str, bytes: &[u8]| Format::of(name, bytes).ok();
        assert_eq!(of("a.dae", b"glTF\x02"), Some(Format::Gltf));
        assert_eq!(of("a.obj", b"ply\nformat ascii 1.0"), Some(Format::Ply));
        assert_eq!(of("a.glb", b"no such thing"), Some(Format::Gltf));
        assert_eq!(of("-", b"\xff\xfe<\0?\0"), Some(Format::Collada));
        assert_eq!(of("-", b"# a room\nv 0 0 0\n"), Some(Format::Obj));
        assert_eq!(of("-", b"T a room\nF 3\nV 1 0 0 0\n"), Some(Format::Vs3));
        assert_eq!(of("-", b"solid a\nfacet normal 0 0 1"), Some(Format::Stl));
        assert_eq!(of("-", b"no such thing"), None);
    }

    #[test]
    fn foreign_formats_are_refused_by_name() {
        for (start, feature) in FOREIGN {
            let message = Format::of("a.glb", start).unwrap_err().to_string();
            assert!(message.contains(feature) && message.lines().count() == 1, "{message}");
        }
    }
}
