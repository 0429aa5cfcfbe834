//! Refuses patches that lie on each other: form factors to both would count the same view twice.
use crate::coplanar::overlaps;
use crate::error::Error;
use crate::scene::Scene;

/// Checks that no two patches of one plane that face the same way overlap. What [`crate::repair()`] leaves passes: it takes planes for
/// one that are further apart. O(n log n) for n patches that are spread out.
pub(super) fn check(scene: &Scene) -> Result<(), Error> {
    let Some(overlap) = overlaps(scene, 0.0).into_iter().next() else { return Ok(()) };
    let [first, second] = overlap.patches.map(|index| &scene.patches[index]);
    let share = overlap.area / first.polygon.area().min(second.polygon.area());
    Err(Error::Overlap { first: first.name.clone(), second: second.name.clone(), share })
}
