//! The final gather: what vertices receive, exactly past what stands in between, and more vertices where light is not linear in between.
//!
//! ```text
//! received   what elements received of every patch, row by row
//! known      what a vertex receives, by what the elements around it did
//! senders    patches, their pieces and their elements, each as bright as its elements are on average
//! tears      vertices apart where light jumps
//! outlook    where vertices are looked from, and the elements around them
//! shown      linear light between vertices; which elements are to be cut
//! bisection  elements cut in halves
//! ```
//!
//! Lights are looked at from the vertex itself, and so are patches that bring much, where they are near or the elements around the vertex, and
//! the ends of the edge that it was the middle of, receive unlike shares of their light: piece by piece, where these are not equally bright. Of
//! the others a vertex receives what the elements around it do. From the smallest vertices only lights are looked at: they have 3 % of the
//! area, and are most where bodies are round.
//!
//! Where the time was up before all had shot, drafts take roughly what elements receive of the rest, by who sees their clusters.
mod bisection;
mod known;
mod outlook;
mod received;
mod senders;
mod shown;
mod tears;

use super::{interpolate::Means, run::Run, solution::FineLight};
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::scene::Scene;
use known::{Known, Look};
use outlook::{Outlook, areas_around, narrow, outlooks};
use shown::Shown;
use std::{collections::BTreeMap, time::Instant};

/// So many times the vertices that the mesh has are looked from beside these at most,
const MORE: usize = 2;
/// in so many rounds.
const ROUNDS: usize = 16;
/// After so many of them cutting ends where most is as good as is asked for: what is little of the area was cut until then.
const FIRST: usize = 6;
/// From so many vertices is looked to foresee how long all take, so many at a time,
const SAMPLE: usize = 64;
const FEW: usize = 8;
/// until so many seconds are spent.
const ENOUGH: f64 = 0.3;

/// What every vertex receives, and of others between them: the mean of the elements around it, or what is linear, where it is not looked from
/// in time. Nothing when the watcher wants to stop before the first.
///
/// Takes (form factors to the patches that a vertex is near) × (vertices), and the light of lamps, sun and sky for each.
///
/// # Errors
/// [`Error::Shape`] where a place is beyond what form factors take, [`Error::Defect`] when one fails.
pub(super) fn gather(scene: &Scene, run: &mut Run<'_>) -> Result<Option<FineLight>, Error> {
    let Some(known) = Known::of(run)? else { return Ok(None) };
    let mesh = known.torn(&run.factors.subdivision.mesh);
    let (corners, mut looks) = corners(scene, run, &known, &mesh)?;
    let mut shown = Shown::of(&mesh, corners, run.light.bands, &known);
    for round in 0..ROUNDS {
        let count = (MORE * mesh.vertices.len()).div_ceil(ROUNDS);
        let is_done = run.is_stopped() || (round >= FIRST && shown.is_within(run.options.error));
        let middles = if is_done { Vec::new() } else { shown.cut(count) };
        if middles.is_empty() {
            break;
        }
        let vertices: Vec<usize> = middles.iter().map(|middle| middle.vertex).collect();
        let bisection = &shown.bisection;
        let mut outlooks = outlooks(scene, run, (&bisection.mesh, &bisection.whole), &vertices)?;
        outlooks.iter_mut().zip(&middles).for_each(|(outlook, middle)| outlook.ends = Some(middle.ends));
        let found = look(run, &known, &outlooks, &looks)?;
        shown.learn(&middles, &found, &known);
        looks.extend(vertices.into_iter().zip(found));
    }
    Ok(Some(shown.into_light(scene)))
}

/// How many seconds a gather of the light that is found so far would take, by those of a few vertices among all; fewer where each takes long.
///
/// # Errors
/// As [`gather`].
pub(super) fn foresee(scene: &Scene, run: &mut Run<'_>) -> Result<f64, Error> {
    let start = Instant::now();
    let Some(known) = Known::of(run)? else { return Ok(f64::INFINITY) };
    let mesh = known.torn(&run.factors.subdivision.mesh);
    let whole: Vec<usize> = (0..mesh.elements.len()).collect();
    let count = mesh.vertices.len();
    let some: Vec<usize> = (0..count).step_by(count.div_ceil(SAMPLE).max(1)).collect();
    let mut outlooks: Vec<(usize, Outlook)> =
        outlooks(scene, run, (&mesh, &whole), &some)?.into_iter().enumerate().collect();
    outlooks.sort_by_key(|(index, _)| index % FEW);
    let outlooks: Vec<Outlook> = outlooks.into_iter().map(|(_, outlook)| outlook).collect();
    let (ready, mut done) = (start.elapsed().as_secs_f64(), 0);
    for few in outlooks.chunks(FEW) {
        known.look(run, few, &BTreeMap::new())?;
        done += few.len();
        if start.elapsed().as_secs_f64() - ready > ENOUGH {
            break;
        }
    }
    let each = (start.elapsed().as_secs_f64() - ready) / done.max(1) as f64;
    Ok(ready + each * (count * (ROUNDS + MORE * FIRST) / ROUNDS) as f64)
}

/// What the vertices of the run's mesh receive, torn apart as they are, and what they see: those with the most area around them first, so
/// that most of what is shown is right when there is no time for all.
fn corners(
    scene: &Scene,
    run: &mut Run<'_>,
    known: &Known,
    mesh: &Mesh,
) -> Result<(Vec<f64>, BTreeMap<usize, Look>), Error> {
    let [vertices, whole] =
        [mesh.vertices.len(), mesh.elements.len()].map(|count| (0..count).collect::<Vec<_>>());
    let mut outlooks = outlooks(scene, run, (mesh, &whole), &vertices)?;
    let areas = areas_around(mesh);
    narrow(&areas, &mut outlooks);
    let mut outlooks: Vec<(usize, Outlook)> = outlooks.into_iter().enumerate().collect();
    outlooks.sort_by(|(a, _), (b, _)| areas[*b].total_cmp(&areas[*a]));
    let (order, outlooks): (Vec<usize>, Vec<Outlook>) = outlooks.into_iter().unzip();
    let found = look(run, known, &outlooks, &BTreeMap::new())?;
    let looks: BTreeMap<usize, Look> = order.into_iter().zip(found).collect();
    let bands = run.light.bands;
    let mut light = Means::of(mesh, bands).around(&known.light);
    for (vertex, look) in &looks {
        light[vertex * bands..][..bands].copy_from_slice(&look.light);
    }
    Ok((light, looks))
}

/// What vertices receive; of fewer than all when the watcher wants to stop. Of those in between what their ends see is known.
fn look(
    run: &mut Run<'_>,
    known: &Known,
    outlooks: &[Outlook],
    looks: &BTreeMap<usize, Look>,
) -> Result<Vec<Look>, Error> {
    run.in_batches(outlooks.len(), |run, some| known.look(run, &outlooks[some], looks))
}
