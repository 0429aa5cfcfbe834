//! The visible part of a target as a region.
use crate::exact::shadows::{Shadows, shadows};
use crate::exact::{pyramid::Pyramid, view::View, visible::union};
use crate::shapes::{differential_area::DifferentialArea, loops::leaf, polygon::PlanarPolygon};
use crate::stats::Stats;
use glam::DVec3;
use polycsg::Region;

/// The part of a target that a differential area sees: a region of the target's plane.
#[derive(Clone, Debug)]
pub struct VisiblePart {
    region: Region,
    target: PlanarPolygon,
}

impl VisiblePart {
    /// The part in two of the three coordinates.
    ///
    /// The axis along which the target's normal is longest is dropped. The other two are in the order in which loops that run
    /// counter-clockwise seen from the front do so in the plane.
    #[must_use]
    pub fn region(&self) -> &Region {
        &self.region
    }

    /// The rings in space. Outer rings run counter-clockwise seen from the front, holes clockwise. Vertices of the target keep
    /// their bits.
    pub fn rings(&self) -> impl Iterator<Item = Vec<DVec3>> + '_ {
        self.region.rings().map(|ring| ring.iter().map(|p| self.target.raise(*p)).collect())
    }

    /// The area in space, in the coordinates' units squared.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.region.area() * self.target.steepness()
    }
}

/// The part of the target's front that the differential area sees, as a valid region with holes and islands.
///
/// Arguments and definitions are those of [`form_factor`](fn@crate::form_factor). New vertices are crossings rounded to doubles.
///
/// ```
/// use formfactor::{DVec3, DifferentialArea, PlanarPolygon, visible_part};
/// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
/// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
/// let board = PlanarPolygon::new([[[-0.25, -0.25, 1.0], [0.25, -0.25, 1.0], [0.25, 0.25, 1.0], [-0.25, 0.25, 1.0]]])?;
/// // The board's shadow is a square of side 1 in the lamp's middle.
/// let seen = visible_part(&floor, &lamp, &[board]);
/// assert_eq!(seen.area(), 3.0);
/// assert_eq!(seen.rings().count(), 2);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[must_use]
pub fn visible_part(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> VisiblePart {
    seen_past(from, to, |_| occluders)
}

/// The visible part past those of the occluders that `occluders` finds within reach of the target.
pub(crate) fn seen_past<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Pyramid) -> I,
) -> VisiblePart
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    VisiblePart { region: visible_region(from, to, occluders), target: to.clone() }
}

fn visible_region<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Pyramid) -> I,
) -> Region
where
    I: IntoIterator<Item = &'a PlanarPolygon>,
{
    let Some(view) = View::in_place(from, to) else {
        return Region::default();
    };
    match shadows(&view, occluders(&view.pyramid), &mut Stats::default()) {
        Shadows::Total => Region::default(),
        Shadows::Some(shadows, _) => (leaf(&view.flat) - union(&shadows)).evaluate(),
    }
}
