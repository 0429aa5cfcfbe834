//! What elements are known to receive of every patch, and what a point among them receives.
use super::around::PlaceAmong;
use super::senders::Sender;
use crate::error::Error;
use crate::solve::{factors::Factors, run::Run, workers::attempt};
use formfactor::DifferentialArea;
use rayon::prelude::*;

/// The share of its light that a point may receive from patches that it does not look at itself.
const UNSEEN: f64 = 0.1;
/// Pieces are looked at one by one where that may change more than this share.
const UNEVEN: f64 = 0.005;
/// What is darker than this share of the mean counts as that bright.
const DIM: f64 = 0.01;

/// What elements receive of the pieces that shot.
pub(super) struct Known {
    /// The patches that send light.
    senders: Vec<Sender>,
    /// What each piece of them sends, per band.
    pieces: Vec<Vec<f64>>,
    /// For each element what it sees.
    rows: Vec<Vec<Seen>>,
    /// The mean irradiance, per band.
    mean: Vec<f64>,
}

/// What an element sees of a piece.
#[derive(Clone, Copy)]
struct Seen {
    sender: usize,
    piece: usize,
    factor: f64,
}

impl Known {
    /// What the elements of a run received; nothing when the watcher wants to stop.
    pub(super) fn of(run: &mut Run<'_>) -> Result<Option<Known>, Error> {
        let (subdivision, count) = (run.factors.subdivision, run.light.areas.len());
        let nodes = &subdivision.nodes;
        let area: f64 = run.light.areas.iter().sum();
        let mean = run.light.total(&run.light.irradiance).iter().map(|power| power / area).collect();
        let mut known =
            Known { senders: Vec::new(), pieces: Vec::new(), rows: vec![Vec::new(); count], mean };
        let mut of_patch = vec![None; nodes.len()];
        let front: Vec<usize> = run.shooters.front().collect();
        for node in front {
            if !run.sends(node) {
                continue;
            }
            let patch = nodes[node].patch;
            let sender = match of_patch[patch] {
                Some(sender) => sender,
                None => known.add(Sender::of_node(&run.factors, &run.light, patch)?),
            };
            of_patch[patch] = Some(sender);
            let piece = known.pieces.len();
            known.pieces.push(run.light.mean_radiosity(nodes[node].elements.clone()));
            let Some(column) = run.column(node)? else { return Ok(None) };
            for (element, factor) in column.iter() {
                known.rows[element].push(Seen { sender, piece, factor });
            }
        }
        Ok(Some(known))
    }

    fn add(&mut self, sender: Sender) -> usize {
        self.senders.push(sender);
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
        let mut is_seen = vec![false; self.senders.len()];
        for sender in self.brightest(point, of) {
            is_seen[sender] = true;
            self.senders[sender].shine(factors, point, (of, UNEVEN), light);
        }
        for (element, share) in around {
            for Seen { sender, piece, factor } in &self.rows[*element] {
                if !is_seen[*sender] {
                    let sent = light.iter_mut().zip(&self.pieces[*piece]);
                    sent.for_each(|(light, sent)| *light += share * factor * sent);
                }
            }
        }
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
