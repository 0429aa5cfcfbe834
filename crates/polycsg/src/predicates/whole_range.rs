//! Every predicate over the whole range of exponents, against big integers.

use super::configurations::{Configuration, configuration};
use super::laws::{LAWS, certain_order, filtered};
use super::*;
use glam::DVec2;

/// SplitMix64 (Steele, Lea and Flood 2014).
fn words(mut state: u64) -> impl FnMut() -> u64 {
    move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// Asks each predicate so many questions; most configurations hold none for some of them.
fn ask(questions: usize, seed: u64) {
    let mut word = words(seed);
    for (name, law) in LAWS {
        let (mut asked, mut looked_at) = (0, 0);
        while asked < questions {
            let points = configuration(&mut word);
            looked_at += 1;
            assert!(looked_at < 1000 + 200 * questions, "{name} is hardly ever asked");
            if let Some(is_right) = law(&points) {
                assert!(is_right, "{name} is wrong about {points:?}");
                asked += 1;
            }
        }
    }
}

#[test]
fn no_predicate_is_wrong_over_the_whole_range() {
    ask(2_000, 1);
}

#[test]
#[ignore = "minutes: cargo test --release -p polycsg --lib whole_range -- --ignored"]
fn no_predicate_is_wrong_in_a_million_questions() {
    ask(1_000_000, 2);
}

/// How many leave each filter: of at least so many sides, of so many orders along an edge and of so many crossings.
fn unfiltered(questions: u32, mut points: impl FnMut() -> Configuration) -> [u32; 3] {
    let (mut left, mut asked) = ([0; 3], 0);
    while asked < questions {
        let [a, b, c, d, g, h] = points();
        let area = doubled_area(a, b, c);
        left[0] += u32::from(area.value.abs() <= area.error);
        let does_cross = |f: Segment| {
            side(a, b, f[0]) == side(a, b, f[1]).reversed()
                && side(f[0], f[1], a) == side(f[0], f[1], b).reversed()
        };
        if does_cross([c, d]) && does_cross([g, h]) {
            let order = certain_order(filtered([a, b], [c, d]), filtered([a, b], [g, h]));
            left[1] += u32::from(order.is_none());
            left[2] += u32::from(round::crossing_by_residuals([a, b], [c, d]).is_none());
            asked += 1;
        }
    }
    left
}

/// In the unit square, near to one another, and far from the origin: what leaves a filter is rarer than one in 10 000.
#[test]
fn ordinary_input_hardly_ever_leaves_the_filters() {
    let mut word = words(3);
    for (size, origin) in [(1.0, 0.0), (1e-3, 1.0), (1e5, 3e6)] {
        let mut unit = || (word() >> 11) as f64 / (1_u64 << 53) as f64;
        let left = unfiltered(20_000, || {
            std::array::from_fn(|_| DVec2::new(origin + size * unit(), origin + size * unit()))
        });
        assert!(left.iter().all(|&count| count <= 2), "{left:?} of 20 000 left the filters");
    }
}
