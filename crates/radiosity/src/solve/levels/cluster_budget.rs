//! Which links of clusters to refine: as those of tiles, by what they may be wrong by at every patch.
use super::budget::{BandLight, PatchErrors};
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::clusters::Clusters;
use super::hidden::{HiddenLight, by_ways};
use super::tiling::Tiling;
use super::ways::{Ways, dot, ways};

/// The errors of the links of clusters, with the patches that have them.
pub(super) fn cluster_errors(
    tiling: &Tiling<'_>,
    links: &ClusterLinks,
    bands: &[BandLight],
) -> Vec<(usize, PatchErrors)> {
    let seen = links.all.iter().flat_map(|link| seen_errors(tiling, link, bands));
    let seen = seen.filter(|(_, error)| *error > 0.0).map(|(patch, error)| (patch, (error, 1)));
    seen.chain(hidden_errors(tiling, links, bands)).collect()
}

/// Those of what is hidden: the means over the links of each cluster.
fn hidden_errors(
    tiling: &Tiling<'_>,
    links: &ClusterLinks,
    bands: &[BandLight],
) -> Vec<(usize, PatchErrors)> {
    let mut found = Vec::new();
    let sums = |light: &BandLight| HiddenLight::new(tiling, &links.clusters, &light.sent).sums(links, 1.0);
    let sums: Vec<Vec<(Ways, usize)>> = bands.iter().map(sums).collect();
    for cluster in 0..links.clusters.all.len() {
        let Some(count) = sums.first().map(|sums| sums[cluster].1).filter(|count| *count > 0) else {
            continue;
        };
        for &tile in links.clusters.tiles(cluster) {
            let facing = ways(tiling.tiles[tile].normal);
            let share = |(light, sums): (&BandLight, &Vec<(Ways, usize)>)| {
                rate(tiling, light, tile) * dot(&facing, &sums[cluster].0)
            };
            let worst = bands.iter().zip(&sums).map(share).fold(0.0, f64::max);
            if worst > 0.0 {
                found.push((tiling.tiles[tile].patch, (worst / count as f64, count)));
            }
        }
    }
    found
}

/// What links of clusters may be wrong by.
pub(super) struct ClusterLimits<'c> {
    tiling: &'c Tiling<'c>,
    bands: &'c [BandLight],
    limits: &'c [f64],
    /// What is hidden in each band, and by the ways that tiles face the largest number that their errors times it are beyond their limits at 1.
    hidden: Vec<(HiddenLight<'c>, Vec<Ways>)>,
}

impl<'c> ClusterLimits<'c> {
    pub(super) fn new(
        tiling: &'c Tiling<'c>,
        clusters: &'c Clusters,
        bands: &'c [BandLight],
        limits: &'c [f64],
    ) -> ClusterLimits<'c> {
        let of = |light: &'c BandLight| {
            let beyond = |tile: usize| rate(tiling, light, tile) / limits[tiling.tiles[tile].patch];
            (HiddenLight::new(tiling, clusters, &light.sent), by_ways(tiling, clusters, beyond, f64::max))
        };
        ClusterLimits { tiling, bands, limits, hidden: bands.iter().map(of).collect() }
    }

    /// Whether an error of a link is beyond the limit of its patch.
    pub(super) fn is_beyond(&self, link: &ClusterLink) -> bool {
        let is_beyond = |(light, beyond): &(HiddenLight<'_>, Vec<Ways>)| {
            (0..2).any(|end| dot(&light.errors(link, end), &beyond[link.ends[end]]) > 1.0)
        };
        (link.hidden() > 0.0 && self.hidden.iter().any(is_beyond))
            || seen_errors(self.tiling, link, self.bands)
                .into_iter()
                .any(|(patch, error)| error > self.limits[patch])
    }
}

/// What an error of the irradiance of a tile comes to at its patch, as a share of the light of that.
fn rate(tiling: &Tiling<'_>, light: &BandLight, tile: usize) -> f64 {
    if light.unit[tile] > 0.0 { tiling.tiles[tile].area * light.strain[tile] / light.unit[tile] } else { 0.0 }
}

/// The patch of each tile that sees something across a link, and the error of what it receives in the worst band.
fn seen_errors(tiling: &Tiling<'_>, link: &ClusterLink, bands: &[BandLight]) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> = Vec::new();
    for end in [0, 1] {
        let start = all.len();
        all.extend(link.seen(end).iter().map(|(tile, _)| (tiling.tiles[*tile].patch, 0.0)));
        for light in bands {
            let curvature = link.curvature(end, &light.sent).map_or(0.0, |(_, power)| power);
            let errors = link.errors(end, (&light.sent, &light.deviation));
            for ((tile, error), (_, worst)) in errors.zip(&mut all[start..]) {
                let error = error + light.within(tiling, tile) * curvature;
                *worst = worst.max(error * rate(tiling, light, tile) / tiling.tiles[tile].area);
            }
        }
    }
    all
}
