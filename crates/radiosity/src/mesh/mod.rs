//! Elements: the pieces of patches that carry a value each.
//!
//! ```text
//! frame        a patch in two dimensions, its longest edge along x
//! contacts     lines on which other patches touch it: light jumps there
//! divide       its edges and contacts at a spacing, and the points of a lattice of that spacing inside
//! triangulate  constrained Delaunay triangles of the points, those outside dropped
//! sever        vertices that are not shared across contacts, and the zones between contacts
//! tree         the triangles in the order of a binary tree of zones and lattice cells
//! outline      the polygon around any node of the tree: what a shooter looks like
//! ```
use crate::{Error, Scene, extent::Extent};
use formfactor::PlanarPolygon;
use glam::DVec3;

mod contacts;
mod divide;
mod frame;
mod lattice;
mod outline;
mod sever;
mod tree;
mod triangulate;

pub(crate) use outline::Flat;
pub(crate) use tree::Node;

/// Triangles over all patches of a scene.
///
/// Vertices are shared neither between patches nor across a line on which another patch touches theirs: light is
/// discontinuous there.
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
        let extents: Vec<Extent> = scene.patches.iter().map(Extent::of).collect();
        for (index, patch) in scene.patches.iter().enumerate() {
            let contacts = contacts::contacts(scene, &extents, index, spacing);
            subdivision
                .add(index, &patch.polygon, &contacts, spacing)
                .map_err(|source| source.of(&patch.name))?;
        }
        Ok(subdivision)
    }

    /// Cuts one patch and appends its triangles and pieces.
    fn add(
        &mut self,
        patch: usize,
        polygon: &PlanarPolygon,
        contacts: &[[DVec3; 2]],
        spacing: f64,
    ) -> Result<(), Refusal> {
        let frame = frame::Frame::new(polygon);
        let points = divide::divide(polygon, contacts, &frame, spacing)?;
        let triangles = triangulate::triangulate(&points)?;
        let severed = sever::sever(&triangles, &points);
        let triangles = tree::grow(patch, &severed, &points, self.mesh.elements.len(), &mut self.nodes);
        let base = self.mesh.vertices.len();
        self.flat.append(base, &severed.points, &points);
        self.mesh.vertices.extend(severed.points.iter().map(|&point| points.places[point]));
        let element = |corners: [usize; 3]| Element { patch, corners: corners.map(|corner| base + corner) };
        self.mesh.elements.extend(triangles.into_iter().map(element));
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
