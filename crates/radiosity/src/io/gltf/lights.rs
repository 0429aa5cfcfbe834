//! Lights of `KHR_lights_punctual`.
//!
//! The extension is photometric: candela, and lux of a directional light. Blender multiplies its watts with 683 lm/W, the efficacy of green
//! light of 555 nm, and spreads them over a sphere; in its files that is undone.
use super::material::as_written;
use crate::io::surface::lamps::LampPose;
use crate::scene::lamp::{Cone, Distribution, Lamp, Rim};
use crate::scene::sky::Sun;
use crate::scene::units::Units;
use gltf::khr_lights_punctual::{Kind, Light};

/// Lumens that Blender makes of a watt.
const BLENDER: f64 = 683.0;
/// The least difference of cosines between the inner and the outer cone, as the extension recommends.
const RIM: f64 = 1e-3;

/// A lamp or a sun.
pub(super) enum ReadLight {
    Lamp(Lamp),
    Sun(Sun),
}

/// The units of a file's lights: as in Blender where that wrote them, else photometric.
pub(super) fn units(document: &gltf::Document) -> Units {
    let generator = document.as_json().asset.generator.as_deref().unwrap_or_default();
    let is_blender = generator.contains("Blender");
    let has_lights = document.lights().is_some_and(|mut lights| lights.next().is_some());
    if has_lights && !is_blender { Units::Luminous } else { Units::Radiant }
}

/// The light of a node that stands so; nothing where it has none, or numbers that no light has.
pub(super) fn read(light: &Light<'_>, name: &str, pose: LampPose, units: Units) -> Option<ReadLight> {
    let factor = if units == Units::Radiant { 1.0 / BLENDER } else { 1.0 };
    let strength = factor * as_written(light.intensity());
    let bands: Vec<f64> = light.color().map(|band| strength * as_written(band)).to_vec();
    let is_sound = bands.iter().all(|band| *band >= 0.0 && band.is_finite());
    if !is_sound || bands.iter().all(|band| *band == 0.0) {
        return None;
    }
    let name = name.to_owned();
    Some(match light.kind() {
        Kind::Directional => ReadLight::Sun(Sun { name, direction: pose.ahead(), irradiance: bands }),
        Kind::Point => ReadLight::Lamp(pose.lamp(name, Distribution::Even, bands)),
        Kind::Spot { inner_cone_angle, outer_cone_angle } => {
            let outer = as_written(outer_cone_angle).cos();
            let inner = as_written(inner_cone_angle).cos().max(outer + RIM).min(1.0);
            let cone = Cone { exponent: 0.0, inner, outer: outer.min(inner), rim: Rim::Squared };
            ReadLight::Lamp(pose.lamp(name, Distribution::Cone(cone), bands))
        }
    })
}
