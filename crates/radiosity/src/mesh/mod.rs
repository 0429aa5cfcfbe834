//! Elements: the pieces of patches that carry a value each.
//!
//! ```text
//! spacing      how long the sides of cells are
//! frame        a patch in two dimensions, its longest edge along x
//! contacts     lines on which other patches touch it: light jumps there
//! shadows      lines where the light of strong lamps starts or ceases to be hidden
//! divide       its edges and contacts at a spacing, and the points of a lattice of that spacing inside
//! triangulate  constrained Delaunay triangles of the points, those outside dropped
//! sever        vertices that are not shared across contacts, and the zones between contacts
//! tree         the triangles in the order of a binary tree of zones and lattice cells
//! outline      the polygon around any node of the tree: what a shooter looks like
//! ```
use crate::{Error, Scene, extent::Extent};
use divide::Division;
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};

mod contacts;
mod divide;
mod frame;
mod lattice;
mod outline;
mod sever;
mod shadows;
mod spacing;
mod tree;
mod triangulate;

pub(crate) use lattice::LEVELS;
pub(crate) use outline::Flat;
pub(crate) use shadows::shadows;
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
    /// The cell of its patch's lattice that each element is in.
    pub(crate) cells: Vec<usize>,
    /// How many cells each patch's lattice has.
    pub(crate) cell_counts: Vec<usize>,
}

/// How fine to cut what.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Side of a cell of each patch, in the scene's unit.
    pub(crate) spacings: Vec<f64>,
    /// For each patch and each cell of its lattice, how often to halve it; empty where nothing is halved.
    pub(crate) levels: Vec<Vec<u8>>,
    /// For each patch the lines where shadows begin and end; empty where none are wanted.
    pub(crate) shadows: Vec<Vec<[DVec3; 2]>>,
}

impl Plan {
    /// A plan for about so many triangles of about equal size; see [`spacing`].
    pub(crate) fn even(scene: &Scene, elements: usize) -> Plan {
        Plan { spacings: spacing::spacings(scene, elements), ..Plan::default() }
    }
}

impl Subdivision {
    /// Cuts the scene as a plan says.
    pub(crate) fn new(scene: &Scene, plan: &Plan) -> Result<Subdivision, Error> {
        let mut subdivision =
            Subdivision { nodes: vec![Node::default(); scene.patches.len()], ..Default::default() };
        let extents: Vec<Extent> = scene.patches.iter().map(Extent::of).collect();
        let finest = plan.spacings.iter().copied().fold(f64::INFINITY, f64::min);
        for (index, patch) in scene.patches.iter().enumerate() {
            let division = Division {
                contacts: &contacts::contacts(scene, &extents, index, finest),
                shadows: plan.shadows.get(index).map_or(&[], Vec::as_slice),
                spacing: plan.spacings[index],
                levels: plan.levels.get(index).map_or(&[], Vec::as_slice),
            };
            subdivision.add(index, &patch.polygon, &division).map_err(|source| source.of(&patch.name))?;
        }
        Ok(subdivision)
    }

    /// Cuts one patch and appends its triangles and pieces.
    fn add(&mut self, patch: usize, polygon: &PlanarPolygon, division: &Division<'_>) -> Result<(), Refusal> {
        let frame = frame::Frame::new(polygon);
        let points = divide::divide(polygon, division, &frame)?;
        let triangles = triangulate::triangulate(&points)?;
        let severed = sever::sever(&triangles, &points);
        let triangles = tree::grow(patch, &severed, &points, self.mesh.elements.len(), &mut self.nodes);
        let base = self.mesh.vertices.len();
        self.flat.append(base, &severed.points, &points);
        self.mesh.vertices.extend(severed.points.iter().map(|&point| points.places[point]));
        let centroid = |corners: &[usize; 3]| {
            corners.iter().map(|&corner| points.flat[severed.points[corner]]).sum::<DVec2>() / 3.0
        };
        self.cells.extend(triangles.iter().map(|corners| points.lattice.index(centroid(corners))));
        self.cell_counts.push(points.lattice.cells[0] * points.lattice.cells[1]);
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
