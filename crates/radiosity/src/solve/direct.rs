//! The final gather: light straight from the emitters, exact at every vertex.
use super::{receivers::receivers, run::Run, solution::Gathered};
use crate::error::Error;
use crate::scene::Scene;
use formfactor::DifferentialArea;
use std::f64::consts::PI;

/// The emitters' light on every element and at every vertex.
pub(super) fn gather(scene: &Scene, run: &mut Run<'_>) -> Result<Gathered, Error> {
    let (mesh, bands) = (&run.factors.subdivision.mesh, run.light.bands);
    let on_patch =
        |(element, area): (usize, DifferentialArea)| run.factors.on_patch(area, mesh.elements[element].patch);
    let receivers: Vec<DifferentialArea> = receivers(scene, mesh)?.into_iter().map(on_patch).collect();
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
    Ok(Gathered { elements, vertices })
}
