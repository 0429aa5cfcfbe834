//! Which sides of double-sided surfaces matter.
//!
//! ```text
//! sight    what a ray from a point meets
//! ```
//!
//! Modellers and exporters make every material double-sided. Two patches for each face cost twice the patches and up to four times
//! the form factors, and a panel under a ceiling would light the gap above it. What a viewer of the file cannot tell stays out:
//!
//! - A closed body has one side that light can come to, unless light is made within it.
//! - A lamp before a wall shines away from the wall.
mod sight;

use crate::bodies::Bodies;
use crate::repair::weld::Welds;
use crate::scene::{Scene, patch::Patch};
use glam::DVec3;
use sight::SightLines;

/// A lamp has a wall behind it where one is nearer than this share of the square root of its area.
const BEHIND: f64 = 0.05;
/// Just before a patch: in shares of the square root of its area.
const BEFORE: f64 = 1e-3;

/// The scene with one side of each face: that of the file's polygons.
#[must_use]
pub fn one_sided(scene: &Scene) -> Scene {
    let patches = scene.patches.iter().filter(|patch| !patch.is_back).cloned().collect();
    Scene { patches, ..scene.clone() }
}

/// The scene with the sides of double-sided surfaces that light can come to.
///
/// Of a closed and consistently oriented body the inner side is left out, whichever that is; but both sides stay where light is made
/// within: an emitter of another body is inside, or the body emits itself and a camera or another body is inside. Of the two
/// sides of other surfaces that emit, the one that has a surface close before it, at less than a twentieth of its own size, emits
/// nothing; where both have, and where the second lies on another surface, the first side emits.
///
/// Edges that single precision keeps apart are one. O(n log n) for n patches that are spread out.
#[must_use]
pub fn needed_sides(scene: &Scene) -> Scene {
    if !scene.patches.iter().any(|patch| patch.is_back) {
        return scene.clone();
    }
    let bodies = Bodies::of_first_sides(scene, &Welds::of(scene));
    let sight = SightLines::of(scene);
    let shines = |index: usize| {
        let is_sheet = is_pair(scene, index) && bodies.of(index).turned_in.is_none();
        scene.patches[index].emits() && (!is_sheet || shines(scene, &sight, index))
    };
    let lamps: Vec<bool> = (0..scene.patches.len()).map(shines).collect();
    let is_lit = lit_within(scene, &bodies, &sight, &lamps);
    let is_needed = |index: &usize| {
        let turned_in = bodies.of(*index).turned_in;
        let is_inner = turned_in.is_some_and(|turned_in| scene.patches[*index].is_back != turned_in);
        !is_inner || is_lit[bodies.of_patch[*index]] || !is_pair(scene, *index)
    };
    let side = |index: usize| {
        let patch = scene.patches[index].clone();
        if patch.emits() && !lamps[index] {
            Patch { emission: vec![0.0; scene.bands], ..patch }
        } else {
            patch
        }
    };
    let patches = (0..scene.patches.len()).filter(is_needed).map(side).collect();
    Scene { patches, ..scene.clone() }
}

/// For each patch the number of the closed body that it is a part of, if it is of one.
pub(crate) fn closed_bodies(scene: &Scene) -> Vec<Option<usize>> {
    let bodies = Bodies::of_first_sides(scene, &Welds::of(scene));
    let is_closed = |patch: usize| bodies.of(patch).turned_in.is_some();
    (0..scene.patches.len()).map(|patch| is_closed(patch).then(|| bodies.of_patch[patch])).collect()
}

/// Whether a patch is one of two sides.
fn is_pair(scene: &Scene, index: usize) -> bool {
    scene.patches[index].is_back || scene.patches.get(index + 1).is_some_and(|next| next.is_back)
}

/// The other side of a patch that has one.
fn other_side(scene: &Scene, index: usize) -> usize {
    if scene.patches[index].is_back { index - 1 } else { index + 1 }
}

/// Which closed bodies have light within.
fn lit_within(scene: &Scene, bodies: &Bodies, sight: &SightLines<'_>, lamps: &[bool]) -> Vec<bool> {
    let mut is_lit = vec![false; bodies.bodies.len()];
    for index in (0..lamps.len()).filter(|&index| lamps[index]) {
        let around =
            before(scene, index).map_or_else(Vec::new, |place| sight.around(place, &bodies.of_patch));
        around
            .into_iter()
            .filter(|body| *body != bodies.of_patch[index])
            .for_each(|body| is_lit[body] = true);
    }
    // A body that emits itself may be a room, for whoever stands in it.
    let cameras = scene.cameras.iter().map(|camera| (None, camera.position));
    let others = bodies.bodies.iter().enumerate();
    let others = others.filter_map(|(body, other)| Some((Some(body), before(scene, other.first)?)));
    for (own, place) in cameras.chain(others) {
        let around = sight.around(place, &bodies.of_patch).into_iter();
        let rooms = around.filter(|body| bodies.bodies[*body].emits && own != Some(*body));
        rooms.for_each(|body| is_lit[body] = true);
    }
    is_lit
}

/// A point just before a patch.
fn before(scene: &Scene, index: usize) -> Option<DVec3> {
    let patch = &scene.patches[index];
    let middle = patch.middle()?;
    Some(middle.position() + BEFORE * patch.polygon.area().sqrt() * middle.normal())
}

/// Whether this side of a lamp with two sides emits.
fn shines(scene: &Scene, sight: &SightLines<'_>, index: usize) -> bool {
    let is_back = scene.patches[index].is_back;
    let is_free = |side: usize| {
        let patch = &scene.patches[side];
        let size = patch.polygon.area().sqrt();
        let Some(middle) = patch.middle() else { return true };
        // What touches a lamp is behind it.
        let touch = if patch.is_back { -BEFORE * size } else { BEFORE * size };
        let ray = [
            middle.position() + touch * middle.normal(),
            middle.position() + BEHIND * size * middle.normal(),
        ];
        sight.is_free(ray, [index, other_side(scene, index)])
    };
    is_free(index) || (!is_back && !is_free(other_side(scene, index)))
}
