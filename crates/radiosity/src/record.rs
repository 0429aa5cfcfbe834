//! A solution as it is written: all that pictures, pages and tables need, without the scene's file.
use crate::expose::Exposure;
use crate::image_file::fetch;
use crate::mesh::conform::Conforming;
use crate::mesh::element::{Element, Mesh};
use crate::picture::{framing::framing, linear::LinearFormat, paint, painting::Painting, radiance, seen};
use crate::recording::Recording;
use crate::scene::{Scene, asset::Asset, camera::Camera, patch::Patch, texture::Image};
use crate::solve::solution::Solution;
use crate::spectrum::Colours;
use base64::Engine;
use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A solution with a description of its scene, as it is written to JSON and read back.
///
/// Lists of values hold all bands of the first vertex or element, then all bands of the second, and so on.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// The name of the scene's file.
    pub scene: String,
    /// The scene's up axis and unit.
    pub asset: Asset,
    /// The scene's cameras.
    pub cameras: Vec<Camera>,
    /// Number of bands of every value.
    pub bands: usize,
    /// The wavelength of each band in nm; see [`Scene::wavelengths`].
    #[serde(default)]
    pub wavelengths: Vec<f64>,
    /// Lumens in a unit of power of each band: an irradiance times these, added up, is an illuminance in lx. See [`Scene::lumens`].
    #[serde(default)]
    pub lumens: Vec<f64>,
    /// Per band, a bound on the algebraic error of every radiosity, W/m²; see [`Solution::bound`].
    pub bound: Vec<f64>,
    /// The patches, in the scene's order.
    pub patches: Vec<PatchRecord>,
    /// Positions of the mesh's vertices.
    pub vertices: Vec<DVec3>,
    /// Interpolated radiosity at the vertices, W/m².
    pub vertex_radiosity: Vec<f64>,
    /// Interpolated irradiance at the vertices, W/m².
    pub vertex_irradiance: Vec<f64>,
    /// The texture coordinates of each vertex in the picture of its patch; empty where no patch has a picture.
    pub places: Vec<DVec2>,
    /// The elements: the patch, and the vertices at the three corners, counter-clockwise seen from the front.
    pub elements: Vec<[usize; 4]>,
    /// Radiosity of the elements, W/m².
    pub radiosity: Vec<f64>,
    /// Irradiance of the elements, W/m².
    pub irradiance: Vec<f64>,
    /// The pictures, as `data:` URLs.
    pub pictures: Vec<String>,
    /// The run, step by step, where it was recorded.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recording: Option<Recording>,
}

/// A patch as it is written.
#[derive(Clone, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PatchRecord {
    /// Its name.
    pub name: String,
    /// Its area, in the file's unit squared.
    pub area: f64,
    /// Reflectance per band; the mean of its texture where it has one.
    pub reflectance: Vec<f64>,
    /// Emitted radiance per band.
    pub emission: Vec<f64>,
    /// Mean irradiance per band, W/m².
    pub irradiance: Vec<f64>,
    /// Mean radiosity per band, W/m².
    pub radiosity: Vec<f64>,
    /// How far the mean irradiance may be from that of the scene, per band, W/m²; see [`Solution::estimate`]. Empty where that is not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub estimate: Vec<f64>,
    /// Whether the camera sees it for which the light was found; see [`Solution::in_view`]. Nothing where it was found for no camera.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub in_view: Option<bool>,
    /// Index of its picture.
    pub picture: Option<usize>,
    /// What the picture's colours are multiplied by.
    pub tint: [f64; 3],
}

