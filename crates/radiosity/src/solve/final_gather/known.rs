//! What elements are known to receive of every patch, and what a point among them receives.
use super::outlook::Outlook;
use super::received::{Received, SentPiece};
use super::senders::{LitPoint, Sender};
use super::tears::tear;
use crate::error::Error;
use crate::mesh::element::Mesh;
use crate::solve::{factors::Factors, run::Run, state::Column, state::KEPT, workers::attempt};
use rayon::prelude::*;
use std::{collections::BTreeMap, sync::Arc};

/// The share of its light by which a vertex may be wrong for what it receives from patches that it does not look at itself.
const UNSEEN: f64 = 0.05;
/// Of the error that is asked for, this share may come of each patch that is looked at as if it were evenly bright,
const UNEVEN: f64 = 0.5;
/// and of a vertex's light always this share.
const EVEN: f64 = 0.005;
/// A patch that may be nearer than this share of the way to the elements' centroids is looked at.
const NEAR: f64 = 0.5;
/// The mean of elements may be off by so many times what they differ by,
const UNLIKE: f64 = 2.0;
/// and by this share of what they receive.
const ALIKE: f64 = 0.02;
/// Light jumps between neighbours of which one is so many times as bright as the other.
const JUMP: f64 = 3.0;
/// What is darker than this share of the mean counts as that bright.
const DIM: f64 = 0.01;

/// What elements receive of patches.
pub(super) struct Known {
    /// The patches that send light.
    senders: Vec<Sender>,
    /// What elements receive of them.
    rows: Received,
    /// What they receive in all, elements × bands: what they did while the light was found, and what was open then.
    pub(super) light: Vec<f64>,
    /// The mean irradiance, per band.
    mean: Vec<f64>,
    /// What an uneven patch may change, as a share of a vertex's light.
    uneven: f64,
}

/// What a vertex receives, and what it was looked at for that.
#[derive(Debug)]
pub(super) struct Look {
    /// Per band.
    pub(super) light: Vec<f64>,
    /// The elements around it, with their shares.
    around: Vec<(usize, f64)>,
    /// The senders that it looks at, in ascending order.
    seen: Vec<usize>,
    /// What these bring, senders × bands.
    brought: Vec<f64>,
}

/// What vertices receive of a sender at least and at most, as a share of what one receives in all.
#[derive(Clone, Copy, Debug)]
struct Shares {
    low: f64,
    high: f64,
    /// How many tell.
    count: usize,
}

