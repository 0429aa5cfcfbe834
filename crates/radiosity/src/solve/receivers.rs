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
    /// The largest of the elements around the vertex.
    pub(super) element: usize,
    patch: &'s Patch,
    place: DVec3,
    /// On the rim of a patch, and at the foot of what stands on it: to the middle of the elements around it, and of the largest of them.
    way: DVec3,
    way_in_element: DVec3,
}

impl Receiver<'_> {
    /// At that share of the way inside: F is discontinuous at the feet of walls, and there the limit from the vertex's own side is wanted.
    ///
    /// # Errors
    /// [`Error::Shape`] where a place is beyond what form factors take.
    pub(super) fn inside(&self, share: f64) -> Result<DifferentialArea, Error> {
        self.at(self.place + share * self.way)
    }

    /// The same within its element: at the corner of what stands on a patch light and shade meet, and elements around are on one side or the other.
    ///
    /// # Errors
    /// [`Error::Shape`] where a place is beyond what form factors take.
    pub(super) fn inside_element(&self, share: f64) -> Result<DifferentialArea, Error> {
        self.at(self.place + share * self.way_in_element)
    }

    fn at(&self, place: DVec3) -> Result<DifferentialArea, Error> {
        DifferentialArea::new(place, self.patch.polygon.normal())
            .map_err(|source| Error::Shape { patch: self.patch.name.clone(), source })
    }
}

/// The elements around a vertex so far: their ways to their middles, by their areas, and the largest with its own.
#[derive(Clone, Copy, Debug, Default)]
struct Around {
    ways: DVec3,
    areas: f64,
    largest: (f64, usize, DVec3),
}

impl Around {
    fn add(&mut self, element: usize, area: f64, way: DVec3) {
        self.ways += area * way;
        self.areas += area;
        if area >= self.largest.0 {
            self.largest = (area, element, way);
        }
    }
}

/// A receiver for every vertex.
pub(super) fn receivers<'s>(scene: &'s Scene, mesh: &Mesh) -> Vec<Receiver<'s>> {
    let rim = rim(mesh);
    let mut around = vec![Around::default(); mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let (area, centroid) = (mesh.area(index), mesh.centroid(index));
        for corner in element.corners {
            around[corner].add(index, area, centroid - mesh.vertices[corner]);
        }
    }
    let receiver = |(vertex, Around { ways, areas, largest: (_, element, way) }): (usize, Around)| {
        let at_rim = |way: DVec3| if areas > 0.0 && rim[vertex] { way } else { DVec3::ZERO };
        Receiver {
            element,
            patch: &scene.patches[mesh.elements[element].patch],
            place: mesh.vertices[vertex],
            way: at_rim(ways / areas),
            way_in_element: at_rim(way),
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use formfactor::PlanarPolygon;

    /// At the inner corner of an L the middle of all elements is not within the largest.
    #[test]
    fn what_is_within_an_element_is_on_its_side_of_every_corner() {
        let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 5.0], [0.0, 5.0]];
        let outline = corners.map(|[x, y]| DVec3::new(x, y, 0.0));
        let floor = Patch::new("floor", PlanarPolygon::new([outline]).unwrap(), vec![0.5], vec![0.0]);
        let scene = Scene { patches: vec![floor], bands: 1, ..Scene::default() };
        let mesh = Mesh::even(&scene, 40).unwrap();
        let mut is_outside_of_mean = false;
        for receiver in receivers(&scene, &mesh) {
            let [a, b, c] = mesh.elements[receiver.element].corners.map(|corner| mesh.vertices[corner]);
            let is_within = |place: DVec3| {
                [[a, b], [b, c], [c, a]].iter().all(|[p, q]| (*q - *p).cross(place - *p).z >= -1e-12)
            };
            assert!(is_within(receiver.inside_element(0.1).unwrap().position()));
            is_outside_of_mean |= !is_within(receiver.inside(0.1).unwrap().position());
        }
        assert!(is_outside_of_mean, "the two are not the same");
    }
}
