//! What the corners of parts of leaves receive, and their middles: corners that several leaves share are looked from once.
use super::line_tree::LineTree;
use super::tiling::Tiling;
use glam::DVec2;
use std::collections::BTreeMap;

/// Places in the frame of a patch are told apart by this.
const APART: f64 = 1.0 / (1u64 << 32) as f64;

/// A place on a patch, with the tile where light may jump there: nothing where all tiles around it see the same.
pub(super) type CornerKey = (usize, Option<usize>, [u64; 2]);

/// The light at corners, band by band.
pub(super) struct CornerLight<'c> {
    tiling: &'c Tiling<'c>,
    /// The lines on each patch across which light may jump.
    jumps: Vec<LineTree>,
    /// The sides of each patch.
    sides: Vec<LineTree>,
    light: BTreeMap<CornerKey, Vec<f64>>,
}

impl<'c> CornerLight<'c> {
    /// `lines` are those on each patch across which light jumps.
    pub(super) fn new(tiling: &'c Tiling<'c>, lines: &[Vec<[DVec2; 2]>]) -> CornerLight<'c> {
        let sides = |patch: usize| {
            let loops = tiling.scene.patches[patch].polygon.loops();
            let sides = loops.flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
            sides.map(move |(start, end)| [*start, *end].map(|place| tiling.flatten(patch, place))).collect()
        };
        let jumps = lines.iter().map(|lines| LineTree::of(lines.clone())).collect();
        let sides = (0..lines.len()).map(|patch| LineTree::of(sides(patch))).collect();
        CornerLight { tiling, jumps, sides, light: BTreeMap::new() }
    }

    /// The key of a corner of a part of a tile.
    pub(super) fn key(&self, tile: usize, corner: DVec2) -> CornerKey {
        let patch = self.tiling.tiles[tile].patch;
        (patch, is_on(&self.jumps[patch], corner).then_some(tile), place(corner))
    }

    /// Whether light at a corner with such a key may be other than beside it: where that may jump, and at the sides of the patch, where others
    /// touch it.
    pub(super) fn is_at_rim(&self, (patch, own, _): &CornerKey, corner: DVec2) -> bool {
        own.is_some() || is_on(&self.sides[*patch], corner)
    }

    pub(super) fn is_known(&self, key: &CornerKey) -> bool {
        self.light.contains_key(key)
    }

    pub(super) fn add(&mut self, light: impl Iterator<Item = (CornerKey, Vec<f64>)>) {
        self.light.extend(light);
    }

    /// The light at a corner, where that was looked from.
    pub(super) fn of(&self, key: &CornerKey) -> Option<&[f64]> {
        self.light.get(key).map(Vec::as_slice)
    }

    /// The light at a place of a tile, where that was looked from.
    pub(super) fn at(&self, tile: usize, place: DVec2) -> Option<&[f64]> {
        self.of(&self.key(tile, place))
    }
}

/// Whether one of some lines passes a place.
fn is_on(lines: &LineTree, place: DVec2) -> bool {
    // A little more than what is asked for: boxes are rounded otherwise than distances.
    lines.any_near(place, 3.0 * APART, |line| distance(place, line) < 2.0 * APART)
}

/// Names a place.
fn place(corner: DVec2) -> [u64; 2] {
    // The sum makes −0 a 0.
    corner.to_array().map(|along| ((along / APART).round() + 0.0).to_bits())
}

/// How far a point is from a line between two.
fn distance(point: DVec2, [start, end]: [DVec2; 2]) -> f64 {
    let way = end - start;
    let share = ((point - start).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (start + way * share).distance(point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use formfactor::PlanarPolygon;

    /// A floor in two tiles, on which a wall stands across its middle.
    #[test]
    fn corners_are_shared_within_a_patch_but_not_across_what_stands_on_it() {
        let square = |corners: [[f64; 3]; 4]| {
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
        };
        let floor = square([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
        let wall = square([[1.0, 0.0, 0.0], [1.0, 0.5, 0.0], [1.0, 0.5, 1.0], [1.0, 0.0, 1.0]]);
        let scene = Scene { patches: vec![floor, wall], bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        let mut corners =
            CornerLight::new(&tiling, &[tiling.contacts(0).to_vec(), tiling.contacts(1).to_vec()]);
        let key = |corners: &CornerLight<'_>, tile: usize, place: [f64; 3]| {
            corners.key(tile, tiling.flatten(0, place.into()))
        };
        let within = key(&corners, 0, [0.25, 0.5, 0.0]);
        assert_eq!(within.1, None);
        let is_at_rim =
            |place: [f64; 3]| corners.is_at_rim(&key(&corners, 0, place), tiling.flatten(0, place.into()));
        for at_rim in [[1.0, 0.25, 0.0], [0.5, 0.0, 0.0], [2.0, 1.0, 0.0]] {
            assert!(is_at_rim(at_rim), "{at_rim:?}");
            assert_eq!(key(&corners, 0, at_rim).1, (at_rim[0] == 1.0).then_some(0), "{at_rim:?}");
        }
        assert!(!is_at_rim([0.25, 0.5, 0.0]));
        let at_wall = key(&corners, 0, [1.0, 0.25, 0.0]);
        corners.add([(within, vec![7.0]), (at_wall, vec![8.0])].into_iter());
        let at = |tile: usize, place: [f64; 3]| corners.at(tile, tiling.flatten(0, place.into()));
        assert_eq!(at(0, [0.25, 0.5, 0.0]), Some(&[7.0][..]));
        assert_eq!(at(0, [0.25, 0.5 + 1e-6, 0.0]), None);
        assert_eq!(at(0, [1.0, 0.25, 0.0]), Some(&[8.0][..]));
    }

    /// A grid of lines, as around the houses of a town.
    #[test]
    fn a_place_is_on_one_of_many_lines_if_it_is_on_any_of_them() {
        let at = |k: u32| DVec2::new(f64::from(k % 20), f64::from(k / 20));
        let lines: Vec<[DVec2; 2]> = (0..400)
            .flat_map(|k| [[at(k), at(k) + 0.5 * DVec2::X], [at(k), at(k) + 0.5 * DVec2::new(0.6, 0.8)]])
            .collect();
        let jumps = LineTree::of(lines.clone());
        for [start, end] in lines {
            for share in [0.0, 0.3, 1.0] {
                let place = start.lerp(end, share);
                let aside = (end - start).perp() * 1e-6;
                assert!(is_on(&jumps, place) && is_on(&jumps, place + aside * 1e-4), "{place}");
                assert!(share == 0.0 || !is_on(&jumps, place + aside), "{place}");
            }
        }
        assert!(!is_on(&jumps, DVec2::splat(0.7)) && !is_on(&LineTree::of(Vec::new()), DVec2::ZERO));
    }
}
