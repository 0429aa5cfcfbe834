//! Where the light of vertices is gathered.
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::scene::{Scene, patch::Patch};
use formfactor::DifferentialArea;
use glam::DVec3;
use std::collections::BTreeSet;

/// The share of the way inside that changes no light but that of what touches the rim.
pub(super) const AT_RIM: f64 = 1e-3;

/// Where the light of a vertex is gathered.
#[derive(Debug)]
pub(super) struct Receiver<'s> {
    /// One of the elements around the vertex.
    pub(super) element: usize,
    patch: &'s Patch,
    place: DVec3,
    /// On the rim of a patch, and at the foot of what stands on it: to the middle of the elements around it.
    way: DVec3,
}

impl Receiver<'_> {
    /// At that share of the way inside: F is discontinuous at the feet of walls, and there the limit from the vertex's own side is wanted.
    ///
    /// # Errors
    /// [`Error::Shape`] where a place is beyond what form factors take.
    pub(super) fn inside(&self, share: f64) -> Result<DifferentialArea, Error> {
        DifferentialArea::new(self.place + share * self.way, self.patch.polygon.normal())
            .map_err(|source| Error::Shape { patch: self.patch.name.clone(), source })
    }
}

/// A receiver for every vertex.
pub(super) fn receivers<'s>(scene: &'s Scene, mesh: &Mesh) -> Vec<Receiver<'s>> {
    let rim = rim(mesh);
    let mut around = vec![(DVec3::ZERO, 0.0, 0); mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let (area, centroid) = (mesh.area(index), mesh.centroid(index));
        for corner in element.corners {
            let (sum, weight, _) = around[corner];
            around[corner] = (sum + area * (centroid - mesh.vertices[corner]), weight + area, index);
        }
    }
    let receiver = |(vertex, (sum, weight, element)): (usize, (DVec3, f64, usize))| Receiver {
        element,
        patch: &scene.patches[mesh.elements[element].patch],
        place: mesh.vertices[vertex],
        way: if weight > 0.0 && rim[vertex] { sum / weight } else { DVec3::ZERO },
    };
    around.into_iter().enumerate().map(receiver).collect()
}

/// Which vertices have a side that only one element has.
fn rim(mesh: &Mesh) -> Vec<bool> {
    let sides = mesh.elements.iter().flat_map(|element| {
        let [a, b, c] = element.corners;
        [[a, b], [b, c], [c, a]]
    });
    let sides: BTreeSet<[usize; 2]> = sides.collect();
    let mut rim = vec![false; mesh.vertices.len()];
    for [a, b] in sides.iter().filter(|[a, b]| !sides.contains(&[*b, *a])) {
        (rim[*a], rim[*b]) = (true, true);
    }
    rim
}
