//! Lights: lamps, suns, and surfaces that shine.
//!
//! COLLADA gives lights no unit. What Blender writes is in watts, as an `<extra>` of it tells: a colour is the power of a lamp, of which all
//! directions of a sphere get alike (a spot has what is in its cone of that), the irradiance of a sun, and of an area A the radiance is a
//! quarter of the power by A, as Cycles has it. Other colours are taken as radiant intensity in W/sr, or as irradiance in W/m². An `<extra>`
//! of this program holds exact values, of any number of bands:
//!
//! ```xml
//! <light id="…"><technique_common><spot>…</spot></technique_common>
//!   <extra><technique profile="radiosity">
//!     <intensity>5 5 5</intensity>          <!-- W/sr, of a directional light W/m² -->
//!     <cone>1 0.9 0.8 squared</cone>        <!-- exponent, cosines of the inner and the outer cone, how it falls -->
//!   </technique></extra>
//! </light>
//! ```
use super::file::{File, XmlNode, child, children};
use super::spectra::own;
use super::walk::{LightInstance, name_of};
use crate::io::error::{Fault, FileError};
use crate::io::surface::lamps::{LampPose, area_corners};
use crate::scene::finding::Finding;
use crate::scene::lamp::{Cone, Distribution, Lamp, Rim};
use crate::scene::sky::Sun;
use glam::DVec3;
use std::f64::consts::PI;

/// What `type` is of an area light of Blender.
const AREA: f64 = 4.0;

/// A surface that shines, in the coordinates of its node.
pub(super) struct AreaLamp<'a, 'v> {
    pub(super) instance: &'v LightInstance<'a>,
    pub(super) corners: Vec<DVec3>,
    /// Radiance.
    pub(super) emission: [f64; 3],
}

/// The lights of a scene.
#[derive(Default)]
pub(super) struct ReadLights<'a, 'v> {
    pub(super) lamps: Vec<Lamp>,
    pub(super) suns: Vec<Sun>,
    pub(super) areas: Vec<AreaLamp<'a, 'v>>,
}

/// The lights of the scene; those without light are left out, and others that are not read draw a warning.
pub(super) fn lights<'a, 'v>(
    file: &File<'a>,
    instances: &'v [LightInstance<'a>],
    unit: f64,
    warnings: &mut Vec<Finding>,
) -> Result<ReadLights<'a, 'v>, FileError> {
    let mut all = ReadLights::default();
    for instance in instances {
        let reader = LightReader { file, instance, unit };
        reader.read(&mut all, warnings)?;
    }
    Ok(all)
}

/// One light where it stands.
struct LightReader<'a, 'v, 'f> {
    file: &'f File<'a>,
    instance: &'v LightInstance<'a>,
    /// Metres in the file's unit.
    unit: f64,
}

