//! Polygon Booleans along one axis of stress each, where the area is known.
use crate::clock::{Job, interleaved};
use crate::plan::Plan;
use crate::rows::{Chapter, Deviation, Measured, Time};
use polycsg::{Csg, DVec2, FillRule, Region};

/// Two operands and the Boolean of which the area is known.
struct BooleanCase {
    at: f64,
    operands: [Vec<Vec<DVec2>>; 2],
    op: fn(&Region, &Region) -> Region,
    /// The deviation of the result, relative to the area that it should have.
    off: Box<dyn Fn(&Region) -> f64>,
}

/// An axis of stress: its name, and what its places are.
type BooleanAxis = (&'static str, fn(i32) -> BooleanCase, Vec<i32>);

/// All axes.
pub(crate) fn measure(plan: &Plan) -> Vec<Measured> {
    let axes: [BooleanAxis; 5] = [
        ("scale of the coordinates", scaled, (-480..=480).step_by(160).collect()),
        ("distance of 64 wedges from one point", concurrent, (0..=20).step_by(4).collect()),
        ("shift of a grid on its copy", coincident, (0..=50).step_by(10).collect()),
        ("length of nearly parallel edges / their distance", parallel, (0..=50).step_by(10).collect()),
        (
            "number of edges of long slats across each other",
            slats,
            (3..=if plan.quick { 6 } else { 8 }).collect(),
        ),
    ];
    axes.into_iter().flat_map(|(name, case, steps)| axis(plan, name, steps.into_iter().map(case))).collect()
}

fn axis(plan: &Plan, name: &str, cases: impl Iterator<Item = BooleanCase>) -> Vec<Measured> {
    let cases: Vec<BooleanCase> = cases.collect();
    let job = |case: &'_ BooleanCase| {
        let (operands, op) = (case.operands.clone(), case.op);
        let run: Job<'_, Region> = Box::new(move || {
            let [a, b] = [0, 1].map(|side| region(&operands[side]));
            op(&a, &b)
        });
        run
    };
    let found = interleaved(&cases.iter().map(job).collect::<Vec<_>>(), plan.rounds());
    let row = |(case, (result, time)): (&BooleanCase, (Region, Time))| Measured {
        chapter: Chapter::Booleans,
        subject: name.to_owned(),
        series: "polycsg".to_owned(),
        setting: String::new(),
        amount: case.at,
        error: Deviation::of(&[(case.off)(&result)]),
        certified: false,
        bound: None,
        defect: None,
        points: None,
        in_part: None,
        valid: Some(result.validate().is_ok()),
        time,
    };
    cases.iter().zip(found).map(row).collect()
}

fn region(rings: &[Vec<DVec2>]) -> Region {
    Csg::from_rings(rings, FillRule::NonZero).expect("the cases are finite").evaluate()
}

fn ring(corners: impl IntoIterator<Item = [f64; 2]>) -> Vec<DVec2> {
    corners.into_iter().map(DVec2::from).collect()
}

/// A case whose result has a known area.
fn of_area(
    at: f64,
    operands: [Vec<Vec<DVec2>>; 2],
    op: fn(&Region, &Region) -> Region,
    area: f64,
) -> BooleanCase {
    BooleanCase { at, operands, op, off: Box::new(move |result| (result.area() / area - 1.0).abs()) }
}

fn rectangle([low, high]: [[f64; 2]; 2]) -> Vec<DVec2> {
    ring([low, [high[0], low[1]], high, [low[0], high[1]]])
}

/// A triangle and a square that touches its long side in corners and sticks out, in coordinates of about 2^k.
fn scaled(k: i32) -> BooleanCase {
    let s = 2f64.powi(k);
    let triangle = ring([[0.0, 0.0], [4.0 * s, 0.0], [0.0, 4.0 * s]]);
    let square = rectangle([[s, s], [2.5 * s, 2.5 * s]]);
    of_area(s, [vec![triangle], vec![square]], Region::intersection, 1.75 * s * s)
}

/// 64 thin wedges that point at the origin from all sides and pass it at 10^-k: |A ∪ B| + |A ∩ B| = |A| + |B|.
fn concurrent(k: i32) -> BooleanCase {
    let near = 10f64.powi(-k);
    let wedge = |i: i32| {
        let toward = DVec2::from_angle(f64::from(i) * 0.098 + 0.01);
        let aside = toward.perp();
        vec![
            -4.0 * toward + near * aside,
            4.0 * toward + (near + 0.04) * aside,
            4.0 * toward + (near - 0.04) * aside,
        ]
    };
    let [a, b] = [0, 1].map(|first| (first..64).step_by(2).map(wedge).collect::<Vec<_>>());
    let parts = [region(&a), region(&b)];
    let off = move |union: &Region| {
        let whole = parts[0].area() + parts[1].area();
        ((union.area() + parts[0].intersection(&parts[1]).area()) / whole - 1.0).abs()
    };
    BooleanCase { at: near, operands: [a, b], op: Region::union, off: Box::new(off) }
}

/// 16 × 16 unit squares and the same moved by 2^-k along both axes.
fn coincident(k: i32) -> BooleanCase {
    let (n, shift) = (16, 2f64.powi(-k));
    let grid = |by: f64| -> Vec<Vec<DVec2>> {
        let place = |i: i32| f64::from(i) + by;
        let square = |i: i32| rectangle([[place(i % n), place(i / n)], [place(i % n + 1), place(i / n + 1)]]);
        (0..n * n).map(square).collect()
    };
    let side = f64::from(n);
    let area = side * side + shift * (2.0 * side - shift);
    of_area(shift, [grid(0.0), grid(shift)], Region::union, area)
}

/// Two strips 2^k long whose lower edges cross at a slope of 2^-20 of what is left.
fn parallel(k: i32) -> BooleanCase {
    let (length, tilt) = (2f64.powi(k), 2f64.powi(-20));
    let level = rectangle([[0.0, 0.0], [length, 1.0]]);
    let tilted = ring([[0.0, -tilt], [length, tilt], [length, 1.0], [0.0, 1.0]]);
    of_area(length / tilt, [vec![level], vec![tilted]], Region::intersection, length * (1.0 - tilt / 4.0))
}

/// 2^k slats along each axis, all of them across all others.
fn slats(k: i32) -> BooleanCase {
    let count = 2_i32.pow(k.unsigned_abs());
    let high = f64::from(2 * count);
    let along = |i: i32| [f64::from(2 * i), f64::from(2 * i) + 1.0];
    let upright = |i: i32| along(i).map(|x| [x, 0.0]);
    let rows = (0..count).map(|i| rectangle([[0.0, along(i)[0]], [high, along(i)[1]]])).collect();
    let columns = (0..count).map(|i| rectangle([upright(i)[0], [upright(i)[1][0], high]])).collect();
    let area = f64::from(count) * f64::from(count);
    of_area(f64::from(8 * count), [rows, columns], Region::intersection, area)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_area_is_met_and_every_result_is_valid() {
        for row in measure(&Plan { scenes: Vec::new(), quick: true, general: true }) {
            assert_eq!(row.valid, Some(true), "{} {}", row.subject, row.amount);
            assert!(row.error.max < 1e-12, "{} {}: {}", row.subject, row.amount, row.error.max);
        }
    }
}
