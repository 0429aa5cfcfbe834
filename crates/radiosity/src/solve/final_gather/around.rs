//! The elements around every vertex.
use crate::mesh::element::Mesh;
use formfactor::DifferentialArea;

/// A place that is looked from, and the elements around it with their shares of the area.
pub(super) type PlaceAmong<'v> = (DifferentialArea, &'v [(usize, f64)]);

/// Vertices are not looked from that have this share of the area together,
const FEW: f64 = 0.03;
/// and each less than this share of the mean.
const SMALL: f64 = 0.125;

/// For each vertex the elements around it.
pub(super) struct Around {
    /// With their shares of the area there.
    elements: Vec<Vec<(usize, f64)>>,
    areas: Vec<f64>,
}

impl Around {
    /// Around the vertices of a mesh.
    pub(super) fn of(mesh: &Mesh) -> Around {
        let mut elements = vec![Vec::new(); mesh.vertices.len()];
        for (index, element) in mesh.elements.iter().enumerate() {
            element.corners.iter().for_each(|&corner| elements[corner].push((index, mesh.area(index))));
        }
        let sum = |around: &Vec<(usize, f64)>| around.iter().map(|(_, area)| area).sum::<f64>();
        let areas: Vec<f64> = elements.iter().map(sum).collect();
        for (around, whole) in elements.iter_mut().zip(&areas) {
            around.iter_mut().for_each(|(_, area)| *area /= whole.max(f64::MIN_POSITIVE));
        }
        Around { elements, areas }
    }

    /// Those around a vertex.
    pub(super) fn elements(&self, vertex: usize) -> &[(usize, f64)] {
        &self.elements[vertex]
    }

    /// All vertices but the smallest.
    pub(super) fn large(&self) -> Vec<usize> {
        let mut all: Vec<usize> = (0..self.areas.len()).collect();
        all.sort_by(|&a, &b| self.areas[a].total_cmp(&self.areas[b]));
        let whole: f64 = self.areas.iter().sum();
        let small = SMALL * whole / all.len().max(1) as f64;
        let mut sum = 0.0;
        let is_small = |vertex: &&usize| {
            sum += self.areas[**vertex];
            sum < FEW * whole && self.areas[**vertex] < small
        };
        let small = all.iter().take_while(is_small).count();
        let mut large = all.split_off(small);
        large.sort_unstable();
        large
    }
}
