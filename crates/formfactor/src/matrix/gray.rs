//! Gray surfaces: what one emits and another absorbs, with all reflections in between.
use super::sparse::{Factor, FactorMatrix};
use crate::error::Error;

impl FactorMatrix {
    /// Hottel's total exchange factors of gray surfaces with these emittances, from above 0 to 1: the power that i emits and j
    /// absorbs, directly or by diffuse reflections, as a share of what i would emit if it were black.
    ///
    /// 𝓕 = ε (I − F ρ)⁻¹ F ε with ρ = 1 − ε (Hottel and Sarofim, *Radiative Transfer*, 1967). In a closed room row i adds to ε_i, and
    /// A_i 𝓕_ij = A_j 𝓕_ji. Errors E of F change it by ε (I − F ρ)⁻¹ E (I − ρ F)⁻¹ ε to first order; the last two factors are shares of
    /// power that is absorbed, 1 at most, so row i errs by ε_i (I − F ρ)⁻¹ E 1 at most. Nearly all factors are positive, so that the
    /// matrix is full: O(n³) time, O(n²) memory for n surfaces.
    ///
    /// # Errors
    /// [`Error::BadEmittance`] with the first that is not above 0 and at most 1, or is missing.
    pub fn with_emittances(&self, emittances: &[f64]) -> Result<FactorMatrix, Error> {
        let count = self.len();
        let is_good = |i: &usize| emittances.get(*i).is_some_and(|e| *e > 0.0 && *e <= 1.0);
        if let Some(surface) = (0..count).find(|i| !is_good(i)) {
            return Err(Error::BadEmittance { surface });
        }
        let reflectance = |i: usize| 1.0 - emittances[i];
        // [I − F ρ | F ε | E 1], whose left part is made the identity.
        let mut rows: Vec<Vec<f64>> = (0..count).map(|_| vec![0.0; 2 * count + 1]).collect();
        for (i, row) in rows.iter_mut().enumerate() {
            for Factor { to, value, error } in self.row(i).filter(|factor| factor.to < count) {
                row[to] = -value * reflectance(to);
                row[count + to] = value * emittances[to];
                row[2 * count] += error;
            }
            row[i] += 1.0;
        }
        eliminate(&mut rows);
        Ok(self.by_rows(self.areas.clone(), |i| {
            let row = &rows[i];
            let error = emittances[i] * row[2 * count];
            let factor = |j: usize| Factor { to: j, value: emittances[i] * row[count + j], error };
            (0..count).map(factor).filter(|factor| factor.value > 0.0).collect()
        }))
    }
}

/// Makes the left square of some rows the identity. Its diagonal dominates: rows of F add to 1 at most, and ρ is below 1; so no
/// pivot is looked for.
fn eliminate(rows: &mut [Vec<f64>]) {
    let count = rows.len();
    for pivot in 0..count {
        let mut row = std::mem::take(&mut rows[pivot]);
        let scale = 1.0 / row[pivot];
        row[pivot..].iter_mut().for_each(|x| *x *= scale);
        for other in rows.iter_mut().filter(|other| !other.is_empty() && other[pivot] != 0.0) {
            let factor = other[pivot];
            other[pivot..].iter_mut().zip(&row[pivot..]).for_each(|(x, y)| *x -= factor * y);
        }
        rows[pivot] = row;
    }
}
