//! The mesh: triangles, each of which carries a value.
use glam::DVec3;

/// The triangles of all patches of a scene.
///
/// Light is discontinuous between patches and along lines on which one patch touches another, so triangles do not share
/// vertices there.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions, in the scene's coordinates.
    pub vertices: Vec<DVec3>,
    /// The triangles, sorted by patch.
    pub elements: Vec<Element>,
}

/// A triangle that carries one radiosity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Element {
    /// Index of the patch it is a part of.
    pub patch: usize,
    /// Indices of its vertices, counter-clockwise seen from the patch's front.
    pub corners: [usize; 3],
}

impl Mesh {
    /// The corners of element `element`.
    #[must_use]
    pub fn triangle(&self, element: usize) -> [DVec3; 3] {
        self.elements[element].corners.map(|corner| self.vertices[corner])
    }

    /// The area of element `element`.
    #[must_use]
    pub fn area(&self, element: usize) -> f64 {
        let [a, b, c] = self.triangle(element);
        (b - a).cross(c - a).length() / 2.0
    }

    /// The centroid of element `element`: an interior point.
    #[must_use]
    pub fn centroid(&self, element: usize) -> DVec3 {
        let [a, b, c] = self.triangle(element);
        (a + b + c) / 3.0
    }
}
