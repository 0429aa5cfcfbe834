//! What a primitive reflects and emits.
use super::accessor::Buffers;
use crate::image_file;
use crate::io::surface::finish::Finish;
use crate::scene::{finding::Finding, texture::Image};
use glam::{DAffine2, DVec2};
use gltf::material::AlphaMode;
use gltf::texture::{Info, TextureTransform, WrappingMode};
use std::{collections::HashMap, path::Path, sync::Arc};

/// Places so far beyond a picture's rim, in shares of it, are still on the rim.
const RIM: f64 = 1e-3;

/// A material as patches need it.
#[derive(Clone)]
pub(super) struct ReadMaterial {
    pub(super) finish: Finish,
    /// Which set of a picture's coordinates it uses.
    pub(super) places: u32,
    /// From these coordinates to those in the picture.
    pub(super) laid: DAffine2,
    /// Whether the picture repeats to the right and down.
    repeats: [bool; 2],
    pub(super) two_sided: bool,
}

impl ReadMaterial {
    /// Whether a place is beyond the rim of a picture that does not repeat there.
    pub(super) fn is_beyond(&self, place: DVec2) -> bool {
        let is_outside = |at: f64| !(-RIM..=1.0 + RIM).contains(&at);
        let outside = place.to_array().map(is_outside);
        self.finish.image.is_some()
            && outside.iter().zip(self.repeats).any(|(outside, repeats)| *outside && !repeats)
    }
}

/// The materials met so far.
pub(super) struct Materials<'f> {
    pub(super) buffers: &'f Buffers<'f>,
    pub(super) folder: Option<&'f Path>,
    /// How many of the scene's units there are in one of what the file says that surfaces emit.
    emitted: f64,
    known: HashMap<Option<usize>, ReadMaterial>,
    images: HashMap<usize, Option<Arc<Image>>>,
}

impl<'f> Materials<'f> {
    pub(super) fn new(buffers: &'f Buffers<'f>, folder: Option<&'f Path>, emitted: f64) -> Self {
        Self { buffers, folder, emitted, known: HashMap::new(), images: HashMap::new() }
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
        let mut warn = |what: &str, repair: &str| Finding::note(warnings, name.as_str(), what, repair);
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
        if material.normal_texture().is_some() {
            warn("bumps are left out", "make them geometry where they matter");
        }
        let surface = material.pbr_metallic_roughness();
        let [red, green, blue, _] = surface.base_color_factor().map(as_written);
        let strength = self.emitted * as_written(material.emissive_strength().unwrap_or(1.0));
        let emission = material.emissive_factor().map(|band| strength * as_written(band));
        let texture = surface.base_color_texture();
        let image = texture.as_ref().and_then(|info| self.image(&info.texture().source(), warnings));
        let named = material.name().unwrap_or_default().into();
        let finish =
            Finish { material: named, reflectance: [red, green, blue], emission, image, spectra: None };
        ReadMaterial {
            finish,
            places: texture.as_ref().map_or(0, places),
            repeats: texture.as_ref().map_or([true; 2], repeats),
            laid: texture
                .as_ref()
                .and_then(Info::texture_transform)
                .map_or(DAffine2::IDENTITY, |laid| laid_by(&laid)),
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
            let what = "a texture cannot be read; its factor alone is taken";
            let repair = "put the picture beside the file, as PNG or JPEG";
            Finding::note(warnings, format!("{name}: {reason}"), what, repair);
        });
        self.images.insert(image.index(), read.clone().ok());
        read.ok()
    }
}

/// The set of coordinates: a transform may name another one.
fn places(info: &Info<'_>) -> u32 {
    info.texture_transform().and_then(|laid| laid.tex_coord()).unwrap_or_else(|| info.tex_coord())
}

/// Whether a picture repeats to the right and down.
fn repeats(info: &Info<'_>) -> [bool; 2] {
    let sampler = info.texture().sampler();
    [sampler.wrap_s(), sampler.wrap_t()].map(|mode| mode == WrappingMode::Repeat)
}

/// Scaled, turned, moved; u to the right and v down, as KHR_texture_transform has it.
fn laid_by(laid: &TextureTransform<'_>) -> DAffine2 {
    let [scale, offset] = [laid.scale(), laid.offset()].map(|pair| DVec2::from(pair.map(as_written)));
    // A positive angle turns against the clock, and v goes down.
    DAffine2::from_scale_angle_translation(scale, -as_written(laid.rotation()), offset)
}

/// A number of the document, which the `gltf` crate rounds to single precision, as it is written there: 0.8 and not 0.800000011920929.
pub(super) fn as_written(number: f32) -> f64 {
    number.to_string().parse().unwrap_or_else(|_| f64::from(number))
}
