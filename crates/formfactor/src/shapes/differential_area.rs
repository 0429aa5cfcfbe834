//! The differential area dA: a point with a normal.
use crate::error::Error;
use crate::numeric::offset::accurate_dot;
use crate::numeric::rounding::{SMALLEST, in_range};
use glam::DVec3;

/// An infinitesimal one-sided area dA, from which polygons are seen: a point with a normal.
///
/// It sees the half-space in front of its horizon, the plane through `position` perpendicular to `normal`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DifferentialArea {
    position: DVec3,
    given_normal: DVec3,
    normal: DVec3,
    owner: Option<usize>,
}

impl DifferentialArea {
    /// A differential area at `position` that faces along `normal`, a vector of any length.
    ///
    /// The horizon is decided with `normal` exactly as given. Only the value of a form factor uses the unit vector.
    ///
    /// # Errors
    /// [`Error::BadPoint`] and [`Error::BadNormal`] for NaN, infinity, a zero vector, or magnitudes out of range.
    pub fn new(position: DVec3, normal: DVec3) -> Result<Self, Error> {
        if !in_range(position) {
            return Err(Error::BadPoint);
        }
        let largest = normal.abs().max_element();
        if !in_range(normal) || largest < SMALLEST {
            return Err(Error::BadNormal);
        }
        let length = accurate_dot(normal, normal).sqrt();
        Ok(Self { position, given_normal: normal, normal: normal / length, owner: None })
    }

    /// The same area, on polygon `polygon` of the enclosure that it is used with.
    ///
    /// The owner never blocks, and the form factor to it is 0. Name the owner whenever dA lies on a polygon: its position may
    /// be a last bit off the plane. Functions without an enclosure ignore the owner.
    #[must_use]
    pub fn owned_by(mut self, polygon: usize) -> Self {
        self.owner = Some(polygon);
        self
    }

    /// Where it lies.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Its unit normal.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The id of the polygon on which it lies, if one was named.
    #[must_use]
    pub fn owner(&self) -> Option<usize> {
        self.owner
    }

    /// The normal exactly as given: what decides the horizon.
    pub(crate) fn given_normal(&self) -> DVec3 {
        self.given_normal
    }
}
