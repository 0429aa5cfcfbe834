//! Where the light of vertices is gathered.
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use formfactor::DifferentialArea;
use glam::DVec3;
use std::collections::BTreeSet;

/// The share of the way that changes no light but that of what touches the rim.
pub(super) const AT_RIM: f64 = 1e-3;

/// A receiver for every vertex, and one of the elements around it; on the rim of a patch, and at the foot of what stands on it, that share
/// of the way to the middle of these elements: F is discontinuous at the feet of walls, and there the limit from the vertex's own side is
/// wanted.
///
/// # Errors
/// [`Error::Shape`] where a place is beyond what form factors take.
pub(super) fn receivers(
    scene: &Scene,
    mesh: &Mesh,
    inward: f64,
) -> Result<Vec<(usize, DifferentialArea)>, Error> {
    let rim = rim(mesh);
    let mut around = vec![(DVec3::ZERO, 0.0, 0); mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let (area, centroid) = (mesh.area(index), mesh.centroid(index));
        for corner in element.corners {
            let (sum, weight, _) = around[corner];
            around[corner] = (sum + area * (centroid - mesh.vertices[corner]), weight + area, index);
        }
    }
    let receiver = |(vertex, (sum, weight, element)): (usize, (DVec3, f64, usize))| {
        let way = if weight > 0.0 && rim[vertex] { sum / weight * inward } else { DVec3::ZERO };
        let patch = &scene.patches[mesh.elements[element].patch];
        DifferentialArea::new(mesh.vertices[vertex] + way, patch.polygon.normal())
            .map(|area| (element, area))
            .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
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
