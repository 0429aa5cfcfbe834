//! How much more wrong the light of patches may be that a camera does not see.
//!
//! Where such a patch reflects a share w of what something in view receives, by any number of reflections, a share ε of its light that is wrong
//! brings w ε there. It may be wrong by 1 / √w times as much as what is seen: so work and error are saved and spent on both (after Smits,
//! Arvo and Salesin 1992, who refine links by importance).
use super::budget::BandLight;
use super::cluster_links::ClusterLinks;
use super::link::Link;
use super::tiling::Tiling;
use std::collections::BTreeMap;

/// No patch may be wrong by more than so many times the error.
const MOST: f64 = 16.0;
/// Reflections that are followed.
const REFLECTIONS: usize = 60;

/// What two patches reflect to each other, as powers: the one receives the first.
type Exchanges = BTreeMap<[usize; 2], [f64; 2]>;

/// How many times the error that is asked for each patch may be wrong by: 1 in view, more elsewhere.
pub(super) fn eases(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    lights: &[BandLight],
    in_view: &[bool],
) -> Vec<f64> {
    let exchanges: Vec<Exchanges> = lights.iter().map(|light| exchanges(tiling, links, light)).collect();
    let mut weights: Vec<f64> = in_view.iter().map(|&is_seen| f64::from(u8::from(is_seen))).collect();
    for _ in 0..REFLECTIONS {
        let before = weights.clone();
        for (light, exchanges) in lights.iter().zip(&exchanges) {
            let of_power = |patch: usize| before[patch] / light.unit[patch].max(f64::MIN_POSITIVE);
            let mut reflects = |patch: usize, share: f64| weights[patch] = weights[patch].max(share.min(1.0));
            for ([one, other], [here, there]) in exchanges {
                reflects(*other, here * of_power(*one));
                reflects(*one, there * of_power(*other));
            }
            for (link, end) in clusters.all.iter().flat_map(|link| [(link, 0), (link, 1)]) {
                let matters = |tile: usize| of_power(tiling.tiles[tile].patch);
                link.most(&clusters.clusters, end, matters, |tile, most| {
                    reflects(tiling.tiles[tile].patch, light.reflected[tile] * most);
                });
            }
        }
        if weights == before {
            break;
        }
    }
    weights.into_iter().map(|weight| weight.sqrt().recip().min(MOST)).collect()
}

fn exchanges(tiling: &Tiling<'_>, links: &[Link], light: &BandLight) -> Exchanges {
    let mut found = Exchanges::new();
    for link in links {
        let [one, other] = link.ends;
        let patches = [one, other].map(|tile| tiling.tiles[tile].patch);
        let [mut here, mut there] = [other, one].map(|from| link.exchange[0] * light.reflected[from]);
        if patches[0] > patches[1] {
            std::mem::swap(&mut here, &mut there);
        }
        let sums = found.entry([patches[0].min(patches[1]), patches[0].max(patches[1])]).or_default();
        *sums = [sums[0] + here, sums[1] + there];
    }
    found
}