impl<'a, 'v> LightReader<'a, 'v, '_> {
    fn read(&self, all: &mut ReadLights<'a, 'v>, warnings: &mut Vec<Finding>) -> Result<(), FileError> {
        let common = child(self.instance.light, "technique_common");
        let kind = common.and_then(|common| common.children().find(XmlNode::is_element));
        let Some(kind) = kind else {
            self.leave_out(
                warnings,
                "a light without a common technique",
                "export it as a point, spot or sun",
            );
            return Ok(());
        };
        let colour = self.colour(kind)?;
        let strength = self.strength(kind, colour, warnings)?;
        if strength.iter().all(|band| *band == 0.0) {
            return Ok(());
        }
        if !strength.iter().all(|band| band.is_finite()) {
            self.leave_out(warnings, "a light beyond all numbers", "correct its colour or attenuation");
            return Ok(());
        }
        let Some(pose) = LampPose::of(self.instance.visit.world) else {
            self.leave_out(warnings, "a light without a direction", "correct the node's transform");
            return Ok(());
        };
        let name = name_of(self.instance.visit.node, "light").to_owned();
        let area = self.area()?;
        match kind.tag_name().name() {
            _ if area.is_some() => {
                let corners = area.unwrap_or_default();
                let emission = colour.map(|power| power / (4.0 * self.square_metres(&corners)));
                if emission.iter().all(|band| band.is_finite()) {
                    all.areas.push(AreaLamp { instance: self.instance, corners, emission });
                } else {
                    self.leave_out(
                        warnings,
                        "a lamp without an area",
                        "correct its size or its node's scale",
                    );
                }
            }
            "directional" => all.suns.push(Sun { name, direction: pose.ahead(), irradiance: strength }),
            "point" | "spot" => {
                let distribution = self.distribution(kind)?;
                all.lamps.push(pose.lamp(name, distribution, strength));
            }
            other => {
                let repair = "let --sky light the scene from all around";
                self.leave_out(warnings, &format!("a light of kind {other}"), repair);
            }
        }
        if self.blender().is_none() && own(self.instance.light).is_none() {
            let what =
                "COLLADA gives lights no unit: a colour is taken as W/sr, of a directional light as W/m²";
            let repair = "compare its brightness with that of other lights";
            Finding::note(warnings, self.file.place(self.instance.light), what, repair);
        }
        Ok(())
    }

    /// Its colour, in whatever unit.
    fn colour(&self, kind: XmlNode<'a>) -> Result<[f64; 3], FileError> {
        let Some(element) = child(kind, "color") else { return Ok([1.0; 3]) };
        let numbers = self.file.numbers(element)?;
        let [red, green, blue] = *numbers
            .first_chunk()
            .ok_or_else(|| self.file.fault(element, Fault::Count { found: numbers.len(), wanted: 3 }))?;
        match [red, green, blue].into_iter().find(|band| *band < 0.0) {
            Some(value) => Err(self.file.fault(element, Fault::Negative { what: "colour", value })),
            None => Ok([red, green, blue]),
        }
    }

    /// Its intensity in W/sr, or its irradiance in W/m², per band.
    fn strength(
        &self,
        kind: XmlNode<'a>,
        colour: [f64; 3],
        warnings: &mut Vec<Finding>,
    ) -> Result<Vec<f64>, FileError> {
        if let Some(element) = own(self.instance.light).and_then(|own| child(own, "intensity")) {
            return super::spectra::values(self.file, element);
        }
        let is_sun = kind.tag_name().name() == "directional";
        let factor = match (is_sun, self.blender().is_some()) {
            (true, _) => 1.0,
            (false, true) => 1.0 / (4.0 * PI),
            (false, false) => self.attenuation(kind, warnings)?,
        };
        Ok(colour.map(|band| band * factor).to_vec())
    }

    /// What the attenuation makes of a colour of 1 at a metre. From there on light falls by the square of the distance, as all light does.
    fn attenuation(&self, kind: XmlNode<'a>, warnings: &mut Vec<Finding>) -> Result<f64, FileError> {
        let names = ["constant_attenuation", "linear_attenuation", "quadratic_attenuation"];
        let is_written = names.iter().any(|name| child(kind, name).is_some());
        let of = |index: usize, otherwise| self.not_negative(kind, names[index], otherwise);
        let (constant, linear, square) = (of(0, 1.0)?, of(1, 0.0)?, of(2, 0.0)?);
        let is_square = constant == 0.0 && linear == 0.0 && square > 0.0;
        if is_written && !is_square {
            let what = "an attenuation is not by the square of the distance alone; it is taken so, with the intensity that it has at a metre";
            Finding::note(warnings, self.file.place(self.instance.light), what, "give a quadratic one alone");
        }
        let whole = constant + linear / self.unit + square / (self.unit * self.unit);
        Ok(if whole > 0.0 { 1.0 / whole } else { 1.0 })
    }

    /// The same of a number that is not negative.
    fn not_negative(&self, of: XmlNode<'a>, what: &'static str, otherwise: f64) -> Result<f64, FileError> {
        let value = self.number(of, what, otherwise)?;
        if value < 0.0 {
            let element = child(of, what).unwrap_or(of);
            return Err(self.file.fault(element, Fault::Negative { what: "number", value }));
        }
        Ok(value)
    }

    fn distribution(&self, kind: XmlNode<'a>) -> Result<Distribution, FileError> {
        if let Some(element) = own(self.instance.light).and_then(|own| child(own, "cone")) {
            return self.own_cone(element).map(Distribution::Cone);
        }
        if kind.tag_name().name() != "spot" {
            return Ok(Distribution::Even);
        }
        let angle = self.number(kind, "falloff_angle", 180.0)?;
        if !(0.0..=180.0).contains(&angle) {
            let element = child(kind, "falloff_angle").unwrap_or(kind);
            return Err(self.file.fault(element, Fault::Angle(angle)));
        }
        let outer = (angle / 2.0).to_radians().cos();
        Ok(Distribution::Cone(match self.blender() {
            Some(blender) => {
                let blend = self.number(blender, "spotblend", 0.0)?.clamp(0.0, 1.0);
                Cone { exponent: 0.0, inner: outer + blend * (1.0 - outer), outer, rim: Rim::Smooth }
            }
            None => {
                let exponent = self.not_negative(kind, "falloff_exponent", 0.0)?;
                Cone { exponent, inner: outer, outer, rim: Rim::Squared }
            }
        }))
    }

    fn own_cone(&self, element: XmlNode<'a>) -> Result<Cone, FileError> {
        let text = element.text().unwrap_or_default();
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let number = |word: &str| word.parse().ok().filter(|number: &f64| number.is_finite());
        let rim = |word: &str| {
            [("squared", Rim::Squared), ("smooth", Rim::Smooth)].into_iter().find(|r| r.0 == word)
        };
        let cone = match words[..] {
            [exponent, inner, outer, rim_word] => {
                number(exponent).zip(number(inner)).zip(number(outer)).zip(rim(rim_word))
            }
            _ => None,
        };
        let cone = cone.map(|(((exponent, inner), outer), (_, rim))| Cone { exponent, inner, outer, rim });
        let is_sound = |cone: &Cone| {
            cone.exponent >= 0.0 && -1.0 <= cone.outer && cone.outer <= cone.inner && cone.inner <= 1.0
        };
        cone.filter(is_sound).ok_or_else(|| {
            let found = text.chars().take(40).collect();
            self.file.fault(
                element,
                Fault::Word { found, wanted: "an exponent, two cosines and squared or smooth" },
            )
        })
    }

    /// The outline of an area light of Blender, which shines along −z: a rectangle, or a polygon of the area of its ellipse.
    fn area(&self) -> Result<Option<Vec<DVec3>>, FileError> {
        let Some(blender) = self.blender() else { return Ok(None) };
        if self.number(blender, "type", 0.0)? != AREA {
            return Ok(None);
        }
        let shape = self.number(blender, "area_shape", 0.0)?;
        let along = self.number(blender, "area_size", 1.0)?;
        // Square and disk have one size, rectangle and ellipse two.
        let has_two = shape == 1.0 || shape == 5.0;
        let across = if has_two { self.number(blender, "area_sizey", along)? } else { along };
        Ok(area_corners([along, across], shape >= 4.0))
    }

    /// The area of an outline in the world, in square metres.
    fn square_metres(&self, corners: &[DVec3]) -> f64 {
        let world = self.instance.visit.world;
        let corners: Vec<DVec3> = corners.iter().map(|corner| world.transform_vector3(*corner)).collect();
        let next = corners.iter().cycle().skip(1);
        let cross: DVec3 = corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
        cross.length() / 2.0 * self.unit * self.unit
    }

    /// What Blender says of it.
    fn blender(&self) -> Option<XmlNode<'a>> {
        let extras = children(self.instance.light, "extra");
        let mut techniques = extras.flat_map(|extra| children(extra, "technique"));
        techniques.find(|technique| technique.attribute("profile") == Some("blender"))
    }

    /// A number of its own, or `otherwise`.
    fn number(&self, of: XmlNode<'a>, name: &'static str, otherwise: f64) -> Result<f64, FileError> {
        match child(of, name) {
            Some(element) => self.file.array(element).map(|[number]| number),
            None => Ok(otherwise),
        }
    }

    fn leave_out(&self, warnings: &mut Vec<Finding>, what: &str, repair: &str) {
        let place = self.file.place(self.instance.light);
        Finding::note(warnings, place, &format!("{what} is left out"), repair);
    }
}
