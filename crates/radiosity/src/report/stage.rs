//! A scene as a stage for questions: the points that light falls on, and the lamps that it comes from.
use super::question::{Ask, Question, exact};
use super::row::Chapter;
use crate::mesh::{Plan as Cut, Subdivision};
use crate::{Error, Mesh, Scene};
use formfactor::{DifferentialArea, Enclosure, unoccluded};
use rayon::prelude::*;

/// From so many polygons on fewer points are asked.
const MANY: usize = 50;
/// The fewest points.
const FEWEST: usize = 4;

/// A scene, cut in elements, with all that hides and all that shines.
#[derive(Debug)]
pub(super) struct Stage<'s> {
    pub(super) name: &'s str,
    pub(super) scene: &'s Scene,
    pub(super) mesh: Mesh,
    pub(super) enclosure: Enclosure,
    /// The patches that emit.
    pub(super) lamps: Vec<usize>,
    /// The centroids of the elements.
    pub(super) points: Vec<DifferentialArea>,
    /// For each point the form factor to all lamps, and its bound.
    pub(super) light: Vec<[f64; 2]>,
}

impl<'s> Stage<'s> {
    /// Cuts a scene in about so many elements and finds what light they get, exactly, on all threads.
    pub(super) fn new(name: &'s str, scene: &'s Scene, elements: usize) -> Result<Stage<'s>, Error> {
        let mesh = Subdivision::new(scene, &Cut::even(scene, elements))?.mesh;
        let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
        let lamps: Vec<usize> = (0..scene.patches.len()).filter(|&p| scene.patches[p].emits()).collect();
        let points = points(scene, &mesh)?;
        let light = points.par_iter().map(|from| exact(&enclosure, from, &lamps)).collect();
        Ok(Stage { name, scene, mesh, enclosure, lamps, points, light })
    }

    /// About so many of the points, evenly picked from those that some lamp would light if nothing hid it; fewer where
    /// there are many polygons, as methods that sample look at all of them for every ray.
    pub(super) fn question(&self, count: usize) -> Question {
        let shone_on = |&point: &usize| {
            let free =
                |&lamp: &usize| unoccluded(&self.points[point], &self.enclosure.polygons()[lamp]).value;
            self.lamps.iter().any(|lamp| free(lamp) > 0.0)
        };
        let lit: Vec<usize> = (0..self.points.len()).filter(shone_on).collect();
        let count = (count * MANY / self.scene.patches.len().max(MANY)).max(FEWEST);
        let stride = lit.len().div_ceil(count).max(1);
        let ask = |&point: &usize| {
            let [exact, bound] = self.light[point];
            let (from, targets) = (self.points[point], self.lamps.clone());
            Ask { enclosure: 0, from, targets, exact, bound }
        };
        Question {
            chapter: Chapter::Scenes,
            subject: self.name.to_owned(),
            enclosures: vec![self.enclosure.clone()],
            asks: lit.iter().step_by(stride).map(ask).collect(),
            relative: false,
            independent: false,
        }
    }
}

/// The centroids, each on its patch.
fn points(scene: &Scene, mesh: &Mesh) -> Result<Vec<DifferentialArea>, Error> {
    let point = |(index, element): (usize, &crate::Element)| {
        let patch = &scene.patches[element.patch];
        DifferentialArea::new(mesh.centroid(index), patch.polygon.normal())
            .map(|area| area.owned_by(element.patch))
            .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
    };
    mesh.elements.iter().enumerate().map(point).collect()
}
