//! Light on the tree: from leaves up to what sends, across the links, and down to the leaves.
use super::link::Link;
use super::tile::SQUARE;
use super::tiling::Tiling;

/// Coefficients of linear light, in one band.
pub(super) type Linear = [f64; 3];

/// The square of light's mean square.
pub(super) fn square([mean, first, second]: Linear) -> f64 {
    mean * mean + SQUARE * (first * first + second * second)
}

/// What linear light is where the two linear functions are so much.
pub(super) fn value([mean, first, second]: Linear, [a, b]: [f64; 2]) -> f64 {
    mean + a * first + b * second
}

/// What the tiles above the leaves send: projections of what their halves do.
pub(super) fn pull(tiling: &Tiling<'_>, sent: &mut [Linear]) {
    for (index, tile) in tiling.tiles.iter().enumerate().rev() {
        let Some(halves) = tile.halves else { continue };
        let parts = halves.map(|half| tiling.tiles[half].extend(sent[half]));
        sent[index] = [0, 1, 2].map(|k| (parts[0][k] + parts[1][k]) / tile.area);
    }
}

/// What the leaves receive: what all above them do as well.
pub(super) fn push(tiling: &Tiling<'_>, received: &mut [Linear]) {
    for index in 0..tiling.tiles.len() {
        let Some(parent) = tiling.tiles[index].parent else { continue };
        let above = tiling.tiles[index].restrict(received[parent]);
        received[index].iter_mut().zip(above).for_each(|(here, above)| *here += above);
    }
}

/// What all tiles receive across some links when they send so much: irradiance.
pub(super) fn gather<'l>(
    tiling: &Tiling<'_>,
    links: impl Iterator<Item = &'l Link>,
    sent: &[Linear],
) -> Vec<Linear> {
    let mut received = vec![[0.0; 3]; sent.len()];
    for link in links {
        let [one, other] = link.ends;
        let g = &link.exchange;
        let (from, back) = (sent[other], sent[one]);
        for k in 0..3 {
            received[one][k] += g[3 * k] * from[0] + g[3 * k + 1] * from[1] + g[3 * k + 2] * from[2];
            received[other][k] += g[k] * back[0] + g[3 + k] * back[1] + g[6 + k] * back[2];
        }
    }
    for (tile, light) in tiling.tiles.iter().zip(&mut received) {
        let per = 1.0 / tile.area;
        *light = [light[0] * per, light[1] * per / SQUARE, light[2] * per / SQUARE];
    }
    received
}
