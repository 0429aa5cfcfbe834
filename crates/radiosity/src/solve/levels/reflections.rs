//! How errors of the light of whole tiles are reflected, in a band.
//!
//! ```text
//!           F              F
//!  δ at t ----> ρ at s ----> p       what p is wrong by: δ + F ρ δ + F ρ F ρ δ + …, each term raised to the exponent;
//!  how much δ matters to p <----     the same backwards tells for one p what comes of all t at once
//! ```
use super::budget::BandLight;
use super::cluster_links::ClusterLinks;
use super::errors::EXPONENT;
use super::link::Link;
use super::tiling::Tiling;
use rayon::prelude::*;
use std::sync::Arc;

/// Reflections that are followed.
const MOST: usize = 60;
/// No more of them when none changes anything by more than this share.
const SETTLED: f64 = 1e-4;

/// See [`ClusterLink::powers`](super::cluster_links::ClusterLink::powers): the same in all bands.
pub(super) type Powers = Arc<[[Vec<(usize, f64)>; 2]]>;

/// What of the errors of tiles links of clusters carry.
pub(super) fn powers(clusters: &ClusterLinks) -> Powers {
    clusters.all.par_iter().map(|link| link.powers(EXPONENT)).collect::<Vec<_>>().into()
}

/// What of an error at one whole tile comes to another, as the light of the band is.
#[derive(Debug)]
pub(super) struct Reflections {
    /// The whole tile that each tile is a part of.
    pub(super) root_of: Vec<usize>,
    /// Pairs, and what each carries to the one and to the other.
    pairs: Vec<([usize; 2], [f64; 2])>,
    powers: Powers,
    /// For each tile what it reflects, and what power is on the area of its whole.
    rates: Vec<f64>,
    per: Vec<f64>,
}

impl Reflections {
    pub(super) fn new(tiling: &Tiling<'_>, links: &[Link], powers: Powers, light: &BandLight) -> Reflections {
        let root_of = tiling.roots();
        let rates: Vec<f64> =
            tiling.tiles.iter().map(|tile| tile.reflectance[light.band].powf(EXPONENT)).collect();
        let per: Vec<f64> = root_of.iter().map(|&root| tiling.tiles[root].area.powf(-EXPONENT)).collect();
        let carried = |to: usize, from: usize, exchange: f64| exchange.powf(EXPONENT) * per[to] * rates[from];
        let pairs = exchanges(&root_of, links, light)
            .into_iter()
            .map(|([one, other], [here, there])| {
                ([one, other], [carried(one, other, here), carried(other, one, there)])
            })
            .collect();
        Reflections { root_of, pairs, powers, rates, per }
    }

    /// What is there at once with what comes of it by reflection.
    pub(super) fn all(&self, direct: &[f64]) -> Vec<f64> {
        self.settled(direct, |ways| ways, [&self.rates, &self.per])
    }

    /// How much what is there at once, at each whole tile, matters to some of them: the sum of [`Reflections::all`] by such weights is that of what is
    /// there at once by these.
    pub(super) fn importance(&self, weights: &[f64]) -> Vec<f64> {
        self.settled(weights, |[here, there]| [there, here], [&self.per, &self.rates])
    }

    /// What some values come to when what follows of them is added again and again: by pairs, and by links of clusters with factors of the
    /// tiles that it comes from and of those that it goes to.
    fn settled(&self, first: &[f64], turned: fn([f64; 2]) -> [f64; 2], factors: [&[f64]; 2]) -> Vec<f64> {
        let mut all = first.to_vec();
        for _ in 0..MOST {
            let mut next = first.to_vec();
            for &([one, other], ways) in &self.pairs {
                let [here, there] = turned(ways);
                next[one] += here * all[other];
                next[other] += there * all[one];
            }
            self.far(&all, &mut next, factors);
            let is_settled =
                all.iter().zip(&next).all(|(before, after)| (after - before).abs() <= SETTLED * after);
            all = next;
            if is_settled {
                break;
            }
        }
        all
    }

    /// Adds what the links of clusters carry.
    fn far(&self, all: &[f64], next: &mut [f64], [from, to]: [&[f64]; 2]) {
        for [one, other] in self.powers.iter() {
            for (here, there) in [(one, other), (other, one)] {
                let sent = |&(tile, power): &(usize, f64)| power * from[tile] * all[self.root_of[tile]];
                let brings: f64 = there.iter().map(sent).sum();
                here.iter().for_each(|&(tile, power)| next[self.root_of[tile]] += brings * power * to[tile]);
            }
        }
    }
}

/// The pairs of whole tiles that are linked, and what the one receives of the other where that shines as bright as it does on average, and the
/// other of the one.
fn exchanges(root_of: &[usize], links: &[Link], light: &BandLight) -> Vec<([usize; 2], [f64; 2])> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use crate::solve::levels::cluster_links::ClusterLink;
    use crate::solve::levels::clusters::Clusters;
    use formfactor::PlanarPolygon;
    use glam::DVec3;

    /// Four squares, two and two before each other.
    fn squares() -> Scene {
        let square = |corner: DVec3, way: f64, reflectance: f64| {
            let [x, y, _] = DVec3::AXES;
            let corners = [corner, corner + x, corner + x + way * y, corner + way * y];
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![reflectance], vec![1.0])
        };
        let [x, y, z] = DVec3::AXES;
        let patches = [
            square(DVec3::ZERO, 1.0, 0.2),
            square(3.0 * x, 1.0, 0.5),
            square(y + 8.0 * z, -1.0, 0.7),
            square(3.0 * x + y + 9.0 * z, -1.0, 0.9),
        ];
        Scene { patches: patches.into(), bands: 1, ..Scene::default() }
    }

    /// ⟨w, (1 − K)⁻¹ δ⟩ = ⟨(1 − Kᵀ)⁻¹ w, δ⟩, of pairs and of links of clusters.
    #[test]
    fn what_errors_come_to_is_the_same_forwards_and_backwards() {
        let scene = squares();
        let tiling = Tiling::new(&scene).unwrap();
        let mut clusters = Clusters::of(&tiling);
        let pairs = clusters.pairs(&mut |_| Ok(None)).unwrap();
        let links: Vec<ClusterLink> =
            pairs.far.iter().filter_map(|pair| ClusterLink::measure(&tiling, &clusters, *pair)).collect();
        assert!(!links.is_empty());
        let clusters = ClusterLinks { clusters, all: links };
        let reflections = Reflections {
            root_of: tiling.roots(),
            pairs: vec![([0, 2], [0.3, 0.1]), ([1, 3], [0.05, 0.4]), ([0, 3], [0.2, 0.0])],
            powers: powers(&clusters),
            rates: vec![0.2, 0.5, 0.7, 0.9],
            per: vec![1.0, 2.0, 0.5, 1.5],
        };
        let (direct, weights) = ([1.0, 0.0, 0.3, 0.2], [0.1, 0.7, 0.0, 1.0]);
        let sum = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        let [forwards, backwards] =
            [sum(&reflections.all(&direct), &weights), sum(&direct, &reflections.importance(&weights))];
        assert!(forwards > sum(&direct, &weights), "something is reflected");
        assert!((forwards - backwards).abs() < 1e-3 * forwards, "{forwards} {backwards}");
    }
}
