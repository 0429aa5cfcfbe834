//! Rows of the upper triangle: what each polygon exchanges with those behind it.
use super::sparse::{FactorMatrix, column};
use crate::area::{Limits, Tolerance};
use crate::error::Error;
use crate::scene::enclosure::Enclosure;

/// What a polygon exchanges with another one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Exchange {
    /// The other polygon.
    pub to: u32,
    /// The exchange area A F, the same in both directions, in the coordinates' units squared.
    pub area: f64,
    /// The estimate of its error.
    pub error: f64,
}

/// What polygon `from` exchanges with each polygon of a higher id that it sees, in the order of the ids.
///
/// All of its fields are plain numbers, so that it can be written and read again bit for bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExchangeRow {
    /// The polygon.
    pub from: usize,
    /// With those behind it.
    pub with: Vec<Exchange>,
}

impl Enclosure {
    /// What polygon `from` exchanges with those of higher ids: a row of the upper triangle of the matrix of exchange areas,
    /// which is symmetric. `None` when `limits` stop it.
    ///
    /// Runs on the calling thread; different rows may be found at once.
    ///
    /// # Errors
    /// [`Error::BadTolerance`] unless the tolerance is positive.
    ///
    /// # Panics
    /// When there is no polygon `from`.
    pub fn exchange_row(
        &self,
        from: usize,
        tolerance: impl Into<Tolerance>,
        limits: &Limits<'_>,
    ) -> Result<Option<ExchangeRow>, Error> {
        let found = self.exchanges(from, &tolerance.into(), limits)?;
        let exchange = |(to, area, error)| Exchange { to: column(to), area, error };
        Ok(found.map(|found| {
            let mut with: Vec<Exchange> = found.into_iter().map(exchange).collect();
            // Many rows are kept at once.
            with.shrink_to_fit();
            ExchangeRow { from, with }
        }))
    }
}

impl FactorMatrix {
    /// The matrix of polygons with these areas from its rows, in any order. Of rows that are missing nothing is known but what
    /// others say: their entries are 0. A row that is given twice counts once.
    ///
    /// Takes 20 bytes an entry, and as long as writing them.
    ///
    /// # Panics
    /// When a row names a polygon that has no area here.
    #[must_use]
    pub fn new(areas: &[f64], rows: impl IntoIterator<Item = ExchangeRow>) -> FactorMatrix {
        let mut rows: Vec<ExchangeRow> = rows.into_iter().collect();
        rows.sort_by_key(|row| row.from);
        rows.dedup_by_key(|row| row.from);
        let mut starts = vec![0; areas.len() + 1];
        let pairs = || rows.iter().flat_map(|row| row.with.iter().map(|exchange| (row.from, exchange)));
        for (from, exchange) in pairs() {
            starts[from + 1] += 1;
            starts[exchange.to as usize + 1] += 1;
        }
        (1..starts.len()).for_each(|row| starts[row] += starts[row - 1]);
        let count = starts[areas.len()];
        let (mut columns, mut values, mut errors) = (vec![0; count], vec![0.0; count], vec![0.0; count]);
        let mut free = starts.clone();
        let mut put = |from: usize, to: usize, exchange: &Exchange| {
            let at = free[from];
            free[from] += 1;
            columns[at] = column(to);
            values[at] = (exchange.area / areas[from]).clamp(0.0, 1.0);
            errors[at] = exchange.error / areas[from];
        };
        // By ascending first polygon: each row gets those before it in their order, and then, all at once, those behind it.
        for (from, exchange) in pairs() {
            let to = exchange.to as usize;
            put(from, to, exchange);
            put(to, from, exchange);
        }
        FactorMatrix { areas: areas.to_vec(), starts, columns, values, errors }
    }
}
