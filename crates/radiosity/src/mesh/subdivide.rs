//! A scene cut into elements.
use super::divide::{Division, divide};
use super::element::{Element, Mesh};
use super::tree::{Node, grow};
use super::triangulate::triangulate;
use super::{
    contacts::Neighbourhood, convex::convex_parts, frame::Frame, outline::Flat, plan::Plan,
    refusal::MeshRefusal, split::split,
};
use crate::error::Error;
use crate::scene::Scene;
use formfactor::PlanarPolygon;
use glam::DVec2;

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

impl Mesh {
    /// Cuts a scene into about so many triangles of about equal size.
    ///
    /// ```
    /// let scene = radiosity::scenes::scene("furnace").expect("a built-in scene");
    /// let mesh = radiosity::Mesh::even(&scene, 48)?;
    /// assert_eq!(mesh.elements.len(), 48);
    /// # Ok::<(), radiosity::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Mesh`] for a patch that cannot be cut.
    pub fn even(scene: &Scene, elements: usize) -> Result<Mesh, Error> {
        Ok(Subdivision::new(scene, &Plan::even(scene, elements))?.mesh)
    }
}

impl Subdivision {
    /// Cuts the scene as a plan says.
    pub(crate) fn new(scene: &Scene, plan: &Plan) -> Result<Subdivision, Error> {
        let mut subdivision =
            Subdivision { nodes: vec![Node::default(); scene.patches.len()], ..Default::default() };
        let neighbourhood = Neighbourhood::of(scene);
        let finest = plan.spacings.iter().copied().fold(f64::INFINITY, f64::min);
        for (index, patch) in scene.patches.iter().enumerate() {
            let division = Division {
                contacts: &neighbourhood.contacts(index, finest),
                shadows: plan.shadows.get(index).map_or(&[], Vec::as_slice),
                spacing: plan.spacings[index],
                levels: plan.levels.get(index).map_or(&[], Vec::as_slice),
            };
            subdivision.add(index, &patch.polygon, &division).map_err(|source| source.of(&patch.name))?;
        }
        Ok(subdivision)
    }

    /// Cuts one patch and appends its triangles and pieces.
    fn add(
        &mut self,
        patch: usize,
        polygon: &PlanarPolygon,
        division: &Division<'_>,
    ) -> Result<(), MeshRefusal> {
        let frame = Frame::new(polygon);
        let points = divide(polygon, division, &frame)?;
        let triangles = triangulate(&points)?;
        let pieces = split(&triangles, &points);
        let triangles = grow(patch, &pieces, &points, self.mesh.elements.len(), &mut self.nodes);
        let base = self.mesh.vertices.len();
        self.flat.append(base, &pieces.points, &points);
        self.mesh.vertices.extend(pieces.points.iter().map(|&point| points.places[point]));
        let centroid = |corners: &[usize; 3]| {
            corners.iter().map(|&corner| points.flat[pieces.points[corner]]).sum::<DVec2>() / 3.0
        };
        self.cells.extend(triangles.iter().map(|corners| points.lattice.index(centroid(corners))));
        self.cell_counts.push(points.lattice.cells[0] * points.lattice.cells[1]);
        let element = |corners: [usize; 3]| Element { patch, corners: corners.map(|corner| base + corner) };
        self.mesh.elements.extend(triangles.into_iter().map(element));
        Ok(())
    }
}

/// Whether a polygon by itself can be cut: into elements, and into convex parts.
pub(crate) fn can_be_divided(polygon: &PlanarPolygon) -> bool {
    let frame = Frame::new(polygon);
    // A cell as large as the polygon: what is in the way of a coarse mesh is in the way of a fine one.
    let division = Division { contacts: &[], shadows: &[], spacing: frame.unit(), levels: &[] };
    divide(polygon, &division, &frame).and_then(|points| triangulate(&points)).is_ok()
        && convex_parts(polygon, &frame).is_ok()
}
