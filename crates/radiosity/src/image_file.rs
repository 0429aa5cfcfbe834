//! Pictures of textures: PNG and JPEG to linear colours.
use crate::scene::texture::Image;
use base64::Engine;
use image::ImageDecoder;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The most texels that are read.
const MAX_TEXELS: u64 = 1 << 26;
/// No byte of a file holds more bytes of a picture: in PNG 1032 (deflate, RFC 1951), in JPEG blocks of 64 texels of three bytes at a bit each.
const MOST_OF_A_BYTE: u64 = 1536;

/// A picture from a `data:` address, or from a file whose name is relative to a folder.
pub(crate) fn fetch(address: &str, folder: Option<&Path>) -> Result<Image, String> {
    let name = if address.starts_with("data:") { "embedded" } else { address };
    decode(name, bytes(address, folder)?)
}

/// The bytes behind a `data:` address, or of a file whose name is relative to a folder.
pub(crate) fn bytes(address: &str, folder: Option<&Path>) -> Result<Vec<u8>, String> {
    if let Some(data) = address.strip_prefix("data:") {
        let (_, text) = data.split_once(";base64,").ok_or("its address is not in base64")?;
        let bytes = base64::engine::general_purpose::STANDARD.decode(text.trim());
        return bytes.map_err(|error| format!("its address is not in base64: {error}"));
    }
    let path = local(address).ok_or("it is not a file of this machine; save it beside the scene")?;
    let folder = folder.ok_or("the scene is in no folder")?;
    let read = regular(&folder.join(&path)).or_else(|error| match foreign(&path) {
        Some(names) => names.iter().find_map(|name| regular(&folder.join(name)).ok()).ok_or(error),
        None => Err(error),
    });
    read.map_err(|error| format!("{}: {error}", path.display()))
}

/// The bytes of a file beside a scene; nothing for a `data:` address and for what cannot be read.
pub(crate) fn beside(address: &str, folder: Option<&Path>) -> Option<Vec<u8>> {
    if address.starts_with("data:") {
        return None;
    }
    bytes(address, folder).ok()
}

/// A path as Windows has it, and its last part alone: the file may be beside the scene. Nothing for a path of this machine.
fn foreign(path: &Path) -> Option<[String; 2]> {
    let turned = path.to_str().filter(|path| path.contains('\\'))?.replace('\\', "/");
    let last = turned.rsplit('/').next()?.to_owned();
    Some([turned, last])
}

/// The bytes of a regular file: what else a scene may name, a device or a pipe, need not end.
fn regular(path: &Path) -> std::io::Result<Vec<u8>> {
    if !path.metadata()?.is_file() {
        return Err(std::io::Error::other("not a regular file"));
    }
    std::fs::read(path)
}

/// A path from an address: `file://` or none, `%20` and its like resolved.
fn local(address: &str) -> Option<PathBuf> {
    let path = address.strip_prefix("file://").unwrap_or(address);
    if path.contains("://") {
        return None;
    }
    Some(PathBuf::from(percent_encoding::percent_decode_str(path).decode_utf8().ok()?.into_owned()))
}

/// Decodes a picture; its colours are taken as sRGB, as pictures are stored, and an alpha channel is left out.
pub(crate) fn decode(name: &str, bytes: Vec<u8>) -> Result<Image, String> {
    let refused = |error: image::ImageError| format!("{name}: {error}");
    let mut reader = image::ImageReader::new(Cursor::new(&bytes))
        .with_guessed_format()
        .map_err(|error| format!("{name}: {error}"))?;
    let mime = match reader.format() {
        Some(image::ImageFormat::Png) => "image/png",
        Some(image::ImageFormat::Jpeg) => "image/jpeg",
        _ => return Err(format!("{name}: neither PNG nor JPEG; convert it")),
    };
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(16 * MAX_TEXELS);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(refused)?;
    may_hold(bytes.len() as u64, &decoder).map_err(|refusal| format!("{name}: {refusal}"))?;
    let picture = image::DynamicImage::from_decoder(decoder).map_err(refused)?.into_rgb16();
    let linear = |word: u16| linear(f64::from(word) / f64::from(u16::MAX));
    let texels: Vec<[f64; 3]> = picture.pixels().map(|pixel| pixel.0.map(linear)).collect();
    if texels.is_empty() {
        return Err(format!("{name}: it has no texels"));
    }
    Ok(Image { name: name.into(), mime, width: picture.width() as usize, texels, bytes })
}

/// Refuses a picture that is larger than what is read, or than a file of so many bytes can hold, before there is memory for it.
fn may_hold(bytes: u64, head: &impl ImageDecoder) -> Result<(), String> {
    let (width, height) = head.dimensions();
    let texels = u64::from(width) * u64::from(height);
    let needed = texels.saturating_mul(u64::from(head.original_color_type().bits_per_pixel())) / 8;
    if texels > MAX_TEXELS {
        return Err(format!("{width} × {height} texels are too many; make it smaller"));
    }
    if needed > MOST_OF_A_BYTE * bytes {
        return Err(format!("{width} × {height} texels are not in {bytes} bytes; save it again"));
    }
    Ok(())
}

/// The linear intensity of an sRGB value, both 0 to 1 (IEC 61966-2-1).
pub(crate) fn linear(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_picture_is_refused_by_name() {
        for bytes in [&b""[..], b"\x89PNG\r\n\x1a\n", b"GIF89a", b"\xff\xd8\xff\xe0 no more"] {
            assert!(decode("broken", bytes.to_vec()).unwrap_err().starts_with("broken"));
        }
        assert!(fetch("https://example.org/a.png", None).is_err());
        assert!(fetch("data:image/png;base64,%%%", None).is_err());
    }

    /// A picture whose head says how large it is, and nothing follows.
    fn head(width: u32, height: u32) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut writer = png::Encoder::new(&mut bytes, width, height).write_header().unwrap();
        writer.write_chunk(png::chunk::IDAT, &[0; 16]).unwrap();
        drop(writer);
        bytes
    }

    #[test]
    fn a_picture_that_a_file_cannot_hold_is_refused_before_it_is_read() {
        let cases =
            [(1, 0x0600_0001, "are too many"), (1, 0x0060_0001, "are not in"), (8192, 8192, "are not in")];
        for (width, height, why) in cases {
            let refusal = decode("tall", head(width, height)).unwrap_err();
            assert!(refusal.contains(why), "{refusal}");
        }
    }

    /// What is packed as tightly as can be is read.
    #[test]
    fn a_large_picture_of_one_colour_is_read() {
        for format in [image::ImageFormat::Png, image::ImageFormat::Jpeg] {
            let mut file = Cursor::new(Vec::new());
            image::RgbImage::from_pixel(4096, 4096, image::Rgb([0; 3])).write_to(&mut file, format).unwrap();
            assert_eq!(decode("black", file.into_inner()).unwrap().texels.len(), 1 << 24);
        }
    }

    #[cfg(unix)]
    #[test]
    fn what_never_ends_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        for address in ["/dev/zero", "file:///dev/zero", "%2Fdev/zero", "."] {
            let refusal = bytes(address, Some(folder.path())).unwrap_err();
            assert!(refusal.contains("not a regular file"), "{refusal}");
        }
    }
}
