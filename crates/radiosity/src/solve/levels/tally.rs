//! How light was taken between tiles.
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::link::Link;
use super::links::Links;
use super::tiling::Tiling;
use crate::solve::solution::Transfers;
use std::collections::BTreeSet;

/// Counts links, and pairs of whole tiles.
pub(super) fn tally(tiling: &Tiling<'_>, links: &Links) -> Transfers {
    let roots = tiling.tiles.iter().filter(|tile| tile.parent.is_none()).count();
    let clusters = by_clusters(tiling, &links.clusters);
    let root_of = tiling.roots();
    let whole = |link: &Link| {
        let [one, other] = link.ends.map(|end| root_of[end]);
        [one.min(other), one.max(other)]
    };
    let linked: BTreeSet<[usize; 2]> = links.all.iter().map(whole).collect();
    let known = links.all.iter().filter(|link| link.of_total.is_some()).map(|link| link.pair);
    let open = links.all.iter().filter(|link| link.among.is_empty()).count();
    Transfers {
        none: (roots * roots.saturating_sub(1) / 2).saturating_sub(linked.len() + clusters),
        clusters,
        open,
        occluded: links.all.len() - open,
        totals: known.collect::<BTreeSet<usize>>().len(),
    }
}

/// The pairs of whole tiles of which each is seen from the other's cluster; parts count by their areas.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "fewer pairs than a double counts"
)]
fn by_clusters(tiling: &Tiling<'_>, links: &ClusterLinks) -> usize {
    let root_of = tiling.roots();
    let share = |tile: usize| tiling.tiles[tile].area / tiling.tiles[root_of[tile]].area;
    let count =
        |link: &ClusterLink, end: usize| -> f64 { link.seen(end).iter().map(|(tile, _)| share(*tile)).sum() };
    links.all.iter().map(|link| count(link, 0) * count(link, 1)).sum::<f64>().round() as usize
}
