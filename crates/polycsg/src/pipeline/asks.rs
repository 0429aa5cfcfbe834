//! Each stage asks whether to stop, about as often as what it goes through is long: no stage is forgotten.
use super::collect;
use super::scratch::Scratch;
use crate::arrangement::labels::{LabelledArrangement, map::Map};
use crate::assemble::nest::nest;
use crate::base::meter::{Meter, OFTEN};
use crate::boundary::repair::{Index, fragments::Rounded};
use crate::contacts::{Request, candidates::Candidates};
use crate::expression::csg::{Csg, FillRule};
use crate::limits::Limits;
use glam::DVec2;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// Asserts that each stage asks once at least for so many of what it goes through; returns how often all do, and the area.
fn asked_by_all(csg: &Csg<'_>) -> (u64, f64) {
    let (asked, sum) = (AtomicU64::new(0), AtomicU64::new(0));
    let stop = || {
        asked.fetch_add(1, Relaxed);
        false
    };
    let check = |stage: &str, size: usize| {
        let count = asked.swap(0, Relaxed);
        assert!(count >= size as u64 / OFTEN, "{stage}: asked {count} times for {size}");
        sum.fetch_add(count, Relaxed);
    };
    let meter = Meter::new(Limits::default().stop(&stop));
    let mut scratch = Scratch::default();
    let Scratch { expression, edges, spatial, contacts, arrangement, boundary, assembly, budget } =
        &mut scratch;
    let winding = collect(csg, expression, edges, &meter).expect("never stopped");
    check("collect", edges.edges.len());
    let (strips, slabs, chains) = (&mut spatial.strips, &mut spatial.slabs, &mut spatial.chains);
    edges.coincident.unite(&mut edges.edges, csg, winding, strips, true, &meter).expect("never stopped");
    check("coincident", edges.edges.len());
    let request = Request { meter: &meter, rings: true, budget: *budget };
    let (all, coincident) = (&mut edges.edges, &mut edges.coincident);
    let candidates = Candidates::index(all, coincident, chains, strips, request).expect("never stopped");
    let boxes = candidates.chains.len();
    check("candidates", boxes);
    let close_pairs = &mut contacts.close_pairs;
    contacts.contacts.find(candidates, slabs, close_pairs, request).expect("never stopped");
    check("contacts", boxes + 3 * contacts.contacts.sorted().len());
    let (edges, contacts) = (&edges.edges, &contacts.contacts);
    arrangement.arrangement.split(edges, contacts, &meter).expect("never stopped");
    let cuts = &arrangement.arrangement;
    check("split", 2 * cuts.len());
    let map = Map { edges, chains, strips, contacts, arrangement: cuts };
    arrangement.labels.classify(map, slabs, winding, &meter).expect("never stopped");
    check("classify", 2 * cuts.len());
    let labels = &arrangement.labels;
    let arranged = LabelledArrangement { edges, contacts, close_pairs, arrangement: cuts, labels };
    let selection = boundary.selection.select(arranged, &meter).expect("never stopped");
    check("select", cuts.len());
    let rounded = Rounded { edges, contacts, selection };
    let outline = &mut boundary.outline;
    let index = Index { strips: &mut spatial.strips, slabs, budget: *budget, meter: &meter };
    boundary.repair.outline(rounded, close_pairs, index, outline).expect("never stopped");
    check("repair", outline.chains().len());
    let (strips, chains, nesting) = (&mut spatial.strips, &mut spatial.chains, &mut assembly.nesting);
    let area = loop {
        let cycles = assembly.cycles.link(outline, &meter).expect("never stopped");
        check("link", 2 * outline.chains().len());
        if let Ok(region) = nest(outline, cycles, chains, strips, slabs, nesting, &meter) {
            check("nest", 2 * region.rings().count());
            break region.area();
        }
        let index = (&mut *chains, &mut *strips, &mut *slabs);
        assembly.positive.reduce(outline, cycles.rings(), index, &meter).expect("never stopped");
        check("reduce", 4 * outline.chains().len());
    };
    (sum.into_inner(), area)
}

fn scattered(count: u32, size: f64, corners: u32) -> Vec<Vec<DVec2>> {
    let at = |i: u32, step: f64| (f64::from(i) * step).fract() * f64::from(count).sqrt();
    let center = |i: u32| DVec2::new(at(i, 0.618_034), at(i, 0.754_878));
    let angle = |corner: u32| f64::from(corner) / f64::from(corners) * std::f64::consts::TAU;
    let ring = |i: u32| (0..corners).map(|j| center(i) + DVec2::from_angle(angle(j)) * size).collect();
    (0..count).map(ring).collect()
}

fn even_odd(rings: Vec<Vec<DVec2>>) -> Csg<'static> {
    Csg::from_rings(rings, FillRule::EvenOdd).expect("finite")
}

#[test]
fn where_many_cross() {
    assert!(asked_by_all(&even_odd(scattered(20_000, 0.8, 8))).0 > 100);
}

#[test]
fn where_none_meet() {
    assert!(asked_by_all(&even_odd(scattered(60_000, 0.2, 5))).0 > 100);
}

/// Walks along a bar pass thousands of crossings in a row.
#[test]
fn where_long_edges_cross() {
    let bars = |count: u32, length: f64| {
        let bar = move |x: f64| vec![[x, -1.0], [x + 1.0, -1.0], [x + 1.0, length - 1.0], [x, length - 1.0]];
        (0..count).map(move |i| bar(2.0 * f64::from(i)))
    };
    let level = bars(1500, 100.0).map(|bar| bar.into_iter().map(|[x, y]| [y, x]).collect::<Vec<_>>());
    let csg = |rings: Vec<Vec<[f64; 2]>>| Csg::from_rings(rings, FillRule::NonZero).expect("finite");
    let (asked, area) = asked_by_all(&(csg(bars(40, 3001.0).collect()) ^ csg(level.collect())));
    assert!(asked > 100);
    assert_eq!(area, 40.0 * 3001.0 + 1500.0 * 100.0 - 2.0 * 40.0 * 1500.0);
}

/// Needles through nearly one point, which rounding lays over one another.
#[test]
fn where_rounding_is_repaired() {
    let center = DVec2::new(0.3, 0.7);
    let needle = |i: u32| {
        let to = DVec2::from_angle(f64::from(i) / 250.0 * std::f64::consts::PI);
        vec![center - to, center + to, center + to + DVec2::new(1e-3, 2e-3)]
    };
    assert!(asked_by_all(&even_odd((0..250).map(needle).collect())).0 > 100);
}
