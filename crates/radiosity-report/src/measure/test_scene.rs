//! A scene to ask about: the points that light falls on, and the emitters that it comes from.
use super::query::{Query, QuerySet, exact};
use crate::rows::Chapter;
use formfactor::{DifferentialArea, Enclosure};
use radiosity::{Element, Error, Mesh, Scene};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// From so many polygons on fewer points are queried.
const MANY: usize = 50;
/// The fewest points.
const FEWEST: usize = 16;

/// A scene cut in elements, with its occluders and emitters.
#[derive(Debug)]
pub(crate) struct TestScene<'s> {
    pub(crate) name: &'s str,
    pub(crate) scene: &'s Scene,
    pub(crate) mesh: Mesh,
    pub(crate) enclosure: Enclosure,
    /// The patches that emit.
    pub(crate) emitters: Vec<usize>,
    /// The centroids of the elements.
    pub(crate) points: Vec<DifferentialArea>,
    /// For each point the form factor to all emitters, and its bound.
    pub(crate) light: Vec<[f64; 2]>,
}

impl<'s> TestScene<'s> {
    /// Cuts a scene in about so many elements and finds what light they get, exactly, on all threads.
    pub(crate) fn new(name: &'s str, scene: &'s Scene, elements: usize) -> Result<TestScene<'s>, Error> {
        let mesh = Mesh::even(scene, elements)?;
        let enclosure = Enclosure::new(scene.patches.iter().map(|patch| patch.polygon.clone()).collect());
        let emitters: Vec<usize> = (0..scene.patches.len()).filter(|&p| scene.patches[p].emits()).collect();
        let points = points(scene, &mesh)?;
        let light = points.par_iter().map(|from| exact(&enclosure, from, &emitters)).collect();
        Ok(TestScene { name, scene, mesh, enclosure, emitters, points, light })
    }

    /// About so many of the points, from those that some emitter would light if nothing hid it: half of them evenly picked
    /// from those that see the emitters in part, if there are any, where errors are; the others from all. Fewer where there
    /// are many polygons, as methods that sample look at all of them for every ray.
    pub(crate) fn queries(&self, count: usize) -> QuerySet {
        let all = QuerySet {
            chapter: Chapter::Scenes,
            subject: self.name.to_owned(),
            enclosures: vec![self.enclosure.clone()],
            queries: (0..self.points.len()).map(|point| self.query(point)).collect(),
            relative: false,
            independent: false,
        };
        let lit = |query: &Query| all.free(query)[0] > 0.0;
        let lit: Vec<usize> = (0..all.queries.len()).filter(|&point| lit(&all.queries[point])).collect();
        let part: Vec<usize> =
            lit.iter().copied().filter(|&point| all.sees_a_part(&all.queries[point])).collect();
        let count = (count * MANY / self.scene.patches.len().max(MANY)).max(FEWEST);
        let of_part = evenly(&part, count / 2);
        let rest = evenly(&lit, count - of_part.len());
        let picked: BTreeSet<usize> = of_part.into_iter().chain(rest).collect();
        QuerySet { queries: picked.into_iter().map(|point| self.query(point)).collect(), ..all }
    }

    /// The query from a point.
    fn query(&self, point: usize) -> Query {
        let [exact, bound] = self.light[point];
        Query { enclosure: 0, from: self.points[point], targets: self.emitters.clone(), exact, bound }
    }
}

/// So many of some, evenly picked, or all there are.
fn evenly(from: &[usize], count: usize) -> Vec<usize> {
    let count = count.min(from.len());
    (0..count).map(|i| from[i * from.len() / count]).collect()
}

/// The centroids, each on its patch.
fn points(scene: &Scene, mesh: &Mesh) -> Result<Vec<DifferentialArea>, Error> {
    let point = |(index, element): (usize, &Element)| {
        let patch = &scene.patches[element.patch];
        DifferentialArea::new(mesh.centroid(index), patch.polygon.normal())
            .map(|area| area.owned_by(element.patch))
            .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
    };
    mesh.elements.iter().enumerate().map(point).collect()
}
