//! The operations that run the pipeline, on expressions and on regions.

use crate::base::meter::Meter;
use crate::boundary::Boundary;
use crate::error::Error;
use crate::expression::csg::{Csg, FillRule};
use crate::limits::Limits;
use crate::pipeline::{self, scratch::Scratch};
use crate::region::Region;
use glam::DVec2;

impl Csg<'_> {
    /// Evaluates the expression to a valid [`Region`]. Expected O((n + k) log n) for n edges with k contacts.
    ///
    /// # Panics
    /// Beyond 2^32 − 2 edges and contacts, which take hundreds of gigabytes; nothing else panics.
    #[must_use]
    pub fn evaluate(&self) -> Region {
        self.evaluate_with(&mut Scratch::default())
    }

    /// Like [`evaluate`](Csg::evaluate), with buffers that the caller keeps from call to call: faster for many small jobs.
    pub fn evaluate_with(&self, scratch: &mut Scratch) -> Region {
        pipeline::region(self, scratch, &Meter::default()).expect("no limit was given")
    }

    /// Like [`evaluate_with`](Csg::evaluate_with), within limits: for untrusted input, and to be stopped. A number limits how often
    /// edges meet.
    ///
    /// # Errors
    /// [`Error::TooManyContacts`], [`Error::TooMuchWork`] and [`Error::Stopped`]. The scratch can be used again.
    ///
    /// ```
    /// use polycsg::{Csg, Error, FillRule, Scratch};
    /// let bars = |n: usize| (0..n).map(|i| 2.0 * i as f64);
    /// let upright = bars(50).map(|x| vec![[x, -1.0], [x + 1.0, -1.0], [x + 1.0, 100.0], [x, 100.0]]);
    /// let level = bars(50).map(|y| vec![[-1.0, y], [100.0, y], [100.0, y + 1.0], [-1.0, y + 1.0]]);
    /// let both = Csg::from_rings(upright, FillRule::NonZero)? & Csg::from_rings(level, FillRule::NonZero)?;
    /// let mut scratch = Scratch::default();
    /// let limit = 10_000; // 100 by 100 edges cross, and each crossing is a contact of both
    /// assert_eq!(both.try_evaluate_with(&mut scratch, limit), Err(Error::TooManyContacts { limit }));
    /// assert_eq!(both.try_evaluate_with(&mut scratch, 2 * limit)?.area(), 2500.0);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn try_evaluate_with<'l>(
        &self,
        scratch: &mut Scratch,
        limits: impl Into<Limits<'l>>,
    ) -> Result<Region, Error> {
        let meter = Meter::new(limits.into());
        pipeline::region(self, scratch, &meter).map_err(|refusal| meter.error(refusal))
    }

    /// The directed edges that bound the set, interior to the left, each vertex rounded once.
    ///
    /// A boundary is cheaper than a region, as nothing is repaired, linked to rings or nested. Use it to sum over edges, for the
    /// area alone, to see whether anything is left, or to see which operand an edge comes from.
    ///
    /// ```
    /// use polycsg::{Csg, FillRule, Region, Scratch};
    /// let square = |x: f64| [[x, 0.0], [x + 2.0, 0.0], [x + 2.0, 2.0], [x, 2.0]];
    /// let (a, b) = (Region::from_rings([square(0.0)], FillRule::NonZero)?, Region::from_rings([square(1.0)], FillRule::NonZero)?);
    /// let mut scratch = Scratch::default();
    /// let rest = Csg::from(&a) - Csg::from(&b);
    /// let boundary = rest.boundary(&mut scratch);
    /// assert_eq!((boundary.is_empty(), boundary.area()), (false, 2.0));
    /// // On the right it is bounded by operand 1, by the edge from its point 3 to its point 0.
    /// let right = boundary.edges().find(|edge| edge.start.x == 1.0 && edge.end.x == 1.0).expect("an edge");
    /// assert_eq!((right.operand, right.edge), (1, 3));
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    pub fn boundary<'s>(&self, scratch: &'s mut Scratch) -> Boundary<'s> {
        pipeline::boundary(self, scratch, &Meter::default()).expect("no limit was given")
    }

    /// Like [`boundary`](Csg::boundary), within limits.
    ///
    /// # Errors
    /// Those of [`try_evaluate_with`](Csg::try_evaluate_with). The scratch can be used again.
    ///
    /// ```
    /// use polycsg::{Csg, Error, FillRule, Limits, Scratch};
    /// let star = [(0.0, 3.0), (-1.8, -2.4), (2.9, 0.9), (-2.9, 0.9), (1.8, -2.4)];
    /// let star = Csg::from_rings([star], FillRule::NonZero)?;
    /// let mut scratch = Scratch::default();
    /// let refused = star.try_boundary(&mut scratch, 9).map(|boundary| boundary.area());
    /// assert_eq!(refused, Err(Error::TooManyContacts { limit: 9 })); // five crossings, each a contact of two edges
    /// assert_eq!(star.try_boundary(&mut scratch, Limits::default().work(1000))?.edges().count(), 10);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn try_boundary<'s, 'l>(
        &self,
        scratch: &'s mut Scratch,
        limits: impl Into<Limits<'l>>,
    ) -> Result<Boundary<'s>, Error> {
        let meter = Meter::new(limits.into());
        pipeline::boundary(self, scratch, &meter).map_err(|refusal| meter.error(refusal))
    }
}

