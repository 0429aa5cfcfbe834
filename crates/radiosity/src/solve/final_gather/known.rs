//! What elements are known to receive of every patch, and what a point among them receives.
use super::outlook::Outlook;
use super::senders::Sender;
use crate::error::Error;
use crate::solve::state::{Column, KEPT};
use crate::solve::{factors::Factors, run::Run, workers::attempt};
use rayon::prelude::*;
use std::sync::Arc;

/// The share of its light that a point may receive from patches that it does not look at itself.
const UNSEEN: f64 = 0.1;
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

    /// What vertices receive, for each and each band.
    pub(super) fn look(&self, run: &Run<'_>, outlooks: &[Outlook]) -> Result<Vec<Vec<f64>>, Error> {
        let factors = &run.factors;
        let points: Vec<_> = outlooks.iter().map(|outlook| outlook.point).collect();
        let straight = factors.straight(&points)?;
        let at = |(outlook, [lamps, beyond]): (&Outlook, &[Vec<f64>; 2])| {
            let mut light: Vec<f64> =
                lamps.iter().zip(beyond).map(|(lamps, beyond)| lamps + beyond).collect();
            self.add_reflected(factors, outlook, &mut light);
            light
        };
        attempt("the final gather", || outlooks.par_iter().zip(&straight).map(at).collect())
    }

    /// Adds what a vertex receives of patches: what the elements around it do, but for those that it looks at itself.
    fn add_reflected(&self, factors: &Factors<'_>, outlook: &Outlook, light: &mut [f64]) {
        let (bands, around) = (light.len(), &outlook.around);
        let of = self.at_least(&outlook.mean);
        let mut rest = vec![0.0; bands];
        for (element, share) in around {
            add(&mut rest, *share, &self.received[element * bands..][..bands]);
        }
        for sender in self.seen(outlook, &of) {
            self.senders[sender].shine(factors, &outlook.point, &of, light);
            for SentPiece { radiosity, column } in &self.pieces[sender] {
                let seen: f64 = around.iter().map(|(element, share)| share * column.factor(*element)).sum();
                add(&mut rest, -seen, radiosity);
            }
        }
        light.iter_mut().zip(rest).for_each(|(light, rest)| *light += rest.max(0.0));
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

    /// The senders that a vertex looks at: lights, and from wide ones those that may bring the most. All others together bring no more than a
    /// share of its light.
    fn seen(&self, outlook: &Outlook, of: &[f64]) -> Vec<usize> {
        let most = self.senders.iter().map(|sender| sender.most(&outlook.point, of)).zip(0..);
        let (mut seen, mut others): (Vec<_>, Vec<_>) =
            most.filter(|(most, _)| *most > 0.0).partition(|(_, sender)| self.senders[*sender].emits);
        if outlook.is_wide {
            others.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut sum = 0.0;
            seen.extend(others.into_iter().filter(|(most, _)| {
                sum += most;
                sum > UNSEEN
            }));
        }
        seen.into_iter().map(|(_, sender)| sender).collect()
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

/// Adds a share of the light of each band.
fn add(to: &mut [f64], share: f64, light: &[f64]) {
    to.iter_mut().zip(light).for_each(|(to, light)| *to += share * light);
}
