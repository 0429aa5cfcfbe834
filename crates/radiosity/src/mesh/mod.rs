//! Elements: the pieces of patches that carry a value each.
//!
//! ```text
//! frame        a patch in two dimensions, its longest edge along x
//! divide       its edges at a spacing, and the lattice points of that spacing inside
//! triangulate  constrained Delaunay triangles of the points, those outside dropped
//! tree         the triangles in the order of a binary tree of lattice cells
//! outline      the polygon around any node of the tree: what a shooter looks like
//! ```
use crate::{Error, Scene};
use glam::DVec3;

mod divide;
mod frame;
mod outline;
mod tree;
mod triangulate;

pub(crate) use outline::Flat;
pub(crate) use tree::Node;

/// Triangles over all patches of a scene.
///
/// Vertices are never shared between patches: light is discontinuous where surfaces meet.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions, in the scene's coordinates.
    pub vertices: Vec<DVec3>,
    /// The triangles; those of one patch stand together, in the order of the patches.
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

/// A mesh with the tree of its pieces.
///
/// A node is a piece of one patch, a contiguous range of its elements; node `i < patches` is patch `i` as a whole.
#[derive(Debug, Default)]
pub(crate) struct Subdivision {
    pub(crate) mesh: Mesh,
    pub(crate) nodes: Vec<Node>,
    /// What the outlines need: the vertices in their patches' frames, and the patches' edges.
    pub(crate) flat: Flat,
}

impl Subdivision {
    /// Cuts the scene into about `elements` triangles of about equal size.
    pub(crate) fn new(scene: &Scene, elements: usize) -> Result<Subdivision, Error> {
        let area: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
        let spacing = (2.0 * area / elements.max(1) as f64).sqrt();
        let mut subdivision =
            Subdivision { nodes: vec![Node::default(); scene.patches.len()], ..Default::default() };
        for (index, patch) in scene.patches.iter().enumerate() {
            subdivision.add(index, &patch.polygon, spacing).map_err(|source| source.of(&patch.name))?;
        }
        Ok(subdivision)
    }

    /// Cuts one patch and appends its triangles and pieces.
    fn add(
        &mut self,
        patch: usize,
        polygon: &formfactor::PlanarPolygon,
        spacing: f64,
    ) -> Result<(), Refusal> {
        let frame = frame::Frame::new(polygon);
        let points = divide::divide(polygon, &frame, spacing)?;
        let triangles = triangulate::triangulate(&points)?;
        let triangles = tree::grow(patch, triangles, &points, self.mesh.elements.len(), &mut self.nodes);
        let base = self.mesh.vertices.len();
        self.flat.append(base, &points);
        self.mesh.vertices.extend(&points.places);
        self.mesh.elements.extend(
            triangles
                .into_iter()
                .map(|corners| Element { patch, corners: corners.map(|corner| base + corner) }),
        );
        Ok(())
    }
}

/// Why a polygon could not be cut.
#[derive(Debug)]
struct Refusal(String);

impl Refusal {
    /// The error that names the patch.
    fn of(self, patch: &str) -> Error {
        Error::Mesh { patch: patch.to_owned(), reason: self.0 }
    }
}

#[cfg(test)]
mod tests;
