//! Constrained Delaunay triangles of a patch.
use super::{divide::Points, refusal::MeshRefusal};
use spade::handles::{DirectedEdgeHandle, FixedFaceHandle, PossiblyOuterTag};
use spade::{CdtEdge, ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::BTreeSet;

type Edge<'t> = DirectedEdgeHandle<'t, Point2<f64>, (), CdtEdge<()>, ()>;
type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangles inside the boundary, each counter-clockwise, in the triangulation's order.
pub(super) fn triangulate(points: &Points) -> Result<Vec<[usize; 3]>, MeshRefusal> {
    let vertices = points.flat.iter().map(|p| Point2::new(normal(p.x), normal(p.y))).collect();
    let boundary: BTreeSet<_> = points.boundary.iter().flat_map(|piece| both_ways(piece.ends)).collect();
    let inner = points.contacts.iter().chain(&points.shadows).copied();
    let edges = points.boundary.iter().map(|piece| piece.ends).chain(inner).collect();
    let mut broken = false;
    let cdt = Cdt::try_bulk_load_cdt(vertices, edges, |edge| broken |= boundary.contains(&edge))
        .map_err(|error| MeshRefusal(format!("its vertices cannot be triangulated ({error})")))?;
    if broken || cdt.num_vertices() != points.flat.len() {
        return Err(MeshRefusal("it is thinner than its coordinates can tell".to_owned()));
    }
    let inside = inside(&cdt, &boundary);
    let corners =
        |face: spade::handles::FaceHandle<'_, _, _, _, _, _>| face.vertices().map(|v| v.fix().index());
    Ok(cdt.inner_faces().filter(|face| inside[face.fix().index()]).map(corners).collect())
}

/// A pair and its reverse.
fn both_ways([a, b]: [usize; 2]) -> [[usize; 2]; 2] {
    [[a, b], [b, a]]
}

/// Numbers below the triangulation's range read as zero: they are what rounding left of it.
fn normal(coordinate: f64) -> f64 {
    if coordinate.abs() < spade::MIN_ALLOWED_VALUE { 0.0 } else { coordinate }
}

/// Which faces an odd number of boundary edges separates from the outside.
fn inside(cdt: &Cdt, boundary: &BTreeSet<[usize; 2]>) -> Vec<bool> {
    let crossed = |edge: Edge<'_>| boundary.contains(&edge.vertices().map(|vertex| vertex.fix().index()));
    let outer = cdt.outer_face().fix();
    let mut inside = vec![None; cdt.num_all_faces()];
    inside[outer.index()] = Some(false);
    let mut reached: Vec<FixedFaceHandle<PossiblyOuterTag>> = vec![outer];
    let hull: Vec<_> = cdt.convex_hull().map(|edge| edge.rev()).collect();
    for edge in hull {
        visit(&mut inside, &mut reached, edge.face().fix(), crossed(edge));
    }
    while let Some(face) = reached.pop() {
        let Some(face) = cdt.face(face).as_inner() else { continue };
        let here = inside[face.fix().index()].unwrap_or(false);
        for edge in face.adjacent_edges() {
            visit(&mut inside, &mut reached, edge.rev().face().fix(), here != crossed(edge));
        }
    }
    inside.into_iter().map(|side| side.unwrap_or(false)).collect()
}

/// Notes the side of a face that was not reached before.
fn visit(
    inside: &mut [Option<bool>],
    reached: &mut Vec<FixedFaceHandle<PossiblyOuterTag>>,
    face: FixedFaceHandle<PossiblyOuterTag>,
    side: bool,
) {
    if inside[face.index()].is_none() {
        inside[face.index()] = Some(side);
        reached.push(face);
    }
}
