//! A polygon that is not planar, cut into triangles, which always are.
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Triangles between the given vertices that cover the polygon as seen along its (Newell) normal, in a fixed order.
///
/// Where outlines cross each other, the later edge is left out of the triangulation. Triangles without area are left
/// out.
pub(super) fn split(loops: &[Vec<DVec3>]) -> Vec<PlanarPolygon> {
    let normal = newell(&loops[0]);
    let axes = kept_axes(normal);
    let flat = |point: DVec3| DVec2::new(point[axes[0]], point[axes[1]]);
    let mut mesh = ConstrainedDelaunayTriangulation::<Vertex>::new();
    let edges: Vec<[DVec2; 2]> = loops.iter().flat_map(|ring| edges(ring, flat)).collect();
    for ring in loops {
        constrain(&mut mesh, ring, flat);
    }
    let triangles = mesh.inner_faces().filter_map(|face| {
        let corners = face.vertices().map(|vertex| vertex.data().point);
        let centre = corners.map(flat).iter().sum::<DVec2>() / 3.0;
        inside(centre, &edges).then_some(corners)
    });
    triangles.filter_map(|corners| PlanarPolygon::new([corners]).ok()).collect()
}

/// A vertex of the triangulation and the point in space that it stands for.
struct Vertex {
    flat: DVec2,
    point: DVec3,
}

impl HasPosition for Vertex {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.flat.x, self.flat.y)
    }
}

/// Coordinates that the triangulation does not take (beyond its range) leave the polygon without triangles.
fn constrain(
    mesh: &mut ConstrainedDelaunayTriangulation<Vertex>,
    ring: &[DVec3],
    flat: impl Fn(DVec3) -> DVec2,
) {
    let vertex = |point: &DVec3| Vertex { flat: flat(*point), point: *point };
    let inserted: Result<Vec<_>, _> = ring.iter().map(|point| mesh.insert(vertex(point))).collect();
    let Ok(corners) = inserted else { return };
    for (index, from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % corners.len()];
        if *from != to && mesh.can_add_constraint(*from, to) {
            mesh.add_constraint(*from, to);
        }
    }
}

fn edges(ring: &[DVec3], flat: impl Fn(DVec3) -> DVec2) -> impl Iterator<Item = [DVec2; 2]> {
    (0..ring.len()).map(move |index| [flat(ring[index]), flat(ring[(index + 1) % ring.len()])])
}

/// Whether a point away from the edges is inside an odd number of loops: crossings of the ray to the right.
fn inside(point: DVec2, edges: &[[DVec2; 2]]) -> bool {
    let crossed = edges.iter().filter(|[a, b]| {
        (a.y > point.y) != (b.y > point.y) && {
            let side = (*b - *a).perp_dot(point - *a);
            (side > 0.0) == (b.y > a.y)
        }
    });
    crossed.count() % 2 == 1
}

fn newell(ring: &[DVec3]) -> DVec3 {
    let spokes = ring[1..].windows(2);
    spokes.map(|pair| (pair[0] - ring[0]).cross(pair[1] - ring[0])).sum()
}

/// The two axes that remain when the normal's longest is dropped, ordered so that the front stays counter-clockwise.
fn kept_axes(normal: DVec3) -> [usize; 2] {
    let dropped = normal.abs().max_position();
    let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
    if normal[dropped] > 0.0 { [u, v] } else { [v, u] }
}
