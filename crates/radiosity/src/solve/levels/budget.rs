//! Which links to refine: the errors of the links of every patch add up to no more than its share.
use super::cluster_links::ClusterLinks;
use super::curvatures::Curvatures;
use super::direct::DirectFlaws;
use super::equilibrium::deviations;
use super::flow::{Linear, square};
use super::link::Link;
use super::tiling::{Tile, Tiling};
use rayon::prelude::*;

/// How much of the curvature of what a tile sees of another, times the deviation of the other's light, counts.
const SENT: f64 = 0.7;
/// How much the curvature of light within a tile counts beside errors of its mean.
const WITHIN: f64 = 0.05;
/// How much it counts where the tile is made of smaller patches, whose means are told as well.
const PARTS: f64 = 0.5;
/// How much the curvature of light within a tile counts for those that look at its parts.
const OTHERS: f64 = 0.3;
/// How much the deviation of a sender's light counts where each place of it is seen from another place.
const PLACE: f64 = 0.3;
/// How much of the light that is reflected by what five points miss may be other than its surroundings.
const BLIND: f64 = 0.3;
/// Patches whose errors add up to so much more than their share are not refined for the rest.
const ENOUGH: f64 = 1.25;
/// How much less than that of a whole the light of a half deviates from linear.
const HALVED: f64 = 0.5;
/// Patches that are darker than this share of the mean count as if they were as bright.
pub(super) const DARK: f64 = 0.01;

/// The light of a band, as errors depend on it.
#[derive(Debug)]
pub(super) struct BandLight {
    pub(super) band: usize,
    /// What each tile sends, and how far that is from linear.
    pub(super) sent: Vec<Linear>,
    pub(super) deviation: Vec<f64>,
    /// How much of what each tile sends is reflected.
    pub(super) reflected: Vec<f64>,
    /// For each tile, the mean of what the whole that it is a part of sends.
    level: Vec<f64>,
    /// What the mean of what lights bring to each leaf may be off by.
    direct_error: Vec<f64>,
    /// See [`importances`].
    pub(super) importance: Vec<f64>,
    /// For each tile the power of its patch that counts as 1: of a plate that several patches are parts of, as if all of it were as bright as the
    /// tile.
    pub(super) unit: Vec<f64>,
    /// How far what each tile receives by itself is from linear, as irradiance.
    pub(super) bend: Vec<f64>,
    /// How many times its errors count in each tile: see [`Spread::strain`](super::members::Spread::strain).
    pub(super) strain: Vec<f64>,
    /// What all patches send, on average.
    pub(super) mean: f64,
}

/// What may be wrong with the light that one end of a link receives, as a power: the mean, what its curvature leaves, the sender's part, and
/// that of the total which the links of the pair add up to, which no cut betters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flaw {
    pub(super) of_mean: f64,
    within: f64,
    pub(super) of_sender: f64,
    pub(super) of_total: f64,
}

/// An error as a share of the light of a patch, in the worst band, and how many there are of such a size.
pub(super) type PatchErrors = (f64, usize);

/// For each tile how much its parts, where others look at them in more detail, matter to one patch: the largest sum of what they send it, in its unit,
/// for a radiosity of 1.
fn importances(tiling: &Tiling<'_>, links: &[Link], unit: &[f64]) -> Vec<f64> {
    let mut of_patch: Vec<Vec<(usize, f64)>> = vec![Vec::new(); tiling.scene.patches.len()];
    for link in links {
        for end in [0, 1] {
            let [here, there] = [link.ends[end], link.ends[1 - end]];
            if unit[here] > 0.0 && tiling.tiles[there].parent.is_some() {
                of_patch[tiling.tiles[here].patch].push((there, link.exchange[0] / unit[here]));
            }
        }
    }
    let above =
        |tile: usize| std::iter::successors(tiling.tiles[tile].parent, |&tile| tiling.tiles[tile].parent);
    let mut largest = vec![0.0f64; tiling.tiles.len()];
    let mut sums = vec![0.0; tiling.tiles.len()];
    for senders in of_patch {
        for (sender, share) in &senders {
            above(*sender).for_each(|tile| sums[tile] += share);
        }
        for (sender, _) in senders {
            above(sender).for_each(|tile| largest[tile] = largest[tile].max(std::mem::take(&mut sums[tile])));
        }
    }
    largest
}

