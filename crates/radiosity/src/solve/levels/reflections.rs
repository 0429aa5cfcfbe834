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

/// Reflections that are followed.
const MOST: usize = 60;
/// No more of them when none changes anything by more than this share.
const SETTLED: f64 = 1e-4;

/// What of an error at one whole tile comes to another, as the light of the band is.
#[derive(Debug)]
pub(super) struct Reflections<'r> {
    clusters: &'r ClusterLinks,
    root_of: Vec<usize>,
    /// Pairs, and what each carries to the one and to the other.
    pairs: Vec<([usize; 2], [f64; 2])>,
    /// See [`ClusterLink::powers`](super::cluster_links::ClusterLink::powers).
    powers: Vec<[Vec<f64>; 2]>,
    /// For each tile what it reflects, and what power is on the area of its whole.
    rates: Vec<f64>,
    per: Vec<f64>,
}

impl<'r> Reflections<'r> {
    pub(super) fn new(
        tiling: &Tiling<'_>,
        links: &[Link],
        clusters: &'r ClusterLinks,
        light: &BandLight,
    ) -> Reflections<'r> {
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
        let powers = clusters.all.par_iter().map(|link| link.powers(EXPONENT)).collect();
        Reflections { clusters, root_of, pairs, powers, rates, per }
    }

    /// What is there at once with what comes of it by reflection.
    pub(super) fn all(&self, direct: &[f64]) -> Vec<f64> {
        settled(direct, |all, next| {
            for ([one, other], [here, there]) in &self.pairs {
                next[*one] += here * all[*other];
                next[*other] += there * all[*one];
            }
            self.far(all, next, &self.rates, &self.per);
        })
    }

    /// How much what is there at once, at each whole tile, matters to some of them: the sum of [`Reflections::all`] by such weights is that of what is
    /// there at once by these.
    pub(super) fn importance(&self, weights: &[f64]) -> Vec<f64> {
        settled(weights, |all, next| {
            for ([one, other], [here, there]) in &self.pairs {
                next[*other] += here * all[*one];
                next[*one] += there * all[*other];
            }
            self.far(all, next, &self.per, &self.rates);
        })
    }

    /// Adds what the links of clusters carry, with factors of the tiles that it comes from and of those that it goes to.
    fn far(&self, all: &[f64], next: &mut [f64], from: &[f64], to: &[f64]) {
        for (link, powers) in self.clusters.all.iter().zip(&self.powers) {
            for end in [0, 1] {
                let tiles =
                    |end: usize| self.clusters.clusters.tiles(link.ends[end]).iter().zip(&powers[end]);
                let brings: f64 =
                    tiles(1 - end).map(|(&tile, power)| power * from[tile] * all[self.root_of[tile]]).sum();
                tiles(end).for_each(|(&tile, power)| next[self.root_of[tile]] += brings * power * to[tile]);
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

/// What some values come to when what follows of them is added again and again.
fn settled(first: &[f64], follow: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let mut all = first.to_vec();
    for _ in 0..MOST {
        let mut next = first.to_vec();
        follow(&all, &mut next);
        let is_settled =
            all.iter().zip(&next).all(|(before, after)| (after - before).abs() <= SETTLED * after);
        all = next;
        if is_settled {
            break;
        }
    }
    all
}
