//! Form factors from polygon to polygon.
//!
//! F(i -> j) is the mean over polygon i of the exact point form factors to polygon j. Where nothing stands in between it
//! has a closed form; elsewhere it is taken by adaptive cubature, whose cells are cut where the view changes its shape.
mod bounded;
mod clip;
mod contact;
mod contour;
mod cubature;
mod estimate;
mod events;
mod hollow;
mod integral;
mod integrand;
mod kernel;
mod lambert;
mod pair;
mod part;
mod patch;
mod plan;
mod point;
mod proven;
mod queue;
mod silhouettes;
mod swept;
mod tolerance;
mod uncut;

use crate::error::Error;
use crate::scene::{enclosure::Enclosure, surfaces::Surface};
use crate::shapes::polygon::PlanarPolygon;
use integral::{Allowed, Integral};
use pair::{Outlook, unobstructed};
use part::End;
use point::Eye;

pub use bounded::BoundedFormFactor;
pub use part::Part;
pub use tolerance::{Limits, Tolerance};

/// A form factor from a polygon to a polygon, with an estimate of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct AreaFormFactor {
    /// The fraction of the power leaving the front of the first polygon that reaches the front of the second directly: a number
    /// from 0 to 1, without a unit.
    pub value: f64,
    /// An estimate of the error; it is not a bound: [`Enclosure::bounded_area_form_factor`] finds one.
    ///
    /// Where nothing stands in between, it is what Gauss's rules of the kernel err by, from the surfaces' sizes and their
    /// distance, or the differences and roundings of contour integrals. Elsewhere, where that is good enough, it is what rules err by as
    /// shadows sweep over the edges of what is seen, by their pace and length. Else one polygon is cut along the lines on which
    /// edges and vertices seem to meet, so that the integrand is analytic on each cell but where three edges seem to meet. Rules of few
    /// nodes take an a-priori share of what is hidden at most, which on different cells goes either way: the root of the sum of squares and an
    /// eighth of the sum. Finer ones take the differences between three rules, times what theory
    /// says is left of them: r^(-2n) for n nodes a side, r from the distance to what is looked at, or n^(-3) where three edges may
    /// meet. Cuts that are not made count with what they can change, and a cell that sees nothing with what its umbrae leave
    /// open.
    ///
    /// Of 20 000 fresh pairs past obstructions at seven tolerances from 1e-2 to 1e-8, none was off by more than its estimate
    /// (`--example obstructed_pairs` of the workspace's tests). It is mostly ten times the error and more.
    pub error_estimate: f64,
    /// The number of point form factors that were evaluated; 0 for a closed form.
    pub evaluations: u64,
}

/// What a polygon exchanges with others: their ids, the integrals over both, and the estimates of their errors.
pub(crate) type Exchanges = Vec<(usize, f64, f64)>;

/// A row of a matrix of form factors: the id of each polygon that is seen and the factor to it, in the order of the ids.
pub type Row = Vec<(usize, AreaFormFactor)>;

/// The form factor from one polygon to another where nothing is in between and each is wholly before the other's plane: in closed form, without
/// an [`Enclosure`](crate::Enclosure). `None` where one reaches behind the other, or roundings leave more than the tolerance.
///
/// Takes a few microseconds; the contour integrals of edges that touch take more than those of polygons apart.
///
/// # Errors
/// [`Error::BadTolerance`] unless the tolerance is positive.
///
/// ```
/// use formfactor::{PlanarPolygon, unoccluded_area};
/// // Unit squares with a common edge.
/// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
/// let wall = PlanarPolygon::new([[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1.0], [0.0, 0.0, 1.0]]])?;
/// let f = unoccluded_area(&floor, &wall, 1e-9)?;
/// assert!(f.is_some_and(|f| (f.value - 0.200_043_776_075_400_86).abs() < 1e-9));
/// # Ok::<(), formfactor::Error>(())
/// ```
pub fn unoccluded_area(
    from: &PlanarPolygon,
    to: &PlanarPolygon,
    tolerance: f64,
) -> Result<Option<AreaFormFactor>, Error> {
    Tolerance::from(tolerance).check()?;
    let [one, other] = [from, to].map(|polygon| Surface::new(polygon, 0, None));
    let absolute = tolerance * one.area.min(other.area);
    let (of_root, equal) = (f64::INFINITY, f64::INFINITY);
    let allowed = Allowed { absolute, relative: 0.0, of_root, equal, evaluations: 0 };
    Ok(unobstructed(&one, &other, &allowed).map(|found| factor(&found, one.area)))
}

