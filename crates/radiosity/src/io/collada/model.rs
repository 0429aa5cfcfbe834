//! A scene on its way to becoming a file: named faces and their materials.
use crate::scene::{Scene, asset::Asset, camera::Camera, patch::Patch, texture::Image, texture::Texture};
use crate::spectrum::Colours;
use glam::DVec3;
use std::{collections::BTreeMap, sync::Arc};

/// All that a new file holds.
#[derive(Debug)]
pub(crate) struct Model {
    /// What it is and where its numbers come from.
    pub(crate) title: String,
    pub(crate) asset: Asset,
    /// In nm; empty where bands are red, green and blue.
    pub(crate) wavelengths: Vec<f64>,
    pub(crate) materials: Vec<Material>,
    pub(crate) faces: Vec<Face>,
    pub(crate) cameras: Vec<Camera>,
}

#[derive(Clone, Debug)]
pub(crate) struct Material {
    pub(crate) name: String,
    /// Per band.
    pub(crate) reflectance: Vec<f64>,
    /// Radiance, per band.
    pub(crate) emission: Vec<f64>,
    pub(crate) texture: Option<Texture>,
}

/// A node: polygons of one material, each an outline, counter-clockwise seen from the front, with its holes.
#[derive(Debug)]
pub(crate) struct Face {
    pub(crate) name: String,
    /// Which of the model's materials.
    pub(crate) material: usize,
    pub(crate) polygons: Vec<Vec<Vec<DVec3>>>,
    /// How the material's picture lies on it, where not as the material has it.
    pub(crate) texture: Option<Texture>,
}

impl Model {
    /// A node for every patch, a material for every kind of surface.
    pub(crate) fn of(scene: &Scene) -> Model {
        let (mut materials, mut known) = (Vec::new(), BTreeMap::new());
        let mut face = |patch: &Patch| {
            let material = *known.entry(kind(patch)).or_insert_with(|| {
                materials.push(Material::of(materials.len(), patch));
                materials.len() - 1
            });
            let polygon = patch.polygon.loops().map(<[DVec3]>::to_vec).collect();
            Face {
                name: patch.name.clone(),
                material,
                polygons: vec![polygon],
                texture: patch.texture.clone(),
            }
        };
        let faces = scene.patches.iter().map(&mut face).collect();
        let title = "Written from another scene file".to_owned();
        let (asset, wavelengths, cameras) = (scene.asset, scene.wavelengths.clone(), scene.cameras.clone());
        Model { title, asset, wavelengths, materials, faces, cameras }
    }
}

/// What patches of one material have in common: the bits of their colours, and the picture that they show.
fn kind(patch: &Patch) -> (Vec<u64>, Option<*const Image>) {
    let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
    match &patch.texture {
        None => ([bits(&patch.reflectance), bits(&patch.emission)].concat(), None),
        Some(texture) => {
            ([bits(&texture.factor), bits(&patch.emission)].concat(), Some(Arc::as_ptr(&texture.image)))
        }
    }
}

impl Material {
    fn of(number: usize, patch: &Patch) -> Material {
        Material {
            name: format!("material-{}", number + 1),
            reflectance: patch.reflectance.clone(),
            emission: patch.emission.clone(),
            texture: patch.texture.clone(),
        }
    }

    /// What the reflectance and the emission look like, for programs that know no bands.
    pub(crate) fn colours(&self, wavelengths: &[f64]) -> [[f64; 3]; 2] {
        let colours = Colours::of(self.reflectance.len(), wavelengths);
        [&self.reflectance, &self.emission].map(|bands| colours.row(bands).map(|part| part.max(0.0)))
    }
}
