//! Lamps and suns as COLLADA text: as the format has them, and exactly in an `<extra>` of this program's own.
use super::spectra::PROFILE;
use crate::escape::escape;
use crate::io::words::{decimal, list};
use crate::scene::lamp::{Cone, Distribution, Lamp, Rim};
use crate::scene::sky::Sun;
use crate::spectrum::Colours;
use glam::{DMat3, DVec3};

/// The lights of a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct WrittenLights<'s> {
    pub(super) lamps: &'s [Lamp],
    pub(super) suns: &'s [Sun],
    /// In nm; empty where bands are red, green and blue.
    pub(super) wavelengths: &'s [f64],
}

impl WrittenLights<'_> {
    /// What `<library_lights>` holds.
    pub(super) fn library(&self) -> String {
        let lamps = self.lamps.iter().map(|lamp| match &lamp.distribution {
            Distribution::Cone(cone) => ("spot", &lamp.intensity, Some(cone)),
            Distribution::Even | Distribution::Measured(_) => ("point", &lamp.intensity, None),
        });
        let suns = self.suns.iter().map(|sun| ("directional", &sun.irradiance, None));
        let all = lamps.chain(suns).enumerate();
        all.map(|(index, (kind, bands, cone))| self.light(index, kind, bands, cone)).collect()
    }

    /// Their nodes.
    pub(super) fn nodes(&self) -> String {
        let lamps = self.lamps.iter().map(|lamp| (&lamp.name, lamp.position, lamp.frame));
        let suns = self.suns.iter().map(|sun| (&sun.name, DVec3::ZERO, ahead(sun.direction.normalize())));
        lamps
            .chain(suns)
            .enumerate()
            .map(|(index, (name, place, frame))| node(index, name, place, frame))
            .collect()
    }

    fn light(&self, index: usize, kind: &str, bands: &[f64], cone: Option<&Cone>) -> String {
        let colour = Colours::of(bands.len(), self.wavelengths).row(bands).map(|part| part.max(0.0));
        let falloff = cone.map_or(String::new(), falloff);
        let exact = cone.map_or(String::new(), exact);
        format!(
            r#"    <light id="light-{index}">
      <technique_common><{kind}><color>{colour}</color>{falloff}</{kind}></technique_common>
      <extra>
        <technique profile="{PROFILE}">
          <intensity>{bands}</intensity>
{exact}        </technique>
      </extra>
    </light>
"#,
            colour = list(colour.iter().map(decimal)),
            bands = list(bands.iter().map(decimal)),
        )
    }
}

/// As far as COLLADA has cones: a whole angle and a power.
fn falloff(cone: &Cone) -> String {
    let angle = decimal(&(2.0 * cone.outer.acos().to_degrees()));
    format!(
        "<falloff_angle>{angle}</falloff_angle><falloff_exponent>{}</falloff_exponent>",
        decimal(&cone.exponent)
    )
}

fn exact(cone: &Cone) -> String {
    let numbers = list([cone.exponent, cone.inner, cone.outer].iter().map(decimal));
    let rim = match cone.rim {
        Rim::Squared => "squared",
        Rim::Smooth => "smooth",
    };
    format!("          <cone>{numbers} {rim}</cone>\n")
}

/// Some frame that points along a unit vector.
fn ahead(way: DVec3) -> DMat3 {
    let right = way.any_orthonormal_vector();
    DMat3::from_cols(right, (-way).cross(right), way)
}

/// A light shines along its node's −z.
fn node(index: usize, name: &str, place: DVec3, frame: DMat3) -> String {
    let axes = [frame.x_axis, frame.y_axis, -frame.z_axis, place];
    let row = |axis: usize| list(axes.map(|column| decimal(&column[axis])).iter());
    format!(
        r##"      <node id="light-node-{index}" name="{name}">
        <matrix>{}  {}  {}  0 0 0 1</matrix>
        <instance_light url="#light-{index}"/>
      </node>
"##,
        row(0),
        row(1),
        row(2),
        name = escape(name),
    )
}
