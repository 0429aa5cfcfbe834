//! The shadow of an occluder on the target's plane: clipped so that coordinates stay bounded, projected from dA.
//!
//! The projection is a pure function of the vertex in double-doubles, rounded once: where the exact projection is a double,
//! it is that double, so that shadows that meet exactly do so in doubles too.
use super::halves::halved;
use super::horizon::{LEVEL, Loops, Vertex, clip, seen};
use super::projected_vertex::{ProjectedVertex, swept};
use super::{planarity::loosen, pyramid::Wall, view::View};
use crate::numeric::offset::Offset;
use crate::shapes::polygon::PlanarPolygon;
use exactfloat::DoubleDouble;
use glam::DVec2;
use std::cmp::Ordering;

/// An occluder's shadow in the target's two kept coordinates, to be read by the even-odd rule.
#[derive(Clone, Debug)]
pub(crate) struct Shadow {
    pub(crate) loops: Vec<Vec<DVec2>>,
    /// A bound on the form factor of the difference between this and the exact shadow.
    pub(crate) error: f64,
    /// Whether the occluder passes through the target's plane.
    pub(crate) is_clipped: bool,
}

/// The shadow of the part of `occluder` between dA and the target's plane. It is right inside the target, and has no loops when
/// no part of the occluder is there. `sides` says on which side of the target's plane the occluder's points lie.
///
/// ```text
/// ----------[==target==]----------  the target's plane
///   \                          /    Walls through dA, well outside of the target, cut the occluder off. Its shadow would
///     \    ---occluder------/----   else reach to infinity where it comes down beside dA.
///       \                  /
///         \      dA       /
/// ```
pub(crate) fn project(view: &View, occluder: &PlanarPolygon, sides: &[Ordering]) -> Shadow {
    let mut loops = before_target(view, occluder, sides);
    for wall in &view.pyramid.walls {
        loops = inside(view, loops, wall);
    }
    let projected = |v: &Vertex| project_vertex(view, occluder, v, sides);
    let vertices: Vec<Vec<ProjectedVertex>> =
        halved(loops).iter().map(|l| l.iter().map(projected).collect()).collect();
    Shadow {
        loops: vertices.iter().map(|l| l.iter().map(|v| v.flat).collect()).collect(),
        error: vertices.iter().map(|l| swept(l)).sum(),
        is_clipped: sides.contains(&Ordering::Less),
    }
}

/// The part of an occluder on dA's side of the target's plane: 0 < t <= 1 on every ray that meets it.
fn before_target(view: &View, occluder: &PlanarPolygon, sides: &[Ordering]) -> Loops {
    let mut loops = seen(view.from, occluder);
    loops.iter_mut().flatten().for_each(|v| v.depth = depth(view, v.offset));
    if sides.contains(&Ordering::Less) {
        // Nothing was clipped yet: every vertex is a given one.
        let place = |v: &Vertex| v.given.map_or(Ordering::Equal, |i| sides[i]);
        let height = |i: usize| view.to.plane().side(occluder.points()[i]).into();
        loops = clip(&loops, place, |v| v.given.map_or(LEVEL, height));
        loops.iter_mut().flatten().filter(|v| v.given.is_none()).for_each(|v| v.depth = view.height);
    }
    loosen(view, occluder, &mut loops);
    loops
}

/// The part of loops on the inner side of a wall. As the wall is well outside of the target, where it stands does not matter,
/// only that clip points lie on their edges.
fn inside(view: &View, loops: Loops, wall: &Wall) -> Loops {
    let rounded = |v: &Vertex| wall.side.of_offset(v.offset.round(), 0.0);
    if loops.iter().flatten().all(|v| rounded(v) == Ordering::Greater) {
        return loops;
    }
    let out = DoubleDouble::difference(wall.bound, view.eye[wall.axis]);
    let height = |v: &Vertex| {
        let height = v.offset.0[wall.axis] * view.height - out * v.depth;
        if wall.is_upper { -height } else { height }
    };
    let place = |v: &Vertex| rounded(v).then_with(|| height(v).hi.total_cmp(&0.0));
    clip(&loops, place, |v| (height(v), 0.0))
}

/// Where the ray from dA through a vertex meets the target's plane.
fn project_vertex(
    view: &View,
    occluder: &PlanarPolygon,
    vertex: &Vertex,
    sides: &[Ordering],
) -> ProjectedVertex {
    let on_plane = vertex.given.filter(|i| sides[*i] == Ordering::Equal);
    let flat = on_plane.map_or_else(|| flat(view, *vertex), |i| view.flat_of(occluder.points()[i]));
    // Clip lines lie well outside of the target, and so does whatever the bounds move.
    let [low, high] = view.pyramid.bounds;
    let kept = DVec2::new(flat.x.max(low.x).min(high.x), flat.y.max(low.y).min(high.y));
    ProjectedVertex::measured(view.from, view.to, view.eye, kept, vertex)
}

/// u = O_u + W_u H / depth(W), rounded once.
fn flat(view: &View, Vertex { offset, depth, .. }: Vertex) -> DVec2 {
    let scale = view.height / depth;
    let [u, v, _] = view.to.axes();
    let coordinate = |axis: usize| (DoubleDouble::from(view.eye[axis]) + offset.0[axis] * scale).round();
    DVec2::new(coordinate(u), coordinate(v))
}

/// The distance from dA toward the target's plane, in the same measure as the view's height.
fn depth(view: &View, offset: Offset) -> DoubleDouble {
    -view.to.plane().normal.dot(offset)
}
