//! A scene as a stage for questions: the points that light falls on, and the lamps that it comes from.
use super::question::{Ask, Question, exact};
use super::row::Chapter;
use crate::mesh::{Plan as Cut, Subdivision};
use crate::{Error, Mesh, Scene};
use formfactor::{DifferentialArea, Enclosure};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// From so many polygons on fewer points are asked.
const MANY: usize = 50;
/// The fewest points.
const FEWEST: usize = 16;

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

    /// About so many of the points, from those that some lamp would light if nothing hid it: half of them evenly picked
    /// from those that see the lamps in part, if there are any, where errors are; the others from all. Fewer where there
    /// are many polygons, as methods that sample look at all of them for every ray.
    pub(super) fn question(&self, count: usize) -> Question {
        let all = Question {
            chapter: Chapter::Scenes,
            subject: self.name.to_owned(),
            enclosures: vec![self.enclosure.clone()],
            asks: (0..self.points.len()).map(|point| self.ask(point)).collect(),
            relative: false,
            independent: false,
        };
        let lit = |ask: &Ask| all.free(ask)[0] > 0.0;
        let lit: Vec<usize> = (0..all.asks.len()).filter(|&point| lit(&all.asks[point])).collect();
        let part: Vec<usize> =
            lit.iter().copied().filter(|&point| all.sees_a_part(&all.asks[point])).collect();
        let count = (count * MANY / self.scene.patches.len().max(MANY)).max(FEWEST);
        let of_part = evenly(&part, count / 2);
        let rest = evenly(&lit, count - of_part.len());
        let picked: BTreeSet<usize> = of_part.into_iter().chain(rest).collect();
        Question { asks: picked.into_iter().map(|point| self.ask(point)).collect(), ..all }
    }

    /// What is asked from a point.
    fn ask(&self, point: usize) -> Ask {
        let [exact, bound] = self.light[point];
        Ask { enclosure: 0, from: self.points[point], targets: self.lamps.clone(), exact, bound }
    }
}

/// So many of some, evenly picked, or all there are.
fn evenly(from: &[usize], count: usize) -> Vec<usize> {
    let count = count.min(from.len());
    (0..count).map(|i| from[i * from.len() / count]).collect()
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
