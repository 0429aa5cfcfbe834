//! Clusters: tiles near each other, which exchange light as a whole with what is far away (Smits, Arvo and Greenberg 1994).
//! What is seen of a cluster is seen from its centre: a few lamps are parted from what is dark beside them before all else.
//!
//! ```text
//!                all
//!            /         \
//!      houses           houses and ground
//!      /    \            /            \
//!    ...    ...      houses           ground      whole tiles are clusters of one, and are cut
//!                                     /    \      where what is near them is smaller
//!                                  part    part
//! ```
use super::cluster::Cluster;
use super::tiling::Tiling;
use crate::error::Error;
use crate::extent::Extent;
use std::ops::Range;

/// Two clusters are far from each other when the product of their radii is less than this share of the square of their distance.
const NEAR: f64 = 0.15;
/// Clusters of so few tiles are halved before a larger tile is cut for them, and so few lamps are parted from other tiles.
const FEW: usize = 8;
/// A tile of more than so many times the radius of what is near it is cut first: what stands between it and that may be all there is.
const WIDE: f64 = 16.0;

/// Of many tiles whose planes pass through a cluster, what of that they may exchange with it is wrong on average.
const ON_AVERAGE: f64 = 0.1;

/// All whole tiles in a tree, halved where they lie furthest apart, and the parts of those that are cut for what is near them.
#[derive(Debug, Default)]
pub(super) struct Clusters {
    /// Whole tiles, then parts.
    order: Vec<usize>,
    pub(super) all: Vec<Cluster>,
    /// For each polygon the first and the last place in the order of its tiles.
    of_surface: Vec<[usize; 2]>,
}

/// Cuts a tile: its halves, each as a cluster; nothing when it is too small.
pub(super) type Cut<'c> = &'c mut dyn FnMut(usize) -> Result<Option<[(usize, Cluster); 2]>, Error>;

/// Pairs of clusters that are to be linked, and pairs of tiles that are too near each other for that.
#[derive(Debug, Default)]
pub(super) struct Pairs {
    pub(super) far: Vec<[usize; 2]>,
    pub(super) near: Vec<[usize; 2]>,
}

impl Clusters {
    /// O(n log² n) for n whole tiles.
    pub(super) fn of(tiling: &Tiling<'_>) -> Clusters {
        let order: Vec<usize> = (0..tiling.tiles.len()).collect();
        let extents: Vec<Extent> =
            tiling.tiles.iter().map(|tile| Extent::of_points(tile.outline.places())).collect();
        let mut clusters = Clusters { order, ..Clusters::default() };
        let count = extents.len();
        if count > 0 {
            clusters.grow(tiling, &extents, 0..count);
        }
        clusters.of_surface = vec![[usize::MAX, 0]; tiling.enclosure.polygons().len()];
        for (place, tile) in clusters.order.iter().enumerate() {
            let [first, last] = &mut clusters.of_surface[tiling.tiles[*tile].surface];
            (*first, *last) = ((*first).min(place), (*last).max(place));
        }
        clusters
    }

    fn grow(&mut self, tiling: &Tiling<'_>, extents: &[Extent], members: Range<usize>) -> usize {
        let index = self.all.len();
        let extent =
            self.order[members.clone()].iter().fold(Extent::NOTHING, |all, tile| all.with(&extents[*tile]));
        self.all.push(Cluster::of(tiling, &self.order[members.clone()], members.clone(), extent));
        if members.len() > 1 {
            let axis = self.all[index].extent.longest();
            let middle = |tile: &usize| extents[*tile].low[axis] + extents[*tile].high[axis];
            let tiles = &mut self.order[members.clone()];
            let emits = |tile: &usize| tiling.scene.patches[tiling.tiles[*tile].patch].emits();
            let lamps = tiles.iter().filter(|tile| emits(tile)).count();
            let are_parted = (1..=FEW).contains(&lamps) && lamps < tiles.len();
            let is_left = |tile: &usize| are_parted && !emits(tile);
            tiles.sort_unstable_by(|a, b| {
                is_left(a).cmp(&is_left(b)).then(middle(a).total_cmp(&middle(b))).then(a.cmp(b))
            });
            let half = members.start + if are_parted { lamps } else { members.len() / 2 };
            let halves =
                [members.start..half, half..members.end].map(|part| self.grow(tiling, extents, part));
            self.all[index].halves = Some(halves);
        }
        index
    }

    /// The tiles of a cluster.
    pub(super) fn tiles(&self, cluster: usize) -> &[usize] {
        &self.order[self.all[cluster].members.clone()]
    }

