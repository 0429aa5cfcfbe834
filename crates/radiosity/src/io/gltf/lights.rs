//! Lights of `KHR_lights_punctual`.
//!
//! The extension is photometric: candela, and lux of a directional light. Blender makes 683 lm of a watt of a lamp by default, and leaves what
//! surfaces emit in watts. Whoever exports may choose to have watts of both, or watts that are not spread over a sphere; the file does not say.
use super::document::GltfFile;
use super::material::as_written;
use crate::io::error::Fault;
use crate::io::surface::lamps::LampPose;
use crate::scene::finding::Finding;
use crate::scene::lamp::{Cone, Distribution, Lamp, Rim};
use crate::scene::sky::Sun;
use crate::scene::units::Units;
use gltf::khr_lights_punctual::{Kind, Light};
use std::f64::consts::PI;

/// Lumens that Blender makes of a watt.
const BLENDER: f64 = 683.0;
/// The least difference of cosines between the inner and the outer cone, as the extension recommends.
const RIM: f64 = 1e-3;

/// A lamp or a sun.
pub(super) enum ReadLight {
    Lamp(Lamp),
    Sun(Sun),
}

/// The units of a file: photometric where it has lights.
pub(super) fn units(file: &GltfFile) -> Units {
    let has_lights = file.document.lights().is_some_and(|mut lights| lights.next().is_some());
    if has_lights { Units::Luminous } else { Units::Radiant }
}

/// How many of the file's units there are in what it says that surfaces emit; of Blender's lights it is noted what else they may be.
pub(super) fn of_emission(file: &GltfFile, name: &str, warnings: &mut Vec<Finding>) -> f64 {
    let generator = file.document.as_json().asset.generator.as_deref().unwrap_or_default();
    if units(file) == Units::Radiant || !generator.contains("Blender") {
        return 1.0;
    }
    let what = "lights are taken as Blender's lighting mode Standard, the default, writes them: 683 lm for each W; so is what surfaces emit";
    let repair = "export again with that mode if it was another: lights of Unitless are 683 times too weak, of Raw 54 times";
    Finding::note(warnings, name, what, repair);
    BLENDER
}

/// The light of a node that stands so; nothing where it has none, or numbers that no light has.
pub(super) fn read(
    light: &Light<'_>,
    name: &str,
    pose: LampPose,
    warnings: &mut Vec<Finding>,
) -> Result<Option<ReadLight>, Fault> {
    let bands = bands(light)?;
    if bands.iter().all(|band| *band == 0.0) {
        return Ok(None);
    }
    let name = name.to_owned();
    let lamp = |name, distribution| ReadLight::Lamp(pose.lamp(name, distribution, bands.clone()));
    Ok(Some(match light.kind() {
        Kind::Directional => ReadLight::Sun(Sun { name, direction: pose.ahead(), irradiance: bands }),
        Kind::Point => lamp(name, Distribution::Even),
        Kind::Spot { inner_cone_angle, outer_cone_angle } => {
            let [inner, outer] = [inner_cone_angle, outer_cone_angle].map(as_written);
            if inner > outer {
                let what = "an inner cone is wider than the outer one; the outer one alone is taken";
                Finding::note(warnings, name.as_str(), what, "correct the angles");
            }
            lamp(name, Distribution::Cone(cone(inner.min(outer), outer)?))
        }
    }))
}

/// Its intensity, or its irradiance, per band.
fn bands(light: &Light<'_>) -> Result<Vec<f64>, Fault> {
    let strength = as_written(light.intensity());
    let colour = light.color().map(as_written);
    let negative = |what, value: f64| if value < 0.0 { Err(Fault::Negative { what, value }) } else { Ok(()) };
    negative("intensity", strength)?;
    colour.into_iter().try_for_each(|band| negative("colour", band))?;
    let bands: Vec<f64> = colour.map(|band| strength * band).to_vec();
    if bands.iter().all(|band| band.is_finite()) { Ok(bands) } else { Err(Fault::Huge("the intensity")) }
}

/// The cone between two angles to the axis.
fn cone(inner: f64, outer: f64) -> Result<Cone, Fault> {
    if let Some(angle) = [inner, outer].into_iter().find(|angle| !(0.0..=PI).contains(angle)) {
        return Err(Fault::Angle(angle.to_degrees()));
    }
    let edge = outer.cos();
    let inner = inner.cos().max(edge + RIM).min(1.0);
    Ok(Cone { exponent: 0.0, inner, outer: edge.min(inner), rim: Rim::Squared })
}
