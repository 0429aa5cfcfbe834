//! The exact area, for sums that cancel.

use super::Segment;
use exactfloat::{Integer, lowest_exponent, multiple, nearest};

/// The area that closed walks of directed edges enclose, correctly rounded; infinite beyond the range.
#[cold]
pub(crate) fn exact_area(edges: impl Iterator<Item = Segment> + Clone) -> f64 {
    let coordinates = edges.clone().flatten().flat_map(|p| [p.x, p.y]);
    let lowest = lowest_exponent(coordinates).unwrap_or(0);
    let cross = |[a, b]: Segment| {
        let [ax, ay, bx, by] = [a.x, a.y, b.x, b.y].map(|x| multiple(x, lowest));
        ax * by - ay * bx
    };
    let doubled = edges.map(cross).fold(Integer::ZERO, |sum, term| sum + term);
    nearest(doubled, 2 * lowest - 1)
}
