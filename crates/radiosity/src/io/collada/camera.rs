//! Perspective cameras.
use super::file::{File, XmlNode, child, descend};
use super::walk::{CameraInstance, name_of};
use crate::io::error::{Fault, FileError};
use crate::scene::{camera::Camera, finding::Finding};
use glam::DVec3;
use std::f64::consts::PI;

/// The cameras of the scene that have a view in perspective; a warning tells of the others.
pub(super) fn cameras<'a>(
    file: &File<'a>,
    camera_instances: &[CameraInstance<'a>],
    warnings: &mut Vec<Finding>,
) -> Vec<Camera> {
    let mut all = Vec::new();
    for instance in camera_instances {
        let Some(perspective) = descend(instance.camera, &["optics", "technique_common", "perspective"])
        else {
            let what = "only perspective cameras are read; another kind is left out";
            Finding::note(warnings, file.place(instance.camera), what, "make it one, or give --camera");
            continue;
        };
        match camera(file, instance, perspective) {
            Ok(camera) => all.push(camera),
            // Nobody's light depends on a camera.
            Err(error) => {
                let what = "a camera without a view is left out";
                Finding::note(warnings, error.to_string(), what, "correct it, or give --camera");
            }
        }
    }
    all
}

/// A camera looks along its node's −z, with +y up.
fn camera<'a>(
    file: &File<'a>,
    instance: &CameraInstance<'a>,
    perspective: XmlNode<'a>,
) -> Result<Camera, FileError> {
    let (vertical_fov, aspect) = lens(file, perspective)?;
    let world = instance.visit.world;
    let turned = |axis| world.transform_vector3(axis).try_normalize();
    let axes = turned(DVec3::NEG_Z).zip(turned(DVec3::Y));
    let upright = axes.filter(|(direction, up)| direction.cross(*up).try_normalize().is_some());
    let (direction, up) = upright.ok_or_else(|| file.fault(instance.visit.node, Fault::Axis))?;
    let name = name_of(instance.visit.node, "camera").into();
    Ok(Camera { name, position: world.w_axis.truncate(), direction, up, vertical_fov, aspect })
}

/// The vertical field of view in radians, and width over height. Of `xfov`, `yfov` and `aspect_ratio` any two give the
/// third; one alone is completed by 4:3.
fn lens<'a>(file: &File<'a>, perspective: XmlNode<'a>) -> Result<(f64, f64), FileError> {
    let horizontal = half_tangent(file, perspective, "xfov")?;
    let vertical = half_tangent(file, perspective, "yfov")?;
    let ratio = ratio(file, perspective)?;
    let (tangent, aspect) = match (horizontal, vertical, ratio) {
        (_, Some(vertical), Some(ratio)) => (vertical, ratio),
        (Some(horizontal), Some(vertical), None) => (vertical, horizontal / vertical),
        (Some(horizontal), None, _) => (horizontal / ratio.unwrap_or(4.0 / 3.0), ratio.unwrap_or(4.0 / 3.0)),
        (None, Some(vertical), None) => (vertical, 4.0 / 3.0),
        (None, None, _) => return Err(file.fault(perspective, Fault::Child("yfov"))),
    };
    let fov = 2.0 * tangent.atan();
    // The tangents' quotients may leave the range.
    let is_open = fov > 0.0 && fov < PI && aspect.is_normal();
    if is_open { Ok((fov, aspect)) } else { Err(file.fault(perspective, Fault::Ratio(aspect))) }
}

/// The tangent of half the angle that a child states in degrees.
fn half_tangent<'a>(
    file: &File<'a>,
    lens: XmlNode<'a>,
    name: &'static str,
) -> Result<Option<f64>, FileError> {
    let Some(element) = child(lens, name) else { return Ok(None) };
    let [degrees] = file.array(element)?;
    let tangent = (degrees.to_radians() / 2.0).tan();
    // One too small to halve has no picture either.
    let is_open = degrees < 180.0 && tangent > 0.0;
    if is_open { Ok(Some(tangent)) } else { Err(file.fault(element, Fault::Angle(degrees))) }
}

fn ratio<'a>(file: &File<'a>, lens: XmlNode<'a>) -> Result<Option<f64>, FileError> {
    let Some(element) = child(lens, "aspect_ratio") else { return Ok(None) };
    let [ratio] = file.array(element)?;
    if ratio.is_normal() && ratio > 0.0 {
        Ok(Some(ratio))
    } else {
        Err(file.fault(element, Fault::Ratio(ratio)))
    }
}
