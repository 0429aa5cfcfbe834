//! How large many numbers are.

/// The largest magnitude; that of NaN is infinite, so that it is never taken for a small one.
pub(super) fn largest(values: &[f64]) -> f64 {
    let magnitude = |value: &f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    values.iter().map(magnitude).fold(0.0, f64::max)
}

/// ΣAR² / ΣAR for each band, 0 where R is 0; scaled by the largest R, so that no square leaves the doubles' range.
pub(super) fn mean_by_itself(values: &[f64], areas: &[f64], bands: usize) -> Vec<f64> {
    let mut largest = vec![0.0f64; bands];
    for value in values.chunks_exact(bands) {
        largest.iter_mut().zip(value).for_each(|(largest, v)| *largest = largest.max(*v));
    }
    let (mut sums, mut squares) = (vec![0.0; bands], vec![0.0; bands]);
    for (value, area) in values.chunks_exact(bands).zip(areas) {
        for band in (0..bands).filter(|&band| largest[band] > 0.0) {
            let share = value[band] / largest[band];
            sums[band] += area * share;
            squares[band] += area * share * share;
        }
    }
    let mean =
        |band: usize| if sums[band] > 0.0 { largest[band] * (squares[band] / sums[band]) } else { 0.0 };
    (0..bands).map(mean).collect()
}
