//! Scenes with every kind of dirt, made from clean ones by a seed: what `repair` makes of them, and what light they have then.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
mod random;

use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::DVec3;
use radiosity::inspect::Kind;
use radiosity::io::collada::Collada;
use radiosity::{Error, Method, Options, Patch, Quality, Repaired, Scene, repair, scenes, solve};
use random::Random;
use std::ops::ControlFlow;

/// A parallelogram with a front, from a corner along two edges.
#[derive(Clone, Copy)]
struct Sheet {
    corner: DVec3,
    along: DVec3,
    up: DVec3,
}

impl Sheet {
    /// The part between shares of the edges.
    fn part(&self, [s0, t0, s1, t1]: [f64; 4]) -> Sheet {
        let corner = self.corner + s0 * self.along + t0 * self.up;
        Sheet { corner, along: (s1 - s0) * self.along, up: (t1 - t0) * self.up }
    }

    fn patch(&self, name: &str, emission: f64) -> Patch {
        let Sheet { corner, along, up } = *self;
        let polygon =
            PlanarPolygon::new([[corner, corner + along, corner + along + up, corner + up]]).unwrap();
        Patch::new(name, polygon, vec![0.5], vec![emission])
    }
}

fn scene(patches: Vec<Patch>) -> Scene {
    Scene { patches, bands: 1, ..Scene::default() }
}

/// The faces of a box, turned out, or in for a room.
fn faces(low: DVec3, size: DVec3, turned_in: bool) -> Vec<Sheet> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * size);
    let pair = |k: usize| {
        let (w, u, v) = (axes[k], axes[(k + 1) % 3], axes[(k + 2) % 3]);
        let (out, back) =
            (Sheet { corner: low + w, along: u, up: v }, Sheet { corner: low, along: v, up: u });
        if turned_in {
            [Sheet { along: v, up: u, ..out }, Sheet { along: u, up: v, ..back }]
        } else {
            [out, back]
        }
    };
    (0..3).flat_map(pair).collect()
}

/// A closed room of a seed's size with a lamp in its ceiling and a block on its floor: clean, and with some dirt.
fn clean_room(random: &mut Random) -> (Vec<Patch>, Vec<Sheet>) {
    let size = DVec3::new(random.within(2.0, 5.0), random.within(2.0, 5.0), random.within(2.0, 4.0));
    let sheets = faces(DVec3::ZERO, size, true);
    let names = ["east", "west", "north", "south", "ceiling", "floor"];
    let patches = sheets.iter().zip(names).map(|(sheet, name)| sheet.patch(name, 0.0)).collect();
    (patches, sheets)
}

/// The same walls with a lamp in the ceiling, which is whole behind it, and a wall that is there twice, in two parts that overlap, a sliver,
/// and vertices beside their places.
fn dirty_room(random: &mut Random) -> (Scene, Scene) {
    let (mut clean, sheets) = clean_room(random);
    let lamp = sheets[4].part([0.3, 0.4, random.within(0.5, 0.8), 0.7]).patch("lamp", 10.0);
    clean.push(lamp);
    let mut dirty = clean.clone();
    // The clean ceiling has a hole for the lamp.
    let hole: Vec<DVec3> = clean[6].polygon.loops().next().unwrap().to_vec();
    let outline: Vec<DVec3> = clean[4].polygon.loops().next().unwrap().to_vec();
    clean[4].polygon = PlanarPolygon::new([outline, hole]).unwrap();
    let (near, far) = (random.within(0.3, 0.5), random.within(0.5, 0.7));
    dirty[0] = sheets[0].part([0.0, 0.0, far, 1.0]).patch("east", 0.0);
    dirty.push(sheets[0].part([near, 0.0, 1.0, 1.0]).patch("east too", 0.0));
    dirty.push(sheets[1].patch("west too", 0.0));
    let corner = sheets[5].corner;
    let sliver = [corner, corner + sheets[5].along, corner + sheets[5].along + 1e-15 * sheets[5].up];
    if let Ok(polygon) = PlanarPolygon::new([sliver]) {
        dirty.push(Patch::new("sliver", polygon, vec![0.5], vec![0.0]));
    }
    // A wall that ends a tenth of a micrometre beside its corners, in its own plane.
    let off = 1e-7 * random.next();
    dirty[2] = sheets[2].part([off, 0.0, 1.0, 1.0 - off]).patch("north", 0.0);
    (scene(clean), scene(dirty))
}

fn area(scene: &Scene) -> f64 {
    scene.patches.iter().map(|patch| patch.polygon.area()).sum()
}

