//! Parallel rectangles on a lattice, two that face each other and a few between: the form factor from area to area is within
//! 1e-3 of the closed form, and the interval that is said to hold has it.
#![no_main]
use arbitrary::Arbitrary;
use formfactor::{Enclosure, Limits, PlanarPolygon};
use libfuzzer_sys::fuzz_target;
use tests::obstructed::{Pair, Plate, Plates};

#[derive(Arbitrary, Debug)]
struct Input {
    source: Sides,
    target: Sides,
    height: u8,
    blockers: Vec<(Sides, u8)>,
}

/// A corner and sizes, in x and y.
#[derive(Arbitrary, Debug, Clone, Copy)]
struct Sides([(i8, u8); 2]);

const MOST_BLOCKERS: usize = 5;
const TOLERANCE: f64 = 1e-3;
/// What an interval may cost: it holds however few there are.
const BUDGET: u64 = 500;
/// Steps of the lattice in a unit of length, and in the height of the target.
const STEPS: f64 = 16.0;

fuzz_target!(|input: Input| {
    let height = f64::from(input.height % 32 + 2) / STEPS;
    let blockers = input.blockers.iter().take(MOST_BLOCKERS);
    let plates = Plates {
        source: plate(input.source, 0.0),
        target: plate(input.target, height),
        blockers: blockers
            .map(|(sides, share)| plate(*sides, height * f64::from(share % 15 + 1) / STEPS))
            .collect(),
    };
    let exact = plates.form_factor();
    let pair = Pair::upright("fuzzed".into(), plates);
    let polygon = |points| PlanarPolygon::new([points]).expect("a rectangle");
    let enclosure = Enclosure::new(pair.polygons().into_iter().map(polygon).collect());
    let found = enclosure
        .area_form_factor(0, 1, TOLERANCE, &Limits::default())
        .expect("a tolerance above 0")
        .expect("no stop");
    assert!((found.value - exact).abs() <= TOLERANCE, "{found:?}, exactly {exact}: {pair:?}");
    assert!((0.0..=1.0).contains(&found.value), "{found:?}");
    let limits = Limits { per_pair: BUDGET, ..Limits::default() };
    let bounded = enclosure
        .bounded_area_form_factor(0, 1, TOLERANCE, &limits)
        .expect("a tolerance above 0")
        .expect("no stop");
    let error = (bounded.value - exact).abs() - 1e-13;
    assert!(error <= bounded.error_bound, "{bounded:?}, exactly {exact}: {pair:?}");
});

fn plate(sides: Sides, height: f64) -> Plate {
    let [x, y] = sides.0.map(|(from, size)| {
        let low = f64::from(from % 32) / STEPS;
        [low, low + f64::from(size % 32 + 1) / STEPS]
    });
    Plate { x, y, height }
}
