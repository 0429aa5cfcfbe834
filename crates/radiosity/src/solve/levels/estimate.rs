//! What the irradiance of every patch may be off by.
use super::budget::{BandLight, errors};
use super::cluster_links::ClusterLinks;
use super::link::Link;
use super::members::{PlateMembers, Spread};
use super::tile::SQUARE;
use super::tiling::{Tile, Tiling};
use rayon::prelude::*;

/// Errors add up as this power of them does: between those of one sign, of which it is the first, and independent ones, of which it is the
/// second. So are those of the rooms of seven kinds of which the benchmarks tell.
const EXPONENT: f64 = 1.2;
/// The root mean square over a rectangle of a² + b² less its mean, a and b the linear functions.
const PARABOLA: f64 = 0.66;
/// Reflections that are followed.
const MOST: usize = 60;
/// No more of them when none changes anything by more than this share.
const SETTLED: f64 = 1e-4;

/// The mean error of the irradiance of every patch; patches × `bands`.
pub(super) fn estimate(
    tiling: &Tiling<'_>,
    members: &PlateMembers<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
    bands: usize,
) -> Vec<f64> {
    let spread = members.spread(tiling);
    let mut found = vec![0.0; members.of_patches.len() * bands];
    for light in lights {
        let unit = tiling.units()[light.band];
        let errors = errors_of(tiling, links, clusters, light);
        let all = spread.means(errors.of_tiles);
        all.into_iter()
            .enumerate()
            .for_each(|(patch, error)| found[patch * bands + light.band] = unit * error);
    }
    found
}

/// The largest error in a band of what is received, as a share of the mean there or, where that is darker, of 1 % of the scene's.
pub(super) struct ErrorShares {
    pub(super) of_plates: Vec<f64>,
    pub(super) of_patches: Vec<f64>,
}

/// What all plates and patches may be off by.
pub(super) fn shares(
    tiling: &Tiling<'_>,
    spread: &Spread<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
) -> ErrorShares {
    let mut of_plates = vec![0.0f64; tiling.scene.patches.len()];
    let mut of_patches = vec![0.0f64; spread.len()];
    let worse = |worst: &mut [f64], errors: Vec<f64>, units: Vec<f64>| {
        for ((worst, error), unit) in worst.iter_mut().zip(errors).zip(units) {
            *worst = worst.max(if unit > 0.0 { error / unit } else { 0.0 });
        }
    };
    for light in lights {
        let Errors { of_roots, of_tiles } = errors_of(tiling, links, clusters, light);
        let bright = |tile: usize| light.unit[tile] / tiling.patch_area(tiling.tiles[tile].patch);
        worse(&mut of_plates, tiling.means(|root| of_roots[root]), tiling.means(bright));
        worse(&mut of_patches, spread.means(of_tiles), spread.means(|tile, _| bright(tile)));
    }
    ErrorShares { of_plates, of_patches }
}

/// The pairs of whole tiles that are linked, and what the one receives of the other where that shines as bright as it does on average, and the
/// other of the one.
fn exchanges(tiling: &Tiling<'_>, links: &[Link], light: &BandLight) -> Vec<([usize; 2], [f64; 2])> {
    let root_of = tiling.roots();
    let pairs = links.iter().map(|link| link.pair + 1).max().unwrap_or(0);
    let mut found = vec![([0, 0], [0.0; 2]); pairs];
    let brightness = |tile: usize| match light.reflected[root_of[tile]] {
        mean if mean > 0.0 => light.reflected[tile] / mean,
        _ => 1.0,
    };
    for link in links {
        let (ends, sums) = &mut found[link.pair];
        *ends = link.ends.map(|end| root_of[end]);
        for end in [0, 1] {
            sums[end] += link.exchange[0] * brightness(link.ends[1 - end]);
        }
    }
    found
}

/// What the irradiance may be off by in a band, by reflection as well: of whole tiles, and of what is on a tile, by how much of its area that is.
///
/// An error δ of the irradiance of a tile is light of its own, of which others receive ρ F: ε = δ + F ρ ε, each term raised to the exponent. It
/// is spread over the tile as its light is: who sees a dark part alone receives nothing of it.
struct Errors<F> {
    of_roots: Vec<f64>,
    of_tiles: F,
}

