//! What `inspect` finds in scenes with known faults, and what `repair` makes of them.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use radiosity::formfactor::PlanarPolygon;
use radiosity::inspect::{Kind, inspect, inspect_until};
use radiosity::{Patch, Scene, repair, scenes};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A level rectangle, `[low x, low y, high x, high y]`, that faces up.
fn level(name: &str, [x0, y0, x1, y1]: [f64; 4], z: f64) -> Patch {
    face(name, &[[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]])
}

fn face(name: &str, corners: &[[f64; 3]]) -> Patch {
    Patch::new(name, PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
}

fn lamp(patch: Patch) -> Patch {
    Patch { emission: vec![1.0], ..patch }
}

fn scene(patches: Vec<Patch>) -> Scene {
    Scene { patches, bands: 1, ..Scene::default() }
}

/// The findings of a kind, as the patches they name.
fn found(scene: &Scene, kind: Kind) -> Vec<Vec<String>> {
    let findings = inspect(scene).findings.into_iter();
    findings.filter(|finding| finding.kind == kind).map(|finding| finding.patches).collect()
}

/// Two unit squares beside each other, a lamp in the first.
fn pair() -> Scene {
    let lamp = lamp(level("lamp", [0.25, 0.25, 0.75, 0.75], 0.0));
    scene(vec![level("a", [0.0, 0.0, 1.0, 1.0], 0.0), level("b", [1.0, 0.0, 2.0, 1.0], 0.0), lamp])
}

#[test]
fn sound_scenes_have_no_findings() {
    for name in ["cornell-box", "furnace", "emission", "perforated", "colour-bleeding", "chessboard"] {
        let inspection = inspect(&scenes::scene(name).unwrap());
        assert!(inspection.findings.is_empty(), "{name}: {:?}", inspection.findings);
    }
}

#[test]
fn closed_rooms_are_closed_and_open_ones_are_not() {
    let opening = |name: &str| inspect(&scenes::scene(name).unwrap());
    assert!(opening("furnace").closed && opening("cube").closed && opening("colour-bleeding").closed);
    let open = opening("cornell-box");
    assert!(!open.closed && open.opening.unwrap().share > 0.1);
}

#[test]
fn what_is_inspected_until_it_is_stopped_says_so_and_has_what_was_found() {
    let scene = pair();
    let whole = inspect(&scene);
    assert!(!whole.stopped && whole.opening.is_some() && !whole.findings.is_empty());
    let at_once = inspect_until(&scene, &|| true);
    assert!(at_once.stopped && at_once.opening.is_none() && !at_once.closed);
    assert_eq!((at_once.patches, at_once.cost.factors), (3, whole.cost.factors));
    let after = |asks: usize| {
        let asked = AtomicUsize::new(0);
        inspect_until(&scene, &|| asked.fetch_add(1, Ordering::Relaxed) >= asks)
    };
    let some: Vec<_> = (0..100).map(after).collect();
    assert!(some.iter().flat_map(|one| &one.findings).all(|finding| whole.findings.contains(finding)));
    assert!(some.iter().any(|one| one.stopped && one.opening.is_none() && one.findings == whole.findings));
    assert!(!some[99].stopped && some[99].findings == whole.findings);
}

#[test]
fn emitters_are_named_with_their_power() {
    let inspection = inspect(&scenes::scene("cornell-box").unwrap());
    assert_eq!(inspection.emitters.len(), 1);
    let power = std::f64::consts::PI * 17.0 * 130.0 * 105.0;
    assert!((inspection.emitters[0].power[0] / power - 1.0).abs() < 1e-12);
    assert_eq!((inspection.unit, inspection.up), (0.001, [0.0, 1.0, 0.0]));
}

#[test]
fn an_emitter_in_a_face_is_found_and_cut_out_of_it() {
    let scene = pair();
    assert_eq!(found(&scene, Kind::EmitterInFace), [["a", "lamp"]]);
    let repaired = repair(&scene).scene;
    assert_eq!(repaired.patches[0].polygon.area(), 0.75);
    assert_eq!(repaired.patches[0].polygon.loops().count(), 2);
    assert_eq!(repaired.patches[2].polygon.area(), 0.25);
    assert!(inspect(&repaired).findings.is_empty(), "{:?}", inspect(&repaired).findings);
}

#[test]
fn duplicates_vanish_but_for_one_and_backs_stay() {
    let a = level("a", [0.0, 0.0, 1.0, 1.0], 0.0);
    let back = face("back", &[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0]]);
    let twice = scene(vec![lamp(a.clone()), Patch { name: "again".into(), ..lamp(a) }, back]);
    assert_eq!(found(&twice, Kind::Duplicate), [["a", "again"]]);
    let repaired = repair(&twice).scene;
    assert!(repaired.patches.iter().map(|patch| &patch.name).eq(["a", "back"]));
}

