//! The angle of a vector in the upper half-plane: a short polynomial where the library's arc tangent takes any quadrant.

/// Coefficients of atan(t) / t - 1 by powers of t^2 from 1 on, within a tenth of a rounding for |t| <= 0.3: interpolated at
/// Chebyshev's nodes.
const SERIES: [f64; 9] = [
    -0.333_333_333_333_333_26,
    0.199_999_999_999_821_96,
    -0.142_857_142_804_287_3,
    0.111_111_105_056_031_6,
    -0.090_908_742_369_682_87,
    0.076_911_756_158_398_17,
    -0.066_449_023_647_526_14,
    0.056_348_415_896_004_48,
    -0.036_892_832_745_438_01,
];

/// Slopes near which other vectors are turned to small ones, and the angles of those.
const TURNS: [(f64, f64); 2] = [(0.6, 0.5404195002705842), (1.8, 1.0636978224025597)];

/// The angle from the direction (1, 0) to (`cosine`, `sine`), a vector of any length with `sine` >= 0: within 4 roundings.
pub(crate) fn angle(sine: f64, cosine: f64) -> f64 {
    if sine < 0.3 * cosine {
        return arc_tangent(sine / cosine);
    }
    let [(low, low_angle), (high, high_angle)] = TURNS;
    if sine < 1.09 * cosine {
        low_angle + arc_tangent((sine - low * cosine) / (cosine + low * sine))
    } else if sine < 4.5 * cosine {
        high_angle + arc_tangent((sine - high * cosine) / (cosine + high * sine))
    } else {
        sine.atan2(cosine)
    }
}

fn arc_tangent(t: f64) -> f64 {
    let square = t * t;
    let fourth = square * square;
    let [c1, c2, c3, c4, c5, c6, c7, c8, c9] = SERIES;
    let odd = c1 + fourth * (c3 + fourth * (c5 + fourth * (c7 + fourth * c9)));
    let even = c2 + fourth * (c4 + fourth * (c6 + fourth * c8));
    t + t * square * (odd + square * even)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::rounding::ROUNDING;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn the_angle_is_that_of_the_library(angle_of in 0.0..PI, scale in -100i32..100, small in 0i32..60) {
            let turned: f64 = angle_of * 0.5_f64.powi(small);
            let (sine, cosine) = (turned.sin().abs() * 2f64.powi(scale), turned.cos() * 2f64.powi(scale));
            let expected = sine.atan2(cosine);
            prop_assert!((angle(sine, cosine) - expected).abs() <= 5.0 * ROUNDING * expected, "{sine} {cosine}");
        }
    }
}
