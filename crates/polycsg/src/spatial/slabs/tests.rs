//! Whatever meets but in a common end is found, and not much else.
use super::SlabDecomposition;
use crate::base::meter::Meter;
use crate::predicates::{Segment, Side, height_order, is_inside, rightward, side};
use glam::DVec2;
use proptest::prelude::*;
use std::{cmp::Ordering, collections::BTreeSet};

fn find(slabs: &mut SlabDecomposition) -> bool {
    slabs.find(usize::MAX, &Meter::default()).expect("no limit was given")
}

fn slabs_of(segments: &[Segment]) -> SlabDecomposition {
    let (mut slabs, meter) = (SlabDecomposition::default(), Meter::default());
    let numbered = (0..u32::try_from(segments.len()).unwrap()).map(|i| (i, [2 * i, 2 * i + 1]));
    slabs.build(segments.iter().flatten().copied(), numbered, &meter).expect("no limit was given");
    slabs
}

fn visited(slabs: &SlabDecomposition) -> BTreeSet<[u32; 2]> {
    let mut found = BTreeSet::new();
    let note = |i: u32, j| {
        assert!(found.insert([i.min(j), i.max(j)]), "{i} and {j} twice");
        Ok(())
    };
    slabs.visit(note).expect("no limit was given");
    found
}

fn found(segments: &[Segment]) -> BTreeSet<[u32; 2]> {
    let mut slabs = slabs_of(segments);
    assert!(find(&mut slabs));
    visited(&slabs)
}

/// Whether two segments have a point in common that is not an end of both.
fn meet(s: Segment, t: Segment) -> bool {
    let on = |s: Segment, p: DVec2| side(s[0], s[1], p) == Side::On && is_inside(s, p);
    let opposite = |s: Segment, t: Segment| {
        let sides = t.map(|p| side(s[0], s[1], p));
        sides[0] == sides[1].reversed() && sides[0] != Side::On
    };
    on(s, t[0]) || on(s, t[1]) || on(t, s[0]) || on(t, s[1]) || (opposite(s, t) && opposite(t, s))
}

fn check(segments: &[Segment]) {
    let found = found(segments);
    let ends = |i: usize| {
        let [a, b] = segments[i];
        if (a.x, a.y) < (b.x, b.y) { [a, b] } else { [b, a] }
    };
    let first = |i: usize| (0..i).find(|&j| ends(j) == ends(i)).unwrap_or(i);
    for i in 0..segments.len() {
        for j in 0..i {
            if meet(segments[i], segments[j]) && first(i) == i && first(j) == j {
                let pair = [u32::try_from(j).unwrap(), u32::try_from(i).unwrap()];
                assert!(found.contains(&pair), "{:?} and {:?}", segments[j], segments[i]);
            }
        }
    }
}

fn distinct(points: Vec<[DVec2; 2]>) -> Vec<Segment> {
    points.into_iter().filter(|[a, b]| a != b).collect()
}

/// Without those that have both ends in common with an earlier one.
fn once(segments: &[Segment]) -> Vec<Segment> {
    let is_same = |s: Segment, t: Segment| s == t || s == [t[1], t[0]];
    let is_first = |i: usize| !segments[..i].iter().any(|&s| is_same(s, segments[i]));
    (0..segments.len()).filter(|&i| is_first(i)).map(|i| segments[i]).collect()
}

fn few_roundings((x, y): (u64, u64)) -> DVec2 {
    DVec2::new(f64::from_bits(1.5_f64.to_bits() + x), f64::from_bits(2.5_f64.to_bits() + y))
}

fn lattice(size: i32) -> impl Strategy<Value = DVec2> + Clone {
    (0..size, 0..size).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)))
}

fn segments(
    points: impl Strategy<Value = DVec2> + Clone,
    most: usize,
) -> impl Strategy<Value = Vec<Segment>> {
    prop::collection::vec([points.clone(), points], 0..most).prop_map(distinct)
}

/// What is below each end, looked for in the slabs and among all segments.
fn check_below(segments: &[Segment]) {
    let mut slabs = slabs_of(segments);
    let mut found = Vec::new();
    let points: Vec<u32> = (0..2 * u32::try_from(segments.len()).unwrap()).collect();
    slabs.below(&points, &mut found, &Meter::default()).expect("no limit was given");
    let covers = |s: Segment, p: DVec2| s[0].x <= p.x && p.x < s[1].x && side(s[0], s[1], p) == Side::Left;
    for (found, p) in found.iter().zip(segments.iter().flatten()) {
        let below = segments.iter().map(|&s| rightward(s)).filter(|&s| covers(s, *p));
        let higher =
            |s: Segment, t: Segment| if height_order(t, s, p.x) == Ordering::Greater { t } else { s };
        let expected = below.reduce(higher);
        let found = found.map(|i| rightward(segments[i as usize]));
        match (found, expected) {
            (Some(s), Some(t)) => assert_eq!(height_order(s, t, p.x), Ordering::Equal, "{s:?} {t:?} {p}"),
            (found, expected) => assert_eq!(found, expected, "{p}"),
        }
    }
}