impl Region {
    /// The region that raw rings enclose under a fill rule.
    ///
    /// The rings may intersect themselves and one another, nest, touch, overlap, have spikes and repeated points (the
    /// first may be repeated as the last, as in GeoJSON). Rings without area add nothing. Anything that yields slices of
    /// points will do, where a point is a `DVec2`, an `[f64; 2]` or an `(f64, f64)`: `Vec<Vec<[f64; 2]>>`, `&[Vec<DVec2>]`,
    /// `[&[(f64, f64)]; 1]`, … Expected O((n + k) log n) for n edges with k contacts.
    ///
    /// ```
    /// use polycsg::{FillRule, Region};
    /// // A pentagram crosses itself five times: even-odd leaves its middle out.
    /// let star = [(0.0, 3.0), (-1.8, -2.4), (2.9, 0.9), (-2.9, 0.9), (1.8, -2.4)];
    /// let points = Region::from_rings([&star[..]], FillRule::EvenOdd)?;
    /// assert_eq!(points.polygons().count(), 5);
    /// let filled = Region::from_rings([&star[..]], FillRule::NonZero)?;
    /// assert_eq!(filled.polygons().next().expect("a star").outer().len(), 10);
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NonFinite`] names the first ring and vertex with a NaN or an infinity.
    pub fn from_rings<R, P>(rings: R, rule: FillRule) -> Result<Region, Error>
    where
        R: IntoIterator,
        R::Item: AsRef<[P]>,
        P: Copy + Into<DVec2>,
    {
        Ok(Csg::from_rings(rings, rule)?.evaluate())
    }

    /// A ∪ B, all points in at least one of the two. For more operands use [`Csg::union`]: one call is faster than many, and
    /// rounds once.
    ///
    /// ```
    /// use polycsg::{FillRule, Region};
    /// let square = |x: f64| Region::from_rings([[[x, 0.0], [x + 2.0, 0.0], [x + 2.0, 2.0], [x, 2.0]]], FillRule::NonZero);
    /// let (a, b) = (square(0.0)?, square(1.0)?);
    /// assert_eq!(a.union(&b).area(), 6.0);
    /// assert_eq!(a.intersection(&b).area(), 2.0);
    /// assert_eq!(a.difference(&b).area(), 2.0);
    /// assert_eq!(a.symmetric_difference(&b).area(), 4.0);
    /// # Ok::<(), polycsg::Error>(())
    /// ```
    #[must_use]
    pub fn union(&self, other: &Region) -> Region {
        (Csg::from(self) | Csg::from(other)).evaluate()
    }

    /// A ∩ B, all points in both.
    #[must_use]
    pub fn intersection(&self, other: &Region) -> Region {
        (Csg::from(self) & Csg::from(other)).evaluate()
    }

    /// A − B, all points in this region but not in the other.
    #[must_use]
    pub fn difference(&self, other: &Region) -> Region {
        (Csg::from(self) - Csg::from(other)).evaluate()
    }

    /// A ⊕ B, all points in exactly one of the two.
    #[must_use]
    pub fn symmetric_difference(&self, other: &Region) -> Region {
        (Csg::from(self) ^ Csg::from(other)).evaluate()
    }

    /// The region that these rings bound by their direction, evaluated again.
    pub(crate) fn evaluated_again(&self) -> Region {
        Csg::positive(self.rings_of().clone()).evaluate_with(&mut Scratch::default())
    }
}
