//! A room with boxes at a loose tolerance: few points, and errors far below the estimates.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, Enclosure, Limits, PlanarPolygon, Row, Tolerance};

/// The six sides of a box, each in n x n rectangles, with their fronts outward or inward. Neighbours share the bits of their corners.
fn sides(middle: DVec3, half: DVec3, n: u32, is_outward: bool) -> Vec<PlanarPolygon> {
    let at = |axis: usize, i: u32| middle[axis] + half[axis] * (f64::from(2 * i) / f64::from(n) - 1.0);
    let side = |(axis, end): (usize, u32)| {
        let [u, v] = if (end > 0) == is_outward { [1, 2] } else { [2, 1] }.map(|next| (axis + next) % 3);
        let corner = move |i: u32, j: u32| {
            let mut corner = DVec3::ZERO;
            (corner[axis], corner[u], corner[v]) = (at(axis, end), at(u, i), at(v, j));
            corner
        };
        let tiles = (0..n * n).map(|tile| (tile % n, tile / n));
        let ring = move |(i, j)| [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        tiles.map(ring).map(|ring| PlanarPolygon::new([ring]).unwrap())
    };
    (0..3).flat_map(|axis| [(axis, 0), (axis, n)]).flat_map(side).collect()
}

fn room() -> Enclosure {
    let boxes = [
        sides(DVec3::new(3.0, 3.4, 2.1), DVec3::new(0.7, 0.5, 0.6), 1, true),
        sides(DVec3::new(6.1, 5.2, 6.6), DVec3::new(0.4, 0.7, 0.5), 1, true),
        sides(DVec3::new(7.0, 2.9, 4.0), DVec3::new(0.6, 0.3, 0.7), 1, true),
    ];
    let walls = sides(DVec3::splat(5.0), DVec3::splat(5.0), 4, false);
    Enclosure::new([walls, boxes.concat()].concat())
}

fn rows(tolerance: impl Into<Tolerance>) -> Vec<Row> {
    room().area_matrix(tolerance, &Limits::default()).unwrap().unwrap()
}

#[test]
fn loose_tolerances_take_few_points_and_keep_rows() {
    let loose = rows(Tolerance { absolute: 1e-3, relative: 0.0, row: 8e-3 });
    let tight = rows(1e-6);
    let (mut evaluations, mut largest) = (0, 0.0_f64);
    for (from, (loose, tight)) in loose.iter().zip(&tight).enumerate() {
        let sum: f64 = loose.iter().map(|(_, f)| f.value).sum();
        assert!((sum - 1.0).abs() <= 3e-4, "row {from} adds to {sum}");
        evaluations += loose.iter().map(|(_, f)| f.evaluations).sum::<u64>();
        for (to, exact) in tight {
            let found =
                loose.iter().find(|entry| entry.0 == *to).map_or_else(Default::default, |entry| entry.1);
            let error = (found.value - exact.value).abs();
            let most = found.error_estimate + exact.error_estimate;
            assert!(error <= most, "from {from} to {to}: {found:?} is not {exact:?}");
            largest = largest.max(error);
        }
    }
    // Each pair counts twice in both.
    let mean = evaluations as f64 / (loose.len() * (loose.len() - 1)) as f64;
    println!("largest error {largest:.1e}, {mean:.1} point factors a pair");
    assert!(largest <= 1.5e-4 && mean < 8.0, "largest error {largest:e}, {mean} point factors a pair");
}