fn errors_of<'e>(
    tiling: &'e Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    light: &'e BandLight,
) -> Errors<impl Fn(usize, f64) -> f64 + 'e> {
    let area = |tile: usize| tiling.tiles[tile].area;
    let (root_of, mut direct) = (tiling.roots(), vec![0.0; tiling.tiles.len()]);
    // What each tile receives by itself, for the parts of plates; and what comes of all on each whole one.
    let mut own = vec![0.0; tiling.tiles.len()];
    errors(tiling, links, clusters, light, |tile, error| {
        own[tile] += (error / area(tile)).powf(EXPONENT);
        direct[root_of[tile]] += (error / area(root_of[tile])).powf(EXPONENT);
    });
    let carried = |to: usize, from: usize, exchange: f64| {
        (exchange / area(to) * tiling.tiles[from].reflectance[light.band]).powf(EXPONENT)
    };
    let ways: Vec<([usize; 2], [f64; 2])> = exchanges(tiling, links, light)
        .into_iter()
        .map(|([one, other], [here, there])| {
            ([one, other], [carried(one, other, here), carried(other, one, there)])
        })
        .collect();
    let powers: Vec<[Vec<f64>; 2]> = clusters.all.par_iter().map(|link| link.powers(EXPONENT)).collect();
    let tiles = tiling.tiles.iter().zip(&root_of);
    let rates: Vec<f64> =
        tiles.clone().map(|(tile, _)| tile.reflectance[light.band].powf(EXPONENT)).collect();
    let per: Vec<f64> = tiles.map(|(_, &root)| area(root).powf(-EXPONENT)).collect();
    let far = |all: &[f64], next: &mut [f64]| {
        for (link, powers) in clusters.all.iter().zip(&powers) {
            for end in [0, 1] {
                let tiles = |end: usize| clusters.clusters.tiles(link.ends[end]).iter().zip(&powers[end]);
                let brings: f64 =
                    tiles(1 - end).map(|(&tile, power)| power * rates[tile] * all[root_of[tile]]).sum();
                tiles(end).for_each(|(&tile, power)| next[root_of[tile]] += brings * power * per[tile]);
            }
        }
    };
    let all = reflected(&direct, &ways, far);
    // Errors of larger tiles are there in all of their parts.
    for tile in 0..own.len() {
        own[tile] += tiling.tiles[tile].parent.map_or(0.0, |parent| own[parent]);
    }
    let of_roots: Vec<f64> = all.iter().map(|error| error.powf(1.0 / EXPONENT)).collect();
    let whole = of_roots.clone();
    let of_tiles = move |tile: usize, area_on: f64| {
        let root = root_of[tile];
        if !tiling.is_joined(tiling.tiles[tile].patch) {
            return whole[tile];
        }
        // What is reflected is as wrong as on the whole tile, in proportion to the light there.
        let bright = if light.unit[root] > 0.0 { light.unit[tile] / light.unit[root] } else { 1.0 };
        let reflected = (all[root] - direct[root]).max(0.0) * bright.powf(EXPONENT);
        // How light bends over what a patch covers makes no difference to its mean.
        let grain = tiling.grain[tiling.tiles[tile].patch].unwrap_or_default();
        let beside = |(above, larger): (usize, usize)| {
            let covers = if above == 0 { area_on } else { area_on.max(grain) };
            let bend = light.bend[larger] * residual(&tiling.tiles[larger], &tiling.tiles[tile]);
            (1.0 - covers / tiling.tiles[larger].area).max(0.0) * bend * bend
        };
        let larger = std::iter::successors(Some(tile), |tile| tiling.tiles[*tile].parent);
        let bend = larger.enumerate().map(beside).sum::<f64>().sqrt();
        (own[tile] + reflected).powf(1.0 / EXPONENT) + bend
    };
    Errors { of_roots, of_tiles }
}

/// How much farther than on average over a tile a parabola over it is from linear at a part of it: three times as far in its corners.
fn residual(tile: &Tile, part: &Tile) -> f64 {
    let [a, b] = tile.outline.linear(part.outline.centroid);
    ((a * a + b * b - 2.0 * SQUARE).abs() / PARABOLA).max(1.0)
}

/// What is there at once with what comes of it by reflection: pairs, and what each carries to the one and to the other.
fn reflected(direct: &[f64], ways: &[([usize; 2], [f64; 2])], far: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let mut all = direct.to_vec();
    for _ in 0..MOST {
        let mut next = direct.to_vec();
        for ([one, other], [here, there]) in ways {
            next[*one] += here * all[*other];
            next[*other] += there * all[*one];
        }
        far(&all, &mut next);
        let is_settled =
            all.iter().zip(&next).all(|(before, after)| (after - before).abs() <= SETTLED * after);
        all = next;
        if is_settled {
            break;
        }
    }
    all
}
