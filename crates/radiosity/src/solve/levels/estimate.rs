//! What the irradiance of every patch may be off by.
use super::budget::{BandLight, errors};
use super::cluster_links::ClusterLinks;
use super::link::Link;
use super::tiling::Tiling;

/// Errors add up as this power of them does: between those of one sign, of which it is the first, and independent ones, of which it is the
/// second. So are those of the rooms of seven kinds of which the benchmarks tell.
const EXPONENT: f64 = 1.2;
/// Reflections that are followed.
const MOST: usize = 60;

/// The mean error of the irradiance of every patch; patches × `bands`.
pub(super) fn estimate(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
    bands: usize,
) -> Vec<f64> {
    let mut found = vec![0.0; tiling.scene.patches.len() * bands];
    for light in lights {
        let unit = tiling.units()[light.band];
        for (patch, power) in powers(tiling, links, clusters, light).into_iter().enumerate() {
            found[patch * bands + light.band] = unit * power / tiling.scene.patches[patch].polygon.area();
        }
    }
    found
}

/// The largest error of each patch's irradiance in a band, as a share of its mean or, where that is darker, of 1 % of the scene's.
pub(super) fn shares(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
) -> Vec<f64> {
    let mut worst = vec![0.0f64; tiling.scene.patches.len()];
    for light in lights {
        let powers = powers(tiling, links, clusters, light);
        for ((worst, power), unit) in worst.iter_mut().zip(powers).zip(&light.unit) {
            *worst = worst.max(if *unit > 0.0 { power / unit } else { 0.0 });
        }
    }
    worst
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

/// What the light that every patch receives may be off by in a band, by reflection as well.
///
/// An error δ of the irradiance of a tile is light of its own, of which others receive ρ F: ε = δ + F ρ ε, each term raised to the exponent. It
/// is spread over the tile as its light is: who sees a dark part alone receives nothing of it.
fn powers(tiling: &Tiling<'_>, links: &[Link], clusters: &ClusterLinks, light: &BandLight) -> Vec<f64> {
    let area = |tile: usize| tiling.tiles[tile].area;
    let direct: Vec<f64> = errors(tiling, links, clusters, light, EXPONENT)
        .into_iter()
        .enumerate()
        .map(|(tile, sum)| sum / area(tile).powf(EXPONENT))
        .collect();
    let carried = |to: usize, from: usize, exchange: f64| {
        (exchange / area(to) * tiling.tiles[from].reflectance[light.band]).powf(EXPONENT)
    };
    let ways: Vec<([usize; 2], [f64; 2])> = exchanges(tiling, links, light)
        .into_iter()
        .map(|([one, other], [here, there])| {
            ([one, other], [carried(one, other, here), carried(other, one, there)])
        })
        .collect();
    let mut sums = vec![0.0; tiling.scene.patches.len()];
    let far = |all: &[f64], next: &mut [f64]| {
        for (link, end) in clusters.all.iter().flat_map(|link| [(link, 0), (link, 1)]) {
            let sent = |tile: usize| all[tile] * tiling.tiles[tile].reflectance[light.band].powf(EXPONENT);
            link.carry_powers(&clusters.clusters, end, EXPONENT, sent, |tile, error| {
                next[tile] += error / area(tile).powf(EXPONENT);
            });
        }
    };
    let all = reflected(&direct, &ways, far);
    for (tile, error) in tiling.tiles.iter().zip(all).filter(|(tile, _)| tile.parent.is_none()) {
        sums[tile.patch] += tile.area * error.powf(1.0 / EXPONENT);
    }
    sums
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
        all = next;
    }
    all
}
