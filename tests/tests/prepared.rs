//! A prepared region is its region, bit for bit, in every call; what contains and meets what is as the oracle says.
use glam::DVec2;
use num_traits::Zero;
use polycsg::{BoundaryEdge, Csg, FillRule, Location, PreparedRegion, Region, Scratch};
use std::f64::consts::TAU;
use tests::against::{self, operand, region};
use tests::generators::{KINDS, crowd, lattice, nasty};
use tests::oracle::{Arrangement, Operation, Place, locate};
use tests::random::Random;
use tests::validity::first_contact;
use tests::{Ring, exact};

/// Pairs of regions: lattices, where everything touches, and nasty ones.
fn pairs() -> impl Iterator<Item = (String, Region, Region)> {
    let nasty_pairs = (0..KINDS.len()).flat_map(|kind| (0..8).map(move |seed| nasty(kind, seed)));
    (0..300).map(lattice).chain(nasty_pairs).map(|pair| (pair.name, region(&pair.a), region(&pair.b)))
}

fn star(corners: usize, inner: f64) -> Ring {
    let radius = |i: usize| if i.is_multiple_of(2) { 10.0 } else { inner };
    (0..corners).map(|i| DVec2::from_angle(TAU * i as f64 / corners as f64) * radius(i)).collect()
}

/// A corridor wound around the origin, as wide as the walls between its turns.
fn spiral(corners: u32) -> Ring {
    let at = |i: u32, width: f64| {
        let angle = f64::from(i) * 0.3;
        DVec2::from_angle(angle) * (angle / TAU + width)
    };
    (0..corners).map(|i| at(i, 0.0)).chain((0..corners).rev().map(|i| at(i, 0.5))).collect()
}

fn square(low: DVec2, size: f64) -> Ring {
    [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| low + p * size).to_vec()
}

/// A board of squares that touch in corners, and of frames with islands.
fn board() -> Vec<Ring> {
    let cells = (0..144).map(|i| DVec2::new(f64::from(i % 12), f64::from(i / 12)) - 6.0);
    let black = cells.clone().filter(|cell| (cell.x + cell.y) % 2.0 == 0.0);
    let islands = cells.flat_map(|cell| [square(cell + 0.25, 0.5), square(cell + 0.375, 0.25)]);
    black.map(|cell| square(cell, 1.0)).chain(islands).collect()
}

/// Regions of many edges and rings.
fn large() -> Vec<(&'static str, Region)> {
    let of = |rings: Vec<Ring>| Region::from_rings(rings, FillRule::EvenOdd).expect("finite");
    let moved = |ring: Ring| ring.into_iter().map(|p| p - 10.0).collect();
    let crowd =
        Region::from_rings(crowd(3, 120).into_iter().map(moved).collect::<Vec<Ring>>(), FillRule::NonZero);
    vec![
        ("smooth", of(vec![star(500, 10.0)])),
        ("spiky", of(vec![star(400, 7.0)])),
        ("spiral", of(vec![spiral(160)])),
        ("board", of(board())),
        ("frames", of((1..40).map(|i| star(12, f64::from(i) * 0.2)).collect())),
        ("crowd", crowd.expect("finite")),
        ("nothing", Region::default()),
    ]
}

/// Small regions for one: on quarters, near its vertices, of its own vertices, around all of it.
fn small(large: &Region, seed: u64) -> Region {
    let mut random = Random::new(seed);
    let vertices: Ring = large.rings().flatten().copied().collect();
    let quarter = |random: &mut Random| f64::from(random.between(-48, 48)) / 4.0;
    let any = DVec2::new(quarter(&mut random), quarter(&mut random));
    let at = if vertices.is_empty() { 0 } else { random.below(vertices.len()) };
    let own = vertices.get(at).copied().unwrap_or(any);
    let ring = match random.below(6) {
        0 => square(any, f64::from(random.between(1, 9)) / 4.0),
        1 => square(own, random.range(0.01, 1.0)),
        2 => star(7, 3.0).into_iter().map(|p| own + p * random.range(0.001, 0.2)).collect(),
        3 => vertices.iter().skip(at).take(3 + random.below(9)).copied().collect(),
        4 => square(any * 1.5, 0.25),
        _ => square(DVec2::splat(-20.0), if random.one_in(4) { 40.0 } else { 12.0 }),
    };
    Region::from_rings([ring], FillRule::EvenOdd).expect("finite")
}

/// All operations of one region with another one, prepared or not, and deeper ones.
fn expressions<'a>(large: &Csg<'a>, small: &'a Region, other: &'a Region) -> Vec<Csg<'a>> {
    let [p, s, o] = [large.clone(), Csg::from(small), Csg::from(other)];
    let c = Clone::clone;
    vec![
        c(&p) & c(&s),
        c(&s) - c(&p),
        c(&p) - c(&s),
        c(&p) | c(&s),
        c(&p) ^ c(&s),
        c(&s) & c(&p) & c(&o),
        c(&s) & (c(&o) - c(&p)),
        c(&s) & (c(&o) ^ c(&p)),
        (c(&s) & c(&p)) | (c(&o) - c(&p)),
        c(&s) - (c(&o) - c(&p)),
        (c(&p) & c(&p) & c(&s)) ^ o,
    ]
}