#[test]
fn the_smaller_of_two_that_overlap_stays_whole() {
    let large = level("large", [0.0, 0.0, 4.0, 1.0], 0.0);
    let across = level("across", [1.0, -1.0, 2.0, 2.0], 0.0);
    let crossed = scene(vec![lamp(large.clone()), lamp(across)]);
    assert_eq!(found(&crossed, Kind::Overlap), [["large", "across"]]);
    let repaired = repair(&crossed).scene;
    let areas: Vec<(&str, f64)> =
        repaired.patches.iter().map(|patch| (patch.name.as_str(), patch.polygon.area())).collect();
    assert_eq!(areas, [("large.1", 1.0), ("large.2", 2.0), ("across", 3.0)]);
}

#[test]
fn what_only_touches_does_not_overlap() {
    // A third is no double: the edges of neighbours agree only because they are the same double.
    let patches = (0..9).map(|i| {
        let edge = |i: i32| f64::from(i) / 3.0;
        lamp(level(&format!("{i}"), [edge(i), 0.1, edge(i + 1), 0.7], 0.3))
    });
    assert!(inspect(&scene(patches.collect())).findings.is_empty());
}

#[test]
fn a_flipped_face_is_the_minority() {
    let mut cube = scenes::scene("furnace").unwrap();
    let corners: Vec<_> = cube.patches[3].polygon.loops().next().unwrap().iter().rev().copied().collect();
    cube.patches[3].polygon = PlanarPolygon::new([corners]).unwrap();
    assert_eq!(found(&cube, Kind::Flipped), [["north"]]);
}

#[test]
fn a_duplicate_is_not_flipped() {
    let mut cube = scenes::scene("furnace").unwrap();
    let again = radiosity::Patch { name: "again".into(), ..cube.patches[0].clone() };
    cube.patches.push(again);
    assert_eq!(found(&cube, Kind::Duplicate), [["floor", "again"]]);
    assert!(found(&cube, Kind::Flipped).is_empty());
}

#[test]
fn a_vertex_within_an_edge_is_a_t_junction() {
    let patches = vec![
        lamp(level("long", [0.0, 0.0, 2.0, 1.0], 0.0)),
        level("left", [0.0, 1.0, 1.0, 2.0], 0.0),
        level("right", [1.0, 1.0, 2.0, 2.0], 0.0),
    ];
    assert_eq!(found(&scene(patches), Kind::TJunction), [["left", "long"], ["right", "long"]]);
}

#[test]
fn what_matters_comes_first_and_is_counted_by_kind() {
    // A row of small faces along the edge of a long one, in which an emitter lies.
    let small = (0..20).map(|i| level(&format!("{i}"), [f64::from(i), 1.0, f64::from(i) + 1.0, 2.0], 0.0));
    let mut patches: Vec<Patch> = small.collect();
    patches.push(level("long", [0.0, 0.0, 20.0, 1.0], 0.0));
    patches.push(lamp(level("lamp", [0.25, 0.25, 0.75, 0.75], 0.0)));
    let inspection = inspect(&scene(patches));
    let counts: Vec<_> =
        inspection.summary.iter().map(|kind| (kind.kind, kind.count, kind.matters)).collect();
    assert_eq!(counts, [(Kind::EmitterInFace, 1, true), (Kind::TJunction, 20, false)]);
    let kinds: Vec<Kind> = inspection.findings.iter().map(|finding| finding.kind).collect();
    assert!(kinds.is_sorted() && kinds.len() == 21);
    assert_eq!(
        inspection.summary[1].to_string(),
        "20 T-junctions: form factors do not mind; interpolated light may show a seam"
    );
}

#[test]
fn reflectance_darkness_and_slivers_are_told() {
    let mut dark = scene(vec![level("a", [0.0, 0.0, 1.0, 1.0], 0.0)]);
    dark.patches[0].reflectance = vec![1.2];
    dark.patches.push(level("thin", [5.0, 5.0, 6.0, 5.0 + 1e-14], 0.0));
    assert_eq!(found(&dark, Kind::Reflectance), [["a"]]);
    assert_eq!(found(&dark, Kind::Dark).len(), 1);
    assert_eq!(found(&dark, Kind::Sliver), [["thin"]]);
}

#[test]
fn repairing_a_tilted_ceiling_is_exact() {
    // A lamp in a plane of no axis: the areas add up to what was there.
    let tilt = |x: f64, y: f64| [x, y, 0.3 * x - 0.7 * y];
    let quad = |name: &str, [x0, y0, x1, y1]: [f64; 4]| {
        face(name, &[tilt(x0, y0), tilt(x1, y0), tilt(x1, y1), tilt(x0, y1)])
    };
    let before = scene(vec![quad("ceiling", [0.0, 0.0, 4.0, 4.0]), lamp(quad("lamp", [1.0, 1.0, 2.0, 3.0]))]);
    let after = repair(&before).scene;
    let areas: Vec<f64> = after.patches.iter().map(|patch| patch.polygon.area()).collect();
    assert!((areas[0] + areas[1] - before.patches[0].polygon.area()).abs() < 1e-12);
    assert!(inspect(&after).findings.is_empty(), "{:?}", inspect(&after).findings);
}
