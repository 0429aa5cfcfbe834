//! What a form factor between areas is from and to: polygons of an enclosure, or parts of them.
use crate::error::Error;
use crate::scene::{enclosure::Enclosure, surfaces::Surface};
use crate::shapes::polygon::PlanarPolygon;
use glam::DVec3;
use std::{borrow::Cow, cmp::Ordering};

/// A polygon of an enclosure by its id, or a part of it by the id and the part, a polygon in the same plane.
///
/// A part has its polygon's front, whichever way its loops run, and like the polygon it is not hidden by what lies in its plane. It
/// hides nothing on its own.
///
/// ```
/// use formfactor::{Enclosure, Limits, PlanarPolygon};
/// let square = |x: f64, z: f64| [[x, 0.0, z], [x, 1.0, z], [x + 1.0, 1.0, z], [x + 1.0, 0.0, z]];
/// let floor = PlanarPolygon::new([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]])?;
/// let room = Enclosure::new(vec![floor, PlanarPolygon::new([square(0.0, 1.0)])?]);
/// // From the half of the floor that is below the ceiling, and from the other one.
/// let halves = [PlanarPolygon::new([square(0.0, 0.0)])?, PlanarPolygon::new([square(1.0, 0.0)])?];
/// let from = |half| room.area_form_factor((0, half), 1, 1e-9, &Limits::default());
/// let [near, far] = [from(&halves[0])?.expect("no stop"), from(&halves[1])?.expect("no stop")];
/// let whole = room.area_form_factor(0, 1, 1e-9, &Limits::default())?.expect("no stop");
/// assert!(((near.value + far.value) / 2.0 - whole.value).abs() < 1e-9);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Part<'p> {
    id: usize,
    polygon: Option<&'p PlanarPolygon>,
}

impl From<usize> for Part<'_> {
    fn from(id: usize) -> Self {
        Self { id, polygon: None }
    }
}

impl<'p> From<(usize, &'p PlanarPolygon)> for Part<'p> {
    fn from((id, polygon): (usize, &'p PlanarPolygon)) -> Self {
        Self { id, polygon: Some(polygon) }
    }
}

/// A part as a surface.
#[derive(Debug)]
pub(super) struct End<'e> {
    pub(super) id: usize,
    pub(super) surface: Cow<'e, Surface>,
    points: &'e [DVec3],
    /// The polygon that it is a part of.
    whole: &'e PlanarPolygon,
    /// How far a vertex of the part may lie from where it stands.
    pub(super) deviation: f64,
}

impl<'e> End<'e> {
    /// A whole polygon.
    pub(super) fn whole(enclosure: &'e Enclosure, id: usize) -> Self {
        let whole = &enclosure.polygons()[id];
        let surface = Cow::Borrowed(&enclosure.surfaces().surfaces[id]);
        Self { id, surface, points: whole.points(), whole, deviation: 0.0 }
    }

    pub(super) fn of(enclosure: &'e Enclosure, part: Part<'e>) -> Result<Self, Error> {
        let end = Self::whole(enclosure, part.id);
        let Some(polygon) = part.polygon else { return Ok(end) };
        let deviation = off_plane(end.whole, polygon)?;
        let faced = faced(polygon, end.whole.normal())?;
        let surface = Cow::Owned(end.surface.part(&faced));
        Ok(Self { surface, points: polygon.points(), deviation, ..end })
    }

    /// Whether two ends see each other as far as their planes say.
    pub(super) fn faces(&self, other: &Self) -> bool {
        self.surface.plane != other.surface.plane && self.is_before(other) && other.is_before(self)
    }

    /// Whether some of it is before another one's plane: exactly.
    fn is_before(&self, other: &Self) -> bool {
        let (own, face) = (&self.surface, other.surface.face);
        let height = face[1].dot(own.middle - face[0]);
        if height.abs() > own.radius * (1.0 + 1e-9) {
            return height > 0.0;
        }
        let plane = other.whole.plane();
        self.points.iter().any(|p| plane.side_of(*p) == Ordering::Greater)
    }
}

/// How far the vertices of a part may lie from where they stand on its polygon's plane.
fn off_plane(whole: &PlanarPolygon, part: &PlanarPolygon) -> Result<f64, Error> {
    whole.deviation_of(part).map_err(|error| match error {
        // Loop 0 is the whole.
        Error::NotPlanar { loop_index, vertex, distance, allowed } => {
            Error::OffSurface { loop_index: loop_index.saturating_sub(1), vertex, distance, allowed }
        }
        other => other,
    })
}

/// A polygon with its front to the side of `normal`.
fn faced(polygon: &PlanarPolygon, normal: DVec3) -> Result<Cow<'_, PlanarPolygon>, Error> {
    if polygon.normal().dot(normal) > 0.0 {
        return Ok(Cow::Borrowed(polygon));
    }
    let reversed = polygon.loops().map(|points| points.iter().rev().copied().collect::<Vec<_>>());
    PlanarPolygon::new(reversed).map(Cow::Owned)
}
