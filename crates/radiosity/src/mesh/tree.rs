//! Pieces of a patch: a binary tree of rectangles of lattice cells.
use super::divide::{Lattice, Points};
use std::ops::Range;

/// A piece of a patch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Node {
    /// The patch it is a part of.
    pub(crate) patch: usize,
    /// Its elements.
    pub(crate) elements: Range<usize>,
    /// The indices of its two halves; none for a single lattice cell.
    pub(crate) halves: Option<[usize; 2]>,
}

/// A triangle and the cell that its centroid is in.
type Placed = ([usize; 3], [usize; 2]);

/// Sorts a patch's triangles into the order of its tree, and stores the tree in `nodes`: the root at index
/// `patch`, the rest at the end. `first` is the index that the first triangle will have as an element.
pub(super) fn grow(
    patch: usize,
    triangles: Vec<[usize; 3]>,
    points: &Points,
    first: usize,
    nodes: &mut Vec<Node>,
) -> Vec<[usize; 3]> {
    let centroid =
        |corners: [usize; 3]| corners.iter().map(|&corner| points.flat[corner]).sum::<glam::DVec2>() / 3.0;
    let mut placed: Vec<Placed> =
        triangles.into_iter().map(|t| (t, points.lattice.cell(centroid(t)))).collect();
    nodes[patch] = Node { patch, elements: first..first + placed.len(), halves: None };
    let mut open = vec![patch];
    while let Some(node) = open.pop() {
        let elements = nodes[node].elements.clone();
        let Some(middle) = part(&mut placed[elements.start - first..elements.end - first], &points.lattice)
        else {
            continue;
        };
        let middle = elements.start + middle;
        let halves = [nodes.len(), nodes.len() + 1];
        nodes[node].halves = Some(halves);
        open.extend(halves);
        nodes.push(Node { patch, elements: elements.start..middle, halves: None });
        nodes.push(Node { patch, elements: middle..elements.end, halves: None });
    }
    placed.into_iter().map(|(corners, _)| corners).collect()
}

/// Parts triangles across the longer side of the rectangle of their cells, at its middle, keeping their order;
/// gives the size of the first half, or nothing when they are in one cell.
fn part(placed: &mut [Placed], lattice: &Lattice) -> Option<usize> {
    let range = |axis: usize| {
        let cells = placed.iter().map(|(_, cell)| cell[axis]);
        (cells.clone().min().unwrap_or(0), cells.max().unwrap_or(0))
    };
    let ranges = [range(0), range(1)];
    let side = |axis: usize| (ranges[axis].1 - ranges[axis].0) as f64 * lattice.step[axis];
    let axis = usize::from(side(1) > side(0));
    let (low, high) = ranges[axis];
    if low == high {
        return None;
    }
    let middle = (low + high).div_ceil(2);
    placed.sort_by_key(|(_, cell)| cell[axis] >= middle);
    Some(placed.partition_point(|(_, cell)| cell[axis] < middle))
}
