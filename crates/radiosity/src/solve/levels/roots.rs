//! What ΣF of every leaf is to be.
//!
//! ```text
//! +-----+-----+-----+
//! |  1  |  1  |  ?  |    on the last one stands something that covers a part of it: the area factors of the whole tell
//! +-----+-----+--##-+    what is left for it
//! ```
use super::cluster_links::{self, ClusterLinks};
use super::link::Link;
use super::tiling::Tiling;

/// Leaves that are not known to be uncovered are scaled by no more than that in a round.
const MOST: f64 = 2.0;

/// What is known of ΣF of the leaves of each whole tile.
#[derive(Debug)]
pub(super) struct Roots {
    /// The whole tile of each leaf, and its area.
    leaves: Vec<(usize, f64)>,
    /// ΣF where it is known.
    known: Vec<Option<f64>>,
    /// For each whole tile: what all that is seen of others adds up to, by its links.
    wholes: Vec<f64>,
}

impl Roots {
    pub(super) fn new(
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &ClusterLinks,
        leaves: &[usize],
        known: &[Option<f64>],
    ) -> Roots {
        let root_of = tiling.roots();
        let even = vec![[1.0, 0.0, 0.0]; tiling.tiles.len()];
        let mut of_clusters = vec![[0.0; 3]; tiling.tiles.len()];
        cluster_links::gather(tiling, clusters.all.iter(), &even, &mut of_clusters);
        let mut wholes = vec![0.0; tiling.tiles.len()];
        let sums = tiling.tiles.iter().zip(of_clusters).zip(&root_of);
        sums.for_each(|((tile, sum), &root)| wholes[root] += tile.area * sum[0]);
        for link in links {
            link.ends.iter().for_each(|&end| wholes[root_of[end]] += link.exchange[0]);
        }
        Roots {
            leaves: leaves.iter().map(|&leaf| (root_of[leaf], tiling.tiles[leaf].area)).collect(),
            known: leaves.iter().map(|&leaf| known[leaf]).collect(),
            wholes,
        }
    }

    /// What ΣF is to be: where it is known, that, and what then is left of the whole for its other leaves, some of which are covered.
    pub(super) fn rights(&self, sums: &[f64]) -> Vec<f64> {
        let mut rest = self.wholes.clone();
        let (mut free, mut is_closed) = (vec![0.0; rest.len()], vec![false; rest.len()]);
        for (leaf, &(root, area)) in self.leaves.iter().enumerate() {
            match self.known[leaf] {
                Some(right) => {
                    rest[root] -= area * right;
                    is_closed[root] |= right > 0.0;
                }
                None => free[root] += area * sums[leaf],
            }
        }
        let right = |leaf: usize| {
            let root = self.leaves[leaf].0;
            let share = if is_closed[root] && free[root] > 0.0 { rest[root] / free[root] } else { 1.0 };
            let left = (sums[leaf] * share.clamp(1.0 / MOST, MOST)).min(1.0);
            self.known[leaf].unwrap_or(left)
        };
        (0..sums.len()).map(right).collect()
    }
}
