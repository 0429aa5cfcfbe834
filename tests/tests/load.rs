//! Much of what is hard: one vertex of many edges, nests, copies, combs, long expressions. Each has a known answer.
//!
//! The suite runs small sizes; the large ones are run on demand. On two cores of a virtual machine, release build:
//!
//! | test | time | memory |
//! | --- | --- | --- |
//! | `one_vertex_of_a_hundred_thousand_edges` | 1.5 s | 170 MB |
//! | `two_vertices_of_a_hundred_thousand_edges` | 1.3 s | 215 MB |
//! | `a_million_squares_and_one_far_away` | 4.2 s | 1.7 GB |
//! | `a_hundred_thousand_nested_rings` | 2.8 s | 200 MB |
//! | `a_million_copies` | 0.8 s | 615 MB |
//! | `a_million_rings` | 1.5 s | 1.1 GB |
//! | `one_ring_of_two_million_edges` | 1.4 s | 1.1 GB |
//! | `one_ring_of_ten_million_edges` | 14 s | 5.5 GB |
//! | `four_million_crossings`, twice | 11 s | 2.5 GB |
//! | `more_crossings_than_memory`, refused | 0.5 s | 470 MB |
//! | `fifty_thousand_edges_nearly_through_a_point`, twice | 2.6 s | 155 MB |
//! | `twenty_thousand_strips_a_few_roundings_apart` | 4.8 s | 230 MB |
//! | `a_star_of_a_few_roundings_below_many_edges` | 4.6 s | 65 MB |
//! | `expressions_a_hundred_thousand_deep`, to the left and to the right | 0.2 s | 160 MB |
use glam::DVec2;
use polycsg::{Csg, Error, FillRule, Region, Scratch};
use tests::Ring;

fn read(rings: &[Ring], rule: FillRule) -> Region {
    Region::from_rings(rings, rule).expect("finite points")
}

fn rectangle(low: [usize; 2], high: [usize; 2]) -> Ring {
    let [[a, b], [c, d]] = [low, high].map(|p| p.map(coordinate));
    [[a, b], [c, b], [c, d], [a, d]].map(DVec2::from).to_vec()
}

fn coordinate(n: usize) -> f64 {
    f64::from(u32::try_from(n).expect("a small number"))
}

/// Triangles from one vertex to every second one of the pieces of a square's side: 2 n edges meet in a point.
fn hub(n: usize) {
    let fan: Vec<Ring> = (0..n)
        .map(|i| [[0, n], [2 * i, 0], [2 * i + 1, 0]].map(|p| DVec2::from(p.map(coordinate))).to_vec())
        .collect();
    let region = read(&fan, FillRule::NonZero);
    assert_eq!(region.polygons().count(), n);
    assert_eq!(region.area(), coordinate(n) * coordinate(n) / 2.0);
    let whole = read(
        &[vec![DVec2::new(0.0, coordinate(n)), DVec2::ZERO, DVec2::new(coordinate(2 * n), 0.0)]],
        FillRule::NonZero,
    );
    assert_eq!(whole.difference(&region).polygons().count(), n);
}

/// Two such vertices beside one another, two roundings apart, each with its triangles on the side away from the other.
fn hubs(n: usize) {
    let (top, beside) = (coordinate(n), coordinate(n).next_up().next_up());
    let triangle = |i: usize, apex: f64, base: usize| {
        let [left, right] = [2 * i, 2 * i + 1].map(|x| DVec2::new(coordinate(x), coordinate(base)));
        vec![DVec2::new(0.0, apex), left, right]
    };
    let fans: Vec<Ring> = (0..n).flat_map(|i| [triangle(i, top, 0), triangle(i, beside, 2 * n)]).collect();
    assert_eq!(read(&fans, FillRule::NonZero).polygons().count(), 2 * n);
}

/// A lattice of squares side by side and one square far away: the points' box says nothing about where they are.
fn far(n: usize) {
    let mut squares: Vec<Ring> =
        (0..n * n).map(|i| [i % n, i / n]).map(|[x, y]| rectangle([x, y], [x + 1, y + 1])).collect();
    squares.push(rectangle([1 << 30, 1 << 30], [(1 << 30) + 1, (1 << 30) + 1]));
    let region = read(&squares, FillRule::NonZero);
    assert_eq!((region.polygons().count(), region.area()), (2, coordinate(n * n + 1)));
}

/// Squares in squares: every second one is a hole, and each hole is its square's.
fn nest(n: usize) {
    let squares: Vec<Ring> = (0..n).map(|i| rectangle([i, i], [4 * n - i, 4 * n - i])).collect();
    let region = read(&squares, FillRule::EvenOdd);
    assert_eq!(region.polygons().count(), n.div_ceil(2));
    for (i, polygon) in region.polygons().enumerate() {
        assert_eq!((polygon.depth(), polygon.holes().count()), (i, usize::from(2 * i + 1 < n)));
    }
}

