//! A node's own transform: the product of its transformation elements, in their order.
use super::file::{File, XmlNode};
use crate::io::error::{Fault, FileError};
use glam::{DMat3, DMat4, DVec3};

/// From the node's coordinates to those of its parent.
pub(super) fn local<'a>(file: &File<'a>, node: XmlNode<'a>) -> Result<DMat4, FileError> {
    let mut product = DMat4::IDENTITY;
    for element in node.children().filter(XmlNode::is_element) {
        if let Some(factor) = factor(file, element)? {
            product *= factor;
        }
    }
    Ok(product)
}

fn factor<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<Option<DMat4>, FileError> {
    Ok(Some(match element.tag_name().name() {
        "matrix" => matrix(file, element)?,
        "translate" => DMat4::from_translation(file.array(element)?.into()),
        "scale" => DMat4::from_scale(file.array(element)?.into()),
        "rotate" => rotate(file, element)?,
        "lookat" => look_at(file, element)?,
        "skew" => return Err(file.fault(element, Fault::Unsupported)),
        _ => return Ok(None),
    }))
}

/// Sixteen numbers, row by row.
fn matrix<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<DMat4, FileError> {
    let rows = file.array::<16>(element)?;
    if rows[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(file.fault(element, Fault::Projective));
    }
    Ok(DMat4::from_cols_array(&rows).transpose())
}

/// An axis and an angle in degrees.
fn rotate<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<DMat4, FileError> {
    let [x, y, z, degrees] = file.array(element)?;
    let axis = direction(file, element, DVec3::new(x, y, z))?;
    let (sine, cosine) = sine_cosine(degrees);
    // Rodrigues: cosine·1 + sine·[axis]× + (1 − cosine)·axis axisᵀ, column by column.
    let column =
        |unit: DVec3| cosine * unit + sine * axis.cross(unit) + (1.0 - cosine) * axis.dot(unit) * axis;
    Ok(DMat4::from_mat3(DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))))
}

/// Sine and cosine of an angle in degrees, exact for multiples of a quarter turn: boxes stay boxes.
fn sine_cosine(degrees: f64) -> (f64, f64) {
    let turned = degrees % 360.0;
    match turned.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turned.to_radians().sin_cos(),
    }
}

/// Eye, point of interest and up: the node stands at the eye and looks along its −z.
fn look_at<'a>(file: &File<'a>, element: XmlNode<'a>) -> Result<DMat4, FileError> {
    let [ex, ey, ez, ix, iy, iz, ux, uy, uz] = file.array(element)?;
    let eye = DVec3::new(ex, ey, ez);
    let back = direction(file, element, eye - DVec3::new(ix, iy, iz))?;
    let up = direction(file, element, DVec3::new(ux, uy, uz))?;
    let right = direction(file, element, up.cross(back))?;
    let turn = DMat3::from_cols(right, back.cross(right), back);
    Ok(DMat4::from_translation(eye) * DMat4::from_mat3(turn))
}

fn direction<'a>(file: &File<'a>, element: XmlNode<'a>, vector: DVec3) -> Result<DVec3, FileError> {
    vector.try_normalize().ok_or_else(|| file.fault(element, Fault::Axis))
}