impl Record {
    /// The record of a solution of `scene`, which was read from the file `name`. Elements with vertices of others in the middle of their sides
    /// are cut there, so that what is drawn has no cracks.
    #[must_use]
    pub fn new(name: &str, scene: &Scene, solution: &Solution) -> Record {
        let fine = solution.shown();
        let (shown, bands) = (Conforming::of(&fine.mesh), solution.bands);
        let mesh = &shown.mesh;
        let (pictures, numbers) = pictures(scene);
        let irradiance = solution.patch_means(&solution.irradiance, scene.patches.len());
        let radiosity = solution.patch_means(&solution.radiosity, scene.patches.len());
        let means = irradiance.into_iter().zip(radiosity);
        let patches = scene.patches.iter().zip(means).enumerate();
        Record {
            scene: name.into(),
            asset: scene.asset,
            cameras: scene.cameras.clone(),
            bands,
            wavelengths: scene.wavelengths.clone(),
            lumens: scene.lumens(),
            bound: solution.bound.clone(),
            patches: patches
                .map(|(index, (patch, (irradiance, radiosity)))| PatchRecord {
                    name: patch.name.clone(),
                    area: patch.polygon.area(),
                    reflectance: patch.reflectance.clone(),
                    emission: patch.emission.clone(),
                    irradiance,
                    radiosity,
                    estimate: solution.patch_estimate(index).to_vec(),
                    in_view: solution.in_view.as_ref().map(|in_view| in_view[index]),
                    picture: numbers.get(&index).copied(),
                    tint: patch.texture.as_ref().map_or([1.0; 3], |texture| texture.factor),
                })
                .collect(),
            vertices: mesh.vertices.clone(),
            vertex_radiosity: shown.at_vertices(fine.vertex_radiosity(), bands),
            vertex_irradiance: shown.at_vertices(fine.vertex_irradiance(), bands),
            places: if pictures.is_empty() { Vec::new() } else { places(scene, mesh) },
            elements: mesh.elements.iter().map(|element| indices(*element)).collect(),
            radiosity: shown.on_elements(&fine.radiosity, bands),
            irradiance: shown.on_elements(&fine.irradiance, bands),
            pictures,
            recording: None,
        }
    }

    /// Checks a record that was read: that every index is within its list, and that every list has the right length.
    ///
    /// # Errors
    /// A sentence that says what is wrong.
    pub fn check(&self) -> Result<(), String> {
        let (vertices, elements) = (self.vertices.len(), self.elements.len());
        let lists = [
            ("bound", self.bound.len(), 1),
            ("vertex_radiosity", self.vertex_radiosity.len(), vertices),
            ("vertex_irradiance", self.vertex_irradiance.len(), vertices),
            ("radiosity", self.radiosity.len(), elements),
            ("irradiance", self.irradiance.len(), elements),
        ];
        for (name, found, rows) in lists {
            let wanted = rows.saturating_mul(self.bands);
            if found != wanted || self.bands == 0 {
                return Err(format!("{name} has {found} values where {wanted} are needed"));
            }
        }
        if ![0, self.bands].contains(&self.wavelengths.len()) {
            return Err(format!(
                "wavelengths has {} values where {} are needed",
                self.wavelengths.len(),
                self.bands
            ));
        }
        if ![0, self.bands].contains(&self.lumens.len()) {
            return Err(format!("lumens has {} values where {} are needed", self.lumens.len(), self.bands));
        }
        if ![0, vertices].contains(&self.places.len()) {
            return Err(format!("places has {} rows where {vertices} are needed", self.places.len()));
        }
        let pictured = self.patches.iter().any(|patch| patch.picture.is_some());
        if pictured && self.places.is_empty() && vertices > 0 {
            return Err("a patch has a picture, but places is empty".to_owned());
        }
        if let Some(camera) = self.cameras.iter().find(|camera| !camera.is_sound()) {
            return Err(format!("camera {} sees nothing", camera.name));
        }
        let outside = |[patch, a, b, c]: &[usize; 4]| {
            *patch >= self.patches.len() || [a, b, c].iter().any(|corner| **corner >= vertices)
        };
        if let Some(element) = self.elements.iter().position(outside) {
            return Err(format!("element {element} names a patch or a vertex that is not there"));
        }
        let sound = |recording: &Recording| recording.is_sound(self.bands, self.patches.len(), elements);
        if !self.recording.as_ref().is_none_or(sound) {
            return Err("the recording does not fit the solution".to_owned());
        }
        let bands = |patch: &PatchRecord| {
            let lists = [&patch.reflectance, &patch.emission, &patch.irradiance, &patch.radiosity];
            lists.iter().any(|list| list.len() != self.bands)
                || ![0, self.bands].contains(&patch.estimate.len())
                || patch.estimate.len() != self.patches[0].estimate.len()
                || patch.picture.is_some_and(|picture| picture >= self.pictures.len())
        };
        match self.patches.iter().find(|patch| bands(patch)) {
            Some(patch) => {
                Err(format!("patch {} has other bands, or a picture that is not there", patch.name))
            }
            None => Ok(()),
        }
    }

