//! A polygon cut into triangles: one that is not planar, since they always are, or one that shows a picture.
use super::polygon::{Corner, Polygon, points};
use crate::predicates::ray_crosses;
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Triangles between the given vertices that cover the polygon as seen along its (Newell) normal, in a fixed order.
///
/// Where outlines cross each other, the later edge is left out of the triangulation.
pub(crate) fn split(loops: &Polygon) -> Vec<[Corner; 3]> {
    let Some(outline) = loops.first().filter(|outline| outline.len() > 2) else { return Vec::new() };
    let axes = kept_axes(newell(&points(outline)));
    let flat = |corner: &Corner| DVec2::new(corner.point[axes[0]], corner.point[axes[1]]);
    let mut mesh = ConstrainedDelaunayTriangulation::<Vertex>::new();
    let edges: Vec<[DVec2; 2]> = loops.iter().flat_map(|ring| edges(ring, flat)).collect();
    for ring in loops {
        constrain(&mut mesh, ring, flat);
    }
    let triangles = mesh.inner_faces().filter_map(|face| {
        let corners = face.vertices().map(|vertex| vertex.data().corner);
        let centre = corners.iter().map(flat).sum::<DVec2>() / 3.0;
        let crossed = edges.iter().filter(|edge| ray_crosses(centre, **edge));
        (crossed.count() % 2 == 1).then_some(corners)
    });
    triangles.collect()
}

/// A vertex of the triangulation and the corner that it stands for.
struct Vertex {
    flat: DVec2,
    corner: Corner,
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
    ring: &[Corner],
    flat: impl Fn(&Corner) -> DVec2,
) {
    let vertex = |corner: &Corner| Vertex { flat: flat(corner), corner: *corner };
    let inserted: Result<Vec<_>, _> = ring.iter().map(|corner| mesh.insert(vertex(corner))).collect();
    let Ok(corners) = inserted else { return };
    for (index, from) in corners.iter().enumerate() {
        let to = corners[(index + 1) % corners.len()];
        if *from != to && mesh.can_add_constraint(*from, to) {
            mesh.add_constraint(*from, to);
        }
    }
}

fn edges(ring: &[Corner], flat: impl Fn(&Corner) -> DVec2) -> impl Iterator<Item = [DVec2; 2]> {
    (0..ring.len()).map(move |index| [flat(&ring[index]), flat(&ring[(index + 1) % ring.len()])])
}

/// Twice the area of a ring as a vector, which points to where the ring runs counter-clockwise.
pub(super) fn newell(ring: &[DVec3]) -> DVec3 {
    let spoke = |point: DVec3| point - ring[0];
    ring[1..].windows(2).map(|pair| spoke(pair[0]).cross(spoke(pair[1]))).sum()
}

/// The two axes that remain when the normal's longest is dropped, ordered so that the front stays counter-clockwise.
fn kept_axes(normal: DVec3) -> [usize; 2] {
    let dropped = normal.abs().max_position();
    let (u, v) = ((dropped + 1) % 3, (dropped + 2) % 3);
    if normal[dropped] > 0.0 { [u, v] } else { [v, u] }
}
