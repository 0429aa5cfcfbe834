//! Pieces of a patch: a binary tree of its zones, and of rectangles of lattice cells within them.
use super::{divide::Points, lattice::Lattice, split::Split};
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
    /// Whether contact lines part it into zones: its light may jump, however small it is.
    pub(crate) parted: bool,
}

/// A triangle, its zone, and the cell that its centroid is in.
#[derive(Clone, Copy, Debug)]
struct Placed {
    corners: [usize; 3],
    zone: usize,
    cell: [usize; 2],
}

/// Sorts a patch's triangles into the order of its tree, and stores the tree in `nodes`: the root at index
/// `patch`, the rest at the end. `first` is the index that the first triangle will have as an element.
pub(super) fn grow(
    patch: usize,
    split: &Split,
    points: &Points,
    first: usize,
    nodes: &mut Vec<Node>,
) -> Vec<[usize; 3]> {
    let centroid = |corners: [usize; 3]| {
        corners.iter().map(|&corner| points.flat[split.points[corner]]).sum::<glam::DVec2>() / 3.0
    };
    let place = |(&corners, &zone)| Placed { corners, zone, cell: points.lattice.cell(centroid(corners)) };
    let mut placed: Vec<Placed> = split.triangles.iter().zip(&split.zones).map(place).collect();
    let node = |elements| Node { patch, elements, ..Node::default() };
    nodes[patch] = node(first..first + placed.len());
    // Every node is a range of triangles; its halves are the two parts of that range, sorted in place.
    let mut open = vec![patch];
    while let Some(parent) = open.pop() {
        let Range { start, end } = nodes[parent].elements;
        let part = part(&mut placed[start - first..end - first], &points.lattice);
        let Some((parted, middle)) = part else { continue };
        let halves = [nodes.len(), nodes.len() + 1];
        nodes[parent].parted = parted;
        nodes[parent].halves = Some(halves);
        nodes.extend([node(start..start + middle), node(start + middle..end)]);
        open.extend(halves);
    }
    placed.into_iter().map(|triangle| triangle.corners).collect()
}

/// Parts triangles between zones, or else across the longer side of the rectangle of their cells at its middle,
/// keeping their order; tells whether there are zones and how many triangles come first. Nothing when all are in
/// one zone and cell.
fn part(placed: &mut [Placed], lattice: &Lattice) -> Option<(bool, usize)> {
    let zones = range(placed, |triangle| triangle.zone);
    if zones.0 < zones.1 {
        return Some((true, cut(placed, zones, |triangle| triangle.zone)));
    }
    let ranges = [0, 1].map(|axis| range(placed, |triangle| triangle.cell[axis]));
    let side = |axis: usize| (ranges[axis].1 - ranges[axis].0) as f64 * lattice.step[axis];
    let axis = usize::from(side(1) > side(0));
    let cells = ranges[axis];
    (cells.0 < cells.1).then(|| (false, cut(placed, cells, |triangle| triangle.cell[axis])))
}

/// The least and the greatest key.
fn range(placed: &[Placed], key: impl Fn(&Placed) -> usize) -> (usize, usize) {
    let keys = || placed.iter().map(&key);
    (keys().min().unwrap_or(0), keys().max().unwrap_or(0))
}

/// Sorts the lower half of a range of keys before the upper; tells how many triangles are in the lower.
fn cut(placed: &mut [Placed], (low, high): (usize, usize), key: impl Fn(&Placed) -> usize) -> usize {
    let middle = (low + high).div_ceil(2);
    placed.sort_by_key(|triangle| key(triangle) >= middle);
    placed.partition_point(|triangle| key(triangle) < middle)
}
