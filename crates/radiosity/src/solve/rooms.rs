//! Which patches light can reach, and which of them close rooms.
use super::light::Light;
use crate::error::Error;
use crate::scene::Scene;
use crate::union_find::UnionFind;

/// At what deviation of ΣF from 1 a room counts as closed: a gap of a billionth of the view loses less than a room with
/// a reflectance of 0.999999 absorbs a thousand times over.
const CLOSED: f64 = 1e-9;

/// Patches that exchange light.
#[derive(Clone, Debug)]
pub(super) struct Room {
    /// The patches, ascending.
    pub(super) patches: Vec<usize>,
    /// Whether every element of a reflecting patch sees a patch wherever it looks.
    pub(super) closed: bool,
    /// The largest reflectance of its elements.
    pub(super) reflectance: f64,
}

/// The lit part of a scene.
#[derive(Debug)]
pub(super) struct Rooms {
    /// Patches connected by light, in the order of their first.
    pub(super) rooms: Vec<Room>,
    /// ΣF over all patches, for every element.
    pub(super) sums: Vec<f64>,
    /// How many patches the scene has.
    pub(super) patches: usize,
}

impl Rooms {
    /// Collects the lit patches of each group.
    pub(super) fn collect(
        &mut self,
        lit: &[bool],
        groups: &mut UnionFind,
        patch_of: &[usize],
        light: &Light,
    ) {
        let mut room_of = vec![usize::MAX; lit.len()];
        for patch in (0..lit.len()).filter(|&patch| lit[patch]) {
            let first = groups.first(patch);
            if room_of[first] == usize::MAX {
                room_of[first] = self.rooms.len();
                self.rooms.push(Room { patches: Vec::new(), closed: true, reflectance: 0.0 });
            }
            room_of[patch] = room_of[first];
            self.rooms[room_of[patch]].patches.push(patch);
        }
        for element in 0..patch_of.len() {
            let Some(room) = self.rooms.get_mut(room_of[patch_of[element]]) else { continue };
            let largest = light.largest_reflectance(element);
            room.reflectance = room.reflectance.max(largest);
            room.closed &= largest == 0.0 || (self.sums[element] - 1.0).abs() <= CLOSED;
        }
    }

    /// Refuses a closed room with a patch that reflects all light: what it emits could never leave.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), Error> {
        let endless = |room: &&Room| room.closed && room.reflectance >= 1.0;
        let Some(room) = self.rooms.iter().find(endless) else { return Ok(()) };
        let reflects_all = |patch: &&usize| scene.patches[**patch].reflectance.iter().any(|&rho| rho >= 1.0);
        let patch = room.patches.iter().find(reflects_all).unwrap_or(&room.patches[0]);
        Err(Error::Endless {
            room: scene.patches[room.patches[0]].name.clone(),
            patches: room.patches.len(),
            patch: scene.patches[*patch].name.clone(),
        })
    }

    /// Which patches are in closed rooms.
    pub(super) fn closed_patches(&self) -> Vec<bool> {
        let mut closed = vec![false; self.patches];
        self.rooms
            .iter()
            .filter(|room| room.closed)
            .flat_map(|room| &room.patches)
            .for_each(|&p| closed[p] = true);
        closed
    }

    /// The lit patches, ascending.
    pub(super) fn lit(&self) -> Vec<usize> {
        let mut patches: Vec<usize> =
            self.rooms.iter().flat_map(|room| room.patches.iter().copied()).collect();
        patches.sort_unstable();
        patches
    }

    /// The largest reflectance of a closed room; 0 when there is none.
    pub(super) fn closed_reflectance(&self) -> f64 {
        let closed = self.rooms.iter().filter(|room| room.closed);
        closed.map(|room| room.reflectance).fold(0.0, f64::max)
    }
}
