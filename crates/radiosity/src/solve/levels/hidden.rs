//! What may be wrong where something stands between two clusters: a share of what could pass were nothing there, at all that faces the other.
//!
//! ```text
//!      ^
//!  < tile >   a tile faces six ways, each by its area times the cosine; of every cluster the sums are known, so that
//!      v      a link tells at once what is wrong at all of its tiles, most of which are hidden in a town
//! ```
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::clusters::{Cluster, Clusters};
use super::flow::Linear;
use super::tiling::Tiling;
use super::ways::{Ways, dot, ways};

/// What clusters send in a band, by the ways that they face.
pub(super) struct HiddenLight<'h> {
    clusters: &'h Clusters,
    sent: Vec<Ways>,
}

impl<'h> HiddenLight<'h> {
    pub(super) fn new(tiling: &Tiling<'_>, clusters: &'h Clusters, sent: &[Linear]) -> HiddenLight<'h> {
        let of_tile = |tile: usize| tiling.tiles[tile].area * sent[tile][0].abs();
        HiddenLight { clusters, sent: by_ways(tiling, clusters, of_tile, |a, b| a + b) }
    }

    /// What may be wrong with the irradiance of the tiles of an end, by the ways that they face.
    pub(super) fn errors(&self, link: &ClusterLink, end: usize) -> Ways {
        let [here, there] = [end, 1 - end].map(|end| &self.clusters.all[link.ends[end]]);
        let way = (there.centre - here.centre).normalize_or_zero();
        let areas = dot(&ways(way), &here.faces) * dot(&ways(-way), &there.faces);
        let brings = link.hidden() * dot(&ways(-way), &self.sent[link.ends[1 - end]]);
        ways(way).map(|part| if areas > 0.0 { part * brings / areas } else { 0.0 })
    }

    /// For every cluster the sums of some power of these errors over all of its links, and how many those are.
    pub(super) fn sums(&self, links: &ClusterLinks, power: f64) -> Vec<(Ways, usize)> {
        let mut all = vec![([0.0; 6], 0); self.sent.len()];
        for (link, end) in links.hidden() {
            let (sums, count) = &mut all[link.ends[end]];
            let errors = self.errors(link, end).map(|error| error.powf(power));
            sums.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error);
            *count += 1;
        }
        all
    }
}

/// For every cluster the sum, or the largest, of a value of its tiles by the ways that these face.
pub(super) fn by_ways(
    tiling: &Tiling<'_>,
    clusters: &Clusters,
    value: impl Fn(usize) -> f64,
    join: fn(f64, f64) -> f64,
) -> Vec<Ways> {
    let mut all = vec![[0.0; 6]; clusters.all.len()];
    // Halves come after what they are halves of.
    for (index, Cluster { halves, .. }) in clusters.all.iter().enumerate().rev() {
        all[index] = match (clusters.tiles(index), halves) {
            ([tile], _) => ways(tiling.tiles[*tile].normal).map(|part| part * value(*tile)),
            (_, Some([one, other])) => std::array::from_fn(|way| join(all[*one][way], all[*other][way])),
            _ => [0.0; 6],
        };
    }
    all
}
