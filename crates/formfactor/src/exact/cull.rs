//! Which occluders can block: the target's pyramid, the side they face, total cover. Verdicts, and nothing is projected.
use super::view::View;
use super::{deviation, planarity};
use crate::numeric::predicates::turn;
use crate::shapes::polygon::PlanarPolygon;
use std::cmp::Ordering;

/// What an occluder does to a target.
#[derive(Clone, Debug)]
pub(crate) enum Verdict {
    /// It hides nothing, but for a form factor of at most `open`.
    HidesNothing { open: f64 },
    /// It may hide a part. `sides` says on which side of the target's plane its points lie; its deviation leaves at most
    /// the form factor `open` undecided.
    CanBlock { sides: Vec<Ordering>, open: f64 },
    /// It hides all of the target: decided exactly.
    HidesAll,
}

/// What `occluder` does to the target.
///
/// Coplanar with dA or with the target, behind the target's plane, or outside of one of a convex target's edges, it hides
/// nothing: decided exactly, touching included.
pub(crate) fn cull(view: &View, occluder: &PlanarPolygon) -> Verdict {
    let deviation = occluder.deviation() + view.to.deviation();
    if view.pyramid.misses(occluder, deviation) {
        return Verdict::HidesNothing { open: 0.0 };
    }
    if let Some((a, b)) = view.pyramid.touched_edge(view.to, occluder, deviation) {
        return Verdict::HidesNothing { open: planarity::of_touch(view, a, b, occluder) };
    }
    let facing = occluder.plane().side_of(view.from.position());
    let sides: Vec<Ordering> = occluder.points().iter().map(|p| view.to.plane().side_of(*p)).collect();
    let open = deviation::of_facing(view.from.position(), occluder) + planarity::of_contact(view, occluder);
    if facing == Ordering::Equal
        || sides.iter().all(|s| *s != Ordering::Greater)
        || planarity::is_coplanar(view.to, occluder)
    {
        return Verdict::HidesNothing { open };
    }
    let is_before = sides.iter().all(|s| *s != Ordering::Less);
    if is_before && deviation == 0.0 && occluder.is_convex() && covers(view, occluder, facing) {
        return Verdict::HidesAll;
    }
    Verdict::CanBlock { sides, open }
}

/// Whether every vertex of the target lies in the cone of dA over a convex occluder before the target's plane.
fn covers(view: &View, occluder: &PlanarPolygon, facing: Ordering) -> bool {
    let origin = view.from.position();
    // Seen from its front a loop is counter-clockwise, so that its cone's inside is to the right of a x b.
    occluder.edges().all(|(a, b)| view.to.points().iter().all(|p| turn(origin, a, b, *p) != facing))
}
