//! Vertices that are not shared across contact lines, and the zones that the lines part a patch into.
use super::divide::Points;
use crate::union_find::UnionFind;
use std::collections::{BTreeMap, BTreeSet};

/// Triangles whose corners are vertices of the mesh.
#[derive(Debug)]
pub(super) struct Split {
    pub(super) triangles: Vec<[usize; 3]>,
    /// The point of each vertex.
    pub(super) points: Vec<usize>,
    /// The zone of each triangle: a number for all that are connected without crossing a contact line.
    pub(super) zones: Vec<usize>,
}

/// Gives the triangles around a point one vertex for each group that is connected, around that point, without
/// crossing a contact line.
pub(super) fn split(triangles: &[[usize; 3]], points: &Points) -> Split {
    let cuts: BTreeSet<[usize; 2]> = points.contacts.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
    let sides: BTreeMap<[usize; 2], usize> =
        (0..triangles.len() * 3).map(|corner| (side(triangles, corner), corner)).collect();
    let mut fans = UnionFind::new(triangles.len() * 3);
    let mut zones = UnionFind::new(triangles.len());
    for (&[start, end], &corner) in &sides {
        if let Some(&opposite) = sides.get(&[end, start]).filter(|_| !cuts.contains(&[start, end])) {
            fans.join(corner, after(opposite));
            fans.join(after(corner), opposite);
            zones.join(corner / 3, opposite / 3);
        }
    }
    let (vertices, firsts) = fans.number();
    Split {
        triangles: vertices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect(),
        points: firsts.iter().map(|&corner| side(triangles, corner)[0]).collect(),
        zones: zones.number().0,
    }
}

/// The directed side of a triangle that starts at a corner; corner `3 t + k` is corner `k` of triangle `t`.
fn side(triangles: &[[usize; 3]], corner: usize) -> [usize; 2] {
    [corner, after(corner)].map(|corner| triangles[corner / 3][corner % 3])
}

/// The next corner of the same triangle.
fn after(corner: usize) -> usize {
    corner - corner % 3 + (corner + 1) % 3
}