impl Known {
    /// What the elements of a run received of what was shot; nothing when the watcher wants to stop, or where there are more form factors
    /// than are kept.
    pub(super) fn of(run: &mut Run<'_>) -> Result<Option<Known>, Error> {
        let nodes = &run.factors.subdivision.nodes;
        let (mut senders, mut pieces, mut unshot) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_patch, mut count) = (vec![None; nodes.len()], 0);
        for index in 0..run.shooters.len() {
            let node = run.shooters.node(index);
            if !run.sends(node) {
                continue;
            }
            let sender = match of_patch[nodes[node].patch] {
                Some(sender) => sender,
                None => {
                    senders.push(Sender::of_node(&run.factors, &run.light, nodes[node].patch)?);
                    senders.len() - 1
                }
            };
            of_patch[nodes[node].patch] = Some(sender);
            if run.shooters.shot(index).iter().all(|shot| *shot == 0.0) {
                unshot.push((sender, index));
                continue;
            }
            let Some(column) = run.column(node)? else { return Ok(None) };
            count += column.len();
            if count > KEPT {
                return Ok(None);
            }
            pieces.push(sent_piece(run, sender, index, column));
        }
        if run.is_open() && run.factors.rough_share() > 0.0 {
            pieces.extend(unshot_pieces(run, unshot, KEPT - count)?);
        }
        Ok(Some(Known::from(run, senders, pieces)))
    }

    fn from(run: &Run<'_>, senders: Vec<Sender>, pieces: Vec<SentPiece>) -> Known {
        let (elements, bands) = (run.light.areas.len(), run.light.bands);
        let rows = Received::of(pieces, elements, bands);
        let area: f64 = run.light.areas.iter().sum();
        let mut light = run.light.irradiance.clone();
        rows.add_open(&mut light);
        let mean = run.light.total(&light).iter().map(|power| power / area).collect();
        Known { senders, rows, light, mean, uneven: (UNEVEN * run.options.error).max(EVEN) }
    }

    /// The run's mesh with vertices apart where the light of the elements around them jumps.
    pub(super) fn torn(&self, mesh: &Mesh) -> Mesh {
        let bands = self.mean.len();
        let received = |element: usize| &self.light[element * bands..][..bands];
        let bright = |element: usize| self.at_least(received(element)).iter().sum::<f64>();
        let bright: Vec<f64> = (0..mesh.elements.len()).map(bright).collect();
        tear(mesh, |one, other| bright[one].max(bright[other]) <= JUMP * bright[one].min(bright[other]))
    }

    /// What vertices receive, and see. Where one is between two `looks`, what these see tells what it must look at.
    pub(super) fn look(
        &self,
        run: &Run<'_>,
        outlooks: &[Outlook],
        looks: &BTreeMap<usize, Look>,
    ) -> Result<Vec<Look>, Error> {
        let factors = &run.factors;
        let points: Vec<_> = outlooks.iter().map(|outlook| outlook.point).collect();
        let straight = factors.straight(&points)?;
        let at = |(outlook, [lamps, beyond]): (&Outlook, &[Vec<f64>; 2])| {
            let ends = outlook.ends.and_then(|[a, b]| Some([looks.get(&a)?, looks.get(&b)?]));
            let mut look = self.reflected(factors, outlook, ends);
            look.light.iter_mut().enumerate().for_each(|(band, light)| *light += lamps[band] + beyond[band]);
            look
        };
        attempt("the final gather", || outlooks.par_iter().zip(&straight).map(at).collect())
    }

    /// What a vertex receives of patches: what the elements around it do, but for those that it looks at itself.
    fn reflected(&self, factors: &Factors<'_>, outlook: &Outlook, ends: Option<[&Look; 2]>) -> Look {
        let of = self.at_least(&outlook.mean);
        let ends: Vec<Vec<f64>> = ends.iter().flatten().map(|look| self.brought(look)).collect();
        let seen = self.seen(outlook, &of, &ends);
        let mut brought = vec![0.0; seen.len() * of.len()];
        for (sender, brought) in
            seen.iter().map(|at| &self.senders[*at]).zip(brought.chunks_exact_mut(of.len()))
        {
            let point = if sender.emits { &outlook.point } else { &outlook.inside };
            sender.shine(factors, &LitPoint { point, of: &of, uneven: self.uneven }, brought);
        }
        let mut look = Look { light: vec![0.0; of.len()], around: outlook.around.clone(), seen, brought };
        self.brought(&look).chunks_exact(of.len()).for_each(|brought| add(&mut look.light, 1.0, brought));
        look
    }

    /// What each sender brings to where it was looked from, or what it brings to the elements around: senders × bands.
    fn brought(&self, look: &Look) -> Vec<f64> {
        let bands = self.mean.len();
        let mut all = vec![0.0; self.senders.len() * bands];
        for (element, share) in &look.around {
            self.rows.for_each(*element, |sender, light| add(&mut all[sender * bands..], *share, light));
        }
        for (sender, light) in look.seen.iter().zip(look.brought.chunks_exact(bands)) {
            all[sender * bands..][..bands].copy_from_slice(light);
        }
        all
    }

    /// How bright something is, per band, but no less than what counts.
    fn at_least(&self, light: &[f64]) -> Vec<f64> {
        let least = |(light, mean): (&f64, &f64)| light.max(DIM * mean).max(f64::MIN_POSITIVE);
        light.iter().zip(&self.mean).map(least).collect()
    }

    /// By how much light is off other light, as a share of it, all bands together. Where both are dim it counts less, the less light there is.
    pub(super) fn difference(&self, light: &[f64], other: &[f64]) -> f64 {
        let [light, other, mean] = [light, other, &self.mean].map(|light| light.iter().sum::<f64>());
        let dim = (DIM * mean).max(f64::MIN_POSITIVE);
        (light - other).abs() / light.max(dim) * (light.max(other) / dim).min(1.0)
    }

    /// The senders that a vertex looks at, in ascending order: lights, and from wide ones those of which least is known. What it receives of
    /// all others is wrong by no more than a share of its light.
    fn seen(&self, outlook: &Outlook, of: &[f64], ends: &[Vec<f64>]) -> Vec<usize> {
        let shares = self.shares(outlook, of, ends);
        let is_told = !ends.is_empty() || (outlook.ends.is_none() && outlook.around.len() > 1);
        let risk = |(sender, shares): (usize, &Shares)| {
            let most = self.senders[sender].most(&outlook.inside, of);
            let is_open = most == 0.0 || !is_told || self.must_be_seen(sender, outlook);
            (if is_open { most } else { most.min(shares.risk()) }, sender)
        };
        let (mut seen, mut others): (Vec<_>, Vec<_>) = shares
            .iter()
            .enumerate()
            .map(risk)
            .filter(|(risk, _)| *risk > 0.0)
            .partition(|(_, sender)| self.senders[*sender].emits);
        if outlook.is_wide {
            others.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut sum = 0.0;
            seen.extend(others.into_iter().filter(|(risk, _)| {
                sum += risk;
                sum > UNSEEN
            }));
        }
        let mut seen: Vec<usize> = seen.into_iter().map(|(_, sender)| sender).collect();
        seen.sort_unstable();
        seen
    }

    /// Whether what elements receive of a sender tells nothing: it is a light, or near.
    fn must_be_seen(&self, sender: usize, outlook: &Outlook) -> bool {
        self.senders[sender].emits || self.senders[sender].is_within(NEAR * outlook.reach, &outlook.inside)
    }

    /// What the elements around a vertex, and the ends of what was an edge, receive of each sender, as shares of `of`.
    fn shares(&self, outlook: &Outlook, of: &[f64], ends: &[Vec<f64>]) -> Vec<Shares> {
        let mut shares = vec![Shares { low: f64::INFINITY, high: 0.0, count: 0 }; self.senders.len()];
        for (element, _) in &outlook.around {
            self.rows.for_each(*element, |sender, light| shares[sender].add(largest(light, of)));
        }
        for brought in ends {
            let brought = brought.chunks_exact(of.len());
            shares.iter_mut().zip(brought).for_each(|(shares, light)| shares.add(largest(light, of)));
        }
        let all = outlook.around.len() + ends.len();
        shares.iter_mut().filter(|shares| shares.count < all).for_each(|shares| shares.low = 0.0);
        shares
    }
}

