//! Which tiles are in closed rooms.
//!
//! ```text
//! +-----------+   .  .  .        of few tiles all points look at everything; of many those look, at their own room, that lack most
//! |   room    |     |  |         across their links, and some others
//! +-----------+  ---+--+---
//! ```
use super::equilibrium::Equilibrium;
use super::look::rises;
use super::tiling::{Tile, Tiling};
use formfactor::DifferentialArea;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// A point is in a closed room when ΣF is 1 within this, and covered when it is 0 within this.
const CLOSED: f64 = 1e-9;
/// Where clusters are linked, what covers most of a tile is known by ΣF alone, which is 1 elsewhere but for the errors of links.
const COVERED: f64 = 0.5;
/// When so many tiles that lack most lack nothing, no others are asked, …
const IN_TURN: usize = 8;
/// … but so many of all. After so many turns it is not known whether the room is closed.
const SAMPLES: usize = 64;
const TURNS: usize = 32;
/// A point looks for what is beyond all so far aside of its normal for each unit along it, in so many directions each, of which so many may be
/// through cracks.
const ASIDE: [f64; 3] = [0.5, 1.5, 4.0];
const DIRECTIONS: u32 = 8;
const CRACKS: usize = 2;

/// Whether a tile is in a closed room, by the points of it: all, some, or none. Those under what stands on it are not, which parts of a tile that
/// is crossed may be; of those some see nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Enclosed {
    Wholly,
    Partly,
    Covered,
    Nowhere,
}

/// What is known of all tiles.
#[derive(Debug, Default)]
pub(super) struct ClosedRooms {
    of_tiles: Vec<Enclosed>,
    /// Where rooms are told apart, these, and the one of each tile.
    rooms: Vec<TileRoom>,
    room_of: Vec<usize>,
}

/// What a point sees of its room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RoomView {
    /// The room and nothing else.
    Whole,
    /// What is beyond it, too.
    Out,
    /// More than there is: faces that lie on each other count twice.
    Twice,
    /// Little: it may be covered.
    Little,
}

/// Tiles that exchange light, at once or through others.
#[derive(Debug)]
struct TileRoom {
    tiles: Vec<usize>,
    surfaces: Vec<usize>,
    /// Farther than anything is.
    far: f64,
}

impl Enclosed {
    /// What the sums of factors of its five points say.
    fn by(sums: &[f64]) -> Enclosed {
        // Between the sides of what stands on a tile, rounding may leave a crack.
        let is_covered = sums.iter().all(|sum| *sum <= CLOSED);
        match sums.iter().filter(|sum| is_one(**sum)).count() {
            5 => Enclosed::Wholly,
            0 if is_covered => Enclosed::Covered,
            0 => Enclosed::Nowhere,
            _ => Enclosed::Partly,
        }
    }
}

impl ClosedRooms {
    /// By the ΣF of the five points of every tile.
    pub(super) fn by_points(sums: &[[f64; 5]]) -> ClosedRooms {
        ClosedRooms {
            of_tiles: sums.iter().map(|sums| Enclosed::by(sums)).collect(),
            ..ClosedRooms::default()
        }
    }

    /// Room by room, where there are too many tiles to look at everything from each.
    pub(super) fn by_rooms(tiling: &Tiling<'_>, equilibrium: &Equilibrium<'_>) -> ClosedRooms {
        let (leaves, count) = (equilibrium.leaves(), tiling.tiles.len());
        let (mut of_tiles, mut room_of) = (vec![Enclosed::Nowhere; count], vec![0; count]);
        let mut linked = vec![0.0; count];
        leaves.iter().enumerate().for_each(|(leaf, tile)| linked[*tile] = equilibrium.sums(leaf)[0]);
        let [low, high] = tiling.scene.extent();
        let far = 2.0 * (high - low).length();
        let room =
            |room: Vec<usize>| TileRoom::of(tiling, room.into_iter().map(|leaf| leaves[leaf]).collect(), far);
        let rooms: Vec<TileRoom> = equilibrium.rooms().into_iter().map(room).collect();
        for (index, room) in rooms.iter().enumerate() {
            for tile in room.enclosed(tiling, &linked) {
                let is_crossed = tiling.tiles[tile].is_crossed;
                of_tiles[tile] = if is_crossed { Enclosed::Partly } else { Enclosed::Wholly };
                room_of[tile] = index;
            }
        }
        ClosedRooms { of_tiles, rooms, room_of }
    }

