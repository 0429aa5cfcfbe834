//! Links: pairs of tiles that exchange light as a whole.
use super::transfer::Transfer;
use std::sync::Arc;

/// What share of a tile may be seen though no point of either sees any of the other.
pub(super) const UNSEEN: f64 = 0.02;

/// A pair of tiles that is to be linked.
#[derive(Clone, Debug)]
pub(super) struct Candidate {
    pub(super) ends: [usize; 2],
    /// What may stand between them, and more.
    pub(super) among: Arc<[u32]>,
    /// What share may be seen though nothing is: it halves with each cut of a pair that does not see each other.
    pub(super) unseen: f64,
    /// Which pair of whole tiles they are parts of.
    pub(super) pair: usize,
    /// No more than this passes between these.
    pub(super) most: f64,
}

/// Two tiles that exchange light as a whole, both ways.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) ends: [usize; 2],
    /// What may stand between them.
    pub(super) among: Arc<[u32]>,
    unseen: f64,
    /// Which pair of whole tiles they are parts of.
    pub(super) pair: usize,
    /// As measured.
    pub(super) transfer: Arc<Transfer>,
    /// What passes: as measured, or by what all links of the pair are known to exchange.
    pub(super) exchange: [f64; 9],
    /// Its share of what all links of the pair may be off by together, where that is known.
    pub(super) of_total: Option<f64>,
    /// No more than this passes between all of the pair.
    pub(super) most: f64,
    /// Of each end, see [`Transfer::curvature`].
    curvatures: [f64; 2],
    /// See [`Transfer::locality`].
    pub(super) locality: f64,
}

impl Link {
    /// The link of a candidate; nothing where no light can pass.
    pub(super) fn new(candidate: &Candidate, among: Arc<[u32]>, transfer: Arc<Transfer>) -> Option<Link> {
        let Candidate { ends, unseen, pair, most, .. } = *candidate;
        let (exchange, locality) = (transfer.exchange, transfer.locality());
        let curvatures = [0, 1].map(|end| transfer.curvature(end, !among.is_empty()));
        let of_total = None;
        let link =
            Link { ends, among, unseen, pair, transfer, exchange, of_total, most, curvatures, locality };
        (link.transfer.exchange[0] > 0.0 || link.error() > 0.0).then_some(link)
    }

    /// Carries so much of constant light, and of other light in proportion.
    pub(super) fn carry(&mut self, whole: f64) {
        let measured = self.transfer.exchange;
        self.exchange = if measured[0] > 0.0 {
            measured.map(|g| g * (whole / measured[0]).max(0.0))
        } else {
            [whole.max(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        };
    }

    /// The estimated error of the light that passes, for a radiosity of 1.
    pub(super) fn error(&self) -> f64 {
        (self.transfer.error + self.unseen * self.transfer.open).min(self.most)
    }

    /// See [`Transfer::curvature`].
    pub(super) fn curvature(&self, end: usize) -> f64 {
        self.curvatures[end]
    }

    /// The two pairs that take its place when one end is cut.
    pub(super) fn parts(&self, end: usize, halves: [usize; 2]) -> [Candidate; 2] {
        let unseen = if self.transfer.open > 0.0 { self.unseen / 2.0 } else { UNSEEN };
        halves.map(|half| {
            let mut ends = self.ends;
            ends[end] = half;
            Candidate { ends, among: self.among.clone(), unseen, pair: self.pair, most: self.most }
        })
    }
}
