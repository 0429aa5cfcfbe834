//! The final gather: light straight from the emitters, exact at every vertex.
use super::{factors::Factors, run::Run, solution::DirectLight};
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use formfactor::DifferentialArea;
use glam::DVec3;
use std::{collections::BTreeSet, f64::consts::PI};

/// How far towards the elements around it a vertex is moved: F is discontinuous at the feet of walls, and there the
/// limit from the vertex's own side is wanted.
const INWARD: f64 = 1e-3;

/// The emitters' light on every element and at every vertex.
pub(super) fn gather(scene: &Scene, run: &mut Run<'_>) -> Result<DirectLight, Error> {
    let (mesh, bands) = (&run.factors.subdivision.mesh, run.light.bands);
    let receivers = receivers(scene, &run.factors)?;
    let mut elements = vec![0.0; mesh.elements.len() * bands];
    let mut vertices = vec![0.0; mesh.vertices.len() * bands];
    for (emitter, patch) in scene.patches.iter().enumerate().filter(|(_, patch)| patch.emits()) {
        let shine = |values: &mut [f64], place: usize, factor: f64| {
            let irradiance = values[place * bands..].iter_mut().zip(&patch.emission);
            irradiance.for_each(|(h, radiance)| *h += PI * radiance * factor);
        };
        for (element, factor) in run.factors.column(emitter)?.iter() {
            shine(&mut elements, element, factor);
        }
        let factors = run.factors.seen_from(&receivers, emitter)?;
        factors.into_iter().enumerate().for_each(|(vertex, factor)| shine(&mut vertices, vertex, factor));
    }
    Ok(DirectLight { elements, vertices })
}

/// A receiver for every vertex; on the rim of a patch, and at the foot of what stands on it, a little inside the elements
/// around it.
fn receivers(scene: &Scene, factors: &Factors<'_>) -> Result<Vec<DifferentialArea>, Error> {
    let mesh = &factors.subdivision.mesh;
    let rim = rim(mesh);
    let mut around = vec![(DVec3::ZERO, 0.0, 0); mesh.vertices.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let (area, centroid) = (mesh.area(index), mesh.centroid(index));
        for corner in element.corners {
            let (sum, weight, _) = around[corner];
            around[corner] = (sum + area * (centroid - mesh.vertices[corner]), weight + area, element.patch);
        }
    }
    let receiver = |(vertex, (sum, weight, patch)): (usize, (DVec3, f64, usize))| {
        let inward = if weight > 0.0 && rim[vertex] { sum / weight * INWARD } else { DVec3::ZERO };
        let area =
            DifferentialArea::new(mesh.vertices[vertex] + inward, scene.patches[patch].polygon.normal());
        area.map(|area| factors.on_patch(area, patch))
            .map_err(|source| Error::Shape { patch: scene.patches[patch].name.clone(), source })
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
