//! Closure and reciprocity by least squares.
use super::sparse::{Factor, FactorMatrix};
use crate::error::Error;

/// What [`FactorMatrix::closed`] did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Closure {
    /// The largest defect of a row before.
    pub defect: f64,
    /// The largest change of a factor.
    pub change: f64,
}

/// A row's sum that is further from 1 is no error that smoothing should hide.
const OPEN: f64 = 0.1;
/// The defects that are left.
const LEFT: f64 = 1e-14;

impl FactorMatrix {
    /// The matrix of a closed room made to obey its two laws: rows that add to 1, and A_i F_ij = A_j F_ji.
    ///
    /// Of all matrices that do, it is the one whose exchange areas x_ij differ least from those found, e_ij (the mean of both
    /// directions), in the sum of (x_ij − e_ij)² / e_ij: least squares smoothing (Larsen and Howell, J. Heat Transfer 108,
    /// 1986). It is x_ij = e_ij (1 + λ_i + λ_j), where the multipliers λ solve a sparse symmetric system, here by conjugate
    /// gradients. Factors of 0 stay 0. What changed is added to the errors.
    ///
    /// # Errors
    /// [`Error::NotClosed`] for a row that lacks more than a tenth of 1 or goes to space, or where no multipliers close the rows: the
    /// scene is open, or the factors are wrong.
    pub fn closed(&self) -> Result<(FactorMatrix, Closure), Error> {
        let escaped = |row: &usize| self.row(*row).find(|factor| factor.to >= self.len());
        if let Some((row, space)) = (0..self.len()).find_map(|row| Some((row, escaped(&row)?))) {
            return Err(Error::NotClosed { row, defect: space.value });
        }
        let exchange = self.exchange_areas();
        let lacking: Vec<f64> =
            (0..self.len()).map(|i| self.areas[i] - exchange[self.span(i)].iter().sum::<f64>()).collect();
        let shares = || lacking.iter().zip(&self.areas).map(|(lack, area)| lack / area);
        let worst = shares().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let Some((row, defect)) = worst else { return Ok((self.clone(), Closure::default())) };
        if defect.is_nan() || defect.abs() > OPEN {
            return Err(Error::NotClosed { row, defect });
        }
        let multipliers = self.multipliers(&exchange, &lacking).ok_or(Error::NotClosed { row, defect })?;
        let mut closed = self.clone();
        let mut change: f64 = 0.0;
        for i in 0..self.len() {
            for at in self.span(i) {
                let scale = 1.0 + multipliers[i] + multipliers[self.columns[at] as usize];
                let value = scale * exchange[at] / self.areas[i];
                closed.errors[at] += (value - self.values[at]).abs();
                change = change.max((value - self.values[at]).abs());
                closed.values[at] = value;
            }
        }
        let is_whole = closed.values.iter().all(|value| (0.0..=1.0 + LEFT).contains(value));
        is_whole
            .then_some((closed, Closure { defect: defect.abs(), change }))
            .ok_or(Error::NotClosed { row, defect })
    }

    /// Per entry the exchange area, the mean of that of both directions.
    fn exchange_areas(&self) -> Vec<f64> {
        let both = |from: usize, Factor { to, value, .. }: Factor| {
            0.5 * (self.areas[from] * value + self.areas[to] * self.factor(to, from).value)
        };
        (0..self.len()).flat_map(|from| self.row(from).map(move |factor| both(from, factor))).collect()
    }

    /// The λ with Σ_j e_ij (λ_i + λ_j) = d_i for all rows, by conjugate gradients scaled by the diagonal.
    ///
    /// The matrix is positive semidefinite: λᵀMλ is the sum of e_ij (λ_i + λ_j)² over all pairs.
    fn multipliers(&self, exchange: &[f64], lacking: &[f64]) -> Option<Vec<f64>> {
        let count = self.len();
        let sums: Vec<f64> = (0..count).map(|i| exchange[self.span(i)].iter().sum()).collect();
        let product = |x: &[f64]| -> Vec<f64> {
            let row =
                |i: usize| self.span(i).map(|at| exchange[at] * x[self.columns[at] as usize]).sum::<f64>();
            (0..count).map(|i| sums[i] * x[i] + row(i)).collect()
        };
        let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let scaled =
            |x: &[f64]| -> Vec<f64> { x.iter().zip(&self.areas).map(|(x, area)| x / area).collect() };
        let is_small = |x: &[f64]| x.iter().zip(&self.areas).all(|(x, area)| x.abs() <= LEFT * area);
        let mut solution = vec![0.0; count];
        let mut residual = lacking.to_vec();
        let mut direction = scaled(&residual);
        let mut length = dot(&residual, &direction);
        for _ in 0..10 * count.max(10) {
            if is_small(&residual) {
                return Some(solution);
            }
            let image = product(&direction);
            let step = length / dot(&direction, &image);
            solution.iter_mut().zip(&direction).for_each(|(x, d)| *x += step * d);
            residual.iter_mut().zip(&image).for_each(|(r, m)| *r -= step * m);
            let next = scaled(&residual);
            let before = std::mem::replace(&mut length, dot(&residual, &next));
            direction.iter_mut().zip(next).for_each(|(d, r)| *d = r + length / before * *d);
        }
        is_small(&residual).then_some(solution)
    }
}
