//! From one value per element to one value per vertex.
use crate::{Mesh, Solution};

impl Solution {
    /// Radiosity at the vertices, vertices × bands, W/m²: the area-weighted mean of the elements around each
    /// vertex within its patch. O(elements).
    #[must_use]
    pub fn vertex_radiosity(&self) -> Vec<f64> {
        at_vertices(&self.mesh, &self.radiosity, self.bands)
    }
}

/// Area-weighted means of element values around every vertex.
fn at_vertices(mesh: &Mesh, values: &[f64], bands: usize) -> Vec<f64> {
    let mut sums = vec![0.0; mesh.vertices.len() * bands];
    let mut weights = vec![0.0; mesh.vertices.len()];
    for (element, value) in values.chunks_exact(bands).enumerate() {
        let area = mesh.area(element);
        for corner in mesh.elements[element].corners {
            weights[corner] += area;
            for (sum, v) in sums[corner * bands..].iter_mut().zip(value) {
                *sum += area * v;
            }
        }
    }
    for (mean, weight) in sums.chunks_exact_mut(bands).zip(&weights) {
        for value in mean {
            *value /= weight.max(f64::MIN_POSITIVE);
        }
    }
    sums
}
