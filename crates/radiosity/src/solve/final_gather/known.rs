//! What elements are known to receive of every patch, and what a point among them receives.
use super::around::PlaceAmong;
use super::senders::Sender;
use crate::error::Error;
use crate::solve::state::{Column, KEPT};
use crate::solve::{factors::Factors, run::Run, workers::attempt};
use formfactor::DifferentialArea;
use rayon::prelude::*;
use std::sync::Arc;

/// The share of its light that a point may receive from patches that it does not look at itself.
const UNSEEN: f64 = 0.1;
/// Pieces are looked at one by one where that may change more than this share.
const UNEVEN: f64 = 0.005;
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
    pub(super) fn look(&self, run: &Run<'_>, vertices: &[PlaceAmong<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        let factors = &run.factors;
        let points: Vec<DifferentialArea> = vertices.iter().map(|(point, _)| *point).collect();
        let straight = factors.straight(&points)?;
        let of: Vec<Vec<f64>> =
            vertices.iter().map(|(_, around)| self.brightness(&run.light.irradiance, around)).collect();
        let at = |(index, (point, around)): (usize, &PlaceAmong<'_>)| {
            let [lamps, beyond] = &straight[index];
            let mut light: Vec<f64> =
                lamps.iter().zip(beyond).map(|(lamps, beyond)| lamps + beyond).collect();
            self.add_reflected(factors, (point, *around), &of[index], &mut light);
            light
        };
        attempt("the final gather", || vertices.par_iter().enumerate().map(at).collect())
    }

    /// About how bright a vertex is, per band, but no less than what counts.
    fn brightness(&self, irradiance: &[f64], around: &[(usize, f64)]) -> Vec<f64> {
        let bands = self.mean.len();
        let mean = |band: usize| -> f64 {
            around.iter().map(|(element, share)| share * irradiance[element * bands + band]).sum()
        };
        let least = |(band, whole): (usize, &f64)| mean(band).max(DIM * whole).max(f64::MIN_POSITIVE);
        self.mean.iter().enumerate().map(least).collect()
    }

    /// Adds what a point receives of patches, the elements around it with their shares; `of` is how bright it is.
    fn add_reflected(
        &self,
        factors: &Factors<'_>,
        (point, around): (&DifferentialArea, &[(usize, f64)]),
        of: &[f64],
        light: &mut [f64],
    ) {
        let bands = of.len();
        let mut rest = vec![0.0; bands];
        for (element, share) in around {
            add(&mut rest, *share, &self.received[element * bands..][..bands]);
        }
        for sender in self.brightest(point, of) {
            self.senders[sender].shine(factors, point, (of, UNEVEN), light);
            for SentPiece { radiosity, column } in &self.pieces[sender] {
                let seen: f64 = around.iter().map(|(element, share)| share * column.factor(*element)).sum();
                add(&mut rest, -seen, radiosity);
            }
        }
        light.iter_mut().zip(rest).for_each(|(light, rest)| *light += rest.max(0.0));
    }

    /// The lights, and the senders that may bring the most to a point: all others together bring no more than a share of its light.
    fn brightest(&self, point: &DifferentialArea, of: &[f64]) -> impl Iterator<Item = usize> {
        let most = self.senders.iter().map(|sender| sender.most(point, of));
        let mut most: Vec<(f64, usize)> = most.zip(0..).filter(|(most, _)| *most > 0.0).collect();
        most.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        most.into_iter().filter_map(move |(most, sender)| {
            let emits = self.senders[sender].emits;
            sum += if emits { 0.0 } else { most };
            (emits || sum > UNSEEN).then_some(sender)
        })
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