    /// Adds the tiles since the last time: those of which a part is in a closed room, or may be covered, are looked at again when they are cut.
    pub(super) fn add(&mut self, tiling: &Tiling<'_>) {
        for tile in &tiling.tiles[self.of_tiles.len()..] {
            let of_part = |parent| self.of_part(tiling, tile, parent);
            self.of_tiles.push(tile.parent.map_or(Enclosed::Nowhere, of_part));
            if !self.rooms.is_empty() {
                self.room_of.push(tile.parent.map_or(0, |parent| self.room_of[parent]));
            }
        }
    }

    fn of_part(&self, tiling: &Tiling<'_>, part: &Tile, parent: usize) -> Enclosed {
        let of_parent = self.of_tiles[parent];
        if of_parent != Enclosed::Partly && (!self.rooms.is_empty() || !tiling.tiles[parent].is_crossed) {
            return of_parent;
        }
        if self.rooms.is_empty() {
            let all = || 0..tiling.enclosure.polygons().len();
            let sums: Vec<f64> = part.points.par_iter().map(|point| sum(tiling, point, all())).collect();
            return Enclosed::by(&sums);
        }
        let seen = || self.rooms[self.room_of[parent]].sum(tiling, &part.points[0]);
        if part.is_crossed { Enclosed::Partly } else { Enclosed::by(&[seen(); 5]) }
    }

    /// ΣF of the tiles of which it is known: 1 in closed rooms, 0 under what stands on them.
    pub(super) fn known(&self, tiling: &Tiling<'_>) -> Vec<Option<f64>> {
        let of = |(tile, enclosed): (&Tile, &Enclosed)| match enclosed {
            Enclosed::Wholly if !tile.is_crossed => Some(1.0),
            Enclosed::Covered if !tile.is_crossed => Some(0.0),
            _ => None,
        };
        let known = tiling.tiles.iter().zip(&self.of_tiles).map(of);
        known.chain(std::iter::repeat(None)).take(tiling.tiles.len()).collect()
    }

    /// Whether what a tile sends cannot leave its room.
    pub(super) fn encloses(&self, tile: usize) -> bool {
        match self.of_tiles[tile] {
            Enclosed::Wholly => true,
            Enclosed::Partly => !self.rooms.is_empty(),
            _ => false,
        }
    }
}

impl TileRoom {
    fn of(tiling: &Tiling<'_>, tiles: Vec<usize>, far: f64) -> TileRoom {
        let mut surfaces: Vec<usize> = tiles.iter().map(|tile| tiling.tiles[*tile].surface).collect();
        surfaces.sort_unstable();
        surfaces.dedup();
        TileRoom { tiles, surfaces, far }
    }

    /// The tiles that see nothing but the room, whatever else there is; those on which something stands may be covered in part. Unless it is the whole
    /// room that is closed, these are only some that are known to.
    fn enclosed(&self, tiling: &Tiling<'_>, linked: &[f64]) -> Vec<usize> {
        let is_seen = |tile: &usize| linked[*tile] >= COVERED;
        let seen: Vec<usize> = self.tiles.iter().copied().filter(is_seen).collect();
        let view = |tile: usize| self.view(tiling, &tiling.tiles[tile].points[0]);
        let step = seen.len().div_ceil(SAMPLES).max(1);
        let (enclosed, is_closed) = self.least(linked, &seen, view);
        if !is_closed || seen.par_iter().step_by(step).any(|tile| view(*tile) == RoomView::Out) {
            return enclosed;
        }
        // Of a tile that is cut for what stands on it, parts are covered, which see as much across the links of the whole as others.
        let above = |tile: &usize| tiling.tiles[*tile].parent;
        let is_of_crossed = |tile: usize| {
            std::iter::successors(above(&tile), above).any(|whole| tiling.tiles[whole].is_crossed)
        };
        let is_enclosed = |tile: &usize| {
            tiling.tiles[*tile].is_crossed || !is_of_crossed(*tile) || view(*tile) == RoomView::Whole
        };
        seen.into_par_iter().filter(is_enclosed).collect()
    }

