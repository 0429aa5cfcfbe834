//! The final gather: light straight from lights and emitters, exact at every vertex.
use super::{receivers::receivers, run::Run, solution::Gathered};
use crate::error::Error;
use crate::scene::Scene;
use formfactor::DifferentialArea;
use std::f64::consts::PI;

/// The light of lamps, sun and sky, and that of emitters where `with_emitters` asks for it, on every element and at every vertex; nothing
/// where there is none of either, or when the watcher wants to stop.
pub(super) fn gather(
    scene: &Scene,
    run: &mut Run<'_>,
    with_emitters: bool,
) -> Result<Option<Gathered>, Error> {
    let subdivision = run.factors.subdivision;
    let (mesh, bands) = (&subdivision.mesh, run.light.bands);
    let on_patch =
        |(element, area): (usize, DifferentialArea)| run.factors.on_patch(area, mesh.elements[element].patch);
    let receivers: Vec<DifferentialArea> = receivers(scene, mesh)?.into_iter().map(on_patch).collect();
    let is_lit = run.factors.are_lit();
    if !is_lit && !with_emitters {
        return Ok(None);
    }
    let mut elements = run.light.direct.clone();
    let straight =
        if is_lit { run.straight(&receivers)? } else { Some(vec![0.0; mesh.vertices.len() * bands]) };
    let Some(mut vertices) = straight else { return Ok(None) };
    let emitters = scene.patches.iter().enumerate().filter(|(_, patch)| with_emitters && patch.emits());
    for (emitter, patch) in emitters {
        let shine = |values: &mut [f64], place: usize, factor: f64| {
            let irradiance = values[place * bands..].iter_mut().zip(&patch.emission);
            irradiance.for_each(|(h, radiance)| *h += PI * radiance * factor);
        };
        let Some(column) = run.column(emitter)? else { return Ok(None) };
        for (element, factor) in column.iter() {
            shine(&mut elements, element, factor);
        }
        let whole = run.factors.piece(emitter)?;
        let Some(factors) = run.seen_from(&receivers, &whole)? else { return Ok(None) };
        factors.into_iter().enumerate().for_each(|(vertex, factor)| shine(&mut vertices, vertex, factor));
    }
    Ok(Some(Gathered { elements, vertices }))
}
