//! Tiles that are near each other for their size, or touch: five points are too few for their mean, which is a contour integral where
//! nothing stands in between.
//!
//! ```text
//! |  F of a point of the floor to the wall falls like
//! |_ the first steps of a stair: what five points miss has one sign wherever two walls meet
//! ```
use super::look::look;
use super::tile::{INNER, OUTER};
use super::tiling::{Tile, Tiling};
use formfactor::{Enclosure, Limits, unoccluded_area};

/// Curvatures of less than this share of what is seen are no matter.
const EVEN: f64 = 0.02;
/// Contour integrals are as exact as this, as a share of what is seen.
const EXACT: f64 = 1e-4;
/// Where the contours do not do, as where one tile reaches behind the other, points may: so many.
const MOST_POINTS: u64 = 256;
/// Exact means differ from those of five points by no more than such a factor, but where the points are wide of all that counts.
const MOST: f64 = 4.0;

/// What the mean over five points of one tile of what it sees of another, with such a curvature, is to be multiplied by, were nothing in between;
/// nothing where five points are enough.
pub(super) fn correction(
    tiling: &Tiling<'_>,
    [from, to]: [&Tile; 2],
    (exchange, is_open): (f64, bool),
    bend: f64,
) -> Option<f64> {
    let is_near = exchange > 0.0 && bend > EVEN * exchange;
    let exact = is_near.then(|| whole([from, to], EXACT * exchange / from.area)).flatten()?;
    let seen = || from.points.each_ref().map(|point| look(tiling, point, to, &[])[0]);
    let mean =
        |[middle, ahead, back, left, right]: [f64; 5]| INNER * middle + OUTER * (ahead + back + left + right);
    let found = if is_open { exchange / from.area } else { mean(seen()) };
    (found > 0.0).then(|| (exact / found).clamp(1.0 / MOST, MOST))
}

/// The form factor with nothing in between.
fn whole([from, to]: [&Tile; 2], tolerance: f64) -> Option<f64> {
    if let Some(found) = unoccluded_area(&from.polygon, &to.polygon, tolerance).ok()? {
        return Some(found.value);
    }
    let pair = Enclosure::new(vec![from.polygon.clone(), to.polygon.clone()]);
    let limits = Limits { per_pair: MOST_POINTS, ..Limits::default() };
    let found = pair.area_form_factor(0, 1, tolerance, &limits).ok()??;
    (found.error_estimate <= tolerance).then_some(found.value)
}