    /// Those in a closed room of the tiles that lack most across their links, several in turn until nothing is lacking; and whether it came to that.
    /// What is covered does not tell.
    fn least(
        &self,
        linked: &[f64],
        seen: &[usize],
        view: impl Fn(usize) -> RoomView + Sync,
    ) -> (Vec<usize>, bool) {
        let mut least = seen.to_vec();
        least.sort_by(|a, b| linked[*a].total_cmp(&linked[*b]));
        let mut enclosed = Vec::new();
        for tiles in least.chunks(IN_TURN).take(TURNS) {
            let views: Vec<RoomView> = tiles.par_iter().map(|tile| view(*tile)).collect();
            let told = views.iter().filter(|view| **view != RoomView::Little).count();
            let before = enclosed.len();
            let whole = tiles.iter().zip(views).filter(|(_, view)| *view == RoomView::Whole);
            enclosed.extend(whole.map(|(tile, _)| *tile));
            match enclosed.len() - before {
                0 if told > 0 => return (enclosed, false),
                found if found == told && found > 0 => return (enclosed, true),
                _ => {}
            }
        }
        (enclosed, false)
    }

    /// What a point sees of the room. Where it sees past everything that is known without a form factor to all of the room, one of thousands.
    fn view(&self, tiling: &Tiling<'_>, point: &DifferentialArea) -> RoomView {
        if sees_out(tiling, point, self.far) {
            return RoomView::Out;
        }
        match self.sum(tiling, point) {
            sum if is_one(sum) => RoomView::Whole,
            sum if sum > 1.0 => RoomView::Twice,
            sum if sum >= COVERED => RoomView::Out,
            _ => RoomView::Little,
        }
    }

    /// ΣF of a point to the room.
    fn sum(&self, tiling: &Tiling<'_>, point: &DifferentialArea) -> f64 {
        sum(tiling, point, self.surfaces.iter().copied())
    }
}

/// Whether a point sees past everything in more directions than rounding may let a look through a crack.
fn sees_out(tiling: &Tiling<'_>, point: &DifferentialArea, far: f64) -> bool {
    let normal = point.normal();
    let along = normal.any_orthonormal_vector();
    let across = normal.cross(along);
    let is_free = |aside: &DVec3| tiling.enclosure.sees(point, point.position() + (normal + *aside) * far);
    let turned = |direction: u32| {
        let angle = f64::from(direction) * TAU / f64::from(DIRECTIONS);
        ASIDE.map(|aside| aside * (along * angle.cos() + across * angle.sin()))
    };
    (0..DIRECTIONS).flat_map(turned).filter(is_free).nth(CRACKS).is_some()
}

fn is_one(sum: f64) -> bool {
    (sum - 1.0).abs() <= CLOSED
}

/// ΣF of a point to those of some surfaces that rise above its plane: whether it sees what touches it face to face is up to rounding.
fn sum(tiling: &Tiling<'_>, point: &DifferentialArea, surfaces: impl Iterator<Item = usize>) -> f64 {
    let polygons = tiling.enclosure.polygons();
    let is_before = |surface: &usize| polygons[*surface].loops().flatten().any(|place| rises(*place, point));
    surfaces.filter(is_before).map(|surface| tiling.enclosure.form_factor(point, surface).value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, patch::Patch};
    use formfactor::PlanarPolygon;

    /// The faces of the unit cube, seen from inside, floor and ceiling last.
    fn cube() -> Scene {
        let face = |corners: [[u8; 3]; 4]| {
            let polygon = PlanarPolygon::new([corners.map(|at| DVec3::from(at.map(f64::from)))]).unwrap();
            Patch::new("face", polygon, vec![0.5], vec![0.0])
        };
        let faces = [
            [[0, 0, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1]],
            [[1, 0, 0], [1, 0, 1], [1, 1, 1], [1, 1, 0]],
            [[0, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 0]],
            [[0, 1, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1]],
            [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
            [[0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]],
        ];
        Scene { patches: faces.map(face).to_vec(), bands: 1, ..Scene::default() }
    }

    /// From no place of a closed room something is seen beyond it, and from all others much is when the ceiling is gone.
    #[test]
    fn who_sees_past_everything_is_in_no_closed_room() {
        let out = |scene: &Scene| {
            let tiling = Tiling::new(scene).unwrap();
            tiling.tiles.iter().filter(|tile| sees_out(&tiling, &tile.points[0], 4.0)).count()
        };
        let mut scene = cube();
        assert_eq!(out(&scene), 0);
        scene.patches.pop();
        assert_eq!(out(&scene), 5);
    }
}
