//! What the irradiance of every patch may be off by.
use super::budget::BandLight;
use super::cluster_links::ClusterLinks;
use super::errors::{EXPONENT, OwnErrors, own_errors};
use super::link::Link;
use super::members::{PlateMembers, Spread};
use super::reflections::{Powers, Reflections, powers};
use super::tile::SQUARE;
use super::tiling::{Tile, Tiling};

/// The root mean square over a rectangle of a² + b² less its mean, a and b the linear functions.
const PARABOLA: f64 = 0.66;

/// What is wrong in each band.
pub(super) fn errors<'e>(
    tiling: &'e Tiling<'e>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &'e [BandLight],
) -> Vec<Errors<'e>> {
    let powers = powers(clusters);
    let of = |light| Errors::of(tiling, links, (clusters, powers.clone()), light);
    lights.iter().map(of).collect()
}

/// The mean error of the irradiance of every patch; patches × `bands`.
pub(super) fn estimate(
    tiling: &Tiling<'_>,
    members: &PlateMembers<'_>,
    errors: &[Errors<'_>],
    bands: usize,
) -> Vec<f64> {
    let spread = members.spread(tiling);
    let mut found = vec![0.0; members.of_patches.len() * bands];
    for errors in errors {
        let (band, unit) = (errors.light.band, tiling.units()[errors.light.band]);
        let all = spread.means(|tile, area_on| errors.of_tile(tile, area_on));
        all.into_iter().enumerate().for_each(|(patch, error)| found[patch * bands + band] = unit * error);
    }
    found
}

/// The largest error in a band of what is received, as a share of the mean there or, where that is darker, of 1 % of the scene's.
pub(super) struct ErrorShares {
    pub(super) of_plates: Vec<f64>,
    pub(super) of_patches: Vec<f64>,
}

/// What all plates and patches may be off by.
pub(super) fn shares(tiling: &Tiling<'_>, spread: &Spread<'_>, errors: &[Errors<'_>]) -> ErrorShares {
    let mut of_plates = vec![0.0f64; tiling.scene.patches.len()];
    let mut of_patches = vec![0.0f64; spread.len()];
    let worse = |worst: &mut [f64], errors: Vec<f64>, units: Vec<f64>| {
        for ((worst, error), unit) in worst.iter_mut().zip(errors).zip(units) {
            *worst = worst.max(share((error, unit)));
        }
    };
    for errors in errors {
        let bright = |tile: usize| errors.unit(tile);
        worse(&mut of_plates, tiling.means(|root| errors.of_root(root)), tiling.means(bright));
        let of_patch = spread.means(|tile, area_on| errors.of_tile(tile, area_on));
        worse(&mut of_patches, of_patch, spread.means(|tile, _| bright(tile)));
    }
    ErrorShares { of_plates, of_patches }
}

fn share((error, unit): (f64, f64)) -> f64 {
    if unit > 0.0 { error / unit } else { 0.0 }
}

/// For each of some plates, what share of its error in its worst band comes of what refining the links of each plate betters.
pub(super) fn causes(tiling: &Tiling<'_>, errors: &[Errors<'_>], plates: &[usize]) -> Vec<Vec<f64>> {
    let shares = |errors: &Errors<'_>| {
        let [wrong, bright] =
            [tiling.means(|root| errors.of_root(root)), tiling.means(|root| errors.unit(root))];
        wrong.into_iter().zip(bright).map(share).collect::<Vec<f64>>()
    };
    let shares: Vec<Vec<f64>> = errors.iter().map(shares).collect();
    let of = |&plate: &usize| {
        let worst = errors.iter().zip(&shares).max_by(|a, b| a.1[plate].total_cmp(&b.1[plate]));
        worst.map_or_else(Vec::new, |(errors, _)| errors.causes(plate))
    };
    plates.iter().map(of).collect()
}

/// What the irradiance may be off by in a band, by reflection as well.
///
/// An error δ of the irradiance of a tile is light of its own, of which others receive ρ F: ε = δ + F ρ ε, each term raised to the exponent. It
/// is spread over the tile as its light is: who sees a dark part alone receives nothing of it.
pub(super) struct Errors<'e> {
    tiling: &'e Tiling<'e>,
    light: &'e BandLight,
    reflections: Reflections,
    own: OwnErrors,
    /// Of whole tiles, raised to the exponent.
    all: Vec<f64>,
}

