//! Compressed sparse rows of form factors.

/// Form factors between polygons as compressed sparse rows.
///
/// Row i has the factors F(i -> j) from polygon i, in the order of j; what is not seen has no entry. The entries of row i are
/// those from `starts()[i]` to `starts()[i + 1]` of `columns()`, `values()` and `errors()`.
///
/// ```
/// use formfactor::{Enclosure, FactorMatrix, Limits, PlanarPolygon};
/// // Unit squares, one above the other.
/// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
/// let ceiling = PlanarPolygon::new([[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]]])?;
/// let both = Enclosure::new(vec![floor, ceiling]);
/// let rows = [0, 1].map(|from| both.exchange_row(from, 1e-6, &Limits::default()).map(Option::unwrap_or_default));
/// let [first, second] = rows;
/// let factors = FactorMatrix::new(&[1.0, 1.0], [first?, second?]);
/// assert!((factors.row(0).next().unwrap().value - 0.199_825).abs() < 1e-6);
/// // 80 % escapes to the sides: a third receiver makes the rows add to 1.
/// let with_space = factors.with_space();
/// assert!(with_space.defects().iter().all(|defect| defect.abs() < 1e-15));
/// # Ok::<(), formfactor::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FactorMatrix {
    pub(super) areas: Vec<f64>,
    pub(super) starts: Vec<usize>,
    pub(super) columns: Vec<u32>,
    pub(super) values: Vec<f64>,
    pub(super) errors: Vec<f64>,
}

/// A factor of a [`FactorMatrix`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Factor {
    /// The polygon that receives.
    pub to: usize,
    /// The fraction of the power that reaches it: from 0 to 1.
    pub value: f64,
    /// The estimate of its error, as of [`AreaFormFactor`](crate::AreaFormFactor); of what was changed afterwards, with the
    /// change added.
    pub error: f64,
}

impl FactorMatrix {
    /// Each polygon's area, in the coordinates' units squared. There is none for space.
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// How many rows there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Whether there are no rows.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// Where each row starts in the other arrays, and where the last one ends: one more than rows.
    #[must_use]
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// The receivers, row after row.
    #[must_use]
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// The factors, row after row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The estimates of the factors' errors, row after row.
    #[must_use]
    pub fn errors(&self) -> &[f64] {
        &self.errors
    }

    /// The factors of a row that are not 0, in the order of the receivers.
    ///
    /// # Panics
    /// When there is no such row.
    pub fn row(&self, from: usize) -> impl Iterator<Item = Factor> + '_ {
        self.span(from).map(|at| Factor {
            to: self.columns[at] as usize,
            value: self.values[at],
            error: self.errors[at],
        })
    }

    /// The factor from one polygon to another.
    ///
    /// # Panics
    /// When there is no such row.
    #[must_use]
    pub fn factor(&self, from: usize, to: usize) -> Factor {
        let span = self.span(from);
        let place = self.columns[span.clone()].binary_search(&column(to));
        let at = |place| Factor {
            to,
            value: self.values[span.start + place],
            error: self.errors[span.start + place],
        };
        place.map_or(Factor { to, ..Factor::default() }, at)
    }

    /// The places of a row's entries.
    pub(super) fn span(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// What each row lacks of 1. In a closed room that is an error, elsewhere what escapes.
    #[must_use]
    pub fn defects(&self) -> Vec<f64> {
        (0..self.len()).map(|from| 1.0 - self.row(from).map(|factor| factor.value).sum::<f64>()).collect()
    }

    /// The same with one more receiver, whose number is that of the rows: space, or the sky, to which all that escapes goes, so
    /// that rows of open scenes add to 1. Its error is the sum of those of the row. A row that adds to more than 1 gets none.
    #[must_use]
    pub fn with_space(mut self) -> FactorMatrix {
        let space = column(self.len());
        let escaped = |from| {
            let sums = self.row(from).fold([0.0; 2], |[value, error], f| [value + f.value, error + f.error]);
            [(1.0 - sums[0]).max(0.0), sums[1]]
        };
        let escaped: Vec<[f64; 2]> = (0..self.len()).map(escaped).collect();
        let more = escaped.iter().filter(|[value, _]| *value > 0.0).count();
        let mut end = self.columns.len() + more;
        self.columns.reserve_exact(more);
        self.columns.resize(end, space);
        for numbers in [&mut self.values, &mut self.errors] {
            numbers.reserve_exact(more);
            numbers.resize(end, 0.0);
        }
        // In place, from the last row on: each moves to where nothing is left.
        for (from, [value, error]) in escaped.into_iter().enumerate().rev() {
            let span = self.span(from);
            self.starts[from + 1] = end;
            if value > 0.0 {
                end -= 1;
                (self.columns[end], self.values[end], self.errors[end]) = (space, value, error);
            }
            end -= span.len();
            self.columns.copy_within(span.clone(), end);
            self.values.copy_within(span.clone(), end);
            self.errors.copy_within(span, end);
        }
        self
    }

    /// A matrix from rows of factors, each in the order of the receivers.
    pub(super) fn by_rows(&self, areas: Vec<f64>, mut row: impl FnMut(usize) -> Vec<Factor>) -> FactorMatrix {
        let mut matrix = FactorMatrix { starts: vec![0], ..FactorMatrix::default() };
        for from in 0..areas.len() {
            for factor in row(from) {
                matrix.columns.push(column(factor.to));
                matrix.values.push(factor.value);
                matrix.errors.push(factor.error);
            }
            matrix.starts.push(matrix.columns.len());
        }
        FactorMatrix { areas, ..matrix }
    }
}

/// A receiver as the matrix stores it.
pub(super) fn column(to: usize) -> u32 {
    u32::try_from(to).expect("fewer than 2^32 polygons")
}
