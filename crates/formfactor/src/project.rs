//! The shadow of an occluder on the target's plane: clipped so that coordinates stay bounded, projected from dA.
//!
//! The projection is a pure function of the vertex in twofold arithmetic, rounded once: where the exact projection is a
//! double, it is that double, so that shadows that meet exactly do so in doubles too.
use crate::horizon::{Loops, Vertex, clip, seen};
use crate::polygon::PlanarPolygon;
use crate::twofold::{Offset, Twofold};
use crate::view::{Spot, View, swept};
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
    let mut loops = before_target(view, occluder);
    for side in view.pyramid.wide {
        loops = inside(loops, side.normal);
    }
    if loops.is_empty() {
        return None;
    }
    let spots: Vec<Vec<Spot>> =
        loops.iter().map(|l| l.iter().map(|v| project(view, occluder, v)).collect()).collect();
    let open = if occluder.is_ambiguous_from(view.from.position()) { 1.0 } else { 0.0 };
    Some(Shadow {
        loops: spots.iter().map(|l| l.iter().map(|s| s.flat).collect()).collect(),
        error: open + spots.iter().map(|l| swept(l)).sum::<f64>(),
    })
}

/// The part of an occluder on dA's side of the target's plane: 0 < t <= 1 on every ray that meets it.
fn before_target(view: &View, occluder: &PlanarPolygon) -> Loops {
    let sides: Vec<_> = occluder.points().iter().map(|p| view.to.plane().side(*p)).collect();
    let loops = seen(view.from, occluder);
    if sides.iter().all(|s| s.sign != Ordering::Less) {
        return loops;
    }
    // Every vertex is a given one here.
    clip(&loops, |v| v.given.map_or(Twofold::ZERO, |i| sides[i].value))
}

/// The part of loops on the inner side of a plane through dA. The plane may be rounded: see [`crate::cull::Pyramid`].
fn inside(loops: Loops, side: DVec3) -> Loops {
    let height = |v: &Vertex| Twofold::from(side.dot(v.offset.round()));
    if loops.iter().flatten().all(|v| height(v).hi >= 0.0) { loops } else { clip(&loops, height) }
}

/// Where the ray from dA through a vertex meets the target's plane.
fn project(view: &View, occluder: &PlanarPolygon, vertex: &Vertex) -> Spot {
    let on_plane = vertex
        .given
        .map(|i| occluder.points()[i])
        .filter(|p| view.to.plane().side(*p).sign == Ordering::Equal);
    let flat = on_plane.map_or_else(|| flat(view, vertex.offset), |p| view.to.flat(p));
    // Clip lines lie well outside of the target: so does whatever the bounds move.
    let [low, high] = view.pyramid.bounds;
    let kept = DVec2::new(flat.x.max(low.x).min(high.x), flat.y.max(low.y).min(high.y));
    Spot::measured(view.from, view.to, kept, vertex.offset, occluder.deviation())
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