/// One square many times is that square, or under the even-odd rule nothing.
fn copies(n: usize) {
    let rings = vec![rectangle([0, 0], [1, 1]); 2 * n];
    assert!(read(&rings, FillRule::EvenOdd).is_empty());
    assert_eq!(read(&rings, FillRule::NonZero), read(&rings[..1], FillRule::NonZero));
}

/// Strips across strips: 4 n² crossings, n² squares in common.
fn comb(n: usize) {
    let upright: Vec<Ring> = (0..n).map(|i| rectangle([2 * i + 1, 0], [2 * i + 2, 2 * n + 1])).collect();
    let level: Vec<Ring> = (0..n).map(|i| rectangle([0, 2 * i + 1], [2 * n + 1, 2 * i + 2])).collect();
    let [upright, level] = [upright, level].map(|strips| read(&strips, FillRule::NonZero));
    let common = upright.intersection(&level);
    assert_eq!((common.polygons().count(), common.area()), (n * n, coordinate(n * n)));
    let grid = upright.union(&level);
    let inner = (n - 1) * (n - 1);
    assert_eq!(grid.polygons().map(|p| p.holes().count()).sum::<usize>(), inner);
}

/// Squares in a row, in a lattice: as many polygons.
fn rings(n: usize) {
    let squares: Vec<Ring> = (0..n)
        .map(|i| [3 * (i % 1000), 3 * (i / 1000)])
        .map(|[x, y]| rectangle([x, y], [x + 2, y + 2]))
        .collect();
    let region = read(&squares, FillRule::NonZero);
    assert_eq!((region.polygons().count(), region.area()), (n, coordinate(4 * n)));
}

/// One ring of many edges, a saw over its own base line: a tooth of area 1 for each two edges.
fn saw(n: usize) {
    let teeth = (0..n).flat_map(|i| [[2 * i, 1], [2 * i + 1, 2]]).map(|p| DVec2::from(p.map(coordinate)));
    let ring: Ring = teeth.chain([DVec2::new(coordinate(2 * n), 1.0)]).collect();
    let region = read(&[ring], FillRule::NonZero);
    assert_eq!((region.area(), region.polygons().count()), (coordinate(n), n));
}

/// Expressions that are nested n deep to the left and to the right, their operations alternating so that nothing can be
/// flattened: built, evaluated and dropped without a stack that grows with them.
fn chain(n: usize) {
    let square = |i: usize| read(&[rectangle([3 * i, 0], [3 * i + 2, 2])], FillRule::NonZero);
    let (keep, drop) = (square(0), square(1));
    let nested = (0..n).fold(Csg::from(&keep), |csg, _| (csg | Csg::from(&drop)) - Csg::from(&drop));
    assert_eq!(nested.evaluate(), keep);
    let nested = (0..n).fold(Csg::from(&keep), |csg, _| Csg::from(&keep) & (Csg::from(&drop) | csg));
    assert_eq!(nested.evaluate(), keep);
}

/// Bars across bars, slanted so that no two are in one direction: 4 n² crossings, of which all but `limit` never are.
fn too_many(n: usize, limit: usize) {
    let bars = || (0..n).map(|i| (coordinate(4 * i), coordinate(5 * i)));
    let end = coordinate(5 * n);
    let ring = |points: [[f64; 2]; 4]| points.map(DVec2::from).to_vec();
    let upright: Vec<Ring> =
        bars().map(|(x, y)| ring([[x, -2.0], [x + 1.0, -2.0], [y + 1.0, end], [y, end]])).collect();
    let level: Vec<Ring> =
        bars().map(|(x, y)| ring([[-2.0, x], [end, y], [end, y + 1.0], [-2.0, x + 1.0]])).collect();
    let [upright, level] =
        [upright, level].map(|bars| Csg::from_rings(&bars, FillRule::NonZero).expect("finite points"));
    let refused = (upright & level).try_evaluate_with(&mut Scratch::default(), limit);
    assert_eq!(refused, Err(Error::TooManyContacts { limit }));
}

/// Triangles from one corner, turn by turn, with nothing between their area and the closed form but roundings.
fn fan(n: usize) -> (Vec<Ring>, f64) {
    let corner = DVec2::new(0.3, 0.7);
    let turn = std::f64::consts::TAU / coordinate(n);
    let tip = |i: usize, part: f64| corner + DVec2::from_angle((coordinate(i) + part) * turn);
    let fan = (0..n).map(|i| vec![corner, tip(i, 0.1), tip(i, 0.6)]).collect();
    (fan, coordinate(n) * (turn / 2.0).sin() / 2.0)
}

