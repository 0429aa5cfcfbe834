//! What a primitive reflects and emits.
use super::accessor::Buffers;
use crate::image_file;
use crate::io::surface::finish::Finish;
use crate::scene::{finding::Finding, texture::Image};
use gltf::material::AlphaMode;
use std::{collections::HashMap, path::Path, sync::Arc};

/// A material as patches need it.
#[derive(Clone)]
pub(super) struct ReadMaterial {
    pub(super) finish: Finish,
    /// Which set of a picture's coordinates it uses.
    pub(super) places: u32,
    pub(super) two_sided: bool,
}

/// The materials met so far.
pub(super) struct Materials<'f> {
    pub(super) buffers: &'f Buffers<'f>,
    pub(super) folder: Option<&'f Path>,
    known: HashMap<Option<usize>, ReadMaterial>,
    images: HashMap<usize, Option<Arc<Image>>>,
}

impl<'f> Materials<'f> {
    pub(super) fn new(buffers: &'f Buffers<'f>, folder: Option<&'f Path>) -> Self {
        Self { buffers, folder, known: HashMap::new(), images: HashMap::new() }
    }

    /// A material; its warnings are told when it is met first.
    pub(super) fn kind(
        &mut self,
        material: &gltf::Material<'_>,
        warnings: &mut Vec<Finding>,
    ) -> ReadMaterial {
        if let Some(kind) = self.known.get(&material.index()) {
            return kind.clone();
        }
        let kind = self.read(material, warnings);
        self.known.insert(material.index(), kind.clone());
        kind
    }

    fn read(&mut self, material: &gltf::Material<'_>, warnings: &mut Vec<Finding>) -> ReadMaterial {
        let name = material.name().map_or_else(|| format!("material {:?}", material.index()), Into::into);
        let mut warn =
            |what: &str, repair: &str| warnings.push(Finding::of_file(format!("{name}: {what}"), repair));
        if material.emissive_texture().is_some() {
            warn(
                "emissive textures are not read; the emissive factor alone is taken",
                "check that it is what you mean",
            );
        }
        if material.alpha_mode() != AlphaMode::Opaque {
            warn(
                "transparency is left out; the surface is opaque",
                "remove surfaces that should let light through",
            );
        }
        let surface = material.pbr_metallic_roughness();
        let [red, green, blue, _] = surface.base_color_factor().map(f64::from);
        let strength = f64::from(material.emissive_strength().unwrap_or(1.0));
        let emission = material.emissive_factor().map(|band| strength * f64::from(band));
        let texture = surface.base_color_texture();
        let image = texture.as_ref().and_then(|info| self.image(&info.texture().source(), warnings));
        let named = material.name().unwrap_or_default().into();
        let finish =
            Finish { material: named, reflectance: [red, green, blue], emission, image, spectra: None };
        ReadMaterial {
            finish,
            places: texture.map_or(0, |info| info.tex_coord()),
            two_sided: material.double_sided(),
        }
    }

    fn image(&mut self, image: &gltf::Image<'_>, warnings: &mut Vec<Finding>) -> Option<Arc<Image>> {
        if let Some(known) = self.images.get(&image.index()) {
            return known.clone();
        }
        let name = image.name().map_or_else(|| format!("image {}", image.index()), Into::into);
        let read = match image.source() {
            gltf::image::Source::View { view, .. } => {
                let bytes = self.buffers.view(&view).map_err(|error| error.to_string());
                bytes.and_then(|bytes| image_file::decode(&name, bytes.to_vec()))
            }
            gltf::image::Source::Uri { uri, .. } => image_file::fetch(uri, self.folder),
        };
        let read = read.map(Arc::new).map_err(|reason| {
            let what = format!("{name}: the texture cannot be read: {reason}; its factor alone is taken");
            warnings.push(Finding::of_file(what, "put the picture beside the file, as PNG or JPEG"));
        });
        self.images.insert(image.index(), read.clone().ok());
        read.ok()
    }
}