/// A piece of a sender by its number among the shooters.
fn sent_piece(run: &Run<'_>, sender: usize, index: usize, column: Arc<Column>) -> SentPiece {
    let elements = run.factors.subdivision.nodes[run.shooters.node(index)].elements.clone();
    let radiosity = run.light.mean_radiosity(elements);
    let open = radiosity.iter().zip(run.shooters.shot(index)).map(|(sent, shot)| sent - shot).collect();
    SentPiece { sender, radiosity, open, column }
}

/// What elements receive, roughly, of pieces that did not shoot before the time was up, given by sender and shooter: of those with most power
/// first, while there is time and so many form factors are kept. Those that are too thin to be outlined are left out.
fn unshot_pieces(
    run: &mut Run<'_>,
    mut unshot: Vec<(usize, usize)>,
    mut left: usize,
) -> Result<Vec<SentPiece>, Error> {
    let mut pieces = Vec::new();
    unshot.sort_by(|(_, a), (_, b)| run.shooters.power(*b).total_cmp(&run.shooters.power(*a)));
    for (sender, index) in unshot {
        let Ok(piece) = run.factors.piece(run.shooters.node(index)) else { continue };
        let Some(column) = run.rough_column(&piece)? else { break };
        let Some(rest) = left.checked_sub(column.len()) else { break };
        left = rest;
        pieces.push(sent_piece(run, sender, index, column));
    }
    Ok(pieces)
}

impl Shares {
    fn add(&mut self, share: f64) {
        self.low = self.low.min(share);
        self.high = self.high.max(share);
        self.count += 1;
    }

    /// How far off their mean may be: what they differ by is a measure.
    fn risk(&self) -> f64 {
        UNLIKE * (self.high - self.low) + ALIKE * self.high
    }
}

/// The largest share of a band.
fn largest(light: &[f64], of: &[f64]) -> f64 {
    light.iter().zip(of).map(|(light, of)| light / of).fold(0.0, f64::max)
}

/// Adds a share of the light of each band.
fn add(to: &mut [f64], share: f64, light: &[f64]) {
    to.iter_mut().zip(light).for_each(|(to, light)| *to += share * light);
}
