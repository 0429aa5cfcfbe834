//! Many expressions on many threads.

use crate::expression::csg::Csg;
use crate::pipeline::scratch::Scratch;
use crate::region::Region;
use rayon::prelude::*;

impl Csg<'_> {
    /// Evaluates many expressions on the threads of rayon's current pool.
    ///
    /// The regions stand in the order of the jobs, and each is bit for bit what [`evaluate`](Csg::evaluate) returns, for any
    /// number of threads. Buffers are reused from job to job. Needs the feature `rayon`.
    ///
    /// ```
    /// use polycsg::{Csg, FillRule, Region};
    /// let square = |x: f64| [[x, 0.0], [x + 2.0, 0.0], [x + 2.0, 2.0], [x, 2.0]];
    /// let windows: Result<Vec<_>, _> =
    ///     (0..9).map(|i| Region::from_rings([square(f64::from(i))], FillRule::NonZero)).collect();
    /// let windows = windows?;
    /// let jobs: Vec<Csg> = windows.windows(2).map(|pair| Csg::from(&pair[0]) & Csg::from(&pair[1])).collect();
    /// assert!(Csg::evaluate_all(&jobs).iter().all(|common| common.area() == 2.0));
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn evaluate_all(jobs: &[Csg<'_>]) -> Vec<Region> {
        jobs.par_iter().map_init(Scratch::default, |scratch, job| job.evaluate_with(scratch)).collect()
    }
}
