//! Leaves in pieces that are small enough for their light to be shown as linear; where shadows have edges, along these.
use super::equilibrium::Equilibrium;
use super::tile::Outline;
use super::tiling::Tiling;
use super::vertices::{Ask, Sights};
use crate::error::Error;
use formfactor::DifferentialArea;

/// Light is as bright as the eye makes it where it is more than this share of the mean.
const DIM: f64 = 0.1;
/// Pieces of less than this share of the scene's area are seen less: by the share of their size.
const SMALL: f64 = 1e-4;
/// Pieces of less than this share are not cut.
const LEAST: f64 = 1e-6;

/// A part of a leaf.
#[derive(Clone, Debug)]
pub(super) struct LeafPart {
    /// Which of the leaves.
    pub(super) leaf: usize,
    pub(super) outline: Outline,
}

/// How far from linear the light of a piece may be.
struct Measure<'m> {
    share: f64,
    /// What counts as dim, band by band.
    dim: &'m [f64],
}

/// The leaves as they are.
pub(super) fn whole(tiling: &Tiling<'_>, equilibrium: &Equilibrium<'_>) -> Vec<LeafPart> {
    let piece =
        |(leaf, tile): (usize, &usize)| LeafPart { leaf, outline: tiling.tiles[*tile].outline.clone() };
    equilibrium.leaves().iter().enumerate().map(piece).collect()
}

/// The leaves in pieces of which the middle is as bright as the means of points on both sides, within a share; nothing when the caller
/// wants to stop. `means` is the mean irradiance in each band.
///
/// # Errors
/// [`Error::Defect`] when a form factor fails.
pub(super) fn pieces(
    sights: &Sights<'_>,
    equilibrium: &Equilibrium<'_>,
    means: &[f64],
    share: f64,
    ask: Ask<'_>,
) -> Result<Option<Vec<LeafPart>>, Error> {
    let tiling = sights.tiling;
    let dim: Vec<f64> = means.iter().map(|mean| DIM * mean).collect();
    let measure = Measure { share, dim: &dim };
    let whole_area = equilibrium.leaves().iter().map(|&leaf| tiling.tiles[leaf].area).sum::<f64>();
    let (mut fine, mut open) = (Vec::new(), whole(tiling, equilibrium));
    while !open.is_empty() {
        let tile = |piece: &LeafPart| equilibrium.leaves()[piece.leaf];
        let mut points: Vec<(usize, DifferentialArea)> = Vec::with_capacity(5 * open.len());
        for piece in &open {
            let on = tiling.points(tiling.tiles[tile(piece)].patch, &piece.outline)?;
            points.extend(on.map(|point| (tile(piece), point)));
        }
        let Some(light) = sights.irradiance(&points, &mut *ask)? else { return Ok(None) };
        let mut parts = Vec::new();
        for (piece, light) in open.into_iter().zip(light.chunks(5 * means.len())) {
            let patch = tiling.tiles[equilibrium.leaves()[piece.leaf]].patch;
            let area = tiling.area(patch, &piece.outline) / whole_area;
            let uneven = measure.uneven(light, (SMALL / area).sqrt().max(1.0)).filter(|_| area > LEAST);
            // What stands on a leaf parts what it covers from what is lit.
            let axis = uneven.or(tiling.is_crossed(patch, &piece.outline).then_some(0));
            let edge = sights.direct.edge_in(equilibrium.leaves()[piece.leaf], &piece.outline);
            match axis.and_then(|axis| tiling.cut_along(patch, &piece.outline, edge, axis)) {
                Some(halves) => parts.extend(halves.map(|outline| LeafPart { leaf: piece.leaf, outline })),
                None => fine.push(piece),
            }
        }
        open = parts;
    }
    Ok(Some(fine))
}

impl Measure<'_> {
    /// The axis along which the light of five points bends most, if that is more than `times` what it may.
    fn uneven(&self, light: &[f64], times: f64) -> Option<usize> {
        let bands = self.dim.len();
        let bend = |ends: [usize; 2]| {
            let of_band = |band: usize| {
                let [middle, one, other] = [0, ends[0], ends[1]].map(|point| light[point * bands + band]);
                let unit = middle.max((one + other) / 2.0) + self.dim[band];
                if unit > 0.0 { ((one + other) / 2.0 - middle).abs() / unit } else { 0.0 }
            };
            (0..bands).map(of_band).fold(0.0, f64::max)
        };
        let [long, short] = [[1, 2], [3, 4]].map(bend);
        (long.max(short) > times * self.share).then_some(usize::from(short > long))
    }
}
