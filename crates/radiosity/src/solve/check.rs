//! Refuses scenes that have no solution.
use crate::error::Error;
use crate::scene::{Scene, patch::Patch};
use formfactor::DifferentialArea;
use glam::DVec3;
use std::f64::consts::PI;

/// No reflectance below 1 makes light so many times as bright, on all surfaces: see [`check_power`].
const BRIGHTEST: f64 = 1e32;

/// Checks that every patch has the scene's bands, a reflectance of 0 or more, and emits no negative light and none beyond
/// the range of doubles. Whether a reflectance of 1 or more is too much depends on what stands around it: see
/// [`super::rooms`].
pub(super) fn check(scene: &Scene) -> Result<(), Error> {
    if scene.patches.is_empty() {
        return Err(Error::NoPatches);
    }
    scene.patches.iter().try_for_each(|patch| check_patch(patch, scene.bands))?;
    check_lights(scene)?;
    let area: f64 = scene.patches.iter().map(|patch| patch.polygon.area()).sum();
    scene.patches.iter().try_for_each(|patch| check_power(patch, area))
}

/// Checks that lights have a place, a direction, and the scene's bands, none of them negative or beyond the range of doubles.
fn check_lights(scene: &Scene) -> Result<(), Error> {
    let refused = |light: &str, why: &str| Error::Light { light: light.into(), reason: why.into() };
    let bands = |name: &str, values: &[f64]| {
        let is_sound = |value: &f64| *value >= 0.0 && (value * BRIGHTEST).is_finite();
        if values.len() == scene.bands && values.iter().all(is_sound) {
            Ok(())
        } else {
            Err(refused(name, "it needs a finite strength of 0 or more in each of the scene's bands"))
        }
    };
    for lamp in &scene.lamps {
        DifferentialArea::new(lamp.position, DVec3::Z)
            .map_err(|_| refused(&lamp.name, "it stands nowhere"))?;
        bands(&lamp.name, &lamp.intensity)?;
        bands(&lamp.name, &lamp.power())?;
    }
    for sun in &scene.suns {
        if sun.direction.try_normalize().is_none() {
            return Err(refused(&sun.name, "it has no direction"));
        }
        bands(&sun.name, &sun.irradiance)?;
    }
    scene.sky.iter().try_for_each(|sky| bands("sky", &sky.radiance))
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
