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
}

/// Two tiles that exchange light as a whole, both ways.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub(super) ends: [usize; 2],
    /// What may stand between them.
    pub(super) among: Arc<[u32]>,
    unseen: f64,
    pub(super) transfer: Arc<Transfer>,
}

impl Link {
    /// The link of a candidate; nothing where no light can pass.
    pub(super) fn new(candidate: &Candidate, among: Arc<[u32]>, transfer: Arc<Transfer>) -> Option<Link> {
        let link = Link { ends: candidate.ends, among, unseen: candidate.unseen, transfer };
        (link.transfer.exchange[0] > 0.0 || link.error() > 0.0).then_some(link)
    }

    /// The estimated error of the light that passes, for a radiosity of 1.
    pub(super) fn error(&self) -> f64 {
        self.transfer.error + self.unseen * self.transfer.open
    }

    /// See [`Transfer::curvature`].
    pub(super) fn curvature(&self, end: usize) -> f64 {
        self.transfer.curvature(end, !self.among.is_empty())
    }

    /// The two pairs that take its place when one end is cut.
    pub(super) fn parts(&self, end: usize, halves: [usize; 2]) -> [Candidate; 2] {
        let unseen = if self.transfer.open > 0.0 { self.unseen / 2.0 } else { UNSEEN };
        halves.map(|half| {
            let mut ends = self.ends;
            ends[end] = half;
            Candidate { ends, among: self.among.clone(), unseen }
        })
    }
}
