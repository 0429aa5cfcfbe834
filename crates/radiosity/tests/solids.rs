//! Boxes on a grid that pass through each other: what is left of their faces is known cell by cell.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
#![allow(clippy::cast_possible_truncation, reason = "counts of cells are small")]
mod random;

use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::{DQuat, DVec3};
use radiosity::inspect::{Kind, inspect};
use radiosity::{Method, Options, Origin, Patch, Quality, Scene, Sky, SkyKind, repair, solve};
use random::Random;
use std::collections::HashSet;
use std::ops::ControlFlow;

/// The cells from one corner up to another.
#[derive(Clone, Copy, Debug)]
struct Block {
    low: [i32; 3],
    high: [i32; 3],
}

/// A cell's face: the cell, the axis along which it is left, and whether that is upwards.
type CellFace = ([i32; 3], usize, bool);

impl Block {
    fn any(random: &mut Random) -> Block {
        let mut block = Block { low: [0; 3], high: [0; 3] };
        for axis in 0..3 {
            block.low[axis] = random.within(0.0, 4.0) as i32;
            block.high[axis] = block.low[axis] + random.within(1.0, 4.0) as i32;
        }
        block
    }

    fn holds(&self, cell: [i32; 3]) -> bool {
        (0..3).all(|axis| (self.low[axis]..self.high[axis]).contains(&cell[axis]))
    }

    /// The cells' faces of one of its six faces.
    fn face(&self, axis: usize, up: bool) -> Vec<CellFace> {
        let at = if up { self.high[axis] - 1 } else { self.low[axis] };
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let cell = |i: i32, j: i32| {
            let mut cell = [at; 3];
            (cell[u], cell[v]) = (i, j);
            (cell, axis, up)
        };
        (self.low[u]..self.high[u])
            .flat_map(|i| (self.low[v]..self.high[v]).map(move |j| cell(i, j)))
            .collect()
    }

    fn faces(&self) -> Vec<Vec<CellFace>> {
        (0..3).flat_map(|axis| [false, true].map(|up| self.face(axis, up))).collect()
    }

    /// Whether both sides of a cell's face are within.
    fn buries(&self, (cell, axis, up): CellFace) -> bool {
        let mut beyond = cell;
        beyond[axis] += if up { 1 } else { -1 };
        self.holds(cell) && self.holds(beyond)
    }

    /// Whether a face of another block is within in part.
    fn is_crossed_by(&self, other: &Block) -> bool {
        other.faces().iter().any(|face| {
            let buried = face.iter().filter(|cell| self.buries(**cell)).count();
            buried > 0 && buried < face.len()
        })
    }

    fn patches(&self, name: usize, turn: DQuat, instance: usize) -> Vec<Patch> {
        let [low, high] = [self.low, self.high].map(|at| DVec3::from(at.map(f64::from)));
        let corner = |k: usize| {
            let at = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
            turn * (DVec3::new(at(0), at(1), at(2)) * 0.1)
        };
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let patch = |(number, corners): (usize, [usize; 4])| {
            let polygon = PlanarPolygon::new([corners.map(corner)]).unwrap();
            let origin = Origin { instance, primitive: name, polygon: number };
            let name = format!("block {name} face {number}");
            Patch { origin, ..Patch::new(name, polygon, vec![0.5], vec![0.0]) }
        };
        (0..).zip(faces).map(patch).collect()
    }
}

/// The cells' faces that are left: each once, without what lies within another block that is crossed.
fn left(blocks: &[Block]) -> HashSet<CellFace> {
    let of = |(number, block): (usize, &Block)| {
        let others = blocks.iter().enumerate().filter(move |(other, _)| *other != number);
        let crossed: Vec<Block> =
            others.map(|(_, other)| *other).filter(|other| other.is_crossed_by(block)).collect();
        let faces = block.faces().into_iter().flatten();
        faces.filter(move |face| !crossed.iter().any(|other| other.buries(*face))).collect::<Vec<_>>()
    };
    blocks.iter().enumerate().flat_map(of).collect()
}

/// The cells' faces that are seen from without: each once, without what lies within another block.
fn seen(blocks: &[Block]) -> HashSet<CellFace> {
    let faces = blocks.iter().flat_map(Block::faces).flatten();
    faces.filter(|face| !blocks.iter().any(|block| block.buries(*face))).collect()
}

/// Of blocks that are objects by themselves.
fn scene(blocks: &[Block], turn: DQuat) -> Scene {
    scene_of(blocks, turn, |name| name)
}

fn scene_of(blocks: &[Block], turn: DQuat, instance: impl Fn(usize) -> usize) -> Scene {
    let patches =
        (0..).zip(blocks).flat_map(|(name, block)| block.patches(name, turn, instance(name))).collect();
    Scene { patches, bands: 1, ..Scene::default() }
}

fn any_blocks(seed: u64) -> (Vec<Block>, DQuat) {
    let mut random = Random(seed);
    let blocks = (0..2 + seed as usize % 4).map(|_| Block::any(&mut random)).collect();
    let axis = DVec3::new(random.next(), random.next(), random.next());
    (blocks, if seed % 2 == 0 { DQuat::IDENTITY } else { DQuat::from_scaled_axis(axis) })
}

