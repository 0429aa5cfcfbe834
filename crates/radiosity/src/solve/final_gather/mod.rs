//! The final gather: what vertices receive, exactly past what stands in between.
//!
//! ```text
//! known      what elements are known to receive of every patch, and what a point receives
//! senders    patches, their pieces and their elements, each as bright as its elements are on average
//! around     the elements around every vertex
//! ```
//!
//! Lights, and patches that bring much, are looked at from the vertex itself: near patches piece by piece, where these are not equally bright.
//! Of the others a vertex receives what the elements around it do. Together they bring no more than a tenth of its light, and what is wrong is
//! a small part of that. The smallest elements are left as they are: they have 3 % of the area, and are most where bodies are round.
mod around;
mod known;
mod senders;

use super::{interpolate::Means, receivers::receivers, run::Run, solution::Gathered};
use crate::error::Error;
use crate::scene::Scene;
use around::{Around, PlaceAmong};
use known::Known;

/// What every vertex receives: the mean of the elements around it where it is not looked from, or not in time;
/// nothing when the watcher wants to stop before the first.
///
/// Takes (form factors to the patches that a vertex is near) × (vertices), and the light of lamps, sun and sky for each.
///
/// # Errors
/// [`Error::Shape`] where a place is beyond what form factors take, [`Error::Defect`] when one fails.
pub(super) fn gather(scene: &Scene, run: &mut Run<'_>) -> Result<Option<Gathered>, Error> {
    let (subdivision, bands) = (run.factors.subdivision, run.light.bands);
    let mesh = &subdivision.mesh;
    let (around, receivers) = (Around::of(mesh), receivers(scene, mesh)?);
    let mut vertices = Means::of(mesh, bands).around(&run.light.irradiance);
    let Some(known) = Known::of(run)? else { return Ok(None) };
    let large = around.large();
    let vertex = |&vertex: &usize| -> PlaceAmong<'_> {
        let (element, point) = receivers[vertex];
        (run.factors.on_patch(point, mesh.elements[element].patch), around.elements(vertex))
    };
    let looking: Vec<PlaceAmong<'_>> = large.iter().map(vertex).collect();
    let found = run.in_batches(large.len(), |run, some| known.look(run, &looking[some]))?;
    for (vertex, found) in large.iter().zip(&found) {
        vertices[vertex * bands..][..bands].copy_from_slice(found);
    }
    Ok(Some(Gathered { elements: run.light.irradiance.clone(), vertices }))
}
