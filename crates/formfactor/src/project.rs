//! The shadow of an occluder on the target's plane: clipped so that coordinates stay bounded, projected from dA.
//!
//! The projection is a pure function of the vertex in twofold arithmetic, rounded once: where the exact projection is a
//! double, it is that double, so that shadows that meet exactly do so in doubles too.
use crate::horizon::{Loops, Vertex, clip, seen};
use crate::predicates::Height;
use crate::region::leaf;
use crate::twofold::{Offset, Twofold};
use crate::view::{Spot, View, swept};
use crate::visible::boundary_sum;
use crate::{PlanarPolygon, Scratch};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;
use std::ops::Add;

/// An occluder's shadow in the target's two kept coordinates, to be read by the even-odd rule.
#[derive(Clone, Debug)]
pub(crate) struct Shadow {
    pub(crate) loops: Vec<Vec<DVec2>>,
    /// A bound on the form factor of the difference between this and the exact shadow.
    pub(crate) error: f64,
}

/// The shadow of the part of `occluder` between dA and the target's plane, right inside the target; `None` when no part
/// of it is there.
pub(crate) fn shadow(view: &View, occluder: &PlanarPolygon) -> Option<Shadow> {
    let sides: Vec<Height> = occluder.points().iter().map(|p| view.to.plane().side(*p)).collect();
    if is_coplanar_but_for_rounding(view, occluder, &sides) {
        return Some(Shadow { loops: Vec::new(), error: overlap(view, occluder) });
    }
    let mut loops = before_target(view, occluder, &sides);
    for side in &view.pyramid.wide {
        loops = inside(loops, side.normal);
    }
    if loops.is_empty() {
        return None;
    }
    let spots: Vec<Vec<Spot>> =
        loops.iter().map(|l| l.iter().map(|v| project(view, occluder, v, &sides)).collect()).collect();
    let open = if occluder.is_ambiguous_from(view.from.position()) { 1.0 } else { 0.0 };
    Some(Shadow {
        loops: spots.iter().map(|l| l.iter().map(|s| s.flat).collect()).collect(),
        error: open + spots.iter().map(|l| swept(l)).sum::<f64>(),
    })
}

/// How far off the two polygons' vertices may be from where they stand, as a height over the target's plane.
fn doubt(view: &View, occluder: &PlanarPolygon) -> f64 {
    2.0 * (view.to.deviation() + occluder.deviation()) * view.to.plane().normal.round().length()
}

/// Whether rounded vertices leave open if the occluder is coplanar with the target; never so for polygons whose vertices
/// are exactly coplanar among themselves.
fn is_coplanar_but_for_rounding(view: &View, occluder: &PlanarPolygon, sides: &[Height]) -> bool {
    let doubt = doubt(view, occluder);
    doubt > 0.0 && sides.iter().all(|s| s.value.hi.abs() <= doubt)
}

/// A bound on the form factor of the part of the target that a polygon in its plane overlaps.
fn overlap(view: &View, polygon: &PlanarPolygon) -> f64 {
    let flat: Vec<Vec<DVec2>> =
        polygon.loops().map(|l| l.iter().map(|p| view.to.flat(*p)).collect()).collect();
    let common = leaf(&view.flat) & leaf(&flat);
    let factor = boundary_sum(view, &common, &mut Scratch::default()).form_factor(0.0);
    let edges = polygon.points().iter().map(|p| polygon.deviation() / (*p - view.from.position()).length());
    factor.value + factor.error_bound + 8.0 * edges.sum::<f64>()
}

/// The part of an occluder on dA's side of the target's plane: 0 < t <= 1 on every ray that meets it.
fn before_target(view: &View, occluder: &PlanarPolygon, sides: &[Height]) -> Loops {
    let mut loops = seen(view.from, occluder);
    if sides.iter().any(|s| s.sign == Ordering::Less) {
        // Every vertex is a given one here.
        loops = clip(&loops, |v| v.given.map_or(Twofold::ZERO, |i| sides[i].value));
    }
    let doubt = doubt(view, occluder);
    if doubt > 0.0 {
        let slack = 2.0 * doubt / sine_between(view, occluder) / view.to.plane().normal.round().length();
        let at_target = |v: &&mut Vertex| v.given.is_none_or(|i| sides[i].value.hi.abs() <= doubt);
        loops.iter_mut().flatten().filter(at_target).for_each(|v| v.slack += slack);
    }
    loops
}

/// The sine of the angle between the occluder's plane and the target's: the line where they meet is known within the
/// vertices' deviation divided by it.
fn sine_between(view: &View, occluder: &PlanarPolygon) -> f64 {
    view.to.normal().cross(occluder.normal()).length()
}

/// The part of loops on the inner side of a plane through dA. The plane may be rounded: see [`crate::cull::Pyramid`].
fn inside(loops: Loops, side: DVec3) -> Loops {
    let height = |v: &Vertex| Twofold::from(side.dot(v.offset.round()));
    if loops.iter().flatten().all(|v| height(v).hi >= 0.0) { loops } else { clip(&loops, height) }
}

/// Where the ray from dA through a vertex meets the target's plane.
fn project(view: &View, occluder: &PlanarPolygon, vertex: &Vertex, sides: &[Height]) -> Spot {
    let on_plane = vertex.given.filter(|i| sides[*i].sign == Ordering::Equal);
    let flat = on_plane.map_or_else(|| flat(view, vertex.offset), |i| view.to.flat(occluder.points()[i]));
    // Clip lines lie well outside of the target: so does whatever the bounds move.
    let [low, high] = view.pyramid.bounds;
    let kept = DVec2::new(flat.x.max(low.x).min(high.x), flat.y.max(low.y).min(high.y));
    Spot::measured(view.from, view.to, kept, vertex)
}

/// u = O_u + W_u H / depth(W), rounded once.
fn flat(view: &View, offset: Offset) -> DVec2 {
    let normal = view.to.plane().normal;
    let depth = (0..3).map(|i| -(normal.0[i] * offset.0[i])).fold(Twofold::ZERO, Add::add);
    let scale = view.height / depth;
    let [u, v, _] = view.to.axes();
    let coordinate =
        |axis: usize| (Twofold::from(view.from.position()[axis]) + offset.0[axis] * scale).round();
    DVec2::new(coordinate(u), coordinate(v))
}
