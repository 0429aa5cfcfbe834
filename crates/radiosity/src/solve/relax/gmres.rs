//! GMRES for one-sided rows.
use super::balance::Balance;
use std::ops::ControlFlow;

/// How many directions are kept before a new start.
const DIRECTIONS: usize = 60;

/// Betters x until `watch`, which is shown before every product x and its residual, both as of the last start, and the
/// length of the least residual so far, says to stop; `residual` is brought up to date. Stops by itself where rounding
/// lets it come no nearer.
///
/// Saad and Schultz 1986: the x of least residual in the span of the residual and its images, by Arnoldi's recurrence
/// and Givens rotations.
pub(super) fn gmres(
    balance: &Balance<'_>,
    x: &mut [f64],
    residual: &mut Vec<f64>,
    mut watch: impl FnMut(&[f64], &[f64], f64) -> ControlFlow<()>,
) {
    let (mut going, mut before) = (ControlFlow::Continue(()), f64::INFINITY);
    while going.is_continue() && norm(residual) < before {
        before = norm(residual);
        let mut span = Span::new(residual);
        while span.triangle.len() < DIRECTIONS && !span.exhausted {
            going = watch(x, residual, span.length());
            if going.is_break() {
                break;
            }
            span.extend(balance);
        }
        span.add_best(x);
        *residual = balance.residual(x);
    }
}

/// An orthonormal basis of the Krylov space, and the least-squares problem in it.
#[derive(Debug)]
struct Span {
    basis: Vec<Vec<f64>>,
    /// Columns of the upper triangle that the rotations leave of the Hessenberg matrix.
    triangle: Vec<Vec<f64>>,
    /// Cosine and sine of each rotation.
    rotations: Vec<[f64; 2]>,
    /// The rotated right-hand side; its last entry is the residual's length.
    right: Vec<f64>,
    /// Whether the space holds the solution.
    exhausted: bool,
}

impl Span {
    /// The space of the residual alone.
    fn new(residual: &[f64]) -> Span {
        let length = norm(residual);
        let first = residual.iter().map(|r| if length > 0.0 { r / length } else { 0.0 }).collect();
        Span {
            basis: vec![first],
            triangle: Vec::new(),
            rotations: Vec::new(),
            right: vec![length],
            exhausted: length == 0.0,
        }
    }

    /// The length of the least residual so far.
    fn length(&self) -> f64 {
        self.right.last().map_or(0.0, |last| last.abs())
    }

    /// Adds the image of the last direction, made orthogonal to all.
    fn extend(&mut self, balance: &Balance<'_>) {
        let Some(last) = self.basis.last() else { return };
        let mut image = balance.apply(last);
        let before = norm(&image);
        let mut column = Vec::with_capacity(self.basis.len() + 1);
        for direction in &self.basis {
            let share = dot(direction, &image);
            image.iter_mut().zip(direction).for_each(|(v, d)| *v -= share * d);
            column.push(share);
        }
        let length = norm(&image);
        self.exhausted = length <= f64::EPSILON * before;
        self.rotate(column, length);
        self.basis.push(image.iter().map(|v| if length > 0.0 { v / length } else { 0.0 }).collect());
    }

    /// Applies the rotations before to a new column, and one more that takes its last entry away.
    fn rotate(&mut self, mut column: Vec<f64>, below: f64) {
        for (row, [cosine, sine]) in self.rotations.iter().enumerate() {
            let (upper, lower) = (column[row], column[row + 1]);
            column[row] = cosine * upper + sine * lower;
            column[row + 1] = cosine * lower - sine * upper;
        }
        let Some(diagonal) = column.last_mut() else { return };
        let length = diagonal.hypot(below);
        let rotation = [*diagonal / length, below / length];
        *diagonal = length;
        let Some(upper) = self.right.last_mut() else { return };
        let whole = *upper;
        *upper = rotation[0] * whole;
        self.right.push(-rotation[1] * whole);
        self.rotations.push(rotation);
        self.triangle.push(column);
    }

    /// Adds to x what makes its residual least.
    fn add_best(&self, x: &mut [f64]) {
        let count = self.triangle.len();
        let mut weights = self.right[..count].to_vec();
        for row in (0..count).rev() {
            let above: f64 =
                (row + 1..count).map(|column| self.triangle[column][row] * weights[column]).sum();
            weights[row] = (weights[row] - above) / self.triangle[row][row];
        }
        for (weight, direction) in weights.iter().zip(&self.basis) {
            x.iter_mut().zip(direction).for_each(|(x, d)| *x += weight * d);
        }
    }
}

fn dot(u: &[f64], v: &[f64]) -> f64 {
    u.iter().zip(v).map(|(u, v)| u * v).sum()
}

/// The Euclidean length, scaled so that no square leaves the doubles' range.
fn norm(v: &[f64]) -> f64 {
    let largest = v.iter().map(|v| v.abs()).fold(0.0, f64::max);
    if largest == 0.0 { 0.0 } else { largest * v.iter().map(|v| (v / largest).powi(2)).sum::<f64>().sqrt() }
}
