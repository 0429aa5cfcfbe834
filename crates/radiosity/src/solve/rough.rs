//! Form factors that are so small that they may be taken roughly.
//!
//! Most pairs of a detailed scene are a small patch and an element far away. What an element sees of the smallest ones, all together, is no
//! more than a share of its view, however much of them is hidden: so much, and no more, is wrong where nothing is found out of what hides
//! them.
use super::ball::Ball;
use super::workers::from_all;
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};
use formfactor::DifferentialArea;

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
}

impl Rough {
    /// Nothing is small yet; nothing at all among very many patches and elements.
    pub(super) fn among(scene: &Scene, elements: usize, share: f64) -> Option<Rough> {
        let ball = |patch: &Patch| (!patch.emits()).then(|| Ball::around(&patch.polygon));
        let are_few = scene.patches.len().saturating_mul(elements) <= MOST;
        are_few.then(|| Rough { balls: scene.patches.iter().map(ball).collect(), share, limits: Vec::new() })
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