fn kinds(repaired: &Repaired) -> Vec<Kind> {
    let mut kinds: Vec<Kind> = repaired.repairs.iter().map(|finding| finding.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds
}

fn same_patches(a: &Scene, b: &Scene) -> bool {
    let alike = |(a, b): (&Patch, &Patch)| a.name == b.name && a.polygon.loops().eq(b.polygon.loops());
    a.patches.len() == b.patches.len() && a.patches.iter().zip(&b.patches).all(alike)
}

#[test]
fn every_kind_of_dirt_is_told_and_gone() {
    for seed in 0..20 {
        let (clean, dirty) = dirty_room(&mut Random(seed));
        let repaired = repair(&dirty);
        let expected =
            [Kind::Duplicate, Kind::EmitterInFace, Kind::Overlap, Kind::Sliver, Kind::Crack, Kind::TJunction];
        assert_eq!(kinds(&repaired), expected, "seed {seed}");
        // The area of the union is that of the clean room.
        assert!((area(&repaired.scene) / area(&clean) - 1.0).abs() < 1e-12, "seed {seed}");
        let again = repair(&repaired.scene);
        assert!(again.repairs.is_empty() && same_patches(&again.scene, &repaired.scene), "seed {seed}");
        assert!(kinds(&repair(&clean)).is_empty(), "seed {seed}");
    }
}

/// Rectangles in one plane, tilted, of which many overlap: each point is covered once afterwards.
#[test]
fn the_area_of_a_union_is_kept() {
    for seed in 0..30 {
        let random = &mut Random(seed);
        let plane = Sheet {
            corner: DVec3::new(random.next(), random.next(), random.next()),
            along: DVec3::new(3.0, random.next(), random.next()),
            up: DVec3::new(-random.next(), 2.0, random.next()),
        };
        let share = |random: &mut Random| random.within(0.0, 0.5);
        let parts: Vec<[f64; 4]> = (0..12)
            .map(|_| {
                let [s, t] = [share(random), share(random)];
                [s, t, s + random.within(0.05, 0.5), t + random.within(0.05, 0.5)]
            })
            .collect();
        let patches = parts.iter().enumerate().map(|(k, part)| plane.part(*part).patch(&format!("{k}"), 0.0));
        let repaired = repair(&scene(patches.collect())).scene;
        let rings = parts.iter().map(|[s, t, u, v]| [[*s, *t], [*u, *t], [*u, *v], [*s, *v]]);
        let union = polycsg::Region::from_rings(rings, polycsg::FillRule::NonZero).unwrap();
        let whole = plane.along.cross(plane.up).length();
        assert!((area(&repaired) / (whole * union.area()) - 1.0).abs() < 1e-9, "seed {seed}");
        assert!(repair(&repaired).repairs.is_empty(), "seed {seed}");
        let solved = solve(&repaired, &Quality::Draft.options(), |_| ControlFlow::Break(()));
        assert!(solved.is_ok(), "seed {seed}: {solved:?}");
    }
}

/// The irradiance of the patches whose names begin like that, by area, and what it may be off by.
fn irradiance(scene: &Scene, names: &[&str]) -> Vec<(f64, f64)> {
    let solution = solve(scene, &Quality::Draft.options(), |_| ControlFlow::Continue(())).unwrap();
    let means = solution.patch_means(&solution.irradiance, scene.patches.len());
    let mean = |name: &&str| {
        let mut sums = [0.0; 3];
        for (index, patch) in
            scene.patches.iter().enumerate().filter(|(_, patch)| patch.name.starts_with(name))
        {
            let area = patch.polygon.area();
            let terms = [area, area * means[index][0], area * solution.patch_estimate(index)[0]];
            (0..3).for_each(|k| sums[k] += terms[k]);
        }
        (sums[1] / sums[0], sums[2] / sums[0])
    };
    names.iter().map(mean).collect()
}

#[test]
fn repaired_rooms_have_the_light_of_clean_ones() {
    let names = ["east", "west", "north", "south", "ceiling", "floor"];
    for seed in 0..3 {
        let (clean, dirty) = dirty_room(&mut Random(100 + seed));
        let (clean, dirty) = (irradiance(&clean, &names), irradiance(&repair(&dirty).scene, &names));
        for (name, (a, b)) in names.iter().zip(clean.iter().zip(&dirty)) {
            assert!((a.0 - b.0).abs() <= a.1 + b.1 + 1e-6 * a.0, "seed {seed}, {name}: {a:?} {b:?}");
        }
    }
}

/// A block that reaches through the floor, as a block that stands on it: what is seen is the same, and the floor has a hole.
#[test]
fn a_block_that_reaches_through_the_floor_gives_the_light_of_one_that_stands_on_it() {
    let random = &mut Random(7);
    let (mut room, sheets) = clean_room(random);
    room.push(sheets[4].part([0.3, 0.3, 0.7, 0.7]).patch("lamp", 10.0));
    let Repaired { scene: room, .. } = repair(&scene(room));
    let block = |low: f64| {
        let size = DVec3::new(0.8, 0.6, 1.0 - low);
        let sheets = faces(DVec3::new(0.5, 0.7, low), size, false);
        sheets
            .iter()
            .enumerate()
            .map(|(k, sheet)| sheet.patch(&format!("block {k}"), 0.0))
            .collect::<Vec<_>>()
    };
    let with = |low: f64| Scene {
        patches: room.patches.iter().cloned().chain(block(low)).collect(),
        ..room.clone()
    };
    let names = ["east", "west", "north", "south", "ceiling"];
    let sunk = repair(&with(-0.5));
    assert_eq!(kinds(&sunk), [Kind::Buried]);
    for (name, (a, b)) in
        names.iter().zip(irradiance(&with(0.0), &names).iter().zip(irradiance(&sunk.scene, &names)))
    {
        assert!((a.0 - b.0).abs() <= a.1 + b.1, "{name}: {a:?} {b:?}");
    }
}

#[test]
fn solving_refuses_what_was_not_repaired() {
    let (_, dirty) = dirty_room(&mut Random(1));
    let refused = solve(&dirty, &Quality::Draft.options(), |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(refused, Error::Overlap { .. }), "{refused}");
}

#[test]
fn reflectances_are_limited() {
    let mut furnace = scenes::scene("furnace").unwrap();
    furnace.patches[0].reflectance = vec![1.0, 1.5, -0.5];
    let repaired = repair(&furnace);
    assert_eq!(kinds(&repaired), [Kind::Reflectance]);
    assert_eq!(repaired.scene.patches[0].reflectance, [0.99, 0.99, 0.0]);
}

/// Neighbours whose corners rounding of a transform set apart share them afterwards, and nothing is told.
#[test]
fn what_doubles_round_apart_is_closed_without_a_word() {
    let off = Sheet { corner: DVec3::new(1.0, f64::EPSILON, 0.0), along: DVec3::X, up: DVec3::Y };
    let square = Sheet { corner: DVec3::ZERO, ..off };
    let repaired = repair(&scene(vec![square.patch("a", 0.0), off.patch("b", 0.0)]));
    assert!(repaired.repairs.is_empty(), "{:?}", repaired.repairs);
    let corners = |index: usize| repaired.scene.patches[index].polygon.loops().flatten().copied();
    let shared = corners(0).filter(|corner| corners(1).any(|other| other == *corner));
    assert_eq!(shared.count(), 2);
}

/// Faces that are near each other but not in one plane stay: the front one hides the other.
#[test]
fn planes_that_a_single_tells_apart_are_two() {
    let plane = Sheet { corner: DVec3::ZERO, along: DVec3::X, up: DVec3::Y };
    let above = |height: f64| {
        Sheet { corner: DVec3::Z * height, ..plane }.part([0.2, 0.2, 0.6, 0.6]).patch("above", 1.0)
    };
    let both = |height: f64| scene(vec![plane.patch("below", 0.0), above(height)]);
    assert_eq!(kinds(&repair(&both(1e-8))), [Kind::EmitterInFace]);
    assert!(kinds(&repair(&both(1e-5))).is_empty());
}

/// The file of a dirty room, repaired, reads as the repaired room, once rounding is closed as in any file, and is longer by what the cuts need.
#[test]
fn a_repaired_file_reads_as_the_repaired_scene() {
    for seed in 0..10 {
        let (_, dirty) = dirty_room(&mut Random(seed));
        let file = Collada::of(&dirty);
        let before = file.scene().unwrap();
        let after = repair(&before).scene;
        let text = file.repaired(&before, &after).unwrap();
        let read = Collada::from_text("repaired.dae", text.clone()).scene().unwrap();
        let Repaired { scene: read, repairs, .. } = repair(&read);
        assert!(repairs.is_empty(), "seed {seed}: {repairs:?}");
        let loops = |scene: &Scene| {
            scene
                .patches
                .iter()
                .map(|patch| patch.polygon.loops().map(<[DVec3]>::to_vec).collect::<Vec<_>>())
                .collect::<Vec<_>>()
        };
        assert_eq!(loops(&read), loops(&after), "seed {seed}");
        assert!(text.len() < file.text().len() * 5 / 4, "{} to {}", file.text().len(), text.len());
        let unchanged = file.repaired(&before, &before).unwrap();
        assert_eq!(unchanged, file.text());
    }
}

/// Tiles of a tilted plane that share edges but for rounding, as instances have them: what is left between them is thin.
#[test]
fn pieces_of_any_cut_are_solved() {
    for seed in 0..40 {
        let random = &mut Random(seed);
        let plane = Sheet {
            corner: DVec3::new(random.within(-9.0, 9.0), random.next(), random.next()),
            along: DVec3::new(2.0, random.next(), random.next()),
            up: DVec3::new(-random.next(), 1.5, random.next()),
        };
        let mut patches = vec![plane.patch("wall", 0.0)];
        for k in 0..4 {
            // Thirds are no doubles, and each tile rounds its corners by itself.
            let (s, u) = (f64::from(k) / 6.0, f64::from(k + 1) / 6.0);
            let tile = plane.part([s, 1.0 / 3.0, u, 1.0 - 1.0 / 3.0 * random.next().round()]);
            let shift = DVec3::splat(random.next());
            let tile = Sheet { corner: (tile.corner + shift) - shift, ..tile };
            patches.push(tile.patch(&format!("tile {k}"), f64::from(k % 2)));
        }
        let repaired = repair(&scene(patches));
        assert!(repair(&repaired.scene).repairs.is_empty(), "seed {seed}");
        for method in [Method::Mesh, Method::Hierarchical] {
            let options = Options { method, elements: 200, ..Quality::Draft.options() };
            let solved = solve(&repaired.scene, &options, |_| ControlFlow::Break(()));
            assert!(solved.is_ok(), "seed {seed}, {method:?}: {solved:?}");
        }
    }
}

/// One square in two places, a rug on the first: nodes through `<instance_node>` as well as by themselves.
const TWICE: &str = r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries>
<geometry id="square"><mesh>
<source id="p"><float_array id="p-array" count="12">0 0 0 4 0 0 4 4 0 0 4 0</float_array>
<technique_common><accessor source="#p-array" count="4" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry>
<geometry id="rug"><mesh>
<source id="q"><float_array id="q-array" count="12">1 1 0 2 1 0 2 2 0 1 2 0</float_array>
<technique_common><accessor source="#q-array" count="4" stride="3"/></technique_common></source>
<vertices id="w"><input semantic="POSITION" source="#q"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#w" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry>
</library_geometries>
<library_nodes><node id="floor" name="floor"><instance_geometry url="#square"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s">
<node name="near"><instance_node url="#floor"/></node>
<node name="far"><translate>9 0 0</translate><instance_node url="#floor"/></node>
<node name="rug"><instance_geometry url="#rug"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##;

#[test]
fn a_shared_geometry_is_copied_for_the_node_that_was_cut() {
    let file = Collada::from_text("twice.dae", TWICE);
    let before = file.scene().unwrap();
    let Repaired { scene: after, repairs, .. } = repair(&before);
    assert_eq!(repairs.len(), 1);
    let text = file.repaired(&before, &after).unwrap();
    let read = Collada::from_text("repaired.dae", text).scene().unwrap();
    let areas: Vec<f64> = read.patches.iter().map(|patch| patch.polygon.area()).collect();
    assert_eq!(areas, [15.0, 16.0, 1.0]);
    assert!(repair(&read).repairs.is_empty());
}

/// Two elements of one geometry, the second with places in a picture, each with a polygon twice: indices are counted in each by its own
/// inputs.
#[test]
fn elements_of_a_geometry_are_cut_by_their_own_inputs() {
    let squares =
        [0.0, 9.0, 20.0].map(|x| format!("{x} 0 0 {} 0 0 {} 4 0 {x} 4 0", x + 4.0, x + 4.0)).join(" ");
    let text = format!(
        r##"<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="p-array" count="36">{squares}</float_array>
<technique_common><accessor source="#p-array" count="12" stride="3"/></technique_common></source>
<source id="t"><float_array id="t-array" count="2">0 0</float_array>
<technique_common><accessor source="#t-array" count="1" stride="2"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4</vcount><p>0 1 2 3 0 1 2 3</p></polylist>
<polylist count="3"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1"/>
<vcount>4 4 4</vcount><p>4 0 5 0 6 0 7 0 4 0 5 0 6 0 7 0 8 0 9 0 10 0 11 0</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node name="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene>
</COLLADA>"##
    );
    let file = Collada::from_text("two.dae", text);
    let before = file.scene().unwrap();
    let after = repair(&before).scene;
    let read = Collada::from_text("repaired.dae", file.repaired(&before, &after).unwrap()).scene().unwrap();
    let first = |scene: &Scene| -> Vec<DVec3> {
        scene.patches.iter().map(|patch| patch.polygon.loops().next().unwrap()[0]).collect()
    };
    assert_eq!(first(&read), [0.0, 9.0, 20.0].map(|x| DVec3::new(x, 0.0, 0.0)));
    assert_eq!(first(&read), first(&after));
}