    /// The mesh.
    #[must_use]
    pub fn mesh(&self) -> Mesh {
        let element = |&[patch, a, b, c]: &[usize; 4]| Element { patch, corners: [a, b, c] };
        let elements = self.elements.iter().map(element).collect();
        Mesh { vertices: self.vertices.clone(), elements }
    }

    /// Red, green and blue radiosity at the vertices; see [`rgb`](crate::expose::rgb).
    #[must_use]
    pub fn colours(&self) -> Vec<[f64; 3]> {
        self.shown().rows(&self.vertex_radiosity)
    }

    /// What the bands look like.
    pub(crate) fn shown(&self) -> Colours {
        Colours::of(self.bands, &self.wavelengths)
    }

    /// The bytes of a PNG, drawn as by [`draw`](crate::picture::draw). Patches with pictures show these in the light that falls
    /// on them. `width` is in pixels.
    #[must_use]
    pub fn draw(&self, camera: &Camera, exposure: Exposure, width: u32) -> Vec<u8> {
        self.painted(|painting| paint(painting, camera, exposure, width))
    }

    /// The bytes of a picture as [`Record::draw`] draws it, but of linear radiance, W/m²/sr, without an exposure.
    ///
    /// # Errors
    /// What the encoder says where such a picture cannot be written.
    pub fn draw_linear(&self, camera: &Camera, format: LinearFormat, width: u32) -> Result<Vec<u8>, String> {
        self.painted(|painting| radiance(painting, camera, format, width))
    }