impl<'e> Errors<'e> {
    fn of(
        tiling: &'e Tiling<'e>,
        links: &[Link],
        (clusters, powers): (&ClusterLinks, Powers),
        light: &'e BandLight,
    ) -> Errors<'e> {
        let reflections = Reflections::new(tiling, links, powers, light);
        let own = own_errors(tiling, links, clusters, light, &reflections.root_of);
        let all = reflections.all(&own.of_roots);
        Errors { tiling, light, reflections, own, all }
    }

    /// What counts as 1 on a tile: how bright its patch is.
    fn unit(&self, tile: usize) -> f64 {
        self.light.unit[tile] / self.tiling.patch_area(self.tiling.tiles[tile].patch)
    }

    /// Of a whole tile.
    fn of_root(&self, root: usize) -> f64 {
        self.all[root].powf(1.0 / EXPONENT)
    }

    /// Of what is on a tile, by how much of its area that is.
    fn of_tile(&self, tile: usize, area_on: f64) -> f64 {
        let Errors { tiling, light, own, .. } = self;
        let root = self.reflections.root_of[tile];
        if !tiling.is_joined(tiling.tiles[tile].patch) {
            return self.of_root(root);
        }
        // What is reflected is as wrong as on the whole tile, in proportion to the light there.
        let bright = if light.unit[root] > 0.0 { light.unit[tile] / light.unit[root] } else { 1.0 };
        let reflected = (self.all[root] - own.of_roots[root]).max(0.0) * bright.powf(EXPONENT);
        (own.of_tiles[tile] + reflected).powf(1.0 / EXPONENT) + self.bend(tile, area_on)
    }

    /// How far from linear light is on a part of a tile, by how much of its area that is. How light bends over what a patch covers makes no difference
    /// to its mean.
    fn bend(&self, tile: usize, area_on: f64) -> f64 {
        let Errors { tiling, light, .. } = self;
        let grain = tiling.grain[tiling.tiles[tile].patch].unwrap_or_default();
        let beside = |(above, larger): (usize, usize)| {
            let covers = if above == 0 { area_on } else { area_on.max(grain) };
            let bend = light.bend[larger] * residual(&tiling.tiles[larger], &tiling.tiles[tile]);
            (1.0 - covers / tiling.tiles[larger].area).max(0.0) * bend * bend
        };
        let larger = std::iter::successors(Some(tile), |tile| tiling.tiles[*tile].parent);
        larger.enumerate().map(beside).sum::<f64>().sqrt()
    }

    /// What share of the error of a plate comes of what refining the links of each plate betters.
    ///
    /// ε^p is linear in all δ^p, p the exponent: of the mean over its tiles each has the part that the derivative tells.
    fn causes(&self, plate: usize) -> Vec<f64> {
        let tiles = || self.tiling.tiles.iter().enumerate().filter(|(_, tile)| tile.parent.is_none());
        let mut weights = vec![0.0; self.all.len()];
        for (root, tile) in tiles().filter(|(root, tile)| tile.patch == plate && self.all[*root] > 0.0) {
            weights[root] = tile.area * self.of_root(root) / self.all[root];
        }
        let sum: f64 = weights.iter().zip(&self.all).map(|(weight, all)| weight * all).sum();
        let importance = self.reflections.importance(&weights);
        let mut causes = vec![0.0; self.tiling.scene.patches.len()];
        for (root, tile) in tiles() {
            causes[tile.patch] += importance[root] * self.own.of_links[root] / sum;
        }
        causes
    }
}

/// How much farther than on average over a tile a parabola over it is from linear at a part of it: three times as far in its corners.
fn residual(tile: &Tile, part: &Tile) -> f64 {
    let [a, b] = tile.outline.linear(part.outline.centroid);
    ((a * a + b * b - 2.0 * SQUARE).abs() / PARABOLA).max(1.0)
}
