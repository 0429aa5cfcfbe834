//! Many expressions, and many regions clipped by one, on many threads.

use crate::base::meter::{Meter, Refusal};
use crate::error::Error;
use crate::expression::csg::Csg;
use crate::limits::Limits;
use crate::pipeline::{self, scratch::Scratch};
use crate::region::{Location, Region, prepared::PreparedRegion};
#[cfg(feature = "rayon")]
use rayon::prelude::*;

#[cfg(feature = "rayon")]
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

impl PreparedRegion {
    /// What each of many regions has in common with this one, in their order: bit for bit what [`Region::intersection`] returns.
    ///
    /// A region whose box no edge of this one meets is copied or dropped, in O(log n) steps; of the others each takes
    /// O((m + k) log(m + k)) for its m edges and k of this region's n near its box. With the feature `rayon` they are clipped on the
    /// threads of rayon's current pool.
    ///
    /// ```
    /// use polycsg::{FillRule, PreparedRegion, Region};
    /// let square = |x: f64, size: f64| {
    ///     Region::from_rings([[[x, x], [x + size, x], [x + size, x + size], [x, x + size]]], FillRule::NonZero)
    /// };
    /// let clip = PreparedRegion::from(square(0.0, 10.0)?);
    /// let parts = clip.clip_all(&[square(1.0, 2.0)?, square(9.0, 2.0)?, square(11.0, 2.0)?]);
    /// assert_eq!(parts.iter().map(Region::area).collect::<Vec<_>>(), [4.0, 1.0, 0.0]);
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn clip_all(&self, regions: &[Region]) -> Vec<Region> {
        self.clip_each(regions, &Meter::default()).expect("no limit was given")
    }

    /// Like [`clip_all`](PreparedRegion::clip_all), within limits: on the work of all clips together, and on the contacts of each.
    ///
    /// # Errors
    /// Those of [`Csg::try_evaluate_with`]; where several limits are exceeded, any of these.
    ///
    /// ```
    /// use polycsg::{Error, FillRule, Limits, PreparedRegion, Region};
    /// let square = |x: f64| Region::from_rings([[[x, x], [x + 2.0, x], [x + 2.0, x + 2.0], [x, x + 2.0]]], FillRule::NonZero);
    /// let (clip, squares) = (PreparedRegion::from(square(0.0)?), [square(1.0)?, square(-1.0)?]);
    /// assert_eq!(clip.try_clip_all(&squares, 3), Err(Error::TooManyContacts { limit: 3 }));
    /// assert_eq!(clip.try_clip_all(&squares, Limits::default().work(10)), Err(Error::TooMuchWork { limit: 10 }));
    /// assert_eq!(clip.try_clip_all(&squares, Limits::default().contacts(4).work(1000))?, clip.clip_all(&squares));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn try_clip_all<'l>(
        &self,
        regions: &[Region],
        limits: impl Into<Limits<'l>>,
    ) -> Result<Vec<Region>, Error> {
        let meter = Meter::new(limits.into());
        self.clip_each(regions, &meter).map_err(|refusal| meter.error(refusal))
    }

    fn clip_each(&self, regions: &[Region], meter: &Meter<'_>) -> Result<Vec<Region>, Refusal> {
        #[cfg(feature = "rayon")]
        {
            let clip = |scratch: &mut Scratch, region| self.clip(region, scratch, meter);
            regions.par_iter().map_init(Scratch::default, clip).collect()
        }
        #[cfg(not(feature = "rayon"))]
        {
            let mut scratch = Scratch::default();
            regions.iter().map(|region| self.clip(region, &mut scratch, meter)).collect()
        }
    }

    fn clip(&self, region: &Region, scratch: &mut Scratch, meter: &Meter<'_>) -> Result<Region, Refusal> {
        meter.spend(1)?;
        match self.locate_window(&region.window()) {
            Location::Inside => Ok(region.clone()),
            Location::Outside => Ok(Region::default()),
            Location::Boundary => pipeline::region(&(Csg::from(region) & Csg::from(self)), scratch, meter),
        }
    }
}
