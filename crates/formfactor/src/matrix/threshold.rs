//! Small factors left out, the rows' sums kept.
use super::sparse::{Factor, FactorMatrix};

impl FactorMatrix {
    /// The matrix without the factors below a threshold. A pair goes only where the factors of both directions are below it; what
    /// a row loses is given to its other factors in proportion, so that its sum stays, and is added to their errors. A row keeps
    /// its largest factor. Reciprocity then holds to the threshold only; [`closed`](FactorMatrix::closed) mends it.
    #[must_use]
    pub fn without_below(&self, threshold: f64) -> FactorMatrix {
        self.by_rows(self.areas.clone(), |from| {
            let row: Vec<Factor> = self.row(from).collect();
            let largest = row.iter().map(|factor| factor.value).fold(0.0, f64::max);
            let is_kept = |factor: &Factor| {
                let back =
                    self.areas.get(factor.to).map_or(0.0, |area| factor.value * self.areas[from] / area);
                factor.value >= threshold || back >= threshold || factor.value == largest
            };
            let sum = |factors: &mut dyn Iterator<Item = &Factor>| factors.map(|f| f.value).sum::<f64>();
            let (all, kept) = (sum(&mut row.iter()), sum(&mut row.iter().filter(|f| is_kept(f))));
            let grown = |factor: &Factor| {
                let value = factor.value * (all / kept);
                Factor { value, error: factor.error + (value - factor.value), ..*factor }
            };
            row.iter().filter(|f| is_kept(f)).map(grown).collect()
        })
    }
}