fn check(name: &str, large: &Region, others: [&Region; 2]) {
    let prepared = PreparedRegion::from(large.clone());
    let [small, other] = others;
    let plain = expressions(&Csg::from(large), small, other);
    for (i, (plain, quick)) in plain.iter().zip(expressions(&Csg::from(&prepared), small, other)).enumerate()
    {
        assert_eq!(quick.evaluate(), plain.evaluate(), "{name}: expression {i}");
    }
    let clipped = prepared.clip_all(&[small.clone(), other.clone()]);
    assert_eq!(clipped, [small.intersection(large), other.intersection(large)], "{name}: clipped");
    for other in others {
        assert_eq!(prepared.contains(other), large.contains(other), "{name}: contains");
        assert_eq!(prepared.intersects(other), other.intersects(large), "{name}: intersects");
        assert!(!prepared.contains(other) || other.intersection(large) == *other, "{name}: contained");
    }
}

#[test]
fn every_result_is_that_of_the_region() {
    for (name, a, b) in pairs() {
        check(&name, &a, [&b, &a]);
    }
    for (name, large) in large() {
        for seed in 0..80 {
            check(&format!("{name} {seed}"), &large, [&small(&large, seed), &small(&large, seed + 1000)]);
        }
    }
}

#[test]
fn boundaries_name_the_edges_of_the_region() {
    for (name, large) in large() {
        let prepared = PreparedRegion::from(large.clone());
        let mut pieces = 0;
        for seed in 0..60 {
            let small = small(&large, seed);
            let [quick, plain] = [Csg::from(&prepared), Csg::from(&large)].map(|large| {
                let common = large & Csg::from(&small);
                let mut edges: Vec<BoundaryEdge> = common.boundary(&mut Scratch::default()).edges().collect();
                // Of edges that coincide either one may be named.
                edges.retain(|edge| edge.operand == 0);
                edges.sort_by_key(|edge| (edge.edge, edge.start.x.to_bits(), edge.start.y.to_bits()));
                edges
            });
            let coincide = small.rings().flatten().any(|p| large.locate(*p) == Location::Boundary);
            assert!(coincide || quick == plain, "{name} {seed}");
            pieces += if coincide { 0 } else { quick.len() };
        }
        assert!(pieces > 100 || large.is_empty(), "{name}: only {pieces} pieces");
    }
}

/// Intersections and differences confine their result to a box, and operands are cut down to it; a symmetric difference takes all.
#[test]
fn cut_operands_yield_the_same() {
    for (name, large) in large() {
        let rings: Vec<Ring> = large.rings().map(<[DVec2]>::to_vec).collect();
        for seed in 0..40 {
            let small = small(&large, seed);
            let raw = || Csg::from_rings(&rings, FillRule::Positive).expect("finite");
            let (a, b) = (|| Csg::from(&small), || Csg::from(&large));
            let common = (a() ^ b() ^ (a() | b())).evaluate();
            let rest = (b() ^ (a() | b())).evaluate();
            for large in [b(), raw()] {
                assert_eq!((a() & large.clone()).evaluate(), common, "{name} {seed}");
                assert_eq!((a() - large).evaluate(), rest, "{name} {seed}");
            }
        }
    }
}

#[test]
fn points_are_located_as_in_the_region() {
    let regions = large().into_iter().map(|(name, region)| (name.to_owned(), region));
    for (name, region) in regions.chain(pairs().map(|(name, region, _)| (name, region))) {
        let prepared = PreparedRegion::from(region.clone());
        let mut random = Random::new(1);
        let vertices: Ring = region.rings().flatten().copied().collect();
        let middles = region.rings().flat_map(exact::edges).map(|(p, q)| p / 2.0 + q / 2.0);
        let mixed = vertices.iter().map(|p| DVec2::new(p.x, vertices[random.below(vertices.len())].y));
        let lattice =
            (-40..40).flat_map(|x| (-40..40).map(move |y| DVec2::new(f64::from(x), f64::from(y)) / 4.0));
        let nowhere = [DVec2::NAN, DVec2::INFINITY, DVec2::MAX];
        for point in vertices.iter().copied().chain(middles).chain(mixed).chain(lattice).chain(nowhere) {
            assert_eq!(prepared.locate(point), region.locate(point), "{name}: {point}");
        }
    }
}

#[test]
fn containing_and_meeting_are_as_the_oracle_says() {
    let (mut contained, mut touching) = (0, 0);
    for (name, a, b) in pairs() {
        let parts = [a.intersection(&b), a.union(&b), b.difference(&a)];
        for (x, y) in [(&a, &b), (&a, &parts[0]), (&parts[1], &b), (&a, &parts[2]), (&a, &a)] {
            let [p, q] = [operand(x), operand(y)];
            let rest = Arrangement::of(&[q.clone(), p.clone()]).operation(Operation::Difference).area();
            assert_eq!(x.contains(y), rest.is_zero(), "{name}: {x:?} contains {y:?}");
            contained += usize::from(rest.is_zero() && !y.is_empty());
            let in_other = |points: &Region, other| {
                points.rings().flatten().any(|&point| locate(point, other) != Place::Outside)
            };
            let mut edges = against::sorted_edges(x);
            edges.extend(against::sorted_edges(y));
            let meet = in_other(x, &q) || in_other(y, &p) || first_contact(&edges).is_some();
            assert_eq!(x.intersects(y), meet, "{name}: {x:?} meets {y:?}");
            touching += usize::from(meet && x.intersection(y).is_empty());
        }
    }
    assert!(contained > 300 && touching > 100, "{contained} contained, {touching} touching");
}
