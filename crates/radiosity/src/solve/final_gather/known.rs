//! What elements are known to receive of every patch, and what a point among them receives.
use super::outlook::Outlook;
use super::senders::Sender;
use crate::error::Error;
use crate::solve::state::{Column, KEPT};
use crate::solve::{factors::Factors, run::Run, workers::attempt};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The share of its light by which a vertex may be wrong for what it receives from patches that it does not look at itself.
const UNSEEN: f64 = 0.1;
/// A patch that may be nearer than this share of the way to the elements' centroids is looked at.
const NEAR: f64 = 0.5;
/// The mean of elements may be off by so many times what they differ by,
const UNLIKE: f64 = 2.0;
/// and by this share of what they receive.
const ALIKE: f64 = 0.02;
/// What is darker than this share of the mean counts as that bright.
const DIM: f64 = 0.01;

/// What elements receive of patches.
pub(super) struct Known {
    /// The patches that send light.
    senders: Vec<Sender>,
    /// For each of them the pieces that shot.
    pieces: Vec<Vec<SentPiece>>,
    /// What elements receive of all pieces, elements × bands.
    received: Vec<f64>,
    /// The mean irradiance, per band.
    mean: Vec<f64>,
}

/// What a vertex receives, and what it was looked at for that.
#[derive(Debug, Default)]
pub(super) struct Look {
    /// Per band, and what of it comes from patches.
    pub(super) light: Vec<f64>,
    reflected: Vec<f64>,
    /// The elements around it, with their shares.
    around: Vec<(usize, f64)>,
    /// The senders that it looks at, in ascending order.
    seen: Vec<usize>,
    /// What these bring, senders × bands.
    brought: Vec<f64>,
}

/// A piece of a patch.
struct SentPiece {
    /// What it sends on average, per band.
    radiosity: Vec<f64>,
    column: Arc<Column>,
}

impl Known {
    /// What the elements of a run received; nothing when the watcher wants to stop, or where there are more form factors than are kept.
    pub(super) fn of(run: &mut Run<'_>) -> Result<Option<Known>, Error> {
        let nodes = &run.factors.subdivision.nodes;
        let area: f64 = run.light.areas.iter().sum();
        let mean = run.light.total(&run.light.irradiance).iter().map(|power| power / area).collect();
        let received = vec![0.0; run.light.irradiance.len()];
        let mut known = Known { senders: Vec::new(), pieces: Vec::new(), received, mean };
        let (mut of_patch, mut count) = (vec![None; nodes.len()], 0);
        for node in run.shooters.front().collect::<Vec<_>>() {
            if !run.sends(node) {
                continue;
            }
            let Some(column) = run.column(node)? else { return Ok(None) };
            count += column.len();
            if count > KEPT {
                return Ok(None);
            }
            let sender = match of_patch[nodes[node].patch] {
                Some(sender) => sender,
                None => known.add(Sender::of_node(&run.factors, &run.light, nodes[node].patch)?),
            };
            of_patch[nodes[node].patch] = Some(sender);
            let piece =
                SentPiece { radiosity: run.light.mean_radiosity(nodes[node].elements.clone()), column };
            piece.shine(&mut known.received);
            known.pieces[sender].push(piece);
        }
        Ok(Some(known))
    }

    fn add(&mut self, sender: Sender) -> usize {
        self.senders.push(sender);
        self.pieces.push(Vec::new());
        self.senders.len() - 1
    }

