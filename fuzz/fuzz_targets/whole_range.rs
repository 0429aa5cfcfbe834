//! A few vertices of any finite doubles, so that every predicate is asked over the whole exponent range: operations,
//! classification and location against exact integers.
#![no_main]
use arbitrary::Arbitrary;
use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use tests::against::{check, check_classify, check_locate, region};
use tests::generators::Pair;
use tests::oracle::{Arrangement, Operand, Operation, Rule};

#[derive(Arbitrary, Debug)]
struct Input {
    rules: [u8; 2],
    pool: [Number; 6],
    corners: [Vec<[u8; 2]>; 2],
}

/// A sign, a few mantissa bits and an exponent: equal numbers and neighbours are likely.
#[derive(Arbitrary, Debug, Clone, Copy)]
struct Number {
    is_negative: bool,
    exponent: u16,
    top: u8,
    bottom: u8,
}

const MOST_CORNERS: usize = 6;

fuzz_target!(|input: Input| {
    let pool = input.pool.map(value);
    let [a, b] = [0, 1].map(|i| operand(&input, i, &pool));
    let pair = Pair { name: String::new(), a, b };
    let arrangement = Arrangement::of(&[pair.a.clone(), pair.b.clone()]);
    for operation in Operation::ALL {
        if let Err(e) = check(&pair, operation, &arrangement) {
            panic!("{operation:?}: {e}\n{:?}\n{:?}", pair.a, pair.b);
        }
    }
    let region = region(&pair.a);
    let points = &pair.b.rings[0];
    for (p, q) in points.iter().zip(points.iter().skip(1)) {
        check_locate(*p, &region).unwrap_or_else(|e| panic!("{e}\n{:?}", pair.a));
        if p != q {
            check_classify([*p, *q], &region).unwrap_or_else(|e| panic!("{e}\n{:?}", pair.a));
        }
    }
});

fn value(number: Number) -> f64 {
    let exponent = u64::from(number.exponent % 0x7ff);
    let fraction = (u64::from(number.top) << 44) | u64::from(number.bottom);
    f64::from_bits((u64::from(number.is_negative) << 63) | (exponent << 52) | fraction)
}

fn operand(input: &Input, index: usize, pool: &[f64; 6]) -> Operand {
    let pick = |i: u8| pool[usize::from(i) % pool.len()];
    let corners = input.corners[index].iter().take(MOST_CORNERS);
    let ring = corners.map(|c| DVec2::new(pick(c[0]), pick(c[1]))).collect();
    Operand { rings: vec![ring], rule: Rule::ALL[usize::from(input.rules[index] % 3)] }
}
