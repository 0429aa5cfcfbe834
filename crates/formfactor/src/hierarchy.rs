//! A second way to form factors, as a check: Equation 3.6 through the boundary representation of what is hidden.
use crate::exact::lambert::{ContourSum, Direction};
use crate::exact::shadows::{Shadows, shadows};
use crate::exact::{deviation::unseen, view::View, visible::union};
use crate::form_factor::FormFactor;
use crate::numeric::rounding::ROUNDING;
use crate::shapes::{differential_area::DifferentialArea, loops::leaf, polygon::PlanarPolygon};
use crate::stats::Stats;
use glam::DVec2;
use polycsg::Region;

/// The form factor by a second way, to check [`form_factor`](fn@crate::form_factor): through the rings of the target's hidden
/// part and their nesting [Barreto 2008, (3.6)].
///
/// F = F(target) - sum of F(outer rings) + sum of F(holes), over the polygons of the target's intersection with the union
/// of the shadows; islands in holes are polygons again.
///
/// It is slower, and loses digits when almost all of the target is hidden; its bound says so.
#[must_use]
pub fn by_hierarchy(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> FormFactor {
    let Some(view) = View::new(from, to) else {
        return unseen(from, to);
    };
    let whole = of_region(&view, &leaf(&view.flat).evaluate());
    let (hidden, error) = match shadows(&view, occluders, &mut Stats::default()) {
        Shadows::Total => (whole, 0.0),
        Shadows::Some(shadows, error) => {
            let region = (leaf(&view.flat) & union(&shadows)).evaluate();
            (of_region(&view, &region), error)
        }
    };
    let open = view.flat_error + view.facing_error + error;
    FormFactor {
        value: (whole.value - hidden.value).clamp(0.0, 1.0),
        error_bound: (whole.error_bound + hidden.error_bound + open + ROUNDING).min(1.0),
    }
}

/// The outer rings' form factors less the holes'.
fn of_region(view: &View, region: &Region) -> FormFactor {
    let mut total = FormFactor::default();
    for polygon in region.polygons() {
        let outer = of_ring(view, polygon.outer().iter().copied());
        total.value += outer.value;
        total.error_bound += outer.error_bound + ROUNDING;
        for hole in polygon.holes() {
            let hole = of_ring(view, hole.iter().rev().copied());
            total.value -= hole.value;
            total.error_bound += hole.error_bound + ROUNDING;
        }
    }
    total
}

/// The form factor of what a counter-clockwise ring encloses.
fn of_ring(view: &View, ring: impl Iterator<Item = DVec2>) -> FormFactor {
    let directions: Vec<Direction> = ring.map(|p| view.direction(p)).collect();
    let mut sum = ContourSum::new(view.from.normal());
    sum.add_loop(&directions);
    sum.form_factor(0.0)
}
