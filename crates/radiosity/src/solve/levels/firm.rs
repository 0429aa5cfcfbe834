//! Which links closing a room leaves as they are.
use super::cluster_links::ClusterLinks;
use super::link::Link;
use super::tiling::Tiling;

/// Where there are links of clusters, those that are known within such a share are not scaled: what is missing is missing from others.
const KNOWN: f64 = 0.3;

/// Which links carry what was measured, and nothing else: none where all are of two tiles, since what is missing then is what points of these miss.
/// Nor is what a tile that is covered in part carries known to be the same for its parts.
#[derive(Debug)]
pub(super) struct Firm {
    /// Of the links of two tiles, of those of two clusters, and whether any may be.
    pub(super) of_tiles: Vec<bool>,
    pub(super) of_clusters: Vec<bool>,
    pub(super) is_any: bool,
}

impl Firm {
    pub(super) fn of(
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &ClusterLinks,
        known: &[Option<f64>],
    ) -> Firm {
        if clusters.all.is_empty() || !known.contains(&Some(1.0)) {
            let [of_tiles, of_clusters] = [links.len(), clusters.all.len()].map(|count| vec![false; count]);
            return Firm { of_tiles, of_clusters, is_any: false };
        }
        let root_of = tiling.roots();
        let is_whole = |end: &usize| !tiling.tiles[root_of[*end]].is_crossed;
        let is_known = |link: &Link| link.error() <= KNOWN * link.exchange[0];
        let is_firm = |link: &Link| is_known(link) && link.ends.iter().all(is_whole);
        Firm {
            of_tiles: links.iter().map(is_firm).collect(),
            of_clusters: clusters.all.iter().map(|link| link.is_within(KNOWN)).collect(),
            is_any: true,
        }
    }
}
