//! The constrained Delaunay triangulation of a region, by spade.

use super::indexed::IndexedRegion;
use crate::base::id::index;
use glam::DVec2;
use spade::handles::{DirectedEdgeHandle, FaceHandle, InnerTag};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, Point2, Triangulation, validate_coordinate};

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;
type Face<'t> = FaceHandle<'t, InnerTag, Point2<f64>, (), CdtEdge<()>, ()>;
type Edge<'t> = DirectedEdgeHandle<'t, Point2<f64>, (), CdtEdge<()>, ()>;

/// The triangles, or none where no scale brings the coordinates into the range in which spade is exact.
pub(super) fn triangles(outline: &IndexedRegion) -> Option<Vec<[u32; 3]>> {
    let vertices = in_range(&outline.points)?;
    let edges = outline.edges.iter().map(|edge| edge.map(|id| id as usize)).collect();
    let mut refused = false;
    let cdt = Cdt::try_bulk_load_cdt(vertices, edges, |_| refused = true).ok()?;
    if refused || cdt.num_vertices() != outline.points.len() {
        return None;
    }
    let inside = inside(&cdt, &outline.edges);
    let corners = |face: Face<'_>| face.vertices().map(|vertex| index(vertex.fix().index()));
    Some(cdt.inner_faces().filter(|face| inside[face.fix().index()]).map(corners).collect())
}

/// The points scaled by powers of two into spade's range: by none, by one for both axes, by one for each.
fn in_range(points: &[DVec2]) -> Option<Vec<Point2<f64>>> {
    let size = points.iter().fold(DVec2::ZERO, |size, p| size.max(p.abs()));
    let scales = [DVec2::ONE, DVec2::splat(scale(size.max_element())), size.map(scale)];
    scales.into_iter().find_map(|scale| points.iter().map(|&p| scaled(p, scale)).collect())
}

/// A point times powers of two, if spade takes it. The range ends far above the subnormal numbers: what it holds is
/// exact, but for a zero that was none.
fn scaled(point: DVec2, scale: DVec2) -> Option<Point2<f64>> {
    let scaled = point * scale;
    let is_kept =
        |axis| validate_coordinate(scaled[axis]).is_ok() && (scaled[axis] == 0.0) == (point[axis] == 0.0);
    (is_kept(0) && is_kept(1)).then(|| Point2::new(scaled.x, scaled.y))
}

/// The power of two that brings a size just below the range's end, 2^201, as far as powers of two reach.
fn scale(size: f64) -> f64 {
    let exponent = ((size.to_bits() >> 52) & 0x7ff).max(1);
    // Biased: 2^200 over 2^(exponent - 1023).
    f64::from_bits((1023 + 200 + 1023 - exponent).min(2046) << 52)
}

/// Which faces lie in the region: those left of its edges, and what is reached from there without crossing an edge.
fn inside(cdt: &Cdt, edges: &[[u32; 2]]) -> Vec<bool> {
    let ids = |edge: Edge<'_>| edge.vertices().map(|vertex| index(vertex.fix().index()));
    let mut inside = vec![false; cdt.num_all_faces()];
    let bounding = cdt
        .directed_edges()
        .filter(|edge| edge.is_constraint_edge() && edges.binary_search(&ids(*edge)).is_ok());
    let mut reached: Vec<Face<'_>> = bounding.filter_map(|edge| edge.face().as_inner()).collect();
    while let Some(face) = reached.pop() {
        if std::mem::replace(&mut inside[face.fix().index()], true) {
            continue;
        }
        let open = face.adjacent_edges().into_iter().filter(|edge| !edge.is_constraint_edge());
        reached.extend(open.filter_map(|edge| edge.rev().face().as_inner()));
    }
    inside
}
