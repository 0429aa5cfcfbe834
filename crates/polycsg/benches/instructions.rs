//! Instruction counts of the main paths; see the README beside this file.
//!
//! What a benchmark takes it returns, so that dropping it is not counted.
#![allow(missing_docs, reason = "the macros make modules of their own")]

use gungraun::{library_benchmark, library_benchmark_group, main};
use polycsg::{Csg, DVec2, Error, FillRule, Interval, Location, Region, Scratch, classify};
use std::f64::consts::TAU;
use std::hint::black_box;

/// Numbers in [0, 1) that look random and are the same everywhere.
fn spread(i: u32, step: f64) -> f64 {
    (f64::from(i) * step).fract()
}

fn region(ring: impl IntoIterator<Item = DVec2>) -> Region {
    let ring: Vec<DVec2> = ring.into_iter().collect();
    Region::from_rings([ring], FillRule::NonZero).expect("finite points")
}

fn rectangle(low: DVec2, size: DVec2) -> Region {
    region([low, low + DVec2::new(size.x, 0.0), low + size, low + DVec2::new(0.0, size.y)])
}

/// Corners at radii between two bounds in turn: spikes, or a smooth blob when the bounds are close.
fn star(center: DVec2, corners: u32, inner: f64) -> Region {
    let corner = |i: u32| {
        let radius = if i % 2 == 0 { 1.0 } else { inner };
        center + radius * DVec2::from_angle(TAU * f64::from(i) / f64::from(corners))
    };
    region((0..corners).map(corner))
}

/// A square of side 10 and rectangles on and beside it.
fn square_and_rectangles(count: u32) -> (Region, Vec<Region>, Scratch) {
    let low = |i| DVec2::new(spread(i, 0.618_034), spread(i, 0.754_878)) * 11.0 - 1.0;
    let size = |i| {
        DVec2::new(0.1 + spread(i, 0.324_718), 0.1 + spread(i, 0.414_214)) * 3.0 / f64::from(count).sqrt()
    };
    let rectangles = (0..count).map(|i| rectangle(low(i), size(i))).collect();
    warm((rectangle(DVec2::ZERO, DVec2::splat(10.0)), rectangles, Scratch::default()))
}

/// Buffers as they are from the second call on.
fn warm((square, rectangles, mut scratch): (Region, Vec<Region>, Scratch)) -> (Region, Vec<Region>, Scratch) {
    (Csg::from(&square) - Csg::union(&rectangles)).evaluate_with(&mut scratch);
    (square, rectangles, scratch)
}

fn square_and_triangle() -> (Region, Region, Scratch) {
    let square = rectangle(DVec2::ZERO, DVec2::ONE);
    let triangle = region([[0.5, 0.5], [1.5, 0.25], [1.5, 0.75]].map(DVec2::from));
    let mut scratch = Scratch::default();
    (Csg::from(&square) - Csg::from(&triangle)).evaluate_with(&mut scratch);
    (square, triangle, scratch)
}

fn octagons(count: u32) -> Vec<Region> {
    let side = f64::from(count).sqrt();
    (0..count).map(|i| star(DVec2::new(spread(i, 0.618_034), spread(i, 0.754_878)) * side, 8, 0.9)).collect()
}

fn stars(corners: u32, inner: f64) -> [Region; 2] {
    [DVec2::ZERO, DVec2::new(0.013, 0.007)].map(|center| star(center, corners, inner))
}

/// Squares on a lattice, each edge but the outermost shared by two.
fn lattice(side: u32) -> Vec<Region> {
    let low = |i| DVec2::new(f64::from(i % side), f64::from(i / side));
    (0..side * side).map(|i| rectangle(low(i), DVec2::ONE)).collect()
}

fn perforated() -> Region {
    let (square, rectangles, mut scratch) = square_and_rectangles(300);
    (Csg::from(&square) - Csg::union(&rectangles)).evaluate_with(&mut scratch)
}