    /// All pairs that may see each other, in clusters that are as large as their distance allows.
    pub(super) fn pairs(&mut self, cut: Cut<'_>) -> Result<Pairs, Error> {
        let mut pairs = Pairs::default();
        let mut within: Vec<usize> = (!self.all.is_empty()).then_some(0).into_iter().collect();
        while let Some(cluster) = within.pop() {
            let halves = self.all[cluster].halves.filter(|_| self.tiles(cluster).len() > 1);
            if let Some(halves) = halves {
                within.extend(halves);
                self.part(halves, &mut pairs, cut)?;
            }
        }
        Ok(pairs)
    }

    /// Adds a pair, or the pairs of its parts that are far enough from each other.
    pub(super) fn part(&mut self, pair: [usize; 2], pairs: &mut Pairs, cut: Cut<'_>) -> Result<(), Error> {
        let mut open = vec![pair];
        while let Some(pair) = open.pop() {
            if self.faces(pair) {
                if self.is_far(pair) {
                    pairs.far.push(pair);
                } else if let Some(parts) = self.halve(pair, cut)? {
                    open.extend(parts);
                } else {
                    pairs.near.push(pair.map(|cluster| self.tiles(cluster)[0]));
                }
            }
        }
        Ok(())
    }

    /// Adds the pairs that take the place of a pair.
    pub(super) fn replace(&mut self, pair: [usize; 2], pairs: &mut Pairs, cut: Cut<'_>) -> Result<(), Error> {
        match self.halve(pair, cut)? {
            Some(parts) => parts.into_iter().try_for_each(|part| self.part(part, pairs, cut)),
            None => {
                pairs.near.push(pair.map(|cluster| self.tiles(cluster)[0]));
                Ok(())
            }
        }
    }

    /// The pairs that take the place of a pair: the larger cluster is halved; nothing for two tiles of which none is far larger.
    pub(super) fn halve(&mut self, pair: [usize; 2], cut: Cut<'_>) -> Result<Option<[[usize; 2]; 2]>, Error> {
        let counts = pair.map(|cluster| self.tiles(cluster).len());
        let [one, other] = pair.map(|cluster| self.all[cluster].radius);
        let (are_two, is_wide) = (counts == [1, 1], one.max(other) > WIDE * one.min(other));
        if are_two && !is_wide {
            return Ok(None);
        }
        let larger = usize::from(other > one);
        let is_of_few = counts[larger] == 1 && counts[1 - larger] <= FEW && !is_wide;
        let first = if is_of_few { 1 - larger } else { larger };
        for end in [first, 1 - first].into_iter().filter(|end| !are_two || *end == larger) {
            if let Some(halves) = self.halves(pair[end], cut)? {
                let with = |half| if end == 0 { [half, pair[1]] } else { [pair[0], half] };
                return Ok(Some(halves.map(with)));
            }
        }
        Ok(None)
    }

    /// The halves of a cluster, of one tile as well.
    fn halves(&mut self, cluster: usize, cut: Cut<'_>) -> Result<Option<[usize; 2]>, Error> {
        if self.all[cluster].halves.is_none() {
            let Some(halves) = cut(self.tiles(cluster)[0])? else { return Ok(None) };
            let added = halves.map(|(tile, mut half)| {
                let at = self.order.len();
                self.order.push(tile);
                half.members = at..at + 1;
                self.all.push(half);
                self.all.len() - 1
            });
            self.all[cluster].halves = Some(added);
        }
        Ok(self.all[cluster].halves)
    }

    /// Whether all tiles of a polygon are in one of two clusters.
    pub(super) fn has_surface(&self, pair: [usize; 2], surface: usize) -> bool {
        let [first, last] = self.of_surface[surface];
        pair.into_iter().any(|cluster| {
            let Range { start, end } = self.all[cluster].members;
            start <= first && last < end
        })
    }

    fn is_far(&self, pair: [usize; 2]) -> bool {
        let [one, other] = pair.map(|cluster| &self.all[cluster]);
        self.nearness(pair) < NEAR
            && one.reach.max(other.reach) < one.centre.distance(other.centre)
            && (0..2).all(|end| self.looks_at_centre(pair[end], pair[1 - end]))
    }

    /// Whether another cluster may be looked at as if it were at its centre; one tile looks at each of many by itself.
    fn looks_at_centre(&self, from: usize, to: usize) -> bool {
        let is_one_and_many = self.tiles(from).len() == 1 && self.tiles(to).len() > 1;
        is_one_and_many || self.all[from].looks_at(self.all[to].centre)
    }

