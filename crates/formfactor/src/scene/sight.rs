//! What a point sees of an enclosure: parts of polygons, their boundaries, and places.
use super::enclosure::Enclosure;
use super::line::LineOfSight;
use crate::numeric::predicates::place;
use crate::quick;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use crate::visible_part::{VisiblePart, seen_past};
use glam::DVec3;
use std::cmp::Ordering;

impl Enclosure {
    /// The part of `part`, a part of polygon `id` in the plane of that polygon, that `from` sees past all other polygons: see
    /// [`visible_part`](fn@crate::visible_part).
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn visible_part(&self, from: &DifferentialArea, id: usize, part: &PlanarPolygon) -> VisiblePart {
        let part = self.on_plane(id, part);
        let deviation = self.deviation() + part.deviation();
        seen_past(from, &part, |pyramid| {
            let outside = |extent: &Extent| pyramid.misses_box(extent, deviation);
            let others = self.others(from, id, self.tree().find(outside), outside);
            others.map(|(_, polygon)| polygon).collect::<Vec<_>>()
        })
    }

    /// The boundary of [`Self::visible_part`] as `from` sees it: arcs between two directions, vectors of any length, each with the visible part
    /// to its left as seen from the front. An edge may come in several parts, and with parts both ways where nothing is hidden.
    ///
    /// Takes no polygon Boolean where doubles decide what is seen. Elsewhere the vertices of the visible part are rounded, which turns
    /// directions to it by much where `from` is close to its plane.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    /// let board = PlanarPolygon::new([[[-2.0, -2.0, 1.0], [0.0, -2.0, 1.0], [0.0, 2.0, 1.0], [-2.0, 2.0, 1.0]]])?;
    /// let room = Enclosure::new(vec![lamp.clone(), board]);
    /// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    /// // Lambert's sum over the arcs is the form factor: half of the lamp's.
    /// let term = |[a, b]: &[DVec3; 2]| a.angle_between(*b) * b.cross(*a).normalize().dot(floor.normal());
    /// let sum: f64 = room.visible_boundary(&floor, 0, &lamp).iter().map(term).sum();
    /// assert!((sum / (2.0 * std::f64::consts::PI) - 0.239_456_470_460_773_54 / 2.0).abs() < 1e-12);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn visible_boundary(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
    ) -> Vec<[DVec3; 2]> {
        let whole = &self.polygons()[id];
        if self.is_edge_on(from, id) || whole.plane().side_of(from.position()) != Ordering::Greater {
            return Vec::new();
        }
        let quickly = self.pool.lend(|buffers| {
            let near = self.within_reach(from, id);
            let found = quick::boundary(from, &self.on_plane(id, part), near, &mut buffers.quick);
            found.map(|_| buffers.quick.recorded().to_vec())
        });
        quickly.unwrap_or_else(|| {
            let seen = self.visible_part(from, id, part);
            seen.rings().flat_map(|ring| arcs(from.position(), &ring)).collect()
        })
    }

    /// Whether `from` sees a place: it is above the horizon, and no polygon meets the way there strictly between its ends. Decided exactly.
    ///
    /// The polygon that [owns](DifferentialArea::owned_by) `from`, and those in its plane, stand in no way. Takes O(log n) where few
    /// boxes are on the way.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let board = PlanarPolygon::new([[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]]])?;
    /// let room = Enclosure::new(vec![board]);
    /// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    /// assert!(!room.sees(&floor, DVec3::new(1.5, 0.0, 2.0)));
    /// assert!(room.sees(&floor, DVec3::new(2.5, 0.0, 2.0)));
    /// assert!(!room.sees(&floor, DVec3::new(2.5, 0.0, -2.0)));
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    #[must_use]
    pub fn sees(&self, from: &DifferentialArea, there: DVec3) -> bool {
        if !is_above_horizon(from, there) {
            return false;
        }
        let line = LineOfSight::between(from.position(), there);
        !self.tree().has_any(|extent| line.misses_box(extent), |id| self.blocks(id, from, &line))
    }

    /// Whether a polygon stands in the way of a point.
    pub(super) fn blocks(&self, id: usize, from: &DifferentialArea, line: &LineOfSight) -> bool {
        line.is_blocked_by(&self.polygons()[id]) && !self.is_edge_on(from, id)
    }
}

/// Whether a place is above the horizon of a point.
pub(super) fn is_above_horizon(from: &DifferentialArea, there: DVec3) -> bool {
    place(from.given_normal(), from.position(), there) == Ordering::Greater
}

/// A closed ring, edge by edge, as seen from a point.
fn arcs(eye: DVec3, ring: &[DVec3]) -> Vec<[DVec3; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a - eye, *b - eye]).collect()
}
