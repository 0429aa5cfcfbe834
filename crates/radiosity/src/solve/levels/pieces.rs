//! Leaves in pieces that are small enough for their light to be shown as linear; where shadows have edges, along these.
use super::corners::CornerLight;
use super::cutting::{Cutting, FoundLight, LeafPart, OpenPart};
use super::equilibrium::Equilibrium;
use super::evenness::Evenness;
use super::tiling::Tiling;
use super::vertices::{Ask, Sights};
use crate::error::Error;
use glam::DVec2;

/// Light is as bright as the eye makes it where it is more than this share of the mean.
const DIM: f64 = 0.1;

/// The leaves as they are.
pub(super) fn whole(tiling: &Tiling<'_>, equilibrium: &Equilibrium<'_>) -> Vec<LeafPart> {
    let piece =
        |(leaf, tile): (usize, &usize)| LeafPart { leaf, outline: tiling.tiles[*tile].outline.clone() };
    equilibrium.leaves().iter().enumerate().map(piece).collect()
}

/// The leaves in view in pieces over which light is linear within a share, as the estimate and looks from their corners, middles or five points say,
/// and the others as they are, with what corners and middles receive; nothing when the caller wants to stop. `lines` are those on each patch across which light jumps, `means` is
/// the mean irradiance in each band, `share` of which pieces may be off by.
///
/// # Errors
/// [`Error::Defect`] when a form factor fails.
pub(super) fn pieces<'s>(
    sights: &Sights<'s>,
    equilibrium: &Equilibrium<'_>,
    found: &FoundLight<'_>,
    lines: &[Vec<[DVec2; 2]>],
    (means, share): (&[f64], f64),
    ask: Ask<'_>,
) -> Result<Option<(Vec<LeafPart>, CornerLight<'s>)>, Error> {
    let dim: Vec<f64> = means.iter().map(|mean| DIM * mean).collect();
    let corners = CornerLight::new(sights.tiling, lines);
    let mut cutting = Cutting::new(sights, corners, equilibrium.leaves(), Evenness { share, dim: &dim });
    let is_in_view = |part: &LeafPart| sights.in_view[equilibrium.patch(part.leaf)];
    let (seen, mut fine): (Vec<_>, Vec<_>) =
        whole(sights.tiling, equilibrium).into_iter().partition(is_in_view);
    let seen: Vec<OpenPart> = seen.into_iter().map(|part| cutting.open(part)).collect();
    if !cutting.look_from_corners(sights, &seen, &mut *ask)? {
        return Ok(None);
    }
    let (flat, open): (Vec<_>, Vec<_>) = seen.into_iter().partition(|piece| cutting.is_flat(piece, found));
    fine.extend(flat.into_iter().map(|piece| piece.part));
    let Some((even, mut open)) = cutting.look_from_middles(sights, open, found, &mut *ask)? else {
        return Ok(None);
    };
    fine.extend(even);
    while !open.is_empty() {
        let Some(light) = cutting.look(sights, &open, &mut *ask)? else { return Ok(None) };
        let mut parts = Vec::new();
        for (piece, light) in open.into_iter().zip(light.chunks(5 * means.len())) {
            match cutting.halves(&piece, light) {
                Some(halves) => parts.extend(halves),
                None => fine.push(piece.part),
            }
        }
        open = parts;
    }
    Ok(Some((fine, cutting.corners)))
}
