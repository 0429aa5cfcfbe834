//! Gauss's rule between breaks, halved until it agrees with itself.
use super::Sweep;
use std::f64::consts::TAU;

/// Nodes and weights of the ten-point rule on [-1, 1]; the other half is their mirror image.
const RULE: [[f64; 2]; 5] = [
    [0.148_874_338_981_631_2, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_14],
];

/// What two rules may differ by before they are halved.
const AGREED: f64 = 2e-15;
/// Halvings of one stretch, and of all together, before the difference counts as error.
const DEEPEST: u32 = 36;
const MOST: u32 = 20_000;
/// Rounding of the measure, of the nodes and of the sum.
const ROUNDING: f64 = 3e-15;

/// The integral over all stretches between neighbouring breaks, by 2 pi.
pub(super) fn over(breaks: &[f64], measure: impl Fn(f64) -> f64) -> Sweep {
    let (mut value, mut error, mut halvings) = (0.0, 0.0, 0);
    for pair in breaks.windows(2) {
        let mut open = vec![(pair[0], pair[1], gauss(pair[0], pair[1], &measure), 0)];
        while let Some((start, end, coarse, depth)) = open.pop() {
            let middle = f64::midpoint(start, end);
            let halves = [gauss(start, middle, &measure), gauss(middle, end, &measure)];
            let difference = (halves[0] + halves[1] - coarse).abs();
            if difference <= AGREED || depth == DEEPEST || halvings == MOST {
                value += halves[0] + halves[1];
                error += difference;
            } else {
                halvings += 1;
                open.push((start, middle, halves[0], depth + 1));
                open.push((middle, end, halves[1], depth + 1));
            }
        }
    }
    Sweep { value: value / TAU, error: error / TAU + ROUNDING }
}

fn gauss(start: f64, end: f64, measure: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (f64::midpoint(start, end), (end - start) / 2.0);
    let both =
        |[node, weight]: [f64; 2]| weight * (measure(middle - half * node) + measure(middle + half * node));
    half * RULE.into_iter().map(both).sum::<f64>()
}
