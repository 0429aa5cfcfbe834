//! What all leaves exchange: b = e + ρ T b.
//!
//! T takes what the leaves send to what they receive: pull, gather, push. As links carry light both ways by one matrix, it is its own
//! adjoint, and power adds up. What leaves of closed rooms send and receive is scaled so that ΣF is 1 (Sinkhorn and Knopp 1967), and what
//! is still missing is taken to be as bright as the receiver: so no room loses or gains light, however bright its finish. Some links of clusters
//! are wrong by far more than others: where there are such, it is they that are scaled.
use super::cluster_links::{self, ClusterLinks};
use super::firm::Firm;
use super::flow::{Linear, gather, pull, push, square};
use super::link::Link;
use super::roots::Roots;
use super::tile::SQUARE;
use super::tiling::Tiling;
use crate::union_find::UnionFind;

/// After so many rounds of scaling, or when only this much is missing anywhere, the rest is no matter: a few while links change.
const ROUNDS: usize = 30;
const FEW_ROUNDS: usize = 4;
const SLIGHT: f64 = 1e-9;
/// Nothing is scaled by more than this at a leaf: where so much is missing, links say nothing about where it comes from.
const MOST: f64 = 4.0;

/// The links of a tree as one operator.
#[derive(Debug)]
pub(super) struct Equilibrium<'e> {
    tiling: &'e Tiling<'e>,
    links: &'e [Link],
    clusters: &'e ClusterLinks,
    leaves: Vec<usize>,
    firm: Firm,
    /// For each leaf, what it sends and receives across the other links is multiplied by.
    scales: Vec<f64>,
    /// The largest change of ΣF by that.
    scaling: f64,
    /// For each leaf, what T then leaves of constant light and its own light has to make up for.
    missing: Vec<Linear>,
    /// For each leaf, constant light after T.
    sums: Vec<Linear>,
    /// The room of each leaf, and the first leaf of each room.
    room_of: Vec<usize>,
    first_of: Vec<usize>,
}

