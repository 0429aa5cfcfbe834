//! Formats that have no up axis: what is written in them is turned to the one that readers take for granted.
use glam::{DMat3, DVec3};

/// From an up axis to y up; right stays right where there is a right. No digit changes.
pub(super) fn y_up(up: DVec3) -> DMat3 {
    if up.z > 0.0 {
        DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y)
    } else if up.x > 0.0 {
        DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z)
    } else {
        DMat3::IDENTITY
    }
}

/// From an up axis to z up.
pub(super) fn z_up(up: DVec3) -> DMat3 {
    y_up(DVec3::Z).transpose() * y_up(up)
}