    /// The product of the radii over the square of the distance.
    pub(super) fn nearness(&self, pair: [usize; 2]) -> f64 {
        let [one, other] = pair.map(|cluster| &self.all[cluster]);
        one.radius * other.radius / one.centre.distance_squared(other.centre)
    }

    /// The share of the view from one cluster that another one may fill, about.
    pub(super) fn fill(&self, from: usize, to: usize) -> f64 {
        let reach = self.all[to].radius / self.all[from].centre.distance(self.all[to].centre);
        (reach * reach).min(1.0)
    }

    /// About the most that two exchange, for a radiosity of 1, and what of that may be wrong because planes of tiles pass through the other: points
    /// on the two sides of such a plane see all and nothing of the tile.
    pub(super) fn bounds(&self, tiling: &Tiling<'_>, [one, other]: [usize; 2]) -> [f64; 2] {
        let of = |one: usize, other: usize| {
            let fill = self.fill(one, other);
            self.all[one].rise(tiling, self.tiles(one), &self.all[other]).map(|rise| fill * rise)
        };
        let [[all, through], [back, back_through]] = [of(one, other), of(other, one)];
        let most = all.min(back);
        let crossing = (through + back_through).min(most);
        let are_two = [one, other].iter().all(|cluster| self.tiles(*cluster).len() == 1);
        [most, if are_two { crossing } else { ON_AVERAGE * crossing }]
    }

