//! Form factors between polygons with a bound that holds.
use super::integral::{Allowed, Integral};
use super::pair::Outlook;
use super::part::{End, Part};
use super::tolerance::{Limits, Tolerance};
use crate::error::Error;
use crate::scene::enclosure::Enclosure;

/// A form factor from a polygon to a polygon, with a bound on its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct BoundedFormFactor {
    /// The fraction of the power leaving the front of the first polygon that reaches the front of the second directly: a number
    /// from 0 to 1, without a unit.
    pub value: f64,
    /// |value - exact| is at most this, where *exact* is for the doubles of the input as given.
    pub error_bound: f64,
    /// The number of cells that were looked from; 0 for a closed form.
    pub evaluations: u64,
}

impl Enclosure {
    /// [`Enclosure::area_form_factor`] as an interval: the exact form factor lies within `error_bound` of `value`, for certain.
    /// `None` once `limits` stop it.
    ///
    /// One polygon is cut into cells. On a cell from which all shapes are alike the point form factor is known as a polynomial with
    /// a bound on what it leaves out (a Taylor model, roundings included); any other cell sees between nothing and all of the other
    /// polygon. Cells are cut and halved until the bound of both directions is within `tolerance`, or until `limits` on evaluations are
    /// reached: compare `error_bound` with `tolerance`. What rounding and deviation may move edges by counts with the area that they
    /// sweep: the bound does not fall below some 1e-11.
    ///
    /// At 1e-4 a pair past obstructions takes about as many evaluations as its estimate (of 1 000 pairs half took fewer, 95 % less
    /// than 5 times as many), each some 50 times as long; at 1e-6 five times as many. Where edges of both are
    /// parallel or perpendicular and nothing stands in between it is a closed form.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive, [`Error::OffSurface`] for a part that is not in its polygon's plane.
    ///
    /// # Panics
    /// When there is no polygon with one of the ids.
    ///
    /// ```
    /// use formfactor::{Enclosure, Limits, PlanarPolygon};
    /// // Unit squares, one above the other, and a board in between that hides some of each.
    /// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
    /// let ceiling = PlanarPolygon::new([[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]]])?;
    /// let board = PlanarPolygon::new([[[0.0, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 1.0, 0.5], [0.0, 1.0, 0.5]]])?;
    /// let room = Enclosure::new(vec![floor, ceiling, board]);
    /// let f = room.bounded_area_form_factor(0, 1, 1e-4, &Limits::default())?.expect("no stop");
    /// assert!(f.error_bound <= 1e-4);
    /// let estimate = room.area_form_factor(0, 1, 1e-9, &Limits::default())?.expect("no stop");
    /// assert!((f.value - estimate.value).abs() <= f.error_bound);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    pub fn bounded_area_form_factor<'p>(
        &self,
        from: impl Into<Part<'p>>,
        to: impl Into<Part<'p>>,
        tolerance: impl Into<Tolerance>,
        limits: &Limits,
    ) -> Result<Option<BoundedFormFactor>, Error> {
        let tolerance = tolerance.into();
        tolerance.check()?;
        let [from, to] = [End::of(self, from.into())?, End::of(self, to.into())?];
        if !from.faces(&to) {
            return Ok(Some(BoundedFormFactor::default()));
        }
        let areas = [&from, &to].map(|end| end.surface.area);
        let allowed = Allowed {
            absolute: tolerance.absolute * areas[0].min(areas[1]),
            relative: tolerance.relative,
            of_root: f64::INFINITY,
            equal: 0.0,
            evaluations: limits.per_pair.min(limits.in_all),
        };
        let [first, second] = if from.id <= to.id { [&from, &to] } else { [&to, &from] };
        let deviation = self.deviation().max(from.deviation).max(to.deviation);
        let outlook = Outlook::toward(self.surfaces(), &first.surface, &second.surface);
        let found = outlook.proven(&second.surface, &allowed, deviation, limits.stop);
        Ok(found.map(|found| bounded(&found, areas[0])))
    }
}

fn bounded(found: &Integral, area: f64) -> BoundedFormFactor {
    let [value, error] = [found.value / area, found.error / area];
    BoundedFormFactor {
        value: value.clamp(0.0, 1.0),
        error_bound: (error * (1.0 + 4.0 * f64::EPSILON)).min(1.0),
        evaluations: found.evaluations,
    }
}