    /// What `drawn` makes of the mesh with its light and pictures.
    fn painted<T>(&self, drawn: impl FnOnce(&Painting<'_>) -> T) -> T {
        let pictures: Vec<Option<Image>> =
            self.pictures.iter().map(|address| fetch(address, None).ok()).collect();
        let shown = |patch: &PatchRecord| pictures[patch.picture?].as_ref();
        let images: Vec<Option<&Image>> = self.patches.iter().map(shown).collect();
        let (mut light, under) = (self.colours(), self.under_pictures());
        for &[_, a, b, c] in self.elements.iter().filter(|element| images[element[0]].is_some()) {
            for corner in [a, b, c] {
                light[corner] = under[corner];
            }
        }
        drawn(&Painting { mesh: &self.mesh(), light: &light, places: &self.places, images: &images })
    }

    /// What a picture's colours are multiplied with at every vertex: the irradiance times the patch's tint.
    pub(crate) fn under_pictures(&self) -> Vec<[f64; 3]> {
        let mut light = self.shown().rows(&self.vertex_irradiance);
        let mut tinted = vec![false; light.len()];
        for &[patch, a, b, c] in &self.elements {
            let tint = self.patches[patch].tint;
            for corner in [a, b, c] {
                if !std::mem::replace(&mut tinted[corner], true) {
                    light[corner] = std::array::from_fn(|band| tint[band] * light[corner][band]);
                }
            }
        }
        light
    }

    /// The automatic exposure of what the first camera sees; see [`Record::exposure_for`].
    #[must_use]
    pub fn exposure(&self) -> Exposure {
        self.exposure_for(&self.first_camera())
    }

    /// The automatic exposure of what a camera sees, or of the whole scene where that is nothing: see [`Exposure::of`]. Pictures
    /// on patches count as their means. Takes as long as a small picture.
    #[must_use]
    pub fn exposure_for(&self, camera: &Camera) -> Exposure {
        let emits = |patch: usize| self.patches[patch].emission.iter().any(|band| *band > 0.0);
        let mut lit: Vec<[f64; 3]> = self.colours();
        let brightest = |colour: [f64; 3]| colour.into_iter().fold(0.0, f64::max);
        lit.iter_mut().for_each(|colour| *colour = [brightest(*colour), 0.0, 0.0]);
        for &[_, a, b, c] in self.elements.iter().filter(|element| emits(element[0])) {
            [a, b, c].into_iter().for_each(|corner| lit[corner][1] = 1.0);
        }
        let mesh = self.mesh();
        let painting = Painting { mesh: &mesh, light: &lit, places: &[], images: &[] };
        let of_sample = |[bright, emits, _]: [f64; 3]| ([bright; 3], 1.0, emits > 0.0);
        let seen: Vec<_> = seen(&painting, camera).into_iter().map(of_sample).collect();
        if seen.iter().any(|([bright, ..], ..)| *bright > 0.0) {
            return Exposure::of(seen.into_iter());
        }
        let colours = self.shown().rows(&self.radiosity);
        Exposure::of(
            colours
                .iter()
                .enumerate()
                .map(|(index, colour)| (*colour, mesh.area(index), emits(mesh.elements[index].patch))),
        )
    }

    /// The camera of that name, or `None` if there is none. Without a name the first camera, or one that sees all of the scene.
    #[must_use]
    pub fn camera(&self, name: Option<&str>) -> Option<Camera> {
        match name {
            Some(name) => self.cameras.iter().find(|camera| camera.name == name).cloned(),
            None => Some(self.first_camera()),
        }
    }

    fn first_camera(&self) -> Camera {
        self.cameras.first().cloned().unwrap_or_else(|| self.framing())
    }

    fn framing(&self) -> Camera {
        let boxes = self.vertices.iter().map(|point| [*point, *point]);
        let extent = boxes.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        framing(extent.unwrap_or([DVec3::ZERO, DVec3::ONE]), self.asset.up)
    }
}

fn indices(element: Element) -> [usize; 4] {
    let [a, b, c] = element.corners;
    [element.patch, a, b, c]
}

/// Every picture once, and which of them each patch shows.
fn pictures(scene: &Scene) -> (Vec<String>, BTreeMap<usize, usize>) {
    let (mut pictures, mut numbers) = (Vec::new(), BTreeMap::new());
    let mut known: BTreeMap<*const Image, usize> = BTreeMap::new();
    let shown = |patch: &Patch| patch.texture.as_ref().map(|texture| texture.image.clone());
    for (index, image) in scene.patches.iter().enumerate().filter_map(|(i, patch)| Some((i, shown(patch)?))) {
        let number = *known.entry(std::sync::Arc::as_ptr(&image)).or_insert_with(|| {
            let text = base64::engine::general_purpose::STANDARD.encode(&image.bytes);
            pictures.push(format!("data:{};base64,{text}", image.mime));
            pictures.len() - 1
        });
        numbers.insert(index, number);
    }
    (pictures, numbers)
}

/// Where each vertex lies in the picture of its patch.
fn places(scene: &Scene, mesh: &Mesh) -> Vec<DVec2> {
    let mut places = vec![DVec2::ZERO; mesh.vertices.len()];
    for element in &mesh.elements {
        if let Some(texture) = &scene.patches[element.patch].texture {
            for corner in element.corners {
                places[corner] = texture.place(mesh.vertices[corner]);
            }
        }
    }
    places
}