    /// Whether some tile of one may be before some tile of the other, and the other way round, as far as normals and boxes tell.
    fn faces(&self, [one, other]: [usize; 2]) -> bool {
        let [one, other] = [&self.all[one], &self.all[other]];
        one.may_see(other) && other.may_see(one)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use crate::solve::levels::tiling::Tile;
    use formfactor::PlanarPolygon;
    use glam::DVec3;
    use std::collections::BTreeMap;

    /// Boxes seen from outside, each 0.4 wide, on a grid of 4 × 3 × 2.
    fn boxes() -> Scene {
        let at = |k: u32| DVec3::new(f64::from(k % 4), f64::from(k / 4 % 3), f64::from(k / 12));
        let faces = [[1, 3, 2, 0], [5, 7, 6, 4], [1, 5, 4, 0], [3, 7, 6, 2], [4, 6, 2, 0], [3, 7, 5, 1]];
        let face = |k: u32, face: [u32; 4]| {
            let corner =
                |c: u32| at(k) + 0.4 * DVec3::new(f64::from(c & 1), f64::from(c >> 1 & 1), f64::from(c >> 2));
            let mut corners = face.map(corner);
            let outward = corners.iter().sum::<DVec3>() / 4.0 - at(k) - 0.2;
            if (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(outward) < 0.0 {
                corners.reverse();
            }
            Patch::new("face", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
        };
        let patches = (0..24).flat_map(|k| faces.map(|corners| face(k, corners))).collect();
        Scene { patches, bands: 1, ..Scene::default() }
    }

    /// The boxes over a square ground, from one place to another on both axes.
    fn with_ground([low, high]: [f64; 2]) -> Scene {
        let corners = [[low, low], [high, low], [high, high], [low, high]];
        let ground = PlanarPolygon::new([corners.map(|[x, y]| DVec3::new(x, y, -0.1))]).unwrap();
        let mut scene = boxes();
        scene.patches.push(Patch::new("ground", ground, vec![0.5], vec![0.0]));
        scene
    }

    /// What is linked where the ground is cut as it is needed.
    fn over_ground(scene: &Scene) -> (Tiling<'_>, Clusters, Pairs) {
        let mut tiling = Tiling::new(scene).unwrap();
        let mut clusters = Clusters::of(&tiling);
        let cut = &mut |tile: usize| {
            let halves = tiling.halve(tile, 0)?;
            Ok(halves.map(|halves| halves.map(|half| (half, Cluster::of_tile(&tiling, half)))))
        };
        let pairs = clusters.pairs(cut).unwrap();
        (tiling, clusters, pairs)
    }

    #[test]
    fn every_pair_that_may_see_each_other_is_in_one_pair_of_clusters() {
        let scene = boxes();
        let tiling = Tiling::new(&scene).unwrap();
        let mut clusters = Clusters::of(&tiling);
        let Pairs { far, near } =
            clusters.pairs(&mut |_| panic!("no tile is larger than its house")).unwrap();
        assert!(
            far.len() < 144 * 143 / 4
                && far.iter().any(|pair| pair.iter().any(|&c| clusters.tiles(c).len() > 2))
        );
        let mut found: BTreeMap<[usize; 2], usize> = BTreeMap::new();
        let mut add =
            |one: usize, other: usize| *found.entry([one.min(other), one.max(other)]).or_default() += 1;
        for [one, other] in far {
            for &a in clusters.tiles(one) {
                clusters.tiles(other).iter().for_each(|&b| add(a, b));
            }
        }
        near.into_iter().for_each(|[one, other]| add(one, other));
        assert!(found.values().all(|times| *times == 1));
        let rises = |tile: &Tile, over: &Tile| {
            let at = over.points[0].position();
            tile.outline.places().any(|place| over.normal.dot(place - at) > 1e-9)
        };
        for a in 0..144 {
            for b in a + 1..144 {
                let [one, other] = [a, b].map(|tile| &tiling.tiles[tile]);
                let sees = rises(other, one) && rises(one, other);
                assert!(!sees || found.contains_key(&[a, b]), "{a} and {b}");
            }
        }
    }

    /// Walls that are higher than a roof, though less than half of each is, are seen from afar as clusters of many.
    #[test]
    fn a_lamp_is_linked_by_itself_with_what_is_near_it_alone() {
        let [x, y, z] = DVec3::AXES;
        let square = |corner: DVec3, [along, up]: [DVec3; 2], emission: f64| {
            let corners = [corner, corner + along, corner + along + up, corner + up];
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![emission])
        };
        let wall = |k: u32| {
            let at = 2.0 * (f64::from(k % 16) * x + f64::from(k / 16) * y);
            square(at, [z * 1.5, y], 0.0)
        };
        let roof = square(-x * 3.0 + z, [x, y], 1.0);
        let scene =
            Scene { patches: (0..256).map(wall).chain([roof]).collect(), bands: 1, ..Scene::default() };
        let tiling = Tiling::new(&scene).unwrap();
        let mut clusters = Clusters::of(&tiling);
        let Pairs { far, near } = clusters.pairs(&mut |_| panic!("no tile is larger than a wall")).unwrap();
        let with_many = far.iter().filter(|pair| {
            let [one, other] = pair.map(|cluster| clusters.tiles(cluster));
            (one == [256] && other.len() > 8) || (other == [256] && one.len() > 8)
        });
        assert!(with_many.count() > 0);
        let of_lamp: Vec<[usize; 2]> = near.into_iter().filter(|pair| pair.contains(&256)).collect();
        let distance = |ends: &[usize; 2]| {
            let [one, other] = ends.map(|end| tiling.tiles[end].points[0].position());
            one.distance(other)
        };
        assert!(of_lamp.iter().all(|ends| distance(ends) < 12.0), "{}", of_lamp.len());
    }

    /// A ground far larger than all boxes is not linked as a whole with the faces beside which the tree has it.
    #[test]
    fn no_tile_is_beside_one_that_is_far_larger() {
        let scene = with_ground([-50.0, 60.0]);
        let (tiling, _, Pairs { near, .. }) = over_ground(&scene);
        let radius = |tile: usize| Cluster::of_tile(&tiling, tile).radius;
        let is_wide = |[one, other]: &&[usize; 2]| {
            let [one, other] = [radius(*one), radius(*other)];
            one.max(other) > WIDE * one.min(other)
        };
        assert_eq!(near.iter().filter(is_wide).count(), 0);
    }

    /// A ground under small boxes is cut for them, and no place of it is forgotten or linked twice with a box.
    #[test]
    fn a_ground_is_cut_for_what_stands_on_it() {
        let scene = with_ground([-1.0, 9.0]);
        let (tiling, clusters, Pairs { far, near }) = over_ground(&scene);
        assert!(tiling.tiles.len() > 160, "{} tiles", tiling.tiles.len());
        let root_of = tiling.roots();
        let mut found = vec![0.0; 144];
        let mut add = |one: usize, other: usize| {
            let [ground, other] = if root_of[one] == 144 { [one, other] } else { [other, one] };
            if root_of[ground] == 144 {
                found[other] += tiling.tiles[ground].area / tiling.tiles[144].area;
            }
        };
        for [one, other] in far {
            for &a in clusters.tiles(one) {
                clusters.tiles(other).iter().for_each(|&b| add(a, b));
            }
        }
        near.into_iter().for_each(|[one, other]| add(one, other));
        for (share, tile) in found.iter().zip(&tiling.tiles) {
            assert!(*share <= 1.0 + 1e-9, "{share}");
            // Undersides see all of the ground.
            assert!(tile.normal.z > -0.5 || (share - 1.0).abs() < 1e-9, "{share}");
        }
    }
}
