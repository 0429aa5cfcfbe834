//! The pictures that textures name: in the file itself, in a `data:` address, or beside the file.
use super::file::{File, XmlNode, child, children, descend};
use crate::image_file;
use crate::scene::{finding::Finding, texture::Image};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{collections::HashMap, sync::Arc};

/// Pictures read so far, by the id of their `<image>`.
pub(super) struct Images {
    /// The folder that file names are relative to; none for a text that is in no folder.
    folder: Option<PathBuf>,
    known: HashMap<String, Option<Arc<Image>>>,
}

impl Images {
    pub(super) fn new(folder: Option<&Path>) -> Images {
        Images { folder: folder.map(Into::into), known: HashMap::new() }
    }

    /// The picture of a `<texture>` element; where it cannot be had, none and a warning that says why.
    pub(super) fn of_texture<'a>(
        &mut self,
        file: &File<'a>,
        effect: XmlNode<'a>,
        texture: XmlNode<'a>,
        warnings: &mut Vec<Finding>,
    ) -> Option<Arc<Image>> {
        let element = element(file, effect, texture);
        let id = element.and_then(|image| image.attribute("id")).unwrap_or_default();
        if let Some(known) = self.known.get(id) {
            return known.clone();
        }
        let image = match element {
            Some(element) => self.read(element),
            None => Err("its <image> is not in the file".to_owned()),
        };
        let image = image.map(Arc::new).map_err(|reason| {
            let place = format!("{}: {reason}", file.place(texture));
            let what = "a texture cannot be read; reflectance 0.5 is taken";
            Finding::note(warnings, place, what, "put the picture beside the file, as PNG or JPEG");
        });
        self.known.insert(id.into(), image.clone().ok());
        image.ok()
    }

    fn read(&self, element: XmlNode<'_>) -> Result<Image, String> {
        let name = element.attribute("name").or_else(|| element.attribute("id")).unwrap_or("image");
        let hex = child(element, "data").or_else(|| descend(element, &["init_from", "hex"]));
        if let Some(digits) = hex.and_then(|data| data.text()) {
            return image_file::decode(name, unhex(digits).ok_or("its <data> is not hexadecimal")?);
        }
        let from = child(element, "init_from").ok_or("the <image> has no <init_from>")?;
        let address = child(from, "ref").unwrap_or(from).text().unwrap_or_default().trim();
        image_file::fetch(address, self.folder.as_deref())
    }
}

/// The `<image>`: through the effect's sampler and surface parameters, or named at once.
fn element<'a>(file: &File<'a>, effect: XmlNode<'a>, texture: XmlNode<'a>) -> Option<XmlNode<'a>> {
    let name = texture.attribute("texture")?;
    let parameter = |sid: &str, kind: &'static str| {
        let places = [Some(effect), child(effect, "profile_COMMON")];
        let mut all = places.into_iter().flatten().flat_map(|place| children(place, "newparam"));
        child(all.find(|parameter| parameter.attribute("sid") == Some(sid))?, kind)
    };
    let text = |node: XmlNode<'a>| node.text().map(str::trim);
    let Some(sampler) = parameter(name, "sampler2D") else { return file.by_id(name, "image") };
    if let Some(image) = child(sampler, "instance_image") {
        let url = image.attribute("url")?;
        return file.by_id(url.strip_prefix('#').unwrap_or(url), "image");
    }
    let surface = parameter(child(sampler, "source").and_then(text)?, "surface")?;
    file.by_id(child(surface, "init_from").and_then(text)?, "image")
}

/// Bytes as hexadecimal digits.
pub(super) fn hex(bytes: &[u8]) -> String {
    let mut digits = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        // Writing to a string cannot fail.
        let _ = write!(digits, "{byte:02x}");
    }
    digits
}

/// Bytes from hexadecimal digits, white space between them.
fn unhex(digits: &str) -> Option<Vec<u8>> {
    let digits: Option<Vec<u32>> =
        digits.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_digit(16)).collect();
    let pairs = digits.filter(|digits| digits.len() % 2 == 0)?;
    pairs.chunks(2).map(|pair| u8::try_from(16 * pair[0] + pair[1]).ok()).collect()
}
