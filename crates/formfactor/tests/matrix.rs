//! Matrices put together from rows, and the laws of what is done to them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{Enclosure, Error, ExchangeRow, Factor, FactorMatrix, Limits, PlanarPolygon};

/// The faces of a box, seen from inside or from outside, as quadrangles.
fn faces(low: [f64; 3], high: [f64; 3], inside: bool) -> Vec<PlanarPolygon> {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] });
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let face = |quad: [usize; 4]| {
        let mut points = quad.map(corner);
        if !inside {
            points.reverse();
        }
        PlanarPolygon::new([points]).unwrap()
    };
    quads.map(face).to_vec()
}

/// A room with a box in its middle.
fn room() -> Enclosure {
    let walls = faces([0.0; 3], [3.0, 4.0, 2.5], true);
    Enclosure::new([walls, faces([1.0, 1.0, 0.5], [1.7, 2.4, 1.6], false)].concat())
}

fn areas(enclosure: &Enclosure) -> Vec<f64> {
    enclosure.polygons().iter().map(PlanarPolygon::area).collect()
}

fn rows(enclosure: &Enclosure, tolerance: f64) -> Vec<ExchangeRow> {
    let row = |from| enclosure.exchange_row(from, tolerance, &Limits::default()).unwrap().unwrap();
    (0..enclosure.polygons().len()).map(row).collect()
}

fn matrix(enclosure: &Enclosure, tolerance: f64) -> FactorMatrix {
    FactorMatrix::new(&areas(enclosure), rows(enclosure, tolerance))
}

