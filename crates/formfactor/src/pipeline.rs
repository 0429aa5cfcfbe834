//! The one way to a form factor: the quick route in doubles, and the exact one where doubles leave it open.
use crate::buffers::Buffers;
use crate::exact::{self, pyramid::Pyramid};
use crate::form_factor::FormFactor;
use crate::quick::{self, QuickBuffers, target::Target};
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use crate::stats::Stats;

/// The form factor from a differential area to the front of a polygon, with occluders in between.
///
/// An occluder blocks a ray from dA to a point of the target exactly when it meets the ray strictly between them. An
/// occluder that is coplanar with the target, or whose plane contains dA, blocks nothing.
///
/// The value is exactly 0 for a dA on or behind the target's plane, and where a single convex occluder covers the target.
/// The order of `occluders` changes the value within the bounds at most; which way they face does not matter.
///
/// The time is linear in the number of occluders that are culled, plus that of one polygon Boolean for the rest. For many
/// targets or points among the same polygons, an [`Enclosure`](crate::Enclosure) finds the occluders faster.
///
/// See the [crate's page](crate) for an example.
#[must_use]
pub fn form_factor(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> FormFactor {
    if occluders.is_empty() {
        return unoccluded(from, to);
    }
    past(from, to, |_| occluders.iter().enumerate(), None, &mut Buffers::default())
}

/// The form factor from a differential area to the front of a polygon with nothing in between.
///
/// The time is linear in the number of vertices of a convex polygon. Any other takes one polygon Boolean.
///
/// ```
/// use formfactor::{DVec3, DifferentialArea, PlanarPolygon, unoccluded};
/// // A square of side 2 at distance 1, seen along its axis: 4 / (pi sqrt 2) atan(1 / sqrt 2).
/// let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
/// let square = PlanarPolygon::new([[[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, 1.0]]])?;
/// let f = unoccluded(&from, &square);
/// assert!((f.value - 0.554_126_423_979_571_9).abs() < 1e-15);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[must_use]
pub fn unoccluded(from: &DifferentialArea, to: &PlanarPolygon) -> FormFactor {
    quick::unoccluded(from, to).unwrap_or_else(|| past(from, to, |_| [], None, &mut Buffers::default()))
}

/// The form factor past those of the occluders that `occluders` finds, with their ids, within reach of the target: the only way to one.
/// What was done is counted in the buffers' stats, and the buffers know which occluders may hide some of the target. With `within`, doubles
/// do if they err by no more.
pub(crate) fn past<'a, I>(
    from: &DifferentialArea,
    to: &PlanarPolygon,
    occluders: impl Fn(&Reach) -> I,
    within: Option<f64>,
    Buffers { quick, scratch, stats }: &mut Buffers,
) -> FormFactor
where
    I: IntoIterator<Item = (usize, &'a PlanarPolygon)>,
{
    *stats = Stats::default();
    let near = |target: &Target| occluders(&Reach::Quick(target));
    let quickly = quick::form_factor(from, to, near, within, quick, stats);
    quickly.unwrap_or_else(|| {
        *stats = Stats::default();
        let QuickBuffers { blockers, .. } = quick;
        blockers.clear();
        let near = move |pyramid: &Pyramid| {
            let near = occluders(&Reach::Exact { pyramid, deviation: to.deviation() });
            near.into_iter().inspect(move |(id, _)| blockers.push(*id)).map(|(_, occluder)| occluder)
        };
        let found = exact::form_factor(from, to, near, scratch, stats);
        // Where little rises above the horizon, roundings may leave open more than all of it.
        match quick::most_seen(from, (to, to.points())) {
            Some(most) if most < found.error_bound => {
                FormFactor { value: found.value.min(most), error_bound: most }
            }
            _ => found,
        }
    })
}

/// Where an occluder must be to hide anything of a target, as each route knows it.
#[derive(Debug)]
pub(crate) enum Reach<'r> {
    Quick(&'r Target<'r>),
    Exact { pyramid: &'r Pyramid, deviation: f64 },
}

impl Reach<'_> {
    /// Whether nothing in a box can hide anything, for certain. Polygons in it may lie off their vertices by `deviation`.
    pub(crate) fn misses_box(&self, extent: &Extent, deviation: f64) -> bool {
        match self {
            Reach::Quick(target) => target.misses_box(extent, deviation),
            Reach::Exact { pyramid, deviation: of_target } => {
                pyramid.misses_box(extent, deviation + of_target)
            }
        }
    }
}
