//! What the simple features' standard says of polygons: known values, and that results have no flaw.

use polycsg::{DVec2, FillRule, Flaw, Region, Scratch, flaw};

type Ring = Vec<[f64; 2]>;

fn square(low: f64, high: f64) -> Ring {
    vec![[low, low], [high, low], [high, high], [low, high]]
}

fn found(polygons: &[Vec<Ring>]) -> Option<Flaw> {
    flaw(polygons, &mut Scratch::default())
}

#[test]
fn valid_polygons_have_no_flaw() {
    let closed: Ring = square(0.0, 4.0).into_iter().chain([[0.0, 0.0]]).collect();
    let clockwise: Ring = square(1.0, 2.0).into_iter().rev().collect();
    let corner: Ring = vec![[0.0, 0.0], [2.0, 1.0], [1.0, 2.0]]; // touches the shell in one point
    for valid in [
        vec![],
        vec![vec![vec![]]],
        vec![vec![]],
        vec![vec![closed, clockwise]],
        vec![vec![square(0.0, 4.0), corner]],
        vec![vec![square(0.0, 1.0)], vec![square(1.0, 2.0)]],
        vec![vec![square(0.0, 9.0), square(1.0, 8.0)], vec![square(2.0, 7.0)]],
    ] {
        assert_eq!(found(&valid), None, "{valid:?}");
    }
}

#[test]
fn flaws_are_named() {
    let bow_tie: Ring = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
    let spike: Ring = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [6.0, 6.0], [4.0, 4.0], [0.0, 4.0]];
    let eight: Ring = vec![[2.0, 2.0], [0.0, 0.0], [4.0, 0.0], [2.0, 2.0], [4.0, 4.0], [0.0, 4.0]];
    let diamond: Ring = vec![[0.0, 2.0], [2.0, 0.0], [4.0, 2.0], [2.0, 4.0]];
    let endless = vec![[0.0, 0.0], [1.0, f64::INFINITY], [1.0, 1.0]];
    for (polygons, expected) in [
        (vec![vec![bow_tie]], Flaw::Crossing { ring: 0, vertex: 0 }),
        (vec![vec![square(9.0, 10.0)], vec![vec![[0.0, 0.0], [1.0, 1.0]]]], Flaw::Short { ring: 1 }),
        (vec![vec![endless]], Flaw::NonFinite { ring: 0, vertex: 1 }),
        (vec![vec![eight]], Flaw::TouchesItself { ring: 0, point: DVec2::new(2.0, 2.0) }),
        (vec![vec![vec![[1.0, 1.0]; 4]]], Flaw::Point { ring: 0 }),
        (vec![vec![square(0.0, 4.0), diamond]], Flaw::Cuts { ring: 0, other: 1 }),
        (vec![vec![square(0.0, 4.0), square(5.0, 6.0)]], Flaw::HoleOutside { ring: 1 }),
        (vec![vec![square(0.0, 4.0)], vec![square(1.0, 2.0)]], Flaw::Inside { ring: 1 }),
        (vec![vec![square(0.0, 4.0)], vec![square(0.0, 4.0)]], Flaw::Crossing { ring: 0, vertex: 0 }),
    ] {
        assert_eq!(found(&polygons), Some(expected), "{polygons:?}");
    }
    assert!(matches!(found(&[vec![spike]]), Some(Flaw::Crossing { ring: 0, .. })));
}

/// A vertex that is an ulp inside of an edge crosses it, one on it touches it.
#[test]
fn a_last_bit_decides() {
    let with = |y: f64| vec![vec![square(0.0, 1.0), vec![[0.5, y], [0.6, 0.5], [0.4, 0.5]]]];
    assert_eq!(found(&with(1.0)), None);
    assert_eq!(found(&with(1.0_f64.next_down())), None);
    assert!(matches!(found(&with(1.0_f64.next_up())), Some(Flaw::Crossing { .. })));
}

/// Whatever rings go in, the region that comes out has no flaw, and rings without one are the region's own.
#[test]
fn results_have_no_flaw_and_what_has_none_is_a_result() {
    let mut state = 1_u64;
    let mut number = |size: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % size
    };
    let (mut scratch, mut sound) = (Scratch::default(), 0);
    for case in 0..3000 {
        let size = 3 + case % 5;
        let rings: Vec<Ring> = (0..1 + number(3))
            .map(|_| (0..3 + number(4)).map(|_| [number(size) as f64, number(size) as f64]).collect())
            .collect();
        let region = Region::from_rings(&rings, FillRule::EvenOdd).expect("finite");
        let polygons: Vec<Vec<Vec<DVec2>>> = region
            .polygons()
            .map(|polygon| {
                std::iter::once(polygon.outer()).chain(polygon.holes()).map(<[_]>::to_vec).collect()
            })
            .collect();
        assert_eq!(flaw(&polygons, &mut scratch), None, "{rings:?}");
        if flaw([&rings], &mut scratch).is_none() {
            sound += 1;
            let sorted = |points: &mut dyn Iterator<Item = DVec2>| {
                let mut points: Vec<[u64; 2]> = points.map(|p| [p.x.to_bits(), p.y.to_bits()]).collect();
                points.sort_unstable();
                points.dedup();
                points
            };
            let given = sorted(&mut rings.iter().flatten().map(|&p| DVec2::from(p)));
            assert_eq!(given, sorted(&mut region.rings().flatten().copied()), "{rings:?}");
            assert_eq!(region.rings().count(), rings.len(), "{rings:?}");
        }
    }
    assert!(sound > 300, "only {sound} are valid");
}