/// The largest difference between A_i F_ij and A_j F_ji.
fn reciprocity(factors: &FactorMatrix) -> f64 {
    let differs = |from: usize| {
        let back = move |to: usize| factors.areas()[to] * factors.factor(to, from).value;
        factors.row(from).map(move |f| (factors.areas()[from] * f.value - back(f.to)).abs())
    };
    (0..factors.len()).flat_map(differs).fold(0.0, f64::max)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

#[test]
fn rows_in_any_order_make_the_matrix() {
    let room = room();
    let rows = rows(&room, 1e-4);
    let expected = FactorMatrix::new(&areas(&room), rows.clone());
    let mut others: Vec<ExchangeRow> = rows.into_iter().rev().collect();
    others.push(others[3].clone());
    assert_eq!(FactorMatrix::new(&areas(&room), others), expected);
    for (from, row) in room.area_matrix(1e-4, &Limits::default()).unwrap().unwrap().into_iter().enumerate() {
        let entry = |f: formfactor::Factor| (f.to, f.value, f.error);
        let found: Vec<_> = expected.row(from).map(entry).collect();
        let row: Vec<_> = row.iter().map(|(to, f)| (*to, f.value, f.error_estimate)).collect();
        assert_eq!(found, row, "row {from}");
    }
}

#[test]
fn a_missing_row_leaves_the_others() {
    let room = room();
    let (whole, mut few) = (matrix(&room, 1e-4), rows(&room, 1e-4));
    few.remove(4);
    let part = FactorMatrix::new(&areas(&room), few);
    assert_eq!(part.factor(4, 1), whole.factor(4, 1));
    assert!(whole.factor(4, 5).value > 0.1 && part.factor(4, 5).value == 0.0);
}

#[test]
fn closing_keeps_both_laws_and_changes_no_more_than_the_defects() {
    let factors = matrix(&room(), 1e-3);
    let (closed, report) = factors.closed().unwrap();
    assert!(largest(&factors.defects()) > 1e-7, "there is nothing to close");
    assert!((report.defect - largest(&factors.defects())).abs() < 1e-14);
    assert!(report.change > 0.0 && report.change < 4.0 * report.defect, "{report:?}");
    assert!(largest(&closed.defects()) < 1e-13 && reciprocity(&closed) < 1e-13, "{closed:?}");
    assert_eq!((closed.starts(), closed.columns()), (factors.starts(), factors.columns()));
    // Closing again changes nothing.
    assert!(closed.closed().unwrap().1.change < 1e-13);
}

/// The smallest change: any other change that keeps the laws is orthogonal to it, weighted by 1 / e.
#[test]
fn closing_is_least_squares() {
    let factors = matrix(&room(), 1e-3);
    let closed = factors.closed().unwrap().0;
    let change = |i: usize, j: usize| {
        let [before, after] = [&factors, &closed].map(|f| f.areas()[i] * f.factor(i, j).value);
        (after - before) / before
    };
    // Around a circle of four walls: + − + − keeps each row's sum.
    for [a, b, c, d] in [[0, 1, 2, 3], [0, 2, 4, 1], [5, 3, 1, 0], [2, 4, 3, 5]] {
        let around = change(a, b) - change(b, c) + change(c, d) - change(d, a);
        let size = [change(a, b), change(b, c), change(c, d), change(d, a)].map(f64::abs).iter().sum::<f64>();
        assert!(around.abs() <= 1e-6 * size + 1e-12, "{around} of {size}");
    }
}

#[test]
fn what_is_open_is_not_closed() {
    let walls = faces([0.0; 3], [1.0; 3], true);
    let open = matrix(&Enclosure::new(walls[1..].to_vec()), 1e-6);
    let refused = open.closed().unwrap_err();
    assert!(matches!(refused, Error::NotClosed { defect, .. } if (defect - 0.2).abs() < 1e-3), "{refused}");
    let with_space = open.with_space();
    assert!(largest(&with_space.defects()) < 1e-15);
    assert!((with_space.factor(0, 5).value - 0.199_825).abs() < 1e-6, "the wall that is missing is space");
    assert!(matches!(with_space.closed(), Err(Error::NotClosed { .. })));
}

#[test]
fn space_comes_after_what_a_row_had() {
    // A closed box, whose rows add to about 1 from both sides, between two rows that see nothing but space.
    let alone = |z: f64| PlanarPolygon::new([[[5.0, 5.0, z], [6.0, 5.0, z], [5.0, 6.0, z]]]).unwrap();
    let surfaces = [vec![alone(0.0)], faces([0.0; 3], [1.0; 3], true), vec![alone(9.0)]].concat();
    let factors = matrix(&Enclosure::new(surfaces), 1e-3);
    let with_space = factors.clone().with_space();
    for from in 0..factors.len() {
        let before: Vec<Factor> = factors.row(from).collect();
        let found: Vec<Factor> = with_space.row(from).collect();
        let sum: f64 = before.iter().map(|f| f.value).sum();
        assert_eq!(found[..before.len()], before, "row {from}");
        let space: Vec<_> = found[before.len()..].iter().map(|f| (f.to, f.value, f.error)).collect();
        let errors = before.iter().map(|f| f.error).sum();
        let expected = (sum < 1.0).then_some((factors.len(), 1.0 - sum, errors));
        assert_eq!(space, expected.into_iter().collect::<Vec<_>>(), "row {from}");
    }
    assert!(with_space.factor(0, factors.len()).value > 1.0 - 1e-6);
}

#[test]
fn small_factors_go_and_sums_stay() {
    let factors = matrix(&room(), 1e-5);
    let few = factors.without_below(0.02);
    assert!(few.values().len() < factors.values().len());
    for from in 0..few.len() {
        assert!((few.defects()[from] - factors.defects()[from]).abs() < 1e-15, "row {from}");
        for kept in few.row(from) {
            let before = [factors.factor(from, kept.to), factors.factor(kept.to, from)];
            assert!(before.iter().any(|f| f.value >= 0.02), "{from} to {}", kept.to);
            assert!((kept.value - before[0].value).abs() <= kept.error);
        }
    }
    assert_eq!(factors.without_below(0.0), factors);
    assert!(
        factors.without_below(2.0).starts().windows(2).all(|ends| ends[1] > ends[0]),
        "largest ones stay"
    );
}

#[test]
fn groups_are_one_surface() {
    let room = room();
    let factors = matrix(&room, 1e-6);
    // The six walls each their own; the box one surface.
    let grouped = factors.grouped(&[0, 1, 2, 3, 4, 5, 6, 6, 6, 6, 6, 6]);
    assert_eq!(grouped.len(), 7);
    assert!(largest(&grouped.defects()) < 1e-5 && reciprocity(&grouped) < 1e-12);
    // A convex box sees the walls alone, so A F to the box from all walls is its area.
    let to_box: f64 = (0..6).map(|wall| grouped.areas()[wall] * grouped.factor(wall, 6).value).sum();
    assert!((to_box - grouped.areas()[6]).abs() < 1e-5);
    // Everything as one sees itself.
    let one = factors.grouped(&[0; 12]);
    assert!((one.factor(0, 0).value - 1.0).abs() < 1e-5 && one.len() == 1);
}

#[test]
fn gray_surfaces_absorb_all_that_one_emits() {
    let (factors, _) = matrix(&room(), 1e-3).closed().unwrap();
    let emittances: Vec<f64> = (0..12).map(|i| 0.05 + 0.08 * f64::from(i)).collect();
    let gray = factors.with_emittances(&emittances).unwrap();
    assert!(reciprocity(&gray) < 1e-12);
    for (from, emittance) in emittances.iter().enumerate() {
        let sum: f64 = gray.row(from).map(|f| f.value).sum();
        assert!((sum - emittance).abs() < 1e-12, "row {from}: {sum}");
    }
    // The independent way: what is absorbed at each of 2 000 reflections.
    let mut on_way: Vec<f64> = (0..12).map(|j| emittances[3] * factors.factor(3, j).value).collect();
    let mut absorbed = [0.0; 12];
    for _ in 0..2000 {
        (0..12).for_each(|j| absorbed[j] += emittances[j] * on_way[j]);
        let from =
            |j: usize| (0..12).map(|i| (1.0 - emittances[i]) * on_way[i] * factors.factor(i, j).value).sum();
        on_way = (0..12).map(from).collect();
    }
    for (j, absorbed) in absorbed.iter().enumerate() {
        assert!((gray.factor(3, j).value - absorbed).abs() < 1e-12, "to {j}");
    }
    let black = factors.with_emittances(&[1.0; 12]).unwrap();
    assert!((0..12).all(|i| (black.factor(0, i).value - factors.factor(0, i).value).abs() < 1e-15));
    assert_eq!(factors.with_emittances(&[0.0; 12]), Err(Error::BadEmittance { surface: 0 }));
    assert_eq!(factors.with_emittances(&[0.5; 11]), Err(Error::BadEmittance { surface: 11 }));
}