impl<'e> Equilibrium<'e> {
    /// `known` is ΣF of the tiles of which it is known: 1 in closed rooms.
    pub(super) fn new(
        tiling: &'e Tiling<'e>,
        links: &'e [Link],
        clusters: &'e ClusterLinks,
        known: &[Option<f64>],
        is_last: bool,
    ) -> Equilibrium<'e> {
        let leaves: Vec<usize> = tiling.leaves().collect();
        let (room_of, first_of) = rooms(tiling, links, clusters, &leaves);
        let count = leaves.len();
        let (scales, missing, sums) = (vec![1.0; count], vec![[0.0; 3]; count], Vec::new());
        let firm = Firm::of(tiling, links, clusters, known);
        let mut equilibrium = Equilibrium {
            tiling,
            links,
            clusters,
            leaves,
            firm,
            scales,
            missing,
            sums,
            room_of,
            first_of,
            scaling: 0.0,
        };
        equilibrium.close(known, if is_last { ROUNDS } else { FEW_ROUNDS });
        equilibrium
    }

    /// Scales what the leaves exchange until ΣF is what it is known to be; in closed rooms what remains goes to their own light.
    fn close(&mut self, known: &[Option<f64>], rounds: usize) {
        let even = vec![[1.0, 0.0, 0.0]; self.leaves.len()];
        let roots = Roots::new(self.tiling, self.links, self.clusters, &self.leaves, known);
        for round in 0..rounds {
            let [firm, loose] = self.carried(&even);
            let sums: Vec<f64> = firm.iter().zip(&loose).map(|(firm, loose)| firm[0] + loose[0]).collect();
            let rights = roots.rights(&sums);
            let mut largest = 0.0f64;
            for (leaf, (sum, right)) in sums.iter().zip(rights).enumerate() {
                let (firm, loose) = (firm[leaf][0], loose[leaf][0]);
                if loose > 0.0 && right >= 0.0 {
                    let by = ((right - firm).max(0.0) / loose).sqrt();
                    self.scales[leaf] = (self.scales[leaf] * by).min(MOST);
                    largest = largest.max((sum - right).abs());
                }
            }
            self.scaling = if round == 0 { largest } else { self.scaling };
            if largest <= SLIGHT {
                break;
            }
        }
        let whole = self.receive(&even);
        for (leaf, [mean, first, second]) in whole.into_iter().enumerate() {
            let (missing, sums) = match (known[self.leaves[leaf]] == Some(1.0), mean > 1.0) {
                (true, _) => ([1.0 - mean, -first, -second], [1.0, 0.0, 0.0]),
                (false, true) => ([1.0 - mean, 0.0, 0.0], [1.0, first, second]),
                (false, false) => ([0.0; 3], [mean, first, second]),
            };
            self.missing[leaf] = missing;
            self.sums.push(sums);
        }
    }

    pub(super) fn leaves(&self) -> &[usize] {
        &self.leaves
    }

    /// Constant light after T on a leaf: ΣF, and how it climbs.
    pub(super) fn sums(&self, leaf: usize) -> Linear {
        self.sums[leaf]
    }

    /// The largest change that closing rooms makes to ΣF.
    pub(super) fn scaling(&self) -> f64 {
        self.scaling
    }

    /// What each link carries is multiplied by, on average.
    pub(super) fn scales(&self) -> Vec<f64> {
        let scales: Vec<Linear> = self.scales.iter().map(|scale| [*scale, 0.0, 0.0]).collect();
        let of_tiles = self.spread(&scales);
        let of_ends = |link: &Link| link.ends.map(|end| of_tiles[end][0]).into_iter().product();
        let of = |(link, is_firm): (&Link, &bool)| if *is_firm { 1.0 } else { of_ends(link) };
        self.links.iter().zip(&self.firm.of_tiles).map(of).collect()
    }

    /// What the leaves reflect.
    pub(super) fn reflectance(&self, band: usize) -> Vec<f64> {
        self.leaves.iter().map(|&leaf| self.tiling.tiles[leaf].reflectance[band]).collect()
    }

    /// 1 − max ρΣF.
    pub(super) fn gap(&self, reflectance: &[f64]) -> f64 {
        let kept = reflectance.iter().zip(&self.sums).map(|(rho, sums)| (1.0 - rho) + rho * (1.0 - sums[0]));
        kept.fold(1.0, f64::min).max(0.0)
    }

    /// How large a residual may be: within the tolerance of what is reflected, whatever is made of it.
    pub(super) fn enough(
        &self,
        reflectance: &[f64],
        sent: &[Linear],
        emitted: &[Linear],
        tolerance: f64,
    ) -> f64 {
        let [mut power, mut squares] = [0.0; 2];
        for ((leaf, light), e) in self.leaves.iter().zip(sent).zip(emitted) {
            let (area, reflected) = (self.tiling.tiles[*leaf].area, (light[0] - e[0]).abs());
            power += area * reflected;
            squares += area * reflected * reflected;
        }
        let brightness = if power > 0.0 { squares / power } else { largest(emitted) };
        0.1 * tolerance * self.gap(reflectance) * brightness
    }

    /// The leaves of each room, ascending.
    pub(super) fn rooms(&self) -> Vec<Vec<usize>> {
        let mut rooms = vec![Vec::new(); self.first_of.len()];
        self.room_of.iter().enumerate().for_each(|(leaf, room)| rooms[*room].push(leaf));
        rooms
    }

    /// The patches of each room, ascending.
    pub(super) fn patches_of_rooms(&self) -> Vec<Vec<usize>> {
        let patches = |room: Vec<usize>| {
            let mut patches: Vec<usize> = room.into_iter().map(|leaf| self.patch(leaf)).collect();
            patches.dedup();
            patches
        };
        self.rooms().into_iter().map(patches).collect()
    }

    /// The light of the leaves among that of all tiles.
    pub(super) fn of_leaves(&self, light: &[Linear]) -> Vec<Linear> {
        self.leaves.iter().map(|&leaf| light[leaf]).collect()
    }

    /// What the leaves send, spread over the tree: for each tile.
    pub(super) fn spread(&self, sent: &[Linear]) -> Vec<Linear> {
        let mut all = vec![[0.0; 3]; self.tiling.tiles.len()];
        self.leaves.iter().zip(sent).for_each(|(&leaf, light)| all[leaf] = *light);
        pull(self.tiling, &mut all);
        all
    }

    /// T: what the leaves receive when they send so much.
    pub(super) fn receive(&self, sent: &[Linear]) -> Vec<Linear> {
        let [firm, loose] = self.carried(sent);
        let here = |(((firm, loose), own), missing): (((Linear, Linear), &Linear), &Linear)| {
            let [mean, first, second] = [0, 1, 2].map(|k| firm[k] + loose[k]);
            let of_slopes = SQUARE * (missing[1] * own[1] + missing[2] * own[2]);
            [
                mean + missing[0] * own[0] + of_slopes,
                first + missing[1] * own[0],
                second + missing[2] * own[0],
            ]
        };
        firm.into_iter().zip(loose).zip(sent).zip(&self.missing).map(here).collect()
    }

    /// What the leaves receive by what is carried as it was measured, and by what is scaled.
    fn carried(&self, sent: &[Linear]) -> [Vec<Linear>; 2] {
        let scaled = |light: &[Linear]| -> Vec<Linear> {
            light.iter().zip(&self.scales).map(|(light, scale)| light.map(|l| l * scale)).collect()
        };
        let loose = self.across(&scaled(sent), false);
        let firm = if self.firm.is_any { self.across(sent, true) } else { vec![[0.0; 3]; sent.len()] };
        [firm, scaled(&loose)]
    }

    /// What the leaves receive across some of the links when they send so much.
    fn across(&self, sent: &[Linear], are_firm: bool) -> Vec<Linear> {
        let sent = self.spread(sent);
        let is_taken = |is_firm: &bool| *is_firm == are_firm;
        let links = self.links.iter().zip(&self.firm.of_tiles).filter(|(_, is_firm)| is_taken(is_firm));
        let mut received = gather(self.tiling, links.map(|(link, _)| link), &sent);
        let far = self.clusters.all.iter().zip(&self.firm.of_clusters);
        let far = far.filter(|(_, is_firm)| is_taken(is_firm)).map(|(link, _)| link);
        cluster_links::gather(self.tiling, far, &sent, &mut received);
        push(self.tiling, &mut received);
        self.of_leaves(&received)
    }

    /// Takes the light out of rooms into which none is sent: what rounding leaves there.
    pub(super) fn darken(&self, emitted: &[Linear], light: &mut [Linear]) {
        let mut lit = vec![false; self.first_of.len()];
        self.room_of.iter().zip(emitted).for_each(|(room, emitted)| lit[*room] |= emitted[0] > 0.0);
        let dark = self.room_of.iter().zip(light).filter(|(room, _)| !lit[**room]);
        dark.for_each(|(_, light)| *light = [0.0; 3]);
    }

    /// The area of a leaf.
    pub(super) fn area(&self, leaf: usize) -> f64 {
        self.tiling.tiles[self.leaves[leaf]].area
    }

    /// The patch of a leaf.
    pub(super) fn patch(&self, leaf: usize) -> usize {
        self.tiling.tiles[self.leaves[leaf]].patch
    }

    /// (I − T) b, without cancellation where light is even: constants are taken out, room by room.
    fn drop(&self, sent: &[Linear]) -> Vec<Linear> {
        let level = |leaf: usize| sent[self.first_of[self.room_of[leaf]]][0];
        let uneven: Vec<Linear> = sent
            .iter()
            .enumerate()
            .map(|(leaf, light)| [light[0] - level(leaf), light[1], light[2]])
            .collect();
        let mut received = self.receive(&uneven);
        for (leaf, light) in received.iter_mut().enumerate() {
            let (even, sums) = (level(leaf), self.sums[leaf]);
            let [mean, first, second] = uneven[leaf];
            *light = [
                mean - light[0] + even * (1.0 - sums[0]),
                first - light[1] - even * sums[1],
                second - light[2] - even * sums[2],
            ];
        }
        received
    }

    /// (I − ρT) b = (1 − ρ) b + ρ (I − T) b.
    pub(super) fn apply(&self, reflectance: &[f64], sent: &[Linear]) -> Vec<Linear> {
        let mut dropped = self.drop(sent);
        for ((drop, light), rho) in dropped.iter_mut().zip(sent).zip(reflectance) {
            (0..3).for_each(|k| drop[k] = (1.0 - rho) * light[k] + rho * drop[k]);
        }
        dropped
    }
}

