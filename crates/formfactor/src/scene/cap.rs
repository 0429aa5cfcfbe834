//! Caps: polygons that one more convex face would close around a convex solid, as walls and a roof on the ground.
//!
//! ```text
//!      _______
//!     /|     /|      A line meets the solid's boundary twice, and the lid, which is flat, once at most: what passes
//!    /_|____/ |      through the solid is blocked by the cap, wherever it enters. So from outside a cap hides what the
//!    | :    | |      closed solid hides.
//!    | :....|_|
//!    |/  lid|/
//! ```
use super::tree::Tree;
use crate::shapes::{extent::Extent, polygon::PlanarPolygon};
use std::{cmp::Ordering, collections::BTreeMap};

/// The polygons of a cap, and the face that it lacks, its front outward.
#[derive(Clone, Debug)]
pub(crate) struct Cap {
    pub(crate) faces: Vec<usize>,
    pub(crate) lid: PlanarPolygon,
}

/// The face that convex faces lack, if one convex face closes them. `neighbours` has what is across each edge.
pub(super) fn lid(
    polygons: &[PlanarPolygon],
    faces: &[usize],
    neighbours: &[Vec<Option<usize>>],
) -> Option<PlanarPolygon> {
    let bits = |p: glam::DVec3| p.to_array().map(f64::to_bits);
    let edges = faces.iter().flat_map(|face| polygons[*face].edges().zip(&neighbours[*face]));
    let open = edges.filter(|(_, across)| across.is_none()).map(|(edge, _)| edge);
    // The lid's edges run the other way.
    let mut next = BTreeMap::new();
    for (to, from) in open {
        if next.insert(bits(from), to).is_some() {
            return None;
        }
    }
    let (start, mut ring) = (*next.keys().next()?, Vec::new());
    let mut at = start;
    while let Some(to) = next.remove(&at) {
        ring.push(to);
        at = bits(to);
    }
    let lid = PlanarPolygon::new([ring]).ok()?;
    let is_lid = at == start && next.is_empty() && lid.is_convex() && lid.deviation() == 0.0;
    let mut heights = faces.iter().flat_map(|face| polygons[*face].points()).map(|p| lid.plane().side_of(*p));
    let is_behind = heights.clone().all(|side| side != Ordering::Greater);
    (is_lid && is_behind && heights.any(|side| side == Ordering::Less)).then_some(lid)
}

/// Whether other polygons may see each other through a convex solid: one that is not on the outer side of some face, or
/// two on its faces that look inward and do not lie in one plane.
pub(crate) fn is_entered(
    polygons: &[PlanarPolygon],
    tree: &Tree,
    faces: &[usize],
    lid: Option<&PlanarPolygon>,
) -> bool {
    let points = faces.iter().flat_map(|face| polygons[*face].points());
    let around = points.fold(Extent::NOTHING, |all, p| all.with(Extent { low: *p, high: *p }));
    let sides: Vec<&PlanarPolygon> = faces.iter().map(|face| &polygons[*face]).chain(lid).collect();
    let others = tree.find(|extent| extent.misses(&around)).into_iter().filter(|id| !faces.contains(id));
    let mut inward: Option<&PlanarPolygon> = None;
    for other in others.map(|id| &polygons[id]) {
        match sides.iter().map(|side| stance(other, side)).max() {
            Some(Stance::Outside) => (),
            Some(Stance::Inward) if inward.is_none_or(|first| other.lies_in_plane_of(first)) => {
                inward = Some(other);
            }
            _ => return true,
        }
    }
    false
}

/// Where a polygon is as far as one face of a convex solid says, from the worst on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stance {
    /// Some of it is behind the face.
    Behind,
    /// In the face's plane, and looks into the solid.
    Inward,
    /// Before the face, or in its plane and looks away.
    Outside,
}

fn stance(other: &PlanarPolygon, side: &PlanarPolygon) -> Stance {
    let heights = other.points().iter().map(|p| side.plane().side_of(*p));
    match [heights.clone().min(), heights.max()] {
        [Some(Ordering::Less), _] => Stance::Behind,
        [_, Some(Ordering::Equal)] if other.normal().dot(side.normal()) < 0.0 => Stance::Inward,
        _ => Stance::Outside,
    }
}
