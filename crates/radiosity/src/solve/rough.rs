//! Form factors that are so small that they may be taken roughly.
//!
//! Most pairs of a detailed scene are a small patch and an element far away. What an element sees of the smallest ones, all together, is no
//! more than a share of its view, however much of them is hidden: so much, and no more, is wrong where nothing is found out of what hides
//! them.
use super::ball::Ball;
use super::workers::from_all;
use crate::error::Error;
use crate::scene::Scene;
use formfactor::DifferentialArea;

/// Among more pairs of patches and elements the small ones are not looked for: it would take longer than a first shot may.
const MOST: usize = 1 << 25;

/// Which form factors may be taken roughly.
#[derive(Debug)]
pub(super) struct Rough {
    /// Around each patch; nothing for one that emits.
    balls: Vec<Option<Ball>>,
    /// For each element, what bounds on its small form factors are below.
    limits: Vec<f64>,
}

impl Rough {
    /// From each element, the smallest patches that fill no more than `share` of its view together, whatever hides them. Nothing among very
    /// many pairs.
    ///
    /// Takes O(n log n) for each element among n patches.
    pub(super) fn find(
        scene: &Scene,
        elements: &[DifferentialArea],
        share: f64,
    ) -> Result<Option<Rough>, Error> {
        if scene.patches.len().saturating_mul(elements.len()) > MOST {
            return Ok(None);
        }
        let balls: Vec<_> = scene
            .patches
            .iter()
            .map(|patch| (!patch.emits()).then(|| Ball::around(&patch.polygon)))
            .collect();
        let limits = from_all(elements, "what is small", |from| limit(&balls, from, share))?;
        Ok(Some(Rough { balls, limits }))
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