/// The largest value of a function anywhere on its tile, about.
pub(super) fn largest(light: &[Linear]) -> f64 {
    light.iter().map(|l| l[0].abs() + l[1].abs() + l[2].abs()).fold(0.0, f64::max)
}

/// Which leaves exchange light, at once or through others: the room of each, and the first leaf of each room.
fn rooms(
    tiling: &Tiling<'_>,
    links: &[Link],
    clusters: &ClusterLinks,
    leaves: &[usize],
) -> (Vec<usize>, Vec<usize>) {
    let root_of = tiling.roots();
    let mut groups = UnionFind::new(tiling.tiles.len());
    for (tile, root) in root_of.iter().enumerate() {
        groups.join(tile, *root);
    }
    for link in links.iter().filter(|link| link.exchange[0] > 0.0) {
        let [one, other] = link.ends;
        groups.join(one, other);
    }
    for link in &clusters.all {
        let mut lit = link.lit();
        if let Some(first) = lit.next() {
            lit.for_each(|tile| groups.join(first, tile));
        }
    }
    let (numbers, firsts) = groups.number();
    let mut first_of = vec![usize::MAX; firsts.len()];
    let mut room_of = Vec::with_capacity(leaves.len());
    for (index, &leaf) in leaves.iter().enumerate() {
        let room = numbers[leaf];
        first_of[room] = first_of[room].min(index);
        room_of.push(room);
    }
    (room_of, first_of)
}

/// The deviation of light from what is linear on each tile: from the leaves' up.
pub(super) fn deviations(tiling: &Tiling<'_>, sent: &[Linear], of_leaves: &[f64]) -> Vec<f64> {
    let mut squares: Vec<f64> = of_leaves.iter().map(|deviation| deviation * deviation).collect();
    for (index, tile) in tiling.tiles.iter().enumerate().rev() {
        let Some(halves) = tile.halves else { continue };
        let all: f64 =
            halves.iter().map(|&half| tiling.tiles[half].area * (squares[half] + square(sent[half]))).sum();
        squares[index] = (all / tile.area - square(sent[index])).max(0.0);
    }
    squares.into_iter().map(f64::sqrt).collect()
}