    /// What vertices receive, and see. Of those between two `looks` these tell.
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
            look.light = (0..look.reflected.len())
                .map(|band| lamps[band] + beyond[band] + look.reflected[band])
                .collect();
            look
        };
        attempt("the final gather", || outlooks.par_iter().zip(&straight).map(at).collect())
    }

    /// What a vertex receives of patches: what is known before it looks, but for those that it looks at itself.
    fn reflected(&self, factors: &Factors<'_>, outlook: &Outlook, ends: Option<[&Look; 2]>) -> Look {
        let of = self.at_least(&outlook.mean);
        let own = Look { around: outlook.around.clone(), ..Look::default() };
        let (sources, share) = ends.map_or((vec![&own], 1.0), |ends| (ends.to_vec(), 0.5));
        let mut rest = self.known_before(outlook, ends);
        let (mut reflected, mut all) = (vec![0.0; of.len()], Vec::new());
        let seen = self.seen(outlook, ends, &of);
        for &sender in &seen {
            let looked_at = &self.senders[sender];
            let point = if looked_at.emits { &outlook.point } else { &outlook.inside };
            let mut brought = vec![0.0; of.len()];
            looked_at.shine(factors, point, &of, &mut brought);
            add(&mut reflected, 1.0, &brought);
            all.extend(brought);
            sources.iter().for_each(|look| add(&mut rest, -share, &self.brought(look, sender)));
        }
        reflected.iter_mut().zip(rest).for_each(|(reflected, rest)| *reflected += rest.max(0.0));
        Look { light: Vec::new(), reflected, around: own.around, seen, brought: all }
    }

    /// What a vertex receives of patches as far as that is known before it looks: what the elements around it do, or on average the ends of
    /// what was an edge.
    fn known_before(&self, outlook: &Outlook, ends: Option<[&Look; 2]>) -> Vec<f64> {
        let bands = self.mean.len();
        let mut light = vec![0.0; bands];
        match ends {
            Some(ends) => ends.iter().for_each(|end| add(&mut light, 0.5, &end.reflected)),
            None => outlook.around.iter().for_each(|(element, share)| {
                add(&mut light, *share, &self.received[element * bands..][..bands]);
            }),
        }
        light
    }

    /// What a sender brings to where it was looked from, or what it brings to the elements around, per band.
    fn brought(&self, look: &Look, sender: usize) -> Vec<f64> {
        let bands = self.mean.len();
        if let Ok(at) = look.seen.binary_search(&sender) {
            return look.brought[at * bands..][..bands].to_vec();
        }
        let mut light = vec![0.0; bands];
        for SentPiece { radiosity, column } in &self.pieces[sender] {
            let seen: f64 = look.around.iter().map(|(element, share)| share * column.factor(*element)).sum();
            add(&mut light, seen, radiosity);
        }
        light
    }

    /// How bright something is, per band, but no less than what counts.
    fn at_least(&self, light: &[f64]) -> Vec<f64> {
        let least = |(light, mean): (&f64, &f64)| light.max(DIM * mean).max(f64::MIN_POSITIVE);
        light.iter().zip(&self.mean).map(least).collect()
    }

    /// By how much light is off other light, as a share of it, all bands together.
    pub(super) fn difference(&self, light: &[f64], other: &[f64]) -> f64 {
        let [light, other, mean] = [light, other, &self.mean].map(|light| light.iter().sum::<f64>());
        (light - other).abs() / light.max(DIM * mean).max(f64::MIN_POSITIVE)
    }

    /// The senders that a vertex looks at, in ascending order: lights, and from wide ones those of which least is known. What it receives of
    /// all others is wrong by no more than a share of its light.
    fn seen(&self, outlook: &Outlook, ends: Option<[&Look; 2]>, of: &[f64]) -> Vec<usize> {
        let risk = (0..self.senders.len()).map(|sender| (self.risk(sender, outlook, ends, of), sender));
        let (mut seen, mut others): (Vec<_>, Vec<_>) =
            risk.filter(|(risk, _)| *risk > 0.0).partition(|(_, sender)| self.senders[*sender].emits);
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

    /// How far off what is known may be from what a vertex receives of a sender, as a share of its light: all of it for a light, for what is
    /// near, and where one element tells it or these were cut; else what the elements, and the ends, differ by is a measure.
    fn risk(&self, sender: usize, outlook: &Outlook, ends: Option<[&Look; 2]>, of: &[f64]) -> f64 {
        let Outlook { inside, around, reach, .. } = outlook;
        let Sender { emits, .. } = self.senders[sender];
        let most = self.senders[sender].most(inside, of);
        let is_told = ends.is_some() || (outlook.ends.is_none() && around.len() > 1);
        if most == 0.0 || emits || !is_told || self.senders[sender].is_within(NEAR * reach, inside) {
            return most;
        }
        let of_elements = around.iter().map(|(element, _)| self.share(sender, *element, of));
        let of_ends = ends.into_iter().flatten().map(|end| largest(&self.brought(end, sender), of));
        let [low, high] = of_elements
            .chain(of_ends)
            .fold([f64::INFINITY, 0.0], |[low, high], share| [low.min(share), high.max(share)]);
        most.min(UNLIKE * (high - low) + ALIKE * high)
    }

    /// A bound on what an element receives of a sender, as the largest share of `of` in a band.
    fn share(&self, sender: usize, element: usize, of: &[f64]) -> f64 {
        let most =
            |SentPiece { radiosity, column }: &SentPiece| column.factor(element) * largest(radiosity, of);
        self.pieces[sender].iter().map(most).sum()
    }
}

impl SentPiece {
    /// Adds what elements receive of it, elements × bands.
    fn shine(&self, received: &mut [f64]) {
        let bands = self.radiosity.len();
        for (element, factor) in self.column.iter() {
            add(&mut received[element * bands..][..bands], factor, &self.radiosity);
        }
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
