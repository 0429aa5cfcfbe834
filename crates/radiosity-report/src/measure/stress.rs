//! Form factors along one axis of stress each, where the visible part is a rectangle with a closed form.
//!
//! Two boards hide all of a rectangular target but a rectangle at the corner above dA (or, of a wall, beside its foot),
//! so that the exact value is that of a corner rectangle: a sum of positive terms, which loses no digits at any size
//! (Howell, *A Catalog of Radiation Heat Transfer Configuration Factors*, B-3 and B-4). Coordinates are chosen such that
//! every shadow falls where the closed form has it, to the last bit or nearly so.
use super::query::{Query, QuerySet};
use crate::plan::Plan;
use crate::rows::Chapter;
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
use std::f64::consts::TAU;

/// A point on an axis: polygons, the first of which is the target, and what is seen of it from `from`.
struct AxisPoint {
    at: f64,
    from: DVec3,
    polygons: Vec<PlanarPolygon>,
    exact: f64,
}

/// How many strips hide the target, half a decade apart.
const COUNTS: [u32; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];

/// An axis of stress: its name, and what its places are.
type StressAxis = (&'static str, fn(i32) -> AxisPoint, Vec<i32>);

/// Every axis with its queries, a set for each place, and the place's amount.
pub(crate) fn query_sets(plan: &Plan) -> Vec<(f64, QuerySet)> {
    let each =
        |(name, point, steps): StressAxis| steps.into_iter().map(move |step| query_set(name, &point(step)));
    axes(plan).into_iter().flat_map(each).collect()
}

fn axes(plan: &Plan) -> Vec<StressAxis> {
    let every = |quick: usize, full: usize| if plan.quick { quick } else { full };
    let most = if plan.quick { 6 } else { 8 };
    vec![
        (
            "distance / size",
            |k| window(10f64.powi(k), [1.0, 1.0], [0.5, 0.5]),
            (-12..=12).step_by(every(4, 1)).collect(),
        ),
        (
            "aspect of a sliver",
            |k| AxisPoint { at: 10f64.powi(k), ..window(1.0, [1.0, 10f64.powi(-k)], [0.5, 1.0]) },
            (0..=12).step_by(every(3, 1)).collect(),
        ),
        ("distance from the origin / size", far_off, (0..=48).step_by(every(12, 4)).collect()),
        ("1 / grazing angle", grazing, (0..=12).step_by(every(3, 1)).collect()),
        ("number of occluders", many, (0..=most).step_by(every(2, 1)).collect()),
        ("occluders one behind the other", deep, (0..=most).step_by(every(2, 1)).collect()),
        (
            "size of the target / size of what is seen",
            |k| AxisPoint { at: 10f64.powi(k), ..window(1.0, [1.0, 1.0], [10f64.powi(-k); 2]) },
            (1..=9).step_by(every(2, 1)).collect(),
        ),
    ]
}

fn query_set(axis: &str, point: &AxisPoint) -> (f64, QuerySet) {
    let enclosure = Enclosure::new(point.polygons.clone());
    let from = DifferentialArea::new(point.from, DVec3::Z).expect("a point with a normal");
    let bound = enclosure.form_factor(&from, 0).error_bound;
    let query = Query { enclosure: 0, from, targets: vec![0], exact: point.exact, bound };
    let set = QuerySet {
        chapter: Chapter::Stability,
        subject: axis.to_owned(),
        enclosures: vec![enclosure],
        queries: vec![query],
        relative: true,
        independent: true,
    };
    (point.at, set)
}

/// From below a corner of an a × b rectangle at a distance (B-3): all terms positive.
fn corner([a, b]: [f64; 2], distance: f64) -> f64 {
    let (x, y) = (a / distance, b / distance);
    let term = |x: f64, y: f64| x / x.hypot(1.0) * (y / x.hypot(1.0)).atan();
    (term(x, y) + term(y, x)) / TAU
}

/// From the ground to a wall of width b and height a whose foot starts at distance c before the point (B-4).
fn wall(a: f64, b: f64, c: f64) -> f64 {
    let q = a.hypot(c);
    let d = a * a / (q + c);
    ((b * d).atan2(c * q + b * b) + d / q * b.atan2(q)) / TAU
}

fn quad(corners: [[f64; 3]; 4]) -> PlanarPolygon {
    PlanarPolygon::new([corners]).expect("a rectangle")
}

/// A level rectangle that faces down.
fn ceiling([low, high]: [[f64; 2]; 2], z: f64) -> PlanarPolygon {
    quad([[low[0], low[1], z], [low[0], high[1], z], [high[0], high[1], z], [high[0], low[1], z]])
}

/// The target and two boards half as high, which leave the rectangle `seen` at the corner above the origin.
fn window(distance: f64, [a, b]: [f64; 2], [s, t]: [f64; 2]) -> AxisPoint {
    let middle = distance / 2.0;
    let mut polygons = vec![ceiling([[0.0, 0.0], [a, b]], distance)];
    polygons.push(ceiling([[s / 2.0, -b], [a, b]], middle));
    if t < b {
        polygons.push(ceiling([[-a, t / 2.0], [s / 2.0, b]], middle));
    }
    AxisPoint { at: distance, from: DVec3::ZERO, polygons, exact: corner([s, t.min(b)], distance) }
}

/// The same, moved by 2^k along all axes; quarters stay whole numbers of roundings.
fn far_off(k: i32) -> AxisPoint {
    let AxisPoint { polygons, exact, .. } = window(1.0, [1.0, 1.0], [0.5, 0.5]);
    let away = DVec3::splat(if k == 0 { 0.0 } else { 2f64.powi(k) });
    let moved = |polygon: &PlanarPolygon| {
        let loops: Vec<Vec<DVec3>> =
            polygon.loops().map(|points| points.iter().map(|point| *point + away).collect()).collect();
        PlanarPolygon::new(loops).expect("a rectangle")
    };
    AxisPoint { at: 2f64.powi(k), from: away, polygons: polygons.iter().map(moved).collect(), exact }
}

/// A wall that rises by the angle over the horizon, half of it behind a board.
fn grazing(k: i32) -> AxisPoint {
    let height = 10f64.powi(-k);
    let upright = |x: f64, [low, high]: [[f64; 2]; 2]| {
        quad([[x, low[0], low[1]], [x, low[0], high[1]], [x, high[0], high[1]], [x, high[0], low[1]]])
    };
    let polygons = vec![upright(1.0, [[0.0, 0.0], [1.0, height]]), upright(0.5, [[0.25, -1.0], [1.0, 1.0]])];
    AxisPoint { at: 10f64.powi(k), from: DVec3::ZERO, polygons, exact: wall(height, 0.5, 1.0) }
}

/// One of the boards cut in strips that share their edges.
fn many(k: i32) -> AxisPoint {
    let AxisPoint { mut polygons, exact, .. } = window(1.0, [1.0, 1.0], [0.5, 0.5]);
    let count = COUNTS[k.unsigned_abs() as usize];
    polygons.remove(1);
    let place = |i: u32| 2.0 * f64::from(i) / f64::from(count) - 1.0;
    let strip = |i: u32| ceiling([[0.25, place(i)], [1.0, place(i + 1)]], 0.5);
    polygons.extend((0..count).map(strip));
    AxisPoint { at: f64::from(count + 1), from: DVec3::ZERO, polygons, exact }
}

/// 2^k pairs of boards at heights between a half and one, all with the same shadow.
fn deep(k: i32) -> AxisPoint {
    let AxisPoint { mut polygons, exact, .. } = window(1.0, [1.0, 1.0], [0.5, 0.5]);
    let count = 2_u32.pow(k.unsigned_abs());
    polygons.truncate(1);
    for z in (0..count).map(|i| 0.5 + 0.5 * f64::from(i) / f64::from(count)) {
        polygons.push(ceiling([[z / 2.0, -1.0], [1.0, 1.0]], z));
        polygons.push(ceiling([[-1.0, z / 2.0], [z / 2.0, 1.0]], z));
    }
    AxisPoint { at: f64::from(2 * count), from: DVec3::ZERO, polygons, exact }
}

#[cfg(test)]
mod tests {
    use super::*;
    use formfactor::unoccluded;

    #[test]
    fn closed_forms_are_the_form_factors_of_what_is_seen() {
        let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
        let plate = unoccluded(&from, &ceiling([[0.0, 0.0], [0.7, 0.3]], 1.5)).value;
        assert!((corner([0.7, 0.3], 1.5) - plate).abs() < 1e-15);
        let high = quad([[2.0, 0.0, 0.0], [2.0, 0.0, 0.6], [2.0, 0.4, 0.6], [2.0, 0.4, 0.0]]);
        assert!((wall(0.6, 0.4, 2.0) - unoccluded(&from, &high).value).abs() < 1e-15);
    }

    #[test]
    fn on_every_axis_the_exact_method_meets_the_closed_form() {
        for (at, set) in query_sets(&Plan { scenes: Vec::new(), quick: true, general: true }) {
            let query = &set.queries[0];
            let found = set.enclosures[0].form_factor(&query.from, 0);
            // The boards' edges stand where the closed form has them but for the rounding of powers of ten.
            let slack = found.error_bound + 1e-15 * query.exact;
            assert!(
                (found.value - query.exact).abs() <= slack,
                "{} {at}: {found:?} {}",
                set.subject,
                query.exact
            );
        }
    }
}
