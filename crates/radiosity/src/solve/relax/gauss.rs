//! Gaussian elimination for the full matrix.
use super::balance::Balance;
use rayon::prelude::*;

/// (I − ρF)⁻¹ r. The matrix is diagonally dominant by rows with a positive diagonal and no positive entry beside it, which
/// elimination preserves: no pivot need be sought. O(n³) for n pieces.
pub(super) fn eliminate(balance: &Balance<'_>, residual: &[f64]) -> Vec<f64> {
    let mut rows: Vec<Vec<f64>> =
        (0..residual.len()).map(|piece| row(balance, piece, residual[piece])).collect();
    for pivot in 0..rows.len() {
        let (above, below) = rows.split_at_mut(pivot + 1);
        let upper = &above[pivot][pivot..];
        below.par_iter_mut().with_min_len(8).for_each(|lower| {
            let share = lower[pivot] / upper[0];
            if share != 0.0 {
                lower[pivot..].iter_mut().zip(upper).for_each(|(lower, upper)| *lower -= share * upper);
            }
        });
    }
    substitute(&rows)
}

/// A row of I − ρF, and the right-hand side at its end.
fn row(balance: &Balance<'_>, piece: usize, right: f64) -> Vec<f64> {
    let factors = balance.exchange.row(piece);
    let mut row: Vec<f64> = factors.iter().map(|factor| -balance.reflectance[piece] * factor).collect();
    let others = factors.iter().sum::<f64>() - factors[piece];
    row[piece] = balance.kept(piece) + balance.reflectance[piece] * others;
    row.push(right);
    row
}

/// Solves the triangle from below.
fn substitute(rows: &[Vec<f64>]) -> Vec<f64> {
    let count = rows.len();
    let mut x = vec![0.0; count];
    for (piece, row) in rows.iter().enumerate().rev() {
        let known: f64 = row[piece + 1..count].iter().zip(&x[piece + 1..]).map(|(entry, x)| entry * x).sum();
        x[piece] = (row[count] - known) / row[piece];
    }
    x
}
