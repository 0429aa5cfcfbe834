//! Balls around polygons: bounds on what is seen of them that cost little.
use crate::extent::Extent;
use formfactor::{DifferentialArea, PlanarPolygon};
use glam::DVec3;
use std::f64::consts::PI;

/// A ball around a polygon.
#[derive(Debug)]
pub(super) struct Ball {
    middle: DVec3,
    radius: f64,
    /// The corners of the box around it.
    low: DVec3,
    high: DVec3,
    normal: DVec3,
    area: f64,
}

impl Ball {
    pub(super) fn around(polygon: &PlanarPolygon) -> Ball {
        let points = || polygon.loops().flatten().copied();
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let middle = low.midpoint(high);
        let radius = points().map(|point| point.distance(middle)).fold(0.0, f64::max);
        Ball { middle, radius, low, high, normal: polygon.normal(), area: polygon.area() }
    }

    pub(super) fn extent(&self) -> Extent {
        Extent { low: self.low, high: self.high }
    }

    pub(super) fn middle(&self) -> DVec3 {
        self.middle
    }

    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    pub(super) fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The form factor of a disk in the middle as large as the polygon, seen from afar, but no more than the bound.
    pub(super) fn disk(&self, point: &DifferentialArea) -> f64 {
        let way = self.middle - point.position();
        let cosines = way.dot(point.normal()).max(0.0) * (-way.dot(self.normal)).max(0.0);
        let square = way.length_squared();
        (self.area / (PI * square + self.area) * (cosines / square)).min(self.most_seen(point))
    }

    /// How near to a point it may come: it is in the ball and in the box.
    pub(super) fn least_distance(&self, point: &DifferentialArea) -> f64 {
        let at = point.position();
        let beside = (self.low - at).max(at - self.high).max(DVec3::ZERO).length();
        beside.max(self.middle.distance(at) - self.radius)
    }

    /// A bound on the form factor: A cos θ cos θ' / (π d²) for the largest cosines and the least distance, and at most r² / d².
    pub(super) fn most_seen(&self, point: &DifferentialArea) -> f64 {
        let way = self.middle - point.position();
        let distance = way.length();
        let near = (distance - self.radius).max(0.0);
        let least = |height: f64| (height / near).clamp(0.0, 1.0);
        let rises = way.dot(point.normal()) + self.radius;
        let stands = self.radius - way.dot(self.normal);
        if rises <= 0.0 || stands <= 0.0 {
            return 0.0;
        }
        if near == 0.0 {
            return 1.0;
        }
        let far = self.area * least(rises) * least(stands) / (PI * near * near);
        far.min((self.radius / distance).powi(2)).min(1.0)
    }
}
