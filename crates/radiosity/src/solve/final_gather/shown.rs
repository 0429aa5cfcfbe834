//! What is shown: linear light between the vertices of elements, which are cut where that is wrong.
use super::bisection::{Bisection, Cuts, Middle};
use super::known::{Known, Look};
use crate::mesh::element::{Element, Mesh};
use crate::scene::Scene;
use crate::solve::interpolate::welds;
use crate::solve::solution::FineLight;

/// Elements are cut where the light inside is off a linear one by more than this share.
const LINEAR: f64 = 0.03;

/// What is shown is within an error where elements that are off by more than so many times the error
const OFF: f64 = 2.0;
/// have no more than so many times that share of the area.
const WRONG: f64 = 3.0;

/// A mesh and the light of its vertices.
#[derive(Debug)]
pub(super) struct Shown {
    pub(super) bisection: Bisection,
    bands: usize,
    /// Irradiance of the vertices, vertices × bands.
    pub(super) vertices: Vec<f64>,
    /// How far the light inside of each element may be off what its vertices say, as a share: a guess, halved with each cut.
    off: Vec<f64>,
}

impl Shown {
    /// The light of a mesh whose vertices were looked from. What elements receive at their centroids is known.
    pub(super) fn of(mesh: &Mesh, vertices: Vec<f64>, bands: usize, known: &Known) -> Shown {
        let mut shown = Shown { bisection: Bisection::of(mesh), bands, vertices, off: Vec::new() };
        let off = |(index, element): (usize, &Element)| {
            let inside = &known.light[index * bands..][..bands];
            known.difference(inside, &shown.mean(&element.corners))
        };
        shown.off = mesh.elements.iter().enumerate().map(off).collect();
        shown
    }

    /// Cuts the elements that are wrong, those that are wrong over most area first, until there are so many vertices to look from. These are
    /// what comes out; all new vertices are linear for now.
    pub(super) fn cut(&mut self, count: usize) -> Vec<Middle> {
        let (mut cuts, mut is_wanted, mut wanted) = (Cuts::default(), Vec::new(), 0);
        for element in self.worst() {
            if wanted >= count {
                break;
            }
            let known = cuts.halved.len();
            self.bisection.halve(element, &mut cuts);
            is_wanted.resize(cuts.middles.len(), false);
            for half in &cuts.halved[known..] {
                let is_wrong = self.off[half.element] > LINEAR;
                wanted += usize::from(is_wrong && !is_wanted[half.middle]);
                is_wanted[half.middle] |= is_wrong;
                self.off[half.element] /= 2.0;
                self.off.push(self.off[half.element]);
            }
        }
        for middle in &cuts.middles {
            self.vertices.extend(self.mean(&middle.ends));
        }
        let wanted = cuts.middles.iter().zip(is_wanted).filter(|(_, is_wanted)| *is_wanted);
        wanted.map(|(middle, _)| *middle).collect()
    }

    /// Takes what vertices receive that were looked from.
    pub(super) fn learn(&mut self, middles: &[Middle], found: &[Look], known: &Known) {
        let mut off = vec![0.0; self.bisection.mesh.vertices.len()];
        for (middle, look) in middles.iter().zip(found) {
            off[middle.vertex] = known.difference(&look.light, &self.mean(&middle.ends)) / 2.0;
        }
        for (middle, look) in middles.iter().zip(found) {
            self.vertices[middle.vertex * self.bands..][..self.bands].copy_from_slice(&look.light);
        }
        for (wrong, element) in self.off.iter_mut().zip(&self.bisection.mesh.elements) {
            *wrong = element.corners.iter().map(|corner| off[*corner]).fold(*wrong, f64::max);
        }
    }

    /// What is shown, the elements in the order of the mesh before all cuts.
    pub(super) fn into_light(self, scene: &Scene) -> FineLight {
        let Bisection { mut mesh, whole, .. } = self.bisection;
        let mut order: Vec<usize> = (0..whole.len()).collect();
        order.sort_by_key(|&element| whole[element]);
        mesh.elements = order.iter().map(|&element| mesh.elements[element]).collect();
        let whole = order.iter().map(|&element| whole[element]).collect();
        FineLight { welds: welds(scene, &mesh), mesh, whole, vertices: self.vertices }
    }

    /// Whether most of what is shown is within an error.
    pub(super) fn is_within(&self, error: f64) -> bool {
        let area = |element: usize| self.bisection.mesh.area(element);
        let whole: f64 = (0..self.off.len()).map(area).sum();
        let off: f64 = (0..self.off.len()).filter(|element| self.off[*element] > OFF * error).map(area).sum();
        off <= WRONG * error * whole
    }

    /// The elements that are to be cut, those that are wrong over most area first.
    fn worst(&self) -> Vec<usize> {
        let size = |element: usize| self.bisection.mesh.area(element) * self.off[element].min(1.0);
        let mut worst: Vec<(f64, usize)> = (0..self.off.len())
            .filter(|element| self.off[*element] > LINEAR)
            .map(|element| (size(element), element))
            .collect();
        worst.retain(|(size, _)| *size > 0.0);
        worst.sort_by(|a, b| b.0.total_cmp(&a.0));
        worst.into_iter().map(|(_, element)| element).collect()
    }

    /// What some vertices receive on average, per band.
    fn mean(&self, vertices: &[usize]) -> Vec<f64> {
        let sum = |band: usize| vertices.iter().map(|at| self.vertices[at * self.bands + band]).sum::<f64>();
        (0..self.bands).map(|band| sum(band) / vertices.len() as f64).collect()
    }
}