/// Without those that meet an earlier one but in a common end.
fn apart(segments: Vec<Segment>) -> Vec<Segment> {
    let mut kept: Vec<Segment> = Vec::new();
    for s in segments {
        if !kept.iter().any(|&t| meet(s, t)) {
            kept.push(s);
        }
    }
    kept
}

/// Edges from points that are a few roundings apart, to a lattice around them.
fn fans() -> impl Strategy<Value = Vec<Segment>> {
    let apex = (0_u64..3, 0_u64..3).prop_map(|(i, j)| {
        DVec2::new(f64::from_bits(5_f64.to_bits() + i), f64::from_bits(6_f64.to_bits() + j))
    });
    let end = (0..12_i32, 0..12_i32).prop_map(|(x, y)| DVec2::new(f64::from(x), f64::from(y)));
    prop::collection::vec((apex, end).prop_map(|(apex, end)| [apex, end]), 0..90).prop_map(distinct)
}

/// Near ends are looked for otherwise.
const REACH: f64 = 2e-15;

/// Whether a point lies above or below a segment by the reach at most, and not at its ends.
fn is_near(s: Segment, p: DVec2) -> bool {
    let [a, b] = rightward(s);
    let t = (p.x - a.x) / (b.x - a.x);
    a.x + REACH < p.x && p.x < b.x - REACH && (a.y + (b.y - a.y) * t - p.y).abs() <= 0.8 * REACH
}