/// Needles through nearly one point: nearly all crossings round to the same few points, and most results are repaired.
fn needles(count: u32) -> Vec<[DVec2; 3]> {
    let center = DVec2::new(0.3, 0.7);
    let needle = |i: u32| {
        let to = DVec2::from_angle(f64::from(i) / f64::from(count) * TAU / 2.0);
        [center - to, center + to, center + to + DVec2::new(1e-3, 2e-3)]
    };
    (0..count).map(needle).collect()
}

/// Triangles that share one corner exactly.
fn fan(count: u32) -> Vec<[DVec2; 3]> {
    let corner = |i: u32| DVec2::from_angle(f64::from(i) / f64::from(2 * count) * TAU);
    (0..count).map(|i| [DVec2::ZERO, corner(2 * i), corner(2 * i + 1)]).collect()
}

type Difference = (Region, Vec<Region>, Scratch);

#[library_benchmark]
#[bench::one_call(square_and_triangle())]
fn square_minus_triangle(
    (a, b, mut scratch): (Region, Region, Scratch),
) -> (Region, Region, Region, Scratch) {
    let rest = (Csg::from(&a) - Csg::from(&b)).evaluate_with(&mut scratch);
    (rest, a, b, scratch)
}

#[library_benchmark]
#[bench::of_10(square_and_rectangles(10))]
#[bench::of_100(square_and_rectangles(100))]
#[bench::of_1000(square_and_rectangles(1000))]
fn square_minus_rectangles((square, rectangles, mut scratch): Difference) -> (Region, Difference) {
    let rest = (Csg::from(&square) - Csg::union(&rectangles)).evaluate_with(&mut scratch);
    (rest, (square, rectangles, scratch))
}

#[library_benchmark]
#[bench::of_10(square_and_rectangles(10))]
#[bench::of_100(square_and_rectangles(100))]
#[bench::of_1000(square_and_rectangles(1000))]
fn boundary_of_the_same((square, rectangles, mut scratch): Difference) -> (f64, Difference) {
    let area = (Csg::from(&square) - Csg::union(&rectangles)).boundary(&mut scratch).area();
    (area, (square, rectangles, scratch))
}

#[library_benchmark]
#[bench::octagons(octagons(1000))]
#[bench::lattice_squares(lattice(20))]
fn union_of(regions: Vec<Region>) -> (Region, Vec<Region>) {
    (Csg::union(&regions).evaluate(), regions)
}

#[library_benchmark]
#[bench::spiky(stars(1000, 0.2))]
#[bench::smooth(stars(10_000, 0.9999))]
fn intersection_of([a, b]: [Region; 2]) -> [Region; 3] {
    [a.intersection(&b), a, b]
}

#[library_benchmark]
#[bench::needles(needles(30))]
#[bench::fan(fan(300))]
fn triangles_through_a_point(rings: Vec<[DVec2; 3]>) -> (Result<Region, Error>, Vec<[DVec2; 3]>) {
    (Region::from_rings(&rings, FillRule::NonZero), rings)
}

#[library_benchmark]
#[bench::perforated(perforated())]
fn validate(region: Region) -> (bool, Region) {
    (region.validate().is_ok(), region)
}

#[library_benchmark]
#[bench::perforated(perforated())]
fn locate(region: Region) -> (Location, Region) {
    (region.locate(black_box(DVec2::splat(5.1))), region)
}

#[library_benchmark]
#[bench::perforated(perforated())]
fn classify_a_diagonal(region: Region) -> (Result<Vec<Interval>, Error>, Region) {
    (classify(black_box([DVec2::ZERO, DVec2::splat(10.0)]), &region), region)
}

library_benchmark_group!(
    name = main_paths,
    benchmarks = [
        square_minus_triangle,
        square_minus_rectangles,
        boundary_of_the_same,
        union_of,
        intersection_of,
        triangles_through_a_point,
        validate,
        locate,
        classify_a_diagonal,
    ]
);

main!(library_benchmark_groups = main_paths);