impl BandLight {
    /// What is wrong with what one end of a link receives.
    pub(super) fn flaw(&self, tiling: &Tiling<'_>, link: &Link, end: usize) -> Flaw {
        let [receiver, sender] = [link.ends[end], link.ends[1 - end]];
        let transfer = &link.transfer;
        let [here, there] = [end, 1 - end].map(|end| link.curvature(end));
        let bright = square(self.sent[sender]).sqrt();
        let tile = &tiling.tiles[receiver];
        // What the sender's points miss, the receiver's see, but not how bright it is.
        let is_missed = usize::from(transfer.from_second) == end;
        let missed = if is_missed { transfer.gap * self.reflected[sender] } else { 0.0 };
        let elsewhere = PLACE * link.locality * link.exchange[0];
        let shared = if link.of_total.is_some() { link.error() } else { 0.0 };
        // Where the total is known only how it is shared can be wrong: no matter where the sender is even, and no part of the receiver is
        // told by itself.
        let is_told = tile.parent.is_some() && tiling.is_joined(tile.patch);
        let is_shared = link.of_total.is_some() && !is_told;
        Flaw {
            of_mean: link.error() * if is_shared { self.stray(sender) } else { bright },
            of_total: link.of_total.map_or(0.0, |error| error * bright),
            within: self.within(tiling, receiver) * (here + shared) * bright,
            of_sender: self.deviation[sender] * (SENT * there + elsewhere) + BLIND * missed,
        }
    }

    /// What the light that a leaf receives straight from lights may be off by, as a power.
    pub(super) fn direct_power(&self, tiling: &Tiling<'_>, leaf: usize) -> f64 {
        tiling.tiles[leaf].area * self.direct_error[leaf]
    }

    /// How much the curvature of light within a tile counts.
    pub(super) fn within(&self, tiling: &Tiling<'_>, receiver: usize) -> f64 {
        let tile = &tiling.tiles[receiver];
        let for_others =
            self.importance[receiver] * tile.reflectance[self.band] / tile.area * self.unit[receiver];
        // Patches of a plate that are smaller than a tile receive what the curve, not the tile's linear light says.
        let is_coarse = tiling.grain[tile.patch].is_some_and(|grain| tile.area > grain);
        (if is_coarse { PARTS } else { WITHIN }) + OTHERS * for_others
    }

    /// How far what a tile sends is from the mean of its whole.
    fn stray(&self, tile: usize) -> f64 {
        let [mean, first, second] = self.sent[tile];
        square([mean - self.level[tile], first, second]).sqrt()
    }

    /// Takes in tiles that were cut since: they send what their parents do.
    pub(super) fn grow(&mut self, tiling: &Tiling<'_>) {
        for (index, tile) in tiling.tiles.iter().enumerate().skip(self.sent.len()) {
            let Some(parent) = tile.parent else { continue };
            let light = tile.restrict(self.sent[parent]);
            self.sent.push(light);
            self.deviation.push(HALVED * self.deviation[parent]);
            self.bend.push(HALVED * self.bend[parent]);
            self.strain.push(self.strain[parent]);
            self.unit.push(self.unit[parent]);
            self.reflected.push((light[0] - tiling.emittance(index, self.band)).abs());
            self.importance.push(self.importance[parent]);
            self.level.push(self.level[parent]);
            self.direct_error.push(self.direct_error[parent] * HALVED);
        }
    }

    /// `received` is the irradiance of the leaves, spread over the tree.
    pub(super) fn new(
        tiling: &Tiling<'_>,
        (links, clusters): (&[Link], &ClusterLinks),
        sent: Vec<Linear>,
        received: &[Linear],
        band: usize,
        direct: DirectFlaws,
        strain: Vec<f64>,
    ) -> BandLight {
        let even = Curvatures::of(tiling, (links, clusters), &sent, &direct.deviation);
        let (mut deviation, mut bend) = (vec![0.0; sent.len()], Vec::new());
        for _ in 0..2 {
            bend = even.unresolved(tiling, links, &deviation);
            let of_leaves = with_larger(tiling, &bend);
            let of_leaves = tiling.tiles.iter().zip(received).zip(of_leaves).map(|((tile, light), off)| {
                (tile.reflectance[band] * off).hypot(tile.mottle[band] * light[0])
            });
            deviation = deviations(tiling, &sent, &of_leaves.collect::<Vec<f64>>());
        }
        let patches = tiling.scene.patches.len();
        let (mut areas, mut powers) = (vec![0.0; patches], vec![0.0; patches]);
        for (tile, light) in tiling.tiles.iter().zip(received).filter(|(tile, _)| tile.parent.is_none()) {
            areas[tile.patch] += tile.area;
            powers[tile.patch] += tile.area * light[0].max(0.0);
        }
        let mean = powers.iter().sum::<f64>() / areas.iter().sum::<f64>();
        let unit = |(tile, light): (&Tile, &Linear)| {
            let (power, area) = (powers[tile.patch], areas[tile.patch]);
            let bright = if tiling.is_joined(tile.patch) { light[0] * area } else { power };
            bright.max(DARK * mean * area)
        };
        let unit: Vec<f64> = tiling.tiles.iter().zip(received).map(unit).collect();
        let reflected = sent
            .iter()
            .enumerate()
            .map(|(tile, light)| (light[0] - tiling.emittance(tile, band)).abs())
            .collect();
        let mut level: Vec<f64> = sent.iter().map(|light| light[0]).collect();
        for (index, tile) in tiling.tiles.iter().enumerate() {
            level[index] = tile.parent.map_or(level[index], |parent| level[parent]);
        }
        let importance = importances(tiling, links, &unit);
        let roots = || tiling.tiles.iter().zip(&sent).filter(|(tile, _)| tile.parent.is_none());
        let sent_power: f64 = roots().map(|(tile, light)| tile.area * light[0]).sum();
        let mean = sent_power / areas.iter().sum::<f64>();
        let direct_error = direct.error;
        BandLight {
            band,
            reflected,
            deviation,
            bend,
            strain,
            sent,
            level,
            direct_error,
            importance,
            unit,
            mean,
        }
    }
}

