//! Form factors by hemicubes, to compare with.
use crate::error::Error;
use crate::mesh::subdivide::Subdivision;
use crate::scene::Scene;
use formfactor::approx::{Hemicube, Method};
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use rayon::prelude::*;

/// Elements whose hemicubes are drawn between two looks at the watcher.
const CHUNK: usize = 64;

/// What each element sees of the others, its own hemicube drawn once: for each sender the receivers and their factors.
#[derive(Debug)]
pub(super) struct Hemicubes {
    columns: Vec<Vec<(usize, f64)>>,
}

impl Hemicubes {
    /// Draws a hemicube of `resolution` × `resolution` cells on every element; nothing when `watch` says to stop.
    pub(super) fn draw(
        scene: &Scene,
        subdivision: &Subdivision,
        resolution: u32,
        mut watch: impl FnMut() -> bool,
    ) -> Result<Option<Hemicubes>, Error> {
        let mesh = &subdivision.mesh;
        let named = |index: usize| {
            let patch = &scene.patches[mesh.elements[index].patch];
            move |source| Error::Shape { patch: patch.name.clone(), source }
        };
        let elements = 0..mesh.elements.len();
        let triangle = |index: usize| PlanarPolygon::new([mesh.triangle(index)]).map_err(named(index));
        let enclosure = Enclosure::new(elements.clone().map(triangle).collect::<Result<_, _>>()?);
        let receiver = |index: usize| {
            let normal = scene.patches[mesh.elements[index].patch].polygon.normal();
            let area = DifferentialArea::new(mesh.centroid(index), normal).map_err(named(index))?;
            Ok(area.owned_by(index))
        };
        let receivers: Vec<DifferentialArea> =
            elements.clone().map(receiver).collect::<Result<_, Error>>()?;
        let (hemicube, targets) = (Hemicube::new(resolution), elements.collect::<Vec<_>>());
        let mut columns = vec![Vec::new(); receivers.len()];
        for (chunk, receivers) in receivers.chunks(CHUNK).enumerate() {
            if watch() {
                return Ok(None);
            }
            let rows: Vec<Vec<f64>> =
                receivers.par_iter().map(|from| hemicube.row(&enclosure, from, &targets)).collect();
            for (index, row) in rows.into_iter().enumerate() {
                let seen = row.into_iter().enumerate().filter(|(_, factor)| *factor > 0.0);
                seen.for_each(|(sender, factor)| columns[sender].push((chunk * CHUNK + index, factor)));
            }
        }
        Ok(Some(Hemicubes { columns }))
    }

    /// The factors from every element to some of them together.
    pub(super) fn column(&self, senders: std::ops::Range<usize>) -> Vec<f64> {
        let mut column = vec![0.0; self.columns.len()];
        for (receiver, factor) in self.columns[senders].iter().flatten() {
            column[*receiver] += factor;
        }
        column
    }
}
