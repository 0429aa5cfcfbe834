//! Form factors from the elements to the pieces: exact ones, but for such as may be taken roughly.
use super::state::{Column, State};
use super::{
    ball::Ball,
    fingerprint,
    hemicube::Hemicubes,
    lights::Lights,
    occluders::Occluders,
    rough::{ElementGroup, Rough},
    workers,
};
use crate::error::Error;
use crate::mesh::{element::Element, subdivide::Subdivision};
use crate::scene::Scene;
use formfactor::{Blockers, DifferentialArea, Enclosure, PlanarPolygon};
use std::{ops::Range, sync::Arc};

/// What a form factor may be off by: far less than what tells a closed room from an open one,
const ENOUGH: f64 = 1e-11;
/// or far less than what is shown, or what is taken roughly, of all together.
const SHOWN: f64 = 1e-8;

/// So many elements are looked from together at most, but for those of one cell.
const GROUP: usize = 16;

/// A piece of a patch, in the plane of the polygon that the enclosure has for the patch.
#[derive(Debug)]
pub(super) struct PieceShape {
    pub(super) patch: usize,
    pub(super) polygon: PlanarPolygon,
}

/// Columns of form factors: from the centroid of every element to one piece, all other patches occluding.
#[derive(Debug)]
pub(super) struct Factors<'s> {
    scene: &'s Scene,
    pub(super) subdivision: &'s Subdivision,
    enclosure: Enclosure,
    lights: Lights<'s>,
    /// The polygon of the enclosure that each patch is a part of.
    surface_of: Vec<usize>,
    pub(super) receivers: Vec<DifferentialArea>,
    /// Elements near each other, all in ascending order.
    pub(super) groups: Vec<Range<usize>>,
    /// What is taken roughly.
    rough: Option<Rough>,
    /// What takes the place of exact factors, to compare with.
    hemicubes: Option<Hemicubes>,
    /// The mesh in `state`,
    of_mesh: u64,
    /// and its form factors there, which depend on how they are found.
    fingerprint: u64,
    pub(super) state: &'s mut State,
}

