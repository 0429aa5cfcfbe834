//! The edges of occluders that bound their shadows, as the points of a cell see them.
use super::clip::Bound;
use crate::scene::occluder::{Occluder, Ridge, silhouette};
use glam::DVec3;
use std::{borrow::Borrow, ops::Range};

/// The silhouettes of occluders from the points of a cell.
#[derive(Debug, Default)]
pub(super) struct Silhouettes {
    /// Those that all points see alike, and where the edges of each end.
    edges: Vec<[DVec3; 2]>,
    edge_ends: Vec<usize>,
    /// Others: the edges that all points see, and the ridges that are edges for some.
    turning: Vec<Turning>,
    fixed: Vec<[DVec3; 2]>,
    ridges: Vec<Ridge>,
    sides: Vec<[bool; 2]>,
    facing: Vec<bool>,
}

/// An occluder that points of a cell may see otherwise than others do.
#[derive(Debug)]
struct Turning {
    occluder: usize,
    edges: Range<usize>,
    ridges: Range<usize>,
}

impl Silhouettes {
    pub(super) fn clear(&mut self) {
        self.turning.clear();
        self.fixed.clear();
        self.ridges.clear();
        self.edges.clear();
        self.edge_ends.clear();
    }

    pub(super) fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.turning.is_empty()
    }

    /// The edges of an occluder as one point sees it: they count as the cell's once they are kept.
    pub(super) fn try_from(&mut self, from: DVec3, occluder: &Occluder) -> &[[DVec3; 2]] {
        self.edges.truncate(self.edge_ends.last().copied().unwrap_or(0));
        let start = self.edges.len();
        occluder.facing(from, &mut self.facing);
        silhouette(&occluder.ridges, &self.facing, |edge| self.edges.push(edge));
        &self.edges[start..]
    }

    /// Keeps the edges that were tried.
    pub(super) fn keep(&mut self) {
        self.edge_ends.push(self.edges.len());
    }

    /// Leaves out the edges that were tried and not kept.
    pub(super) fn forget(&mut self) {
        self.edges.truncate(self.edge_ends.last().copied().unwrap_or(0));
    }

    /// Finds the edges of an occluder that are seen before the target from some points of a cell.
    pub(super) fn turn(&mut self, index: usize, occluder: &Occluder, cell: &[DVec3], pieces: &[Vec<DVec3>]) {
        occluder.sides(cell, &mut self.sides);
        let (first_edge, first_ridge) = (self.fixed.len(), self.ridges.len());
        let (mut is_seen, mut is_beside) = (!occluder.is_plate, false);
        for ridge in &occluder.ridges {
            let outline = Outline::of(ridge, &self.sides, cell, pieces);
            is_seen |= !matches!(outline, Outline::Never);
            match outline {
                Outline::Never | Outline::Around => (),
                Outline::Beside => is_beside = true,
                Outline::Edge(edge) => self.fixed.push(edge),
                Outline::Turning => self.ridges.push(*ridge),
            }
        }
        if is_seen && !is_beside {
            let (edges, ridges) = (first_edge..self.fixed.len(), first_ridge..self.ridges.len());
            self.turning.push(Turning { occluder: index, edges, ridges });
        } else {
            self.fixed.truncate(first_edge);
            self.ridges.truncate(first_ridge);
        }
    }

    /// The half-spaces of the cones that a point of the cell sees, and where those of each end.
    pub(super) fn cones(
        &mut self,
        from: DVec3,
        occluders: &[impl Borrow<Occluder>],
        walls: &mut Vec<Bound>,
        ends: &mut Vec<usize>,
    ) {
        let Self { edges, edge_ends, turning, fixed, ridges, facing, .. } = self;
        walls.clear();
        walls.extend(edges.iter().map(|edge| Bound::through(*edge, from)));
        ends.clone_from(edge_ends);
        for Turning { occluder, edges, ridges: some } in &*turning {
            let (occluder, before): (&Occluder, _) = (occluders[*occluder].borrow(), walls.len());
            walls.extend(fixed[edges.clone()].iter().map(|edge| Bound::through(*edge, from)));
            if !some.is_empty() {
                occluder.facing(from, facing);
                silhouette(&ridges[some.clone()], facing, |edge| walls.push(Bound::through(edge, from)));
                if walls.len() == before && occluder.is_plate {
                    // Seen edge-on: its cone is empty.
                    walls.push(Bound::NOWHERE);
                }
            }
            ends.push(walls.len());
        }
    }

    /// Whether two shadows meet anywhere, on the target or beside it, as the middle of a cell sees them.
    ///
    /// Events cut cells where two begin to meet, so that what holds for the middle holds for all.
    pub(super) fn cross(&self, cell: &[DVec3]) -> bool {
        let from = cell.iter().sum::<DVec3>() / cell.len() as f64;
        let shadow = |i: usize| {
            let start = if i == 0 { 0 } else { self.edge_ends[i - 1] };
            &self.edges[start..self.edge_ends[i]]
        };
        let count = self.edge_ends.len();
        let mut pairs = (0..count).flat_map(|i| (0..i).map(move |j| [shadow(i), shadow(j)]));
        (count + self.turning.len() > 1 && !self.turning.is_empty())
            || pairs.any(|[one, other]| !is_beside(one, other, from) && !is_beside(other, one, from))
    }
}

