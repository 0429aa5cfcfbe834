//! Form factors between polygons with a bound that holds.
use super::integral::{Allowed, Integral};
use super::pair::Outlook;
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
    pub fn bounded_area_form_factor(
        &self,
        from: usize,
        to: usize,
        tolerance: impl Into<Tolerance>,
        limits: &Limits,
    ) -> Result<Option<BoundedFormFactor>, Error> {
        let tolerance = tolerance.into();
        tolerance.check()?;
        if !self.face([from, to]) {
            return Ok(Some(BoundedFormFactor::default()));
        }
        let areas = [from, to].map(|id| self.area(id));
        let allowed = Allowed {
            absolute: tolerance.absolute * areas[0].min(areas[1]),
            relative: tolerance.relative,
            of_whole: f64::INFINITY,
            equal: 0.0,
            evaluations: limits.per_pair.min(limits.in_all),
        };
        let [first, second] = [from.min(to), from.max(to)];
        let outlook = Outlook::from(self.surfaces(), first);
        let found = outlook.proven(second, &allowed, self.deviation(), limits.stop);
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