impl<'s> Factors<'s> {
    /// Puts a receiver on the centroid of every element; what `state` knows is not found again.
    pub(super) fn new(
        scene: &'s Scene,
        subdivision: &'s Subdivision,
        state: &'s mut State,
    ) -> Result<Factors<'s>, Error> {
        let (mesh, of_mesh) = (&subdivision.mesh, fingerprint::of_mesh(scene, subdivision));
        let Occluders { polygons, of_patch: surface_of } = Occluders::join(scene);
        let receiver = |(index, element): (usize, &Element)| {
            let patch = &scene.patches[element.patch];
            DifferentialArea::new(mesh.centroid(index), patch.polygon.normal())
                .map(|area| area.owned_by(surface_of[element.patch]))
                .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
        };
        Ok(Factors {
            receivers: mesh.elements.iter().enumerate().map(receiver).collect::<Result<_, _>>()?,
            groups: groups(scene, subdivision),
            scene,
            subdivision,
            lights: Lights::new(scene, &polygons),
            enclosure: Enclosure::new(polygons),
            surface_of,
            rough: None,
            hemicubes: None,
            of_mesh,
            fingerprint: of_mesh,
            state,
        })
    }

    /// Takes the factors of hemicubes instead of exact ones.
    pub(super) fn approximate(&mut self, hemicubes: Hemicubes, resolution: u32) {
        self.hemicubes = Some(hemicubes);
        self.fingerprint ^= u64::from(resolution);
    }

    /// Takes small form factors roughly from now on.
    pub(super) fn take_roughly(&mut self, rough: Rough) {
        self.fingerprint ^= fingerprint::of_emitters(self.scene, rough.share);
        self.rough = Some(rough);
    }

    /// The share of an element's view that is taken roughly at most.
    pub(super) fn rough_share(&self) -> f64 {
        self.rough.as_ref().map_or(0.0, |rough| rough.share)
    }

    /// Whether the state knows of this scene and mesh.
    pub(super) fn are_known(&self) -> bool {
        self.state.knows(self.of_mesh)
    }

    /// Whether the column of a piece is known.
    pub(super) fn is_known(&self, node: usize) -> bool {
        self.kept(node).is_some()
    }

    fn kept(&self, node: usize) -> Option<Arc<Column>> {
        self.state.column(self.fingerprint, node, self.receivers.len())
    }

    /// The form factors from all elements to one piece, where nothing is left to be found of them.
    pub(super) fn known(&mut self, node: usize) -> Option<Arc<Column>> {
        let drawn = || {
            let elements = self.subdivision.nodes[node].elements.clone();
            self.hemicubes.as_ref().map(|hemicubes| hemicubes.column(elements))
        };
        if let Some(kept) = self.kept(node) {
            return Some(kept);
        }
        let column = drawn()?;
        Some(self.keep(node, &column))
    }

    /// Keeps the form factors from all elements to one piece while memory lasts: they never change.
    pub(super) fn keep(&mut self, node: usize, factors: &[f64]) -> Arc<Column> {
        let column = Arc::new(Column::new(factors));
        self.state.note(self.of_mesh);
        self.state.keep(self.fingerprint, node, &column);
        column
    }

    /// What lights without surfaces bring to any points, from lamps and from beyond the scene: for each point and band.
    pub(super) fn straight(&self, points: &[DifferentialArea]) -> Result<Vec<[Vec<f64>; 2]>, Error> {
        let find = |point: &DifferentialArea| self.lights.irradiance(&self.enclosure, point);
        workers::from_all(points, "what a light shines on", find)
    }

    /// Whether there are lights without surfaces.
    pub(super) fn are_lit(&self) -> bool {
        !self.lights.is_empty()
    }

    /// The power of the lamps per band.
    pub(super) fn lamp_power(&self) -> &[f64] {
        self.lights.power()
    }

    /// A point of a patch, as the enclosure knows it.
    pub(super) fn on_patch(&self, from: DifferentialArea, patch: usize) -> DifferentialArea {
        from.owned_by(self.surface_of[patch])
    }

    /// What a form factor may be off by.
    fn enough(&self) -> f64 {
        if self.rough.is_some() { SHOWN } else { ENOUGH }
    }

    /// The form factor from a point to a piece, and what may hide some of it.
    pub(super) fn factor_and_blockers(&self, from: &DifferentialArea, piece: &PieceShape) -> (f64, Blockers) {
        let surface = self.surface_of[piece.patch];
        let (factor, blockers) =
            self.enclosure.form_factor_and_blockers(from, surface, &piece.polygon, SHOWN);
        (factor.value, blockers)
    }

    /// The form factor from a point to a part of a piece past what may hide some of that, and what may hide some of the part.
    pub(super) fn factor_behind(
        &self,
        from: &DifferentialArea,
        part: &PieceShape,
        blockers: &Blockers,
    ) -> (f64, Blockers) {
        let surface = self.surface_of[part.patch];
        let (factor, blockers) =
            self.enclosure.form_factor_behind(from, surface, &part.polygon, blockers, SHOWN);
        (factor.value, blockers)
    }

    /// What may hide some of a part of a piece past what may hide some of that; nothing where one of these hides all of it.
    pub(super) fn blockers_of_part(
        &self,
        from: &DifferentialArea,
        part: &PieceShape,
        blockers: &Blockers,
    ) -> Option<Blockers> {
        self.enclosure.blockers_of_part(from, self.surface_of[part.patch], &part.polygon, blockers)
    }

    /// Whether a patch gives light of its own.
    pub(super) fn emits(&self, patch: usize) -> bool {
        self.scene.patches[patch].emits()
    }

    /// The shape of an element; nothing for one without area.
    pub(super) fn triangle(&self, element: usize) -> Option<PieceShape> {
        let mesh = &self.subdivision.mesh;
        let polygon = PlanarPolygon::new([mesh.triangle(element)]).ok()?;
        Some(self.part(mesh.elements[element].patch, &polygon))
    }

    /// The form factors from some groups of elements to a piece.
    pub(super) fn seen(&self, groups: Range<usize>, piece: &PieceShape) -> Result<Vec<Vec<f64>>, Error> {
        let ball = Ball::around(&piece.polygon);
        workers::from_all(&self.groups[groups], &self.scene.patches[piece.patch].name, |group| {
            #[cfg(test)]
            assert_ne!(self.state.trap, Some(piece.patch), "injected");
            let points = &self.receivers[group.clone()];
            let is_small = |at: &usize| self.is_small(group.start + at, piece.patch);
            let (small, others): (Vec<usize>, Vec<usize>) = (0..points.len()).partition(is_small);
            let rough = self.roughly((group.start, points), &small, (piece.patch, &ball));
            let exact = self.exact(points, &others, piece);
            let mut found = vec![0.0; points.len()];
            small
                .into_iter()
                .zip(rough)
                .chain(others.into_iter().zip(exact))
                .for_each(|(at, factor)| found[at] = factor);
            found
        })
    }

    /// About the form factors from some groups of elements to a piece, however large they are; for runs that take some roughly.
    pub(super) fn about(&self, groups: Range<usize>, piece: &PieceShape) -> Result<Vec<Vec<f64>>, Error> {
        let ball = Ball::around(&piece.polygon);
        workers::from_all(&self.groups[groups], &self.scene.patches[piece.patch].name, |group| {
            let points = &self.receivers[group.clone()];
            let faced: Vec<usize> = (0..points.len()).filter(|at| ball.disk(&points[*at]) > 0.0).collect();
            let found = self.roughly((group.start, points), &faced, (piece.patch, &ball));
            let mut factors = vec![0.0; points.len()];
            faced.into_iter().zip(found).for_each(|(at, factor)| factors[at] = factor);
            factors
        })
    }

    /// Whether the form factor from an element to a patch may be taken roughly.
    fn is_small(&self, element: usize, patch: usize) -> bool {
        self.rough.as_ref().is_some_and(|rough| rough.is_small(element, &self.receivers[element], patch))
    }

    /// The form factors from some of a group of elements to a piece.
    fn exact(&self, points: &[DifferentialArea], some: &[usize], piece: &PieceShape) -> Vec<f64> {
        let points: Vec<_> = some.iter().map(|at| points[*at]).collect();
        let surface = self.surface_of[piece.patch];
        let found = self.enclosure.form_factors_within(&points, surface, &piece.polygon, self.enough());
        found.into_iter().map(|factor| factor.value).collect()
    }

    /// The form factors from some of a group of elements to a small piece.
    fn roughly(&self, group: ElementGroup<'_>, some: &[usize], piece: (usize, &Ball)) -> Vec<f64> {
        self.rough.as_ref().map_or_else(Vec::new, |rough| rough.factors(&self.enclosure, group, some, piece))
    }

    /// The shape of a piece.
    pub(super) fn piece(&self, node: usize) -> Result<PieceShape, Error> {
        let Subdivision { mesh, nodes, flat, .. } = self.subdivision;
        let patch = nodes[node].patch;
        if node == patch {
            return Ok(self.part(patch, &self.scene.patches[patch].polygon));
        }
        let outline = flat
            .outline(mesh, &mesh.elements[nodes[node].elements.clone()])
            .map_err(|source| Error::Shape { patch: self.scene.patches[patch].name.clone(), source })?;
        Ok(self.part(patch, &outline))
    }

    fn part(&self, patch: usize, polygon: &PlanarPolygon) -> PieceShape {
        let whole = &self.enclosure.polygons()[self.surface_of[patch]];
        // A patch may be farther off the plane of a wall that it is joined with than roundings are.
        let polygon = whole.part(polygon.loops()).unwrap_or_else(|_| polygon.clone());
        PieceShape { patch, polygon }
    }
}

/// The elements of the largest pieces of patches that have few enough.
fn groups(scene: &Scene, subdivision: &Subdivision) -> Vec<Range<usize>> {
    let nodes = &subdivision.nodes;
    let (mut open, mut groups) = ((0..scene.patches.len()).collect::<Vec<_>>(), Vec::new());
    while let Some(node) = open.pop() {
        match nodes[node].halves {
            Some(halves) if nodes[node].elements.len() > GROUP => open.extend(halves),
            _ => groups.push(nodes[node].elements.clone()),
        }
    }
    groups.sort_by_key(|group| group.start);
    groups
}
