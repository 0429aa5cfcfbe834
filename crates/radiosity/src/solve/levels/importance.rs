//! How much more wrong the light of patches may be that a camera does not see.
//!
//! ```text
//! t ---- w ----> s ----> in view     t is a share w of what s receives, by what t reflects;
//!                                    t may be c / √w times as wrong as s, where that is more,
//!                                    c = SHARE / Σ√w over all t out of view
//! ```
//!
//! What comes of that at s adds up to no more than a share of what s may be wrong by itself, and work is saved where least comes through (after
//! Smits, Arvo and Salesin 1992, who refine links by importance).
use super::budget::BandLight;
use super::cluster_links::{ClusterLink, ClusterLinks};
use super::link::Link;
use super::tiling::Tiling;
use std::collections::BTreeMap;

/// This share of what a patch may be wrong by may come of what others are more wrong by.
const SHARE: f64 = 0.5;
/// No patch may be wrong by more than so many times the error.
const MOST: f64 = 16.0;
/// Reflections that are followed.
const REFLECTIONS: usize = 60;

/// What is known of the light of a band.
struct Exchanges<'e> {
    tiling: &'e Tiling<'e>,
    clusters: &'e ClusterLinks,
    light: &'e BandLight,
    /// Two patches, and which shares of what the one and the other receive they are to each other.
    pairs: Vec<([usize; 2], [f64; 2])>,
}

/// How many times the error that is asked for each patch may be wrong by: 1 in view, more elsewhere.
pub(super) fn eases(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
    in_view: &[bool],
) -> Vec<f64> {
    let mut eases: Vec<f64> = in_view.iter().map(|&is_seen| if is_seen { 1.0 } else { MOST }).collect();
    for light in lights {
        let exchanges = Exchanges { tiling, clusters, light, pairs: pairs(tiling, links, light) };
        let spare = exchanges.spare(in_view);
        for _ in 0..REFLECTIONS {
            let before = eases.clone();
            exchanges.limit(&spare, &before, &mut eases);
            if eases == before {
                break;
            }
        }
    }
    eases
}

fn pairs(tiling: &Tiling<'_>, links: &[Link], light: &BandLight) -> Vec<([usize; 2], [f64; 2])> {
    let mut found: BTreeMap<[usize; 2], [f64; 2]> = BTreeMap::new();
    for link in links {
        let [one, other] = link.ends;
        let mut ends = [(one, other), (other, one)].map(|(here, there)| {
            let patch = tiling.tiles[here].patch;
            (patch, share(link.exchange[0] * light.reflected[there], light.unit[here]))
        });
        ends.sort_by_key(|(patch, _)| *patch);
        let sums = found.entry(ends.map(|(patch, _)| patch)).or_default();
        sums.iter_mut().zip(ends).for_each(|(sum, (_, share))| *sum += share);
    }
    found.into_iter().collect()
}

fn share(power: f64, unit: f64) -> f64 {
    if unit > 0.0 { power / unit } else { 0.0 }
}

impl Exchanges<'_> {
    /// c of each patch.
    fn spare(&self, in_view: &[bool]) -> Vec<f64> {
        let mut sums = vec![0.0; in_view.len()];
        for ([one, other], [here, there]) in &self.pairs {
            sums[*one] += if in_view[*other] { 0.0 } else { here.sqrt() };
            sums[*other] += if in_view[*one] { 0.0 } else { there.sqrt() };
        }
        for (link, end) in self.far() {
            let out_of_view = self.sent(link, end).filter(|(patch, _)| !in_view[*patch]);
            let sum: f64 = out_of_view.map(|(_, sent)| sent.sqrt()).sum();
            self.received(link, end).for_each(|(patch, share)| sums[patch] += sum * share.sqrt());
        }
        sums.into_iter().map(|sum| SHARE / sum).collect()
    }

    /// Limits all patches by what they reflect to others.
    fn limit(&self, spare: &[f64], before: &[f64], eases: &mut [f64]) {
        let mut limit = |patch: usize, ease: f64| eases[patch] = eases[patch].min(ease);
        let eased = |to: usize, share: f64| before[to] * (spare[to] / share.sqrt()).max(1.0);
        for &([one, other], [here, there]) in &self.pairs {
            limit(other, eased(one, here));
            limit(one, eased(other, there));
        }
        for (link, end) in self.far() {
            let least = |value: &dyn Fn(usize, f64) -> f64| {
                let shares = self.received(link, end).filter(|(_, share)| *share > 0.0);
                shares.map(|(patch, share)| value(patch, share)).fold(f64::INFINITY, f64::min)
            };
            let all = least(&|patch, _| before[patch]);
            let each = least(&|patch, share| before[patch] * spare[patch] / share.sqrt());
            self.sent(link, end).for_each(|(patch, sent)| limit(patch, all.max(each / sent.sqrt())));
        }
    }

    /// Both ways of all links of clusters: the end that receives.
    fn far(&self) -> impl Iterator<Item = (&ClusterLink, usize)> {
        self.clusters.all.iter().flat_map(|link| [(link, 0), (link, 1)])
    }

    /// What the patches at the other end send, and what share of it each of this one receives, of its light: multiplied they are shares.
    fn sent<'l>(&'l self, link: &'l ClusterLink, end: usize) -> impl Iterator<Item = (usize, f64)> {
        let scale = link.scale();
        let sent = move |(tile, seen): &(usize, f64)| {
            (self.tiling.tiles[*tile].patch, scale * seen * self.light.reflected[*tile])
        };
        link.seen(1 - end).iter().map(sent)
    }

    fn received<'l>(&'l self, link: &'l ClusterLink, end: usize) -> impl Iterator<Item = (usize, f64)> {
        let received = |(tile, seen): &(usize, f64)| {
            (self.tiling.tiles[*tile].patch, share(*seen, self.light.unit[*tile]))
        };
        link.seen(end).iter().map(received)
    }
}