/// Widened slabs report whatever meets or comes near one another, unless it has an end in common, or there is too much of it.
fn check_near(segments: &[Segment]) {
    let mut slabs = slabs_of(segments);
    if !slabs.widen(REACH) || !find(&mut slabs) {
        return;
    }
    let found = visited(&slabs);
    let is_steep = |[a, b]: Segment| (b.y - a.y).abs() > 100.0 * (b.x - a.x).abs();
    let shares = |s: Segment, t: Segment| s.iter().any(|p| t.contains(p));
    for (i, &s) in segments.iter().enumerate().filter(|&(_, &s)| !is_steep(s)) {
        for (j, &t) in segments.iter().enumerate().filter(|&(_, &t)| !shares(s, t)) {
            let pair = [i.min(j), i.max(j)].map(|i| u32::try_from(i).unwrap());
            let is_wanted = meet(s, t) || t.iter().any(|&p| is_near(s, p));
            assert!(!is_wanted || found.contains(&pair), "{s:?} and {t:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    #[test]
    fn on_lattices(segments in (2..9).prop_flat_map(|size| segments(lattice(size), 60))) {
        check(&segments);
    }

    #[test]
    fn in_the_square(segments in segments((0.0..1.0, 0.0..1.0).prop_map(DVec2::from), 80)) {
        check(&segments);
    }

    #[test]
    fn below_on_lattices(segments in (3..12).prop_flat_map(|size| segments(lattice(size), 90))) {
        check_below(&apart(segments));
    }

    #[test]
    fn below_in_the_square(segments in segments((0.0..1.0, 0.0..1.0).prop_map(DVec2::from), 120)) {
        check_below(&apart(segments));
    }

    /// All within a few units of the last place of a long edge.
    #[test]
    fn around_one_line(segments in segments((0_u32..40, 0_u64..4).prop_map(|(x, ulps)| {
        let x = f64::from(x) / 40.0;
        DVec2::new(x, f64::from_bits((1.0 + 0.3 * x).to_bits() + ulps))
    }), 60)) {
        check(&segments);
    }

    /// Ends and starts on three verticals, a rounding apart.
    #[test]
    fn along_verticals(segments in segments((0..3_i32, 0_u64..24).prop_map(|(x, ulps)| {
        DVec2::new(f64::from(x), f64::from_bits(1_f64.to_bits() + ulps))
    }), 60)) {
        check(&segments);
        check_below(&apart(segments));
    }

    #[test]
    fn fans_from_nearly_one_point(segments in fans()) {
        check(&segments);
        check_below(&apart(segments));
    }

    /// Slanted edges some roundings apart.
    #[test]
    fn near_one_another(segments in segments((0_u32..60, 0_u32..400).prop_map(|(x, y)| {
        let x = f64::from(x) / 60.0;
        DVec2::new(x, 1.0 + 0.3 * x + f64::from(y) * 1e-15)
    }), 60)) {
        check_near(&segments);
    }

    #[test]
    fn nearly_in_one_line(segments in prop::collection::vec((0_u32..60, 0_u32..60, 0_u32..900).prop_map(|(from, to, y)| {
        let at = |x: u32, i: u32| DVec2::new(f64::from(x) / 60.0, 1.0 + 0.005 * f64::from(x) + f64::from(i) * 2e-15);
        [at(from, y), at(to, y + to % 3)]
    }), 0..90)) {
        check_near(&segments.into_iter().filter(|[a, b]| a != b).collect::<Vec<_>>());
    }

    /// All points within a few roundings, so that all is near: paths from point to point, upright and slanted, that share ends.
    #[test]
    fn paths_within_a_few_roundings(paths in prop::collection::vec(prop::collection::vec((0..6_u64, 0..40_u64), 3..9), 4..12)) {
        let paths = paths.iter().flat_map(|path| path.windows(2).map(|ends| [ends[0], ends[1]].map(few_roundings)));
        let segments = once(&distinct(paths.collect()));
        check_near(&segments);
        check(&segments);
    }

    #[test]
    fn over_the_whole_range(segments in segments(
        [prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL, prop::num::f64::NORMAL].prop_map(|[x, y]| DVec2::new(x, y)), 60,
    )) {
        check(&segments);
    }
}

#[test]
fn the_largest_coordinates_do_not_overflow() {
    let corner = |x: f64, y: f64| DVec2::new(x * f64::MAX, y * f64::MAX);
    let points = [corner(-1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0), corner(1.0, -1.0), DVec2::ZERO];
    let all = points.iter().flat_map(|&p| points.iter().map(move |&q| [p, q]));
    check(&distinct(all.collect()));
}

/// Neighbours in a fan have an end in common and nothing else; a closed ring of them is nothing to find.
#[test]
fn fans_cost_nothing() {
    let tip = |i: u32| DVec2::from_angle(f64::from(i) * 0.01);
    let fan: Vec<Segment> = (0..600).map(|i| [DVec2::ZERO, tip(i)]).collect();
    assert!(found(&fan).is_empty());
    let crossed: Vec<Segment> =
        fan.iter().copied().chain([[DVec2::new(-0.5, 0.1), DVec2::new(0.5, 0.1)]]).collect();
    check(&crossed);
    assert!(found(&crossed).len() < 320, "{}", found(&crossed).len());
}

/// Seen from another point of the same abscissa, or nearly the same, a fan is one line; and so are two that start a few
/// roundings apart.
#[test]
fn fans_cost_nothing_from_beside() {
    let turns: [fn(DVec2) -> DVec2; 4] =
        [|p| p, |p| -p, |p| DVec2::new(p.x, -p.y), |p| DVec2::new(-p.x, p.y)];
    for (turn, offset) in turns.iter().flat_map(|turn| [0.0, 1e-300, 1e-14].map(|offset| (turn, offset))) {
        let fan = |apex: f64, base: f64| {
            (0..600).map(move |i| [DVec2::new(0.0, apex), DVec2::new(f64::from(i) + 1.0, base)])
        };
        let above = [DVec2::new(offset, 1200.0), DVec2::new(1.0, 1300.0)];
        let two = fan(600.0, 0.0).chain(fan(600.0_f64.next_up(), 1200.0)).chain([above]);
        let segments: Vec<Segment> = two.map(|s| s.map(turn)).collect();
        assert!(found(&segments).len() < 20, "{} at {offset}", found(&segments).len());
        check_below(&segments);
    }
}

/// Through the vertex of a fan, where its heights are one, and up to one of its edges just beyond that.
#[test]
fn fans_are_met_where_they_start() {
    let apex = DVec2::new(0.0, 600.0);
    let fan = (0..40).map(|i| [apex, DVec2::new(1024.0, 600.0 - 16.0 * f64::from(i))]);
    let (run, rise) = (2_f64.powi(-40), 2_f64.powi(-41));
    let through = [DVec2::new(-3.0, 597.0), DVec2::new(3.0, 603.0)];
    let up_to = |end: f64| [DVec2::new(-7.0, 700.0), apex + DVec2::new(run, end)];
    let beside = [apex + DVec2::new(run / 2.0, 1.0), DVec2::new(5.0, 800.0)];
    let segments: Vec<Segment> =
        fan.chain([through, up_to(-rise / 2.0), up_to(-rise / 4.0), beside]).collect();
    for turn in [|p| p, |p: DVec2| -p, |p: DVec2| DVec2::new(p.x, -p.y), |p: DVec2| DVec2::new(-p.x, p.y)] {
        check(&segments.iter().map(|s| s.map(turn)).collect::<Vec<_>>());
    }
}

/// Edges that all but coincide, with ends all along them.
#[test]
fn bundles_are_compared_once() {
    let along = |i: u32, x: f64| DVec2::new(x, f64::from_bits((0.5 + 0.25 * x).to_bits() + u64::from(i % 3)));
    let bundle: Vec<Segment> = (0..60_u32)
        .map(|i| [along(i, f64::from(i) * 1e-3), along(i + 1, 1.0 - f64::from(i * 7 % 60) * 1e-3)])
        .chain((0..60).map(|i| [along(i, 0.1 + f64::from(i) / 80.0), DVec2::new(0.5, 1.0 + f64::from(i))]))
        .collect();
    check(&bundle);
    let mut slabs = slabs_of(&bundle);
    assert!(find(&mut slabs));
    let room = slabs.found.room();
    assert!(room < 60_000, "{room}");
}

#[test]
fn parallel_edges_cost_nothing() {
    let comb: Vec<Segment> =
        (0..1000).map(|i| [DVec2::new(f64::from(i), 0.0), DVec2::new(f64::from(i) + 1e5, 1e5)]).collect();
    assert!(found(&comb).is_empty());
}

/// Edges around a point that they do not reach, by a few roundings: no height tells them apart there.
#[test]
fn edges_nearly_through_a_point_cost_nothing() {
    let point = DVec2::new(0.3, 0.7);
    for radius in [1e-12, 1e-14] {
        let edge = |i: u32| {
            let direction = DVec2::from_angle(f64::from(i) * 0.0105);
            [point + direction * radius, point + direction]
        };
        let ring: Vec<Segment> = (0..600).map(|i| [edge(i)[0], edge(i + 1)[0]]).collect();
        let segments: Vec<Segment> = (0..600).map(edge).chain(ring).collect();
        let segments = apart(distinct(segments));
        assert!(segments.len() > 400, "{}", segments.len());
        for turn in [|p| p, |p: DVec2| DVec2::new(p.y, p.x)] {
            let segments: Vec<Segment> = segments.iter().map(|s| s.map(turn)).collect();
            let mut slabs = slabs_of(&segments);
            assert!(find(&mut slabs));
            let room = slabs.found.room();
            assert!(room < 20 * segments.len(), "{room} for {}", segments.len());
            check(&segments);
            check_below(&segments);
        }
    }
}

/// Slanted edges a part of the slack apart, with ends of their own: what comes near one another is found in few slabs; when
/// it is too much, nothing but what meets.
#[test]
fn parallel_edges_a_few_roundings_apart() {
    let edges = |distance: f64| {
        let at = move |i: u32, x: f64| DVec2::new(x, 0.3 + 0.5 * x + f64::from(i) * distance);
        let part = |i: u32| f64::from(i * 211 % 400) / 1000.0;
        (0..400).map(move |i| [at(i, part(i)), at(i, 1.0 - part(i + 100))]).collect::<Vec<Segment>>()
    };
    let near = edges(2e-14);
    let mut slabs = slabs_of(&near);
    assert!(slabs.widen(4e-16) && find(&mut slabs));
    let found = visited(&slabs);
    let closest = |i: u32| near[i as usize][0].x.max(near[i as usize + 1][0].x) < near[i as usize][1].x;
    assert!((0..399).filter(|&i| closest(i)).all(|i| found.contains(&[i, i + 1])));
    assert!(slabs.found.room() < 64 * 400, "{}", slabs.found.room());
    let nearer = edges(3e-16);
    let mut slabs = slabs_of(&nearer);
    assert!(slabs.widen(4e-16) && !find(&mut slabs));
    assert!(slabs.narrow() && find(&mut slabs) && !slabs.narrow());
    check(&nearer);
}

/// Of edges with the same ends one stands for all.
#[test]
fn copies_are_compared_once() {
    let cross = [[DVec2::ZERO, DVec2::ONE], [DVec2::X, DVec2::Y]];
    let many: Vec<Segment> = (0..100).map(|i| cross[i % 2]).collect();
    assert_eq!(found(&many).len(), 99);
}
