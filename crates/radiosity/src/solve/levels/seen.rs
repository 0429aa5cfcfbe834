//! What the tiles of two clusters are seen of from each other.
use super::cluster_views::ClusterView;
use super::clusters::Clusters;
use super::tiling::Tiling;

/// What is seen of the tiles of two clusters.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    /// The tiles of each end that the other end sees something of, and what: hardly any in a town.
    pub(super) tiles: [Vec<(usize, f64)>; 2],
    /// The same of the linear functions of an end that is one tile.
    pub(super) slopes: [[f64; 2]; 2],
    /// What is seen of two tiles times this is what they exchange.
    pub(super) scale: f64,
}

impl Seen {
    /// By what is seen of each end from the centre of the other, and what the products of that are to be multiplied by. One tile and many exchange
    /// what points of the one see of each of the many: it is not the centre of these that the one faces, but each of them by itself.
    pub(super) fn of(
        tiling: &Tiling<'_>,
        clusters: &Clusters,
        ends: [usize; 2],
        views: [&ClusterView; 2],
        scale: f64,
    ) -> Seen {
        let of = |end: usize, seen: &[f64]| some(clusters.tiles(ends[end]), seen);
        let slopes = views.map(|view| view.slopes);
        let is_one = |end: usize| clusters.tiles(ends[end]).len() == 1;
        let Some(one) = [0, 1].into_iter().find(|&end| is_one(end) && !is_one(1 - end)) else {
            return Seen { tiles: [of(0, &views[0].seen), of(1, &views[1].seen)], slopes, scale };
        };
        let area = [tiling.tiles[clusters.tiles(ends[one])[0]].area];
        let seen = views[one].seen[0];
        let per = if seen > 0.0 { area[0] / seen } else { 0.0 };
        let tiles = [0, 1].map(|end| of(end, if end == one { &area } else { &views[end].factors[..] }));
        Seen { tiles, slopes: slopes.map(|slopes| slopes.map(|slope| slope * per)), scale: 1.0 }
    }
}

/// The tiles of which something is seen, with that.
fn some(tiles: &[usize], seen: &[f64]) -> Vec<(usize, f64)> {
    tiles.iter().copied().zip(seen.iter().copied()).filter(|(_, seen)| *seen > 0.0).collect()
}
