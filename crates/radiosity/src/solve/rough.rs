//! Form factors that are so small that they may be taken roughly.
//!
//! Most pairs of a detailed scene are a small patch and an element far away. What an element sees of the smallest ones, all together, is no
//! more than a share of its view, however much of them is hidden: so much, and no more, is wrong where nothing is found out of what hides
//! them.
use super::{ball::Ball, patch_clusters::PatchClusters, workers::from_all};
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};
use formfactor::{DifferentialArea, Enclosure, PlanarPolygon};
use glam::DVec3;
use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

/// Among more pairs of patches and elements the small ones are not looked for: it would take longer than a first shot may.
const MOST: usize = 1 << 25;

/// Which form factors may be taken roughly.
#[derive(Debug)]
pub(super) struct Rough {
    /// Around each patch; nothing for one that emits.
    balls: Vec<Option<Ball>>,
    /// The share of an element's view.
    pub(super) share: f64,
    /// For each element, what bounds on its small form factors are below.
    pub(super) limits: Vec<f64>,
    /// The mean of each patch's vertices.
    middles: Vec<DVec3>,
    clusters: PatchClusters,
    elements: usize,
    /// For each cluster and each element: whether it sees the cluster.
    seen: Vec<AtomicU8>,
}

/// What is known of an element and a cluster. Whoever asks at once finds the same.
const UNKNOWN: u8 = 0;
const HIDDEN: u8 = 1;
const SEEN: u8 = 2;

/// A group of elements near each other: which one is the first, and where all receive.
pub(super) type ElementGroup<'g> = (usize, &'g [DifferentialArea]);

impl Rough {
    /// Nothing is small yet; nothing at all among very many patches and elements.
    ///
    /// Takes O(n log² n) for n patches, and a byte for each cluster of these and each element.
    pub(super) fn among(scene: &Scene, elements: usize, share: f64) -> Option<Rough> {
        let ball = |patch: &Patch| (!patch.emits()).then(|| Ball::around(&patch.polygon));
        let are_few = scene.patches.len().saturating_mul(elements) <= MOST;
        are_few.then(|| {
            let balls: Vec<_> = scene.patches.iter().map(ball).collect();
            let clusters = PatchClusters::of(&balls);
            let seen = (0..clusters.len() * elements).map(|_| AtomicU8::new(UNKNOWN)).collect();
            let middles = scene.patches.iter().map(|patch| middle(&patch.polygon)).collect();
            Rough { balls, share, limits: Vec::new(), middles, clusters, elements, seen }
        })
    }

    /// The limits of some elements: from each, the smallest patches fill no more than the share of its view together, whatever hides them.
    ///
    /// Takes O(n log n) for each element among n patches.
    pub(super) fn limits(&self, elements: &[DifferentialArea]) -> Result<Vec<f64>, Error> {
        from_all(elements, "what is small", |from| limit(&self.balls, from, self.share))
    }

    /// Whether the form factors from an element to a patch, and to all parts of it, may be taken roughly.
    pub(super) fn is_small(&self, element: usize, from: &DifferentialArea, patch: usize) -> bool {
        self.balls[patch].as_ref().is_some_and(|ball| ball.most_seen(from) < self.limits[element])
    }

    /// The form factors from some of a group to a part of a patch in a ball: where its cluster is seen, those of the ball's disk.
    pub(super) fn factors(
        &self,
        enclosure: &Enclosure,
        group: ElementGroup<'_>,
        some: &[usize],
        (patch, ball): (usize, &Ball),
    ) -> Vec<f64> {
        let Some(cluster) = self.clusters.of_patch(patch).filter(|_| !some.is_empty()) else {
            return vec![0.0; some.len()];
        };
        let (first, points) = group;
        let known = &self.seen[cluster * self.elements + first..][..points.len()];
        let told = |at: &usize| known[*at].load(Relaxed);
        if some.iter().any(|at| told(at) == UNKNOWN) {
            let seen = self.who_sees(enclosure, points, cluster);
            known
                .iter()
                .zip(seen)
                .for_each(|(known, sees)| known.store(if sees { SEEN } else { HIDDEN }, Relaxed));
        }
        some.iter().map(|at| if told(at) == SEEN { ball.disk(&points[*at]) } else { 0.0 }).collect()
    }

    /// Which points near each other see a cluster: the middle of the patch in it that looks largest from all that it faces.
    fn who_sees(&self, enclosure: &Enclosure, points: &[DifferentialArea], cluster: usize) -> Vec<bool> {
        let disk =
            |patch: usize, at: usize| self.balls[patch].as_ref().map_or(0.0, |ball| ball.disk(&points[at]));
        let (mut seen, mut left) = (vec![false; points.len()], (0..points.len()).collect::<Vec<_>>());
        let look = |left: &[usize]| {
            let of_all = |&patch: &usize| (left.iter().map(|at| disk(patch, *at)).sum::<f64>(), patch);
            let largest =
                self.clusters.patches(cluster).iter().map(of_all).max_by(|a, b| a.0.total_cmp(&b.0));
            largest.filter(|(sum, _)| *sum > 0.0).map(|(_, patch)| patch)
        };
        while let Some(patch) = look(&left) {
            let (faced, others): (Vec<usize>, Vec<usize>) =
                left.iter().partition(|at| disk(patch, **at) > 0.0);
            let from: Vec<_> = faced.iter().map(|at| points[*at]).collect();
            let sees = enclosure.each_sees(&from, self.middles[patch]);
            faced.iter().zip(sees).for_each(|(at, sees)| seen[*at] = sees);
            left = others;
        }
        seen
    }
}

/// The mean of a polygon's vertices.
fn middle(polygon: &PlanarPolygon) -> DVec3 {
    let points = || polygon.loops().flatten();
    points().sum::<DVec3>() / points().count() as f64
}

/// The first of the bounds, in ascending order, that does not add up to a share or less with those before it.
fn limit(balls: &[Option<Ball>], from: &DifferentialArea, share: f64) -> f64 {
    let mut most: Vec<f64> = balls.iter().flatten().map(|ball| ball.most_seen(from)).collect();
    most.sort_unstable_by(f64::total_cmp);
    let mut sum = 0.0;
    let first = most.into_iter().find(|most| {
        sum += most;
        sum > share
    });
    first.unwrap_or(f64::INFINITY)
}