impl Enclosure {
    /// The form factor from polygon `from` to polygon `to`, or between [parts](Part) of polygons, with all other polygons as occluders:
    /// the mean of the point form factors over the front of `from`. `None` once `limits` stop it.
    ///
    /// The integral is taken over one of both; A1 F12 = A2 F21 gives the other direction, so that reciprocity holds to
    /// rounding. Refinement stops when the estimated error of both directions is within `tolerance`, or when the limit on
    /// evaluations is reached: compare `error_estimate` with `tolerance`. Where nothing stands in between there are none; else it takes
    /// about 100 at 1e-2 and 1 000 at 1e-6 with one edge or a few near the line of sight, ten times as many with boxes.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive, [`Error::OffSurface`] for a part that is not in its polygon's plane.
    ///
    /// # Panics
    /// When there is no polygon with one of the ids.
    ///
    /// ```
    /// use formfactor::{Enclosure, Limits, PlanarPolygon};
    /// // Unit squares, one above the other.
    /// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
    /// let ceiling = PlanarPolygon::new([[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]]])?;
    /// let f = Enclosure::new(vec![floor, ceiling]).area_form_factor(0, 1, 1e-9, &Limits::default())?;
    /// assert!(f.is_some_and(|f| (f.value - 0.199_824_895_698_387_4).abs() < 1e-9));
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    pub fn area_form_factor<'p>(
        &self,
        from: impl Into<Part<'p>>,
        to: impl Into<Part<'p>>,
        tolerance: impl Into<Tolerance>,
        limits: &Limits,
    ) -> Result<Option<AreaFormFactor>, Error> {
        let tolerance = Tolerance { row: f64::INFINITY, ..tolerance.into() };
        tolerance.check()?;
        let [from, to] = [End::of(self, from.into())?, End::of(self, to.into())?];
        let [first, second] = if from.id <= to.id { [&from, &to] } else { [&to, &from] };
        let outlook = Outlook::toward(self.surfaces(), &first.surface, &second.surface);
        let limits = limits.with(limits.in_all);
        let found = self.pair(&outlook, [first, second], &tolerance, &limits, &mut Eye::default());
        Ok(found.map(|found| found.map_or_else(AreaFormFactor::default, |f| factor(&f, from.surface.area))))
    }

    /// The form factors from polygon `from` to all polygons that it sees. In a closed room they add to 1 within the row's
    /// tolerance. `None` once `limits` stop it.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    ///
    /// # Panics
    /// When there is no polygon `from`.
    pub fn area_row(
        &self,
        from: usize,
        tolerance: impl Into<Tolerance>,
        limits: &Limits,
    ) -> Result<Option<Row>, Error> {
        let tolerance = tolerance.into();
        tolerance.check()?;
        let (own, end) = (self.outlook(from), End::whole(self, from));
        let all: Vec<usize> = (0..self.polygons().len()).collect();
        let (mut row, mut left) = (Row::new(), limits.in_all);
        for block in all.chunks(BLOCK) {
            let limits = limits.with(left);
            let found = each(block, |eye, to| {
                let other = End::whole(self, *to);
                if *to < from {
                    let outlook = Outlook::toward(self.surfaces(), &other.surface, &end.surface);
                    return self.pair(&outlook, [&other, &end], &tolerance, &limits, eye);
                }
                self.pair(&own, [&end, &other], &tolerance, &limits, eye)
            });
            for (to, found) in block.iter().zip(found) {
                let Some(found) = found else { return Ok(None) };
                let Some(found) = found else { continue };
                left = left.saturating_sub(found.evaluations);
                row.push((*to, factor(&found, self.area(from))));
            }
        }
        Ok(Some(row))
    }

    /// All rows, by id. Each pair of polygons is integrated once.
    ///
    /// The time grows with the square of the number of polygons, the memory with the number of factors that are not 0. With the
    /// feature `rayon` rows are shared among threads; the result is the same for any number of them. `None` once `limits`
    /// stop it.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    pub fn area_matrix(
        &self,
        tolerance: impl Into<Tolerance>,
        limits: &Limits,
    ) -> Result<Option<Vec<Row>>, Error> {
        let tolerance = tolerance.into();
        tolerance.check()?;
        let ids: Vec<usize> = (0..self.polygons().len()).collect();
        let mut rows = vec![Row::new(); ids.len()];
        let mut left = limits.in_all;
        for block in ids.chunks(BLOCK) {
            let limits = limits.with(left);
            let found = each(block, |eye, from| self.later(*from, &tolerance, &limits, eye));
            for (from, later) in block.iter().zip(found) {
                let Some(later) = later else { return Ok(None) };
                for (to, found) in later {
                    left = left.saturating_sub(found.evaluations);
                    rows[*from].push((to, factor(&found, self.area(*from))));
                    rows[to].push((*from, factor(&found, self.area(to))));
                }
            }
        }
        Ok(Some(rows))
    }

    /// What polygon `from` exchanges with each that comes after it and sees it: its id, the integral over both and the estimate of its
    /// error. `None` when stopped.
    pub(crate) fn exchanges(
        &self,
        from: usize,
        tolerance: &Tolerance,
        limits: &Limits,
    ) -> Result<Option<Exchanges>, Error> {
        tolerance.check()?;
        let found = self.later(from, tolerance, limits, &mut Eye::default());
        Ok(found.map(|found| found.into_iter().map(|(to, f)| (to, f.value, f.error)).collect()))
    }

    fn outlook(&self, id: usize) -> Outlook<'_> {
        Outlook::from(self.surfaces(), &self.surfaces().surfaces[id])
    }

    fn area(&self, id: usize) -> f64 {
        self.surfaces().surfaces[id].area
    }

    /// The integrals over a polygon and each that comes after it and sees it; `None` when stopped.
    fn later(
        &self,
        from: usize,
        tolerance: &Tolerance,
        limits: &Limits,
        eye: &mut Eye,
    ) -> Option<Vec<(usize, Integral)>> {
        let (outlook, end) = (self.outlook(from), End::whole(self, from));
        let mut found = Vec::new();
        for to in from + 1..self.polygons().len() {
            let pair = self.pair(&outlook, [&end, &End::whole(self, to)], tolerance, limits, eye)?;
            found.extend(pair.map(|pair| (to, pair)));
        }
        Some(found)
    }

    /// The integral over two ends, the first of which has the lower id; nothing where they do not see each other. `None` when
    /// stopped.
    fn pair(
        &self,
        outlook: &Outlook,
        [first, second]: [&End; 2],
        tolerance: &Tolerance,
        limits: &Limits,
        eye: &mut Eye,
    ) -> Option<Option<Integral>> {
        if !first.faces(second) {
            return Some(None);
        }
        // Among many polygons what stands in between is not found in a moment, and few pairs are integrated.
        if (limits.stop)() {
            return None;
        }
        let area = first.surface.area.min(second.surface.area);
        // Squares of independent errors add up: those of the shares of all entries give the row's.
        let allowed = Allowed {
            absolute: tolerance.absolute * area,
            relative: tolerance.relative,
            of_root: tolerance.row / 2.0 * area.sqrt(),
            equal: tolerance.row / 2.0 * area / (self.polygons().len() as f64).sqrt(),
            evaluations: limits.per_pair,
        };
        let found = outlook.exchange(&second.surface, &allowed, eye, limits.stop)?;
        let is_seen = found.value > 0.0 || found.error > 0.0;
        Some(is_seen.then_some(found))
    }
}

fn factor(found: &Integral, area: f64) -> AreaFormFactor {
    AreaFormFactor {
        value: (found.value / area).clamp(0.0, 1.0),
        error_estimate: found.error / area,
        evaluations: found.evaluations,
    }
}

/// So many rows of a matrix are shared among threads at a time, before what is found goes into the rows.
const BLOCK: usize = 64;

/// A function of each item, in order.
#[cfg(not(feature = "rayon"))]
fn each<T, R>(items: &[T], f: impl Fn(&mut Eye, &T) -> R) -> Vec<R> {
    let mut eye = Eye::default();
    items.iter().map(|item| f(&mut eye, item)).collect()
}

/// A function of each item, in order, by all threads.
#[cfg(feature = "rayon")]
fn each<T: Sync, R: Send>(items: &[T], f: impl Fn(&mut Eye, &T) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    items.par_iter().map_init(Eye::default, |eye, item| f(eye, item)).collect()
}