/// How points of a cell see a ridge of an occluder before a target.
enum Outline {
    /// As no edge of the silhouette.
    Never,
    /// As an edge, if at all, with all of the target on its inner side.
    Around,
    /// All of them as an edge with the target on its outer side: nothing is hidden.
    Beside,
    /// All of them as this edge.
    Edge([DVec3; 2]),
    /// Not all alike.
    Turning,
}

impl Outline {
    /// By whether some points see the faces of the occluder, and some do not.
    fn of(ridge: &Ridge, sides: &[[bool; 2]], cell: &[DVec3], pieces: &[Vec<DVec3>]) -> Self {
        // A cap is no face: none is seen.
        let of = |side: usize| sides.get(side).copied().unwrap_or([false, true]);
        let [[left, not_left], [right, not_right]] = ridge.sides.map(of);
        let (ahead, back) = (left && not_right, right && not_left);
        let is_fixed = left != not_left && right != not_right;
        let [a, b] = ridge.ends;
        if !(ahead || back) {
            return Self::Never;
        }
        match side_of_all(ridge.ends, cell, pieces) {
            Some(inner) if inner != back && ahead != back => Self::Around,
            Some(_) if is_fixed => Self::Beside,
            _ if is_fixed => Self::Edge(if ahead { [a, b] } else { [b, a] }),
            _ => Self::Turning,
        }
    }
}

/// Whether all points of a cell see all of the pieces on one side of an edge, and whether that is the inner one.
///
/// The volume of the tetrahedron of the edge, a point and a corner is linear in both: the cell's corners tell.
fn side_of_all([a, b]: [DVec3; 2], cell: &[DVec3], pieces: &[Vec<DVec3>]) -> Option<bool> {
    let (mut low, mut high) = (0.0_f64, 0.0_f64);
    for from in cell {
        let wall = Bound::through([a, b], *from);
        for corner in pieces.iter().flatten() {
            let depth = wall.depth(*corner - *from);
            low = if depth < low { depth } else { low };
            high = if depth > high { depth } else { high };
        }
        if low < 0.0 && high > 0.0 {
            return None;
        }
    }
    Some(low >= 0.0)
}

/// Whether all of a silhouette is seen outside of one edge of another one.
fn is_beside(one: &[[DVec3; 2]], other: &[[DVec3; 2]], from: DVec3) -> bool {
    let leaves_out = |wall: Bound| other.iter().all(|[a, _]| wall.depth(*a - from) <= 0.0);
    one.iter().any(|edge| leaves_out(Bound::through(*edge, from)))
}
