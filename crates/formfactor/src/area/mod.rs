//! Form factors from polygon to polygon.
//!
//! F(i -> j) is the mean over polygon i of the exact point form factors to polygon j. Where nothing stands in between it
//! has a closed form; elsewhere it is taken by adaptive cubature, whose cells are cut where the view changes its shape.
mod cell;
mod contour;
mod events;
mod pair;
mod rule;

use crate::error::Error;
use crate::scene::enclosure::Enclosure;

/// A form factor from a polygon to a polygon, with an estimate of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct AreaFormFactor {
    /// The fraction of the power leaving the front of the first polygon that reaches the front of the second directly: a number
    /// from 0 to 1, without a unit.
    pub value: f64,
    /// An estimate of the error, from the differences between quadrature rules. It is not a bound.
    pub error_estimate: f64,
    /// The number of point form factors that were evaluated; 0 for a closed form.
    pub evaluations: u64,
}

/// A row of a matrix of form factors: the id of each polygon that is seen and the factor to it, in the order of the ids.
pub type Row = Vec<(usize, AreaFormFactor)>;

impl Enclosure {
    /// The form factor from polygon `from` to polygon `to`, with all other polygons as occluders: the mean of the point form
    /// factors over the front of `from`.
    ///
    /// The integral is taken over the smaller polygon; A1 F12 = A2 F21 gives the other direction, so that reciprocity holds to
    /// rounding. Refinement stops when the estimated error of both directions is within `tolerance`, or after four million
    /// point form factors: compare `error_estimate` with `tolerance`. About 1e2 evaluations suffice where no occluder's edge is
    /// near the line of sight; elsewhere it takes 1e3 to 1e5.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    ///
    /// # Panics
    /// When there is no polygon with one of the ids.
    ///
    /// ```
    /// use formfactor::{Enclosure, PlanarPolygon};
    /// // Unit squares, one above the other.
    /// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
    /// let ceiling = PlanarPolygon::new([[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]]])?;
    /// let f = Enclosure::new(vec![floor, ceiling]).area_form_factor(0, 1, 1e-9)?;
    /// assert!((f.value - 0.199_824_895_698_387_4).abs() < 1e-9);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    pub fn area_form_factor(&self, from: usize, to: usize, tolerance: f64) -> Result<AreaFormFactor, Error> {
        check(tolerance)?;
        let found = self.exchange([from, to], tolerance, &|| false);
        Ok(found.map_or_else(AreaFormFactor::default, |[forth, _]| forth))
    }

    /// The form factors from polygon `from` to all polygons that it sees. In a closed room they add to 1 within `tolerance`.
    ///
    /// Each factor gets an equal share of the tolerance. `is_cancelled` is called often; once it returns `true` the result is
    /// `None`.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    ///
    /// # Panics
    /// When there is no polygon `from`.
    pub fn area_row(
        &self,
        from: usize,
        tolerance: f64,
        is_cancelled: impl Fn() -> bool + Sync,
    ) -> Result<Option<Row>, Error> {
        check(tolerance)?;
        let share = self.share(tolerance);
        let others: Vec<usize> = (0..self.polygons().len()).filter(|to| self.face([from, *to])).collect();
        let found = each(&others, |to| self.exchange([from, *to], share, &is_cancelled));
        let entries = others.into_iter().zip(found).map(|(to, factors)| Some((to, factors?[0])));
        Ok(entries.filter(|entry| entry.is_none_or(|(_, factor)| factor.value > 0.0)).collect())
    }

    /// All rows, by id. Each pair of polygons is integrated once.
    ///
    /// The time grows with the square of the number of polygons, the memory with the number of factors that are not 0. With the
    /// feature `rayon` pairs are shared among threads; the result is the same for any number of them. `is_cancelled` is called
    /// often; once it returns `true` the result is `None`.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    pub fn area_matrix(
        &self,
        tolerance: f64,
        is_cancelled: impl Fn() -> bool + Sync,
    ) -> Result<Option<Vec<Row>>, Error> {
        check(tolerance)?;
        let (count, share) = (self.polygons().len(), self.share(tolerance));
        let mut rows = vec![Row::new(); count];
        // By rows and along them, so that each row comes to be in the order of the ids.
        let all = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
        let mut pairs = all.filter(|pair| self.face(*pair));
        loop {
            let block: Vec<[usize; 2]> = pairs.by_ref().take(BLOCK).collect();
            if block.is_empty() {
                return Ok(Some(rows));
            }
            for (&[i, j], factors) in
                block.iter().zip(each(&block, |p| self.exchange(*p, share, &is_cancelled)))
            {
                let Some([forth, back]) = factors else { return Ok(None) };
                if forth.value > 0.0 {
                    rows[i].push((j, forth));
                    rows[j].push((i, back));
                }
            }
        }
    }

    /// Whether two polygons see each other as far as their planes say.
    fn face(&self, [i, j]: [usize; 2]) -> bool {
        let [one, other] = [i, j].map(|id| &self.polygons()[id]);
        i != j && pair::is_before(one, other) && pair::is_before(other, one)
    }

    /// Of a row's tolerance, what each entry gets.
    fn share(&self, tolerance: f64) -> f64 {
        tolerance / f64::from(u32::try_from(self.polygons().len().max(1)).unwrap_or(u32::MAX))
    }

    /// Both directions between two polygons; `None` when cancelled.
    fn exchange(
        &self,
        [i, j]: [usize; 2],
        tolerance: f64,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<[AreaFormFactor; 2]> {
        if !self.face([i, j]) {
            return Some([AreaFormFactor::default(); 2]);
        }
        let [size_i, size_j] = [i, j].map(|id| self.polygons()[id].area());
        let is_swapped = size_j < size_i || (size_j == size_i && j < i);
        let pair = if is_swapped { [j, i] } else { [i, j] };
        let mean = pair::mean(self, pair, tolerance, is_cancelled)?;
        let scaled = |scale: f64| AreaFormFactor {
            value: (mean.value * scale).clamp(0.0, 1.0),
            error_estimate: mean.error * scale,
            evaluations: mean.evaluations,
        };
        Some(if is_swapped {
            [scaled(size_j / size_i), scaled(1.0)]
        } else {
            [scaled(1.0), scaled(size_i / size_j)]
        })
    }
}

/// So many pairs of a matrix are shared among threads at a time, before what is found goes into the rows.
const BLOCK: usize = 1 << 16;

fn check(tolerance: f64) -> Result<(), Error> {
    if tolerance > 0.0 { Ok(()) } else { Err(Error::BadTolerance) }
}

/// A function of each item, in order.
#[cfg(not(feature = "rayon"))]
fn each<T, R>(items: &[T], f: impl Fn(&T) -> R) -> Vec<R> {
    items.iter().map(f).collect()
}

/// A function of each item, in order, by all threads.
#[cfg(feature = "rayon")]
fn each<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    use rayon::prelude::*;
    items.par_iter().map(f).collect()
}