/// How far the irradiance of each leaf is from linear: what it receives by itself, and what larger tiles do by its share.
pub(super) fn with_larger(tiling: &Tiling<'_>, bend: &[f64]) -> Vec<f64> {
    let mut squares: Vec<f64> = bend.iter().map(|bend| bend * bend).collect();
    for (index, tile) in tiling.tiles.iter().enumerate() {
        let Some(parent) = tile.parent else { continue };
        let share = tile.area / tiling.tiles[parent].area;
        squares[index] += squares[parent] * share * share;
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// What the light that a leaf receives straight from lights may be off by, as a share of its patch's, in the worst band.
fn worst_direct(tiling: &Tiling<'_>, leaf: usize, bands: &[BandLight]) -> f64 {
    let share = |light: &BandLight| {
        let (power, unit) = (light.direct_power(tiling, leaf) * light.strain[leaf], light.unit[leaf]);
        if unit > 0.0 { power / unit } else { 0.0 }
    };
    bands.iter().map(share).fold(0.0, f64::max)
}

/// The leaves whose light straight from lights is beyond the limit of their patch.
pub(super) fn uneven(tiling: &Tiling<'_>, bands: &[BandLight], limits: &[f64]) -> Vec<usize> {
    let is_beyond = |leaf: &usize| worst_direct(tiling, *leaf, bands) > limits[tiling.tiles[*leaf].patch];
    tiling.leaves().filter(is_beyond).collect()
}

/// The largest errors that the links of every patch may have, so that they add up to no more than its share of its light: infinite where all do.
/// `far` are the errors of links of clusters, with the patches that have them.
pub(super) fn limits(
    tiling: &Tiling<'_>,
    links: &[Link],
    far: Vec<(usize, PatchErrors)>,
    bands: &[BandLight],
    shares: &[f64],
) -> Vec<f64> {
    let mut of_patch: Vec<Vec<PatchErrors>> = vec![Vec::new(); tiling.scene.patches.len()];
    for (patch, errors) in far {
        of_patch[patch].push(errors);
    }
    for link in links {
        for end in [0, 1] {
            of_patch[tiling.tiles[link.ends[end]].patch].push((worst(tiling, link, end, bands).0, 1));
        }
    }
    for leaf in tiling.leaves() {
        let error = worst_direct(tiling, leaf, bands);
        if error > 0.0 {
            of_patch[tiling.tiles[leaf].patch].push((error, 1));
        }
    }
    of_patch.into_par_iter().zip(shares).map(|(errors, share)| limit(errors, *share)).collect()
}

/// The limit of one patch.
fn limit(mut errors: Vec<PatchErrors>, share: f64) -> f64 {
    let all = |(error, count): &PatchErrors| *error * *count as f64;
    if errors.iter().map(all).sum::<f64>() <= ENOUGH * share {
        return f64::INFINITY;
    }
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut sum = 0.0;
    let kept = errors.iter().take_while(|errors| {
        let is_within = sum + errors.0 <= share;
        sum += all(errors);
        is_within
    });
    let count: usize = errors.iter().map(|(_, count)| count).sum();
    // Where even the least is too much, they are to be as small as so many may be.
    kept.last().map_or(0.0, |(error, _)| *error).max(share / count as f64)
}

/// Which end of a link is to be cut, if an error of it is beyond the limit of its patch: that of the error which is furthest beyond.
pub(super) fn cut(tiling: &Tiling<'_>, link: &Link, bands: &[BandLight], limits: &[f64]) -> Option<usize> {
    let beyond = |end: usize| {
        let (error, at_end) = worst(tiling, link, end, bands);
        let limit = limits[tiling.tiles[link.ends[end]].patch];
        (error > limit).then_some((error, if at_end { end } else { 1 - end }))
    };
    let [one, other] = [0, 1].map(beyond);
    one.into_iter().chain(other).reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, end)| end)
}

/// The error of what one end of a link receives in the worst band, and whether that end is to be cut for it.
fn worst(tiling: &Tiling<'_>, link: &Link, end: usize, bands: &[BandLight]) -> (f64, bool) {
    let at_end = usize::from(link.transfer.from_second) == end;
    let of = |light: &BandLight| {
        let Flaw { of_mean, within, of_sender, .. } = light.flaw(tiling, link, end);
        let (here, there) =
            if at_end { (of_mean + within, of_sender) } else { (within, of_mean + of_sender) };
        let unit = light.unit[link.ends[end]] / light.strain[link.ends[end]];
        if unit > 0.0 { ((here + there) / unit, here >= there) } else { (0.0, true) }
    };
    bands.iter().map(of).fold((0.0, true), |a, b| if b.0 > a.0 { b } else { a })
}
