//! Exact form factors from the elements to the pieces.
use super::state::{Column, State};
use super::{fingerprint, hemicube::Hemicubes, lights::Lights, occluders::Occluders, workers};
use crate::error::Error;
use crate::mesh::{element::Element, subdivide::Subdivision};
use crate::scene::Scene;
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use std::{ops::Range, sync::Arc};

/// What a form factor may be off by: far less than what tells a closed room from an open one.
const ENOUGH: f64 = 1e-11;

/// Columns of form factors: from the centroid of every element to one piece, all other patches occluding.
#[derive(Debug)]
pub(super) struct Factors<'s> {
    scene: &'s Scene,
    pub(super) subdivision: &'s Subdivision,
    enclosure: Enclosure,
    lights: Lights<'s>,
    /// The polygon of the enclosure that each patch is a part of.
    surface_of: Vec<usize>,
    receivers: Vec<DifferentialArea>,
    /// What takes the place of exact factors, to compare with.
    hemicubes: Option<Hemicubes>,
    /// The mesh in `state`.
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
        let mesh = &subdivision.mesh;
        let Occluders { polygons, of_patch: surface_of } = Occluders::join(scene);
        let receiver = |(index, element): (usize, &Element)| {
            let patch = &scene.patches[element.patch];
            DifferentialArea::new(mesh.centroid(index), patch.polygon.normal())
                .map(|area| area.owned_by(surface_of[element.patch]))
                .map_err(|source| Error::Shape { patch: patch.name.clone(), source })
        };
        Ok(Factors {
            receivers: mesh.elements.iter().enumerate().map(receiver).collect::<Result<_, _>>()?,
            scene,
            subdivision,
            lights: Lights::new(scene, &polygons),
            enclosure: Enclosure::new(polygons),
            surface_of,
            hemicubes: None,
            fingerprint: fingerprint::of_mesh(scene, subdivision),
            state,
        })
    }

    /// Takes the factors of hemicubes instead of exact ones.
    pub(super) fn approximate(&mut self, hemicubes: Hemicubes, resolution: u32) {
        self.hemicubes = Some(hemicubes);
        self.fingerprint ^= u64::from(resolution);
    }

    /// Whether the state knows of this scene and mesh.
    pub(super) fn are_known(&self) -> bool {
        self.state.knows(self.fingerprint)
    }

    /// Whether the column of a piece is known.
    pub(super) fn is_known(&self, node: usize) -> bool {
        self.kept(node).is_some()
    }

    fn kept(&self, node: usize) -> Option<Arc<Column>> {
        self.state.column(self.fingerprint, node, self.receivers.len())
    }

    /// The form factors from all elements to one piece. They never change, so they are kept while memory lasts.
    pub(super) fn column(&mut self, node: usize) -> Result<Arc<Column>, Error> {
        if let Some(column) = self.kept(node) {
            return Ok(column);
        }
        let column = Arc::new(Column::new(&self.find(node)?));
        self.state.keep(self.fingerprint, node, &column);
        Ok(column)
    }

    /// What lights without surfaces bring to the centroids of some elements, in all and from beyond the scene: elements × bands.
    pub(super) fn direct(&self, elements: Range<usize>) -> Result<[Vec<f64>; 2], Error> {
        self.straight(&self.receivers[elements])
    }

    /// What lights without surfaces bring to any points, in all and from beyond the scene: points × bands.
    pub(super) fn straight(&self, points: &[DifferentialArea]) -> Result<[Vec<f64>; 2], Error> {
        let mut all = [(); 2].map(|()| Vec::with_capacity(points.len() * self.scene.bands));
        let find = |point: &DifferentialArea| self.lights.irradiance(&self.enclosure, point);
        for [lamps, beyond] in workers::from_all(points, "what a light shines on", find)? {
            all[0].extend(lamps.iter().zip(&beyond).map(|(lamps, beyond)| lamps + beyond));
            all[1].extend(beyond);
        }
        Ok(all)
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

    /// The form factors from any points to a whole patch.
    pub(super) fn seen_from(&self, points: &[DifferentialArea], patch: usize) -> Result<Vec<f64>, Error> {
        self.to_part(points, patch, &self.scene.patches[patch].polygon)
    }

    /// The form factors from any points to a part of a patch.
    fn to_part(
        &self,
        points: &[DifferentialArea],
        patch: usize,
        part: &PlanarPolygon,
    ) -> Result<Vec<f64>, Error> {
        let (name, surface) = (&self.scene.patches[patch].name, self.surface_of[patch]);
        // A patch may be farther off the plane of a wall that it is joined with than roundings are.
        let part = &self.enclosure.polygons()[surface].part(part.loops()).unwrap_or_else(|_| part.clone());
        workers::from_all(points, name, |from| {
            #[cfg(test)]
            assert_ne!(self.state.trap, Some(patch), "injected");
            self.enclosure.form_factor_within(from, surface, part, ENOUGH).value
        })
    }

    /// Finds the form factors from all elements to one piece.
    fn find(&self, node: usize) -> Result<Vec<f64>, Error> {
        let Subdivision { mesh, nodes, flat, .. } = self.subdivision;
        if let Some(hemicubes) = &self.hemicubes {
            return Ok(hemicubes.column(nodes[node].elements.clone()));
        }
        let patch = nodes[node].patch;
        if node == patch {
            return self.seen_from(&self.receivers, patch);
        }
        let piece = flat
            .outline(mesh, &mesh.elements[nodes[node].elements.clone()])
            .map_err(|source| Error::Shape { patch: self.scene.patches[patch].name.clone(), source })?;
        self.to_part(&self.receivers, patch, &piece)
    }

    /// The sums of form factors from every element over pieces.
    pub(super) fn sums(&mut self, pieces: impl IntoIterator<Item = usize>) -> Result<Vec<f64>, Error> {
        let mut sums = vec![0.0; self.receivers.len()];
        for node in pieces {
            for (element, factor) in self.column(node)?.iter() {
                sums[element] += factor;
            }
        }
        Ok(sums)
    }
}
