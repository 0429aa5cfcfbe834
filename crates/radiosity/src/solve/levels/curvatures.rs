//! How far what tiles receive is from linear.
use super::cluster_links::ClusterLinks;
use super::flow::{Linear, square};
use super::link::Link;
use super::tile::SQUARE;
use super::tiling::Tiling;

/// What part of the square of all curvatures of light from clusters is left where these are added up: they are of both signs.
const ALIKE: f64 = 0.1;
/// How far what each tile receives by itself is from linear.
///
/// Curvatures of one sign add up, as those of a lamp that is cut into many; others may be wrong independently. The larger counts.
pub(super) struct Curvatures {
    /// The squares of what may be wrong independently: of light that is linear where it is sent,
    squares: Vec<f64>,
    /// and what lights and clusters bring.
    others: Vec<f64>,
    /// The sums along both axes.
    sums: Vec<[f64; 2]>,
}

impl Curvatures {
    /// Those of all links when tiles send so much.
    pub(super) fn of(
        tiling: &Tiling<'_>,
        (links, clusters): (&[Link], &ClusterLinks),
        sent: &[Linear],
        direct: &[f64],
    ) -> Curvatures {
        let mut squares = vec![0.0; direct.len()];
        let mut sums = vec![[0.0; 2]; direct.len()];
        for link in links {
            for end in [0, 1] {
                let [here, there] = [link.ends[end], link.ends[1 - end]];
                let area = tiling.tiles[here].area;
                let bend = link.curvature(end) / area;
                squares[here] += SQUARE * bend * bend * square(sent[there]);
                for (sum, bend) in sums[here].iter_mut().zip(link.transfer.bend[end]) {
                    *sum += bend / area * sent[there][0];
                }
            }
        }
        let mut far = vec![0.0; direct.len()];
        for (link, end) in clusters.all.iter().flat_map(|link| [(link, 0), (link, 1)]) {
            if let Some((tile, power)) = link.curvature(end, sent) {
                far[tile] += power / tiling.tiles[tile].area;
            }
        }
        let of_tile = |(deviation, far): (&f64, f64)| deviation * deviation + ALIKE * far * far;
        Curvatures { squares, others: direct.iter().zip(far).map(of_tile).collect(), sums }
    }

    /// The same as irradiance, where what tiles send is off linear by `deviation`.
    pub(super) fn unresolved(&self, tiling: &Tiling<'_>, links: &[Link], deviation: &[f64]) -> Vec<f64> {
        let mut others = self.others.clone();
        for (link, end) in links.iter().flat_map(|link| [(link, 0), (link, 1)]) {
            let [here, there] = [link.ends[end], link.ends[1 - end]];
            let carried = link.locality * link.exchange[0] / tiling.tiles[here].area * deviation[there];
            others[here] += carried * carried;
        }
        let of_tile = |((square, sums), others): ((&f64, &[f64; 2]), f64)| {
            let [first, second] = sums.map(f64::abs);
            (square.max(SQUARE * (first + second) * (first + second)) + others).sqrt()
        };
        self.squares.iter().zip(&self.sums).zip(others).map(of_tile).collect()
    }
}
