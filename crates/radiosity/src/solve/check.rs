//! Refuses scenes that have no solution.
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};
use std::f64::consts::PI;

/// Checks that every patch has the scene's bands, a reflectance of 0 or more, and emits no negative light and none beyond
/// the range of doubles. Whether a reflectance of 1 or more is too much depends on what stands around it: see
/// [`super::rooms`].
pub(super) fn check(scene: &Scene) -> Result<(), Error> {
    if scene.patches.is_empty() {
        return Err(Error::NoPatches);
    }
    scene.patches.iter().try_for_each(|patch| check_patch(patch, scene.bands))?;
    let area: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    scene.patches.iter().try_for_each(|patch| check_power(patch, area))
}

/// Checks that the light that such a patch gives, on all surfaces, is a number, and its power: no reflectance below 1 makes
/// it more than 2^53 times as bright.
fn check_power(patch: &Patch, area: f64) -> Result<(), Error> {
    let brightest = 1.0 / f64::EPSILON * 2.0 * PI * area.max(1.0);
    let beyond = patch.emission.iter().position(|value| !(value * brightest).is_finite());
    beyond.map_or(Ok(()), |band| {
        Err(Error::Bright { patch: patch.name.clone(), band, value: patch.emission[band] })
    })
}

/// The same for one patch.
fn check_patch(patch: &Patch, expected: usize) -> Result<(), Error> {
    let name = || patch.name.clone();
    let found = [patch.reflectance.len(), patch.emission.len()].into_iter().find(|&bands| bands != expected);
    if let Some(found) = found {
        return Err(Error::Bands { patch: name(), found, expected });
    }
    for (band, &value) in patch.reflectance.iter().enumerate() {
        if !(0.0..=1.0).contains(&value) {
            return Err(Error::Reflectance { patch: name(), band, value });
        }
    }
    for (band, &value) in patch.emission.iter().enumerate() {
        if !(0.0..f64::INFINITY).contains(&value) {
            return Err(Error::Emission { patch: name(), band, value });
        }
    }
    Ok(())
}