/// Blocks of one object that share edges may be one body: a whole block within another is cut away then, and may be.
#[test]
fn solids_of_one_object_are_cut_out_of_each_other() {
    for seed in 0..250 {
        let (blocks, turn) = any_blocks(seed);
        let repaired = repair(&scene_of(&blocks, turn, |_| 0)).scene;
        let area: f64 = repaired.patches.iter().map(|patch| patch.polygon.area()).sum();
        let [least, most] = [seen(&blocks), left(&blocks)].map(|faces| faces.len() as f64 * 0.01);
        assert!(least - 1e-9 < area && area < most + 1e-9, "{seed}: {least} {area} {most} {blocks:?}");
        assert!(inspect(&repaired).findings.iter().all(|finding| finding.kind != Kind::Buried), "{seed}");
    }
}

#[test]
fn what_lies_within_solids_is_cut_away() {
    for seed in 0..250 {
        let (blocks, turn) = any_blocks(seed);
        let dirty = scene(&blocks, turn);
        let repaired = repair(&dirty);
        let area: f64 = repaired.scene.patches.iter().map(|patch| patch.polygon.area()).sum();
        let wanted = left(&blocks).len() as f64 * 0.01;
        assert!((area - wanted).abs() < 1e-9, "{seed}: {area} {wanted} {blocks:?}");
        let is_crossed = blocks.iter().any(|one| blocks.iter().any(|other| one.is_crossed_by(other)));
        let is_told = repaired.repairs.iter().any(|finding| finding.kind == Kind::Buried);
        assert_eq!(is_told, is_crossed, "{seed}");
        // A side of a block crosses at most two sides of each of the others.
        let corners = |patch: &Patch| patch.polygon.loops().flatten().count();
        let most = repaired.scene.patches.iter().map(corners).max().unwrap();
        assert!(most <= 4 + 8 * (blocks.len() - 1), "{seed}: {most}");
        let again = inspect(&repaired.scene);
        assert!(again.findings.iter().all(|finding| finding.kind != Kind::Buried), "{seed}");
    }
}

/// A chamber in a solid is empty, and so is what stands in it.
#[test]
fn what_stands_in_a_hollow_stays() {
    let [shell, hollow, column] = [
        Block { low: [0; 3], high: [9; 3] },
        Block { low: [1; 3], high: [8; 3] },
        Block { low: [4, 4, 0], high: [5, 5, 9] },
    ];
    let mut dirty = scene(&[shell, hollow, column], DQuat::IDENTITY);
    for patch in &mut dirty.patches[6..12] {
        let mut outline = patch.polygon.loops().next().unwrap().to_vec();
        outline.reverse();
        patch.polygon = PlanarPolygon::new([outline]).unwrap();
    }
    let repaired = repair(&dirty).scene;
    let of_column = repaired.patches.iter().filter(|patch| patch.name.starts_with("block 2"));
    let area: f64 = of_column.map(|patch| patch.polygon.area()).sum();
    // Its sides within the walls are gone, seven of nine cells of each are left; its ends are flush with the shell, which is cut there.
    assert!((area - 0.01 * (4.0 * 7.0 + 2.0)).abs() < 1e-12, "{area}");
}

/// Of a plate that reaches into a block the part within is gone; both sides of it, and nothing of a block that has two sides itself.
#[test]
fn a_plate_ends_at_the_block_that_it_reaches_into() {
    let block = Block { low: [0; 3], high: [4; 3] };
    let plate = [[0.2, 0.1, 0.2], [0.8, 0.1, 0.2], [0.8, 0.3, 0.25], [0.2, 0.3, 0.25]].map(DVec3::from);
    let mut dirty = scene(&[block], DQuat::IDENTITY);
    dirty.patches.push(Patch::new("plate", PlanarPolygon::new([plate]).unwrap(), vec![0.5], vec![0.0]));
    let area = |scene: &Scene| {
        scene
            .patches
            .iter()
            .filter(|patch| patch.name == "plate")
            .map(|patch| patch.polygon.area())
            .sum::<f64>()
    };
    assert!((area(&repair(&dirty).scene) / area(&dirty) - 2.0 / 3.0).abs() < 1e-12);
    let turned = |patch: &Patch| {
        let mut outline = patch.polygon.loops().next().unwrap().to_vec();
        outline.reverse();
        let polygon = PlanarPolygon::new([outline]).unwrap();
        Patch { name: format!("{}'", patch.name), polygon, is_back: true, ..patch.clone() }
    };
    let sides = dirty.patches.iter().flat_map(|patch| [patch.clone(), turned(patch)]).collect();
    let hollow = Scene { patches: sides, ..dirty };
    assert_eq!(area(&repair(&hollow).scene), area(&hollow));
}

/// Blocks that pass through each other under a sky receive what they did before they were cut.
#[test]
fn cutting_changes_no_light() {
    let blocks = [Block { low: [0, 0, 0], high: [3, 3, 2] }, Block { low: [1, 1, 1], high: [2, 5, 4] }];
    let mut dirty = scene(&blocks, DQuat::from_rotation_x(0.3));
    dirty.sky = Some(Sky { radiance: vec![1.0], kind: SkyKind::Uniform });
    let power = |scene: &Scene| {
        let options = Options { method: Method::Hierarchical, ..Quality::Draft.options() };
        let solution = solve(scene, &options, |_| ControlFlow::Continue(())).unwrap();
        let means = solution.patch_means(&solution.irradiance, scene.patches.len());
        let of = |(index, patch): (usize, &Patch)| {
            [means[index][0], solution.patch_estimate(index)[0]].map(|value| value * patch.polygon.area())
        };
        scene.patches.iter().enumerate().map(of).fold([0.0; 2], |[sum, error], [e, d]| [sum + e, error + d])
    };
    let [[before, error], [after, other]] = [&dirty, &repair(&dirty).scene].map(power);
    assert!((before - after).abs() < error + other && after > 0.0, "{before} {error} {after} {other}");
}
