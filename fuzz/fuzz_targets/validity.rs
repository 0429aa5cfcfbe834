//! Where rounding breaks boundaries: quadrilaterals in slabs of a few ulps, bundles of needles through nearly one point.
//! Every result is valid and reads as itself, and triangles cover it.
#![no_main]
use arbitrary::Arbitrary;
use glam::DVec2;
use libfuzzer_sys::fuzz_target;
use polycsg::{Csg, FillRule, Region};
use tests::Ring;
use tests::against::shapes;
use tests::triangles::check_cover;
use tests::validity;

#[derive(Arbitrary, Debug)]
struct Input {
    height: u8,
    slabs: Vec<[[u8; 2]; 4]>,
    hub: [u8; 2],
    needles: Vec<[i8; 4]>,
    exponent: i8,
}

const MOST_SHAPES: usize = 8;

fuzz_target!(|input: Input| {
    let scale = 2.0_f64.powi(i32::from(input.exponent) * 7);
    let scaled = |ring: Ring| ring.into_iter().map(|p| p * scale).collect();
    let slabs: Vec<Ring> = input.slabs.iter().take(MOST_SHAPES).map(|s| scaled(slab(s, &input))).collect();
    let needles: Vec<Ring> =
        input.needles.iter().take(MOST_SHAPES).map(|n| scaled(needle(*n, &input))).collect();
    let leaf = |rings: &[Ring]| Csg::from_rings(rings, FillRule::EvenOdd).expect("finite points");
    let (a, b) = (leaf(&slabs), leaf(&needles));
    let results = [a.clone() | b.clone(), a.clone() & b.clone(), a.clone() - b.clone(), a ^ b];
    for result in results.map(|csg| csg.evaluate()) {
        let checked = validity::check(&shapes(&result)).and_then(|()| check_cover(&result));
        checked.unwrap_or_else(|e| panic!("{e}\n{slabs:?}\n{needles:?}"));
        assert_eq!(result.validate(), Ok(()));
        let again = Region::from_rings(result.rings(), FillRule::NonZero);
        assert_eq!(again.as_ref(), Ok(&result), "{slabs:?}\n{needles:?}");
    }
});

fn slab(corners: &[[u8; 2]; 4], input: &Input) -> Ring {
    let ulps = f64::EPSILON * f64::from(input.height % 64) / 64.0;
    corners.map(|[x, y]| DVec2::new(f64::from(x) / 255.0, 0.7 + ulps * f64::from(y))).to_vec()
}

fn needle([x, y, along, across]: [i8; 4], input: &Input) -> Ring {
    let hub = DVec2::new(f64::from(input.hub[0]) / 256.0, 0.7 + f64::EPSILON * f64::from(input.hub[1]));
    let to = DVec2::new(f64::from(x), f64::from(y) / 64.0) / 127.0;
    let off = DVec2::new(f64::from(along), f64::from(across)) * f64::EPSILON / 8.0;
    vec![hub - to, hub + to, hub + to + off]
}
