//! What every tile may be wrong by, before any of it is reflected.
use super::budget::BandLight;
use super::cluster_links::ClusterLinks;
use super::hidden::HiddenLight;
use super::link::Link;
use super::tiling::Tiling;
use super::ways::{Ways, dot, ways};

/// Errors add up as this power of them does: between those of one sign, of which it is the first, and independent ones, of which it is the
/// second. So are those of the rooms of seven kinds of which the benchmarks tell.
pub(super) const EXPONENT: f64 = 1.2;

/// What the irradiance of every tile may be off by in a band of what it receives by itself, raised to the exponent.
#[derive(Debug)]
pub(super) struct OwnErrors {
    /// Of each tile, what its parts are wrong by not counted; that of larger tiles is there in all of their parts.
    pub(super) of_tiles: Vec<f64>,
    /// Of each whole tile, with its parts.
    pub(super) of_roots: Vec<f64>,
    /// The same, but for what totals are wrong by: no cut betters that.
    pub(super) of_links: Vec<f64>,
}

/// `root_of` is the whole tile that each tile is a part of.
pub(super) fn own_errors(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    light: &BandLight,
    root_of: &[usize],
) -> OwnErrors {
    let area = |tile: usize| tiling.tiles[tile].area;
    let none = || vec![0.0; tiling.tiles.len()];
    let mut own = OwnErrors { of_tiles: none(), of_roots: none(), of_links: none() };
    each(tiling, links, clusters, light, |tile, of_link, of_total| {
        let error = of_link + of_total;
        let root = root_of[tile];
        let of_root = (error / area(root)).powf(EXPONENT);
        own.of_tiles[tile] += (error / area(tile)).powf(EXPONENT);
        own.of_roots[root] += of_root;
        own.of_links[root] += if error > 0.0 { of_root * of_link / error } else { 0.0 };
    });
    for (tile, error) in hidden(tiling, clusters, light) {
        let root = root_of[tile];
        let of_root = error * (area(tile) / area(root)).powf(EXPONENT);
        own.of_tiles[tile] += error;
        own.of_roots[root] += of_root;
        own.of_links[root] += of_root;
    }
    for tile in 0..own.of_tiles.len() {
        own.of_tiles[tile] += tiling.tiles[tile].parent.map_or(0.0, |parent| own.of_tiles[parent]);
    }
    own
}

/// The errors of the irradiance of tiles by what is hidden between clusters, raised to the exponent.
fn hidden(tiling: &Tiling<'_>, links: &ClusterLinks, light: &BandLight) -> Vec<(usize, f64)> {
    let clusters = &links.clusters;
    let sums = HiddenLight::new(tiling, clusters, &light.sent).sums(links, EXPONENT);
    let of_cluster = |(cluster, (sums, _)): (usize, &(Ways, usize))| {
        let of_tile = |tile: &usize| {
            let facing = ways(tiling.tiles[*tile].normal).map(|part| part.powf(EXPONENT));
            (*tile, dot(&facing, sums))
        };
        clusters.tiles(cluster).iter().map(of_tile).collect::<Vec<_>>()
    };
    sums.iter().enumerate().filter(|(_, (_, count))| *count > 0).flat_map(of_cluster).collect()
}

/// The errors of all that every tile receives, as powers: each with its tile, and apart from it what of a total is wrong.
fn each(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    light: &BandLight,
    mut to: impl FnMut(usize, f64, f64),
) {
    for link in &clusters.all {
        for end in [0, 1] {
            link.errors(end, (&light.sent, &light.deviation)).for_each(|(tile, error)| to(tile, error, 0.0));
        }
    }
    for link in links {
        for end in [0, 1] {
            let flaw = light.flaw(tiling, link, end);
            to(link.ends[end], flaw.of_mean + flaw.of_sender, flaw.of_total);
        }
    }
    tiling.leaves().for_each(|leaf| to(leaf, light.direct_power(tiling, leaf), 0.0));
}