/// Less a square of some roundings about their corner: 2 n edges end beside one another, and no height tells them apart.
fn cut_corner(n: usize) {
    let (fan, area) = fan(n);
    for size in [2e-12, 2e-14] {
        let [low, high] = [DVec2::new(0.3, 0.7) - size, DVec2::new(0.3, 0.7) + size];
        let square = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let cut = read(&fan, FillRule::NonZero).difference(&read(&[square], FillRule::NonZero));
        assert_eq!(cut.polygons().count(), n);
        assert!(cut.validate().is_ok());
        assert!((cut.area() - area).abs() < 1e-9, "{} for {area}", cut.area());
    }
}

/// Less a star as small, whose every vertex is a rounding from another: hardly a crossing can stay where it is.
fn cut_star(n: usize) {
    let (fan, area) = fan(n);
    let radius = |i: usize| 1e-14 * coordinate(1 + i % 2);
    let angle = |i: usize| (coordinate(i) + 0.3) * std::f64::consts::PI / coordinate(n);
    let vertex = |i: usize| DVec2::new(0.3, 0.7) + DVec2::from_angle(angle(i)) * radius(i);
    let star: Ring = (0..2 * n).map(vertex).collect();
    let cut = read(&fan, FillRule::NonZero).difference(&read(&[star], FillRule::NonZero));
    assert!((cut.area() - area).abs() < 1e-9, "{} for {area}", cut.area());
    assert!(cut.validate().is_ok());
    let again: Vec<Ring> = cut.rings().map(<[DVec2]>::to_vec).collect();
    assert_eq!(read(&again, FillRule::EvenOdd), cut);
}

/// Slanted strips a few roundings apart and half as wide, each with ends of its own, less a square across all of them.
fn cut_strips(n: usize) {
    let strip = |i: usize| {
        let at = |x: f64, part: f64| DVec2::new(x, 0.3 + 0.5 * x + (coordinate(i) + part) * 1e-14);
        let (left, right) = (coordinate(i * 7919 % n), coordinate(i * 6007 % n));
        let [left, right] = [0.3 * left / coordinate(n), 1.0 - 0.3 * right / coordinate(n)];
        vec![at(left, 0.0), at(right, 0.0), at(right, 0.5), at(left, 0.5)]
    };
    let strips: Vec<Ring> = (0..n).map(strip).collect();
    let square = [[0.3, 0.3], [0.7, 0.3], [0.7, 0.8], [0.3, 0.8]].map(DVec2::from).to_vec();
    let cut = read(&strips, FillRule::NonZero).difference(&read(&[square], FillRule::NonZero));
    assert_eq!(cut.polygons().count(), 2 * n);
    assert!(cut.validate().is_ok());
}

#[test]
fn many_edges_nearly_through_a_point() {
    cut_corner(1_000);
}

#[test]
fn many_strips_a_few_roundings_apart() {
    cut_strips(1_000);
}

#[test]
fn a_star_of_a_few_roundings() {
    cut_star(300);
}

#[test]
fn one_vertex_of_many_edges() {
    hub(5_000);
}

#[test]
fn two_vertices_of_many_edges() {
    hubs(3_000);
}

#[test]
fn many_squares_and_one_far_away() {
    far(150);
}

#[test]
fn many_nested_rings() {
    nest(10_000);
}

#[test]
fn many_copies() {
    copies(20_000);
}

#[test]
fn many_crossings() {
    comb(120);
}

#[test]
fn more_crossings_than_asked_for() {
    too_many(5_000, 100_000);
}

#[test]
fn many_rings() {
    rings(30_000);
}

#[test]
fn one_ring_of_many_edges() {
    saw(30_000);
}

#[test]
fn deep_expressions() {
    chain(10_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn one_vertex_of_a_hundred_thousand_edges() {
    hub(50_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn two_vertices_of_a_hundred_thousand_edges() {
    hubs(50_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn a_million_squares_and_one_far_away() {
    far(1_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn a_hundred_thousand_nested_rings() {
    nest(100_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn a_million_copies() {
    copies(500_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn four_million_crossings() {
    comb(1_000);
}

/// 40 000 000 000 crossings would take 20 TB.
#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn more_crossings_than_memory() {
    too_many(100_000, 10_000_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn a_million_rings() {
    rings(1_000_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn one_ring_of_two_million_edges() {
    saw(1_000_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn one_ring_of_ten_million_edges() {
    saw(5_000_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn expressions_a_hundred_thousand_deep() {
    chain(100_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn fifty_thousand_edges_nearly_through_a_point() {
    cut_corner(25_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn twenty_thousand_strips_a_few_roundings_apart() {
    cut_strips(20_000);
}

#[test]
#[ignore = "large: cargo test --release -p tests --test load -- --ignored"]
fn a_star_of_a_few_roundings_below_many_edges() {
    cut_star(4_000);
}
