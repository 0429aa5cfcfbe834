//! Two meshes of one scene, laid over each other.
use crate::record::Record;
use glam::{DVec2, DVec3};

/// Where an element of one solution covers one of the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// The element of the one and of the other.
    pub(super) elements: [usize; 2],
    /// The area that they share.
    pub(super) area: f64,
}

/// A triangle in its patch's plane, seen along the axis that the plane faces most.
#[derive(Clone, Copy, Debug)]
struct FlatTriangle {
    element: usize,
    /// Counter-clockwise.
    corners: [DVec2; 3],
    low: DVec2,
    high: DVec2,
    /// Along the patch's normal.
    height: f64,
}

/// In shares of a patch's reach, how far apart rounding may leave two meshes of it.
const NEAR: f64 = 1e-6;

/// Every element with itself.
pub(super) fn same(record: &Record) -> Vec<Piece> {
    let mesh = record.mesh();
    let piece = |element| Piece { elements: [element; 2], area: mesh.area(element) };
    (0..mesh.elements.len()).map(piece).collect()
}

/// Every element of `a` with every element of `b` that it overlaps; `patches` has each patch of `a` in `b`.
pub(super) fn overlaps(a: &Record, b: &Record, patches: &[usize]) -> Vec<Piece> {
    let (of_a, of_b) = (by_patch(a), by_patch(b));
    let mut pieces = Vec::new();
    for (patch, &other) in patches.iter().enumerate() {
        let Some(normal) = facing(a, &of_a[patch]) else { continue };
        let flat = |record: &Record, elements: &[usize]| -> Vec<FlatTriangle> {
            elements.iter().map(|&element| flattened(record, element, normal)).collect()
        };
        let mut under = flat(b, &of_b[other]);
        under.sort_by(|one, next| one.low.x.total_cmp(&next.low.x));
        let widest = under.iter().map(|t| t.high.x - t.low.x).fold(0.0, f64::max);
        let over = flat(a, &of_a[patch]);
        let low = over.iter().map(|t| t.low).reduce(DVec2::min).unwrap_or_default();
        let reach = over.iter().map(|t| (t.high - low).max_element()).fold(0.0, f64::max);
        // What a step in the picture along the axis is on the plane.
        let stretch = 1.0 / normal.abs().max_element();
        for over in over {
            let first = under.partition_point(|t| t.low.x < over.low.x - widest);
            let near = under[first..].iter().take_while(|t| t.low.x < over.high.x);
            let level = |t: &&FlatTriangle| (t.height - over.height).abs() <= NEAR * reach;
            for below in near.filter(|t| t.low.y < over.high.y && t.high.y > over.low.y).filter(level) {
                let area = stretch * shared(over.corners, below.corners);
                if area > 0.0 {
                    pieces.push(Piece { elements: [over.element, below.element], area });
                }
            }
        }
    }
    pieces
}

/// The elements of each patch.
fn by_patch(record: &Record) -> Vec<Vec<usize>> {
    let mut elements = vec![Vec::new(); record.patches.len()];
    record.elements.iter().enumerate().for_each(|(element, [patch, ..])| elements[*patch].push(element));
    elements
}

fn corners(record: &Record, element: usize) -> [DVec3; 3] {
    let [_, a, b, c] = record.elements[element];
    [a, b, c].map(|corner| record.vertices[corner])
}

/// The unit normal of a patch's elements together: one that is a mere line does not count.
fn facing(record: &Record, elements: &[usize]) -> Option<DVec3> {
    let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
    elements.iter().map(|&element| across(corners(record, element))).sum::<DVec3>().try_normalize()
}

/// An element without the coordinate in which the normal is longest.
fn flattened(record: &Record, element: usize, normal: DVec3) -> FlatTriangle {
    let longest = normal.abs().max_position();
    let [u, v] = [(longest + 1) % 3, (longest + 2) % 3];
    let places = corners(record, element);
    let mut corners = places.map(|p| DVec2::new(p[u], p[v]));
    if normal[longest] < 0.0 {
        corners.swap(1, 2);
    }
    let low = corners.iter().copied().fold(corners[0], DVec2::min);
    let high = corners.iter().copied().fold(corners[0], DVec2::max);
    FlatTriangle { element, corners, low, high, height: normal.dot(places[0]) }
}

/// The area that two counter-clockwise triangles share: one clipped by the other's sides (Sutherland and Hodgman 1974).
fn shared(one: [DVec2; 3], other: [DVec2; 3]) -> f64 {
    let mut rest = one.to_vec();
    for side in 0..3 {
        let (start, end) = (other[side], other[(side + 1) % 3]);
        let inside = |point: DVec2| (end - start).perp_dot(point - start);
        let mut kept = Vec::with_capacity(rest.len() + 1);
        for (index, &point) in rest.iter().enumerate() {
            let before = rest[(index + rest.len() - 1) % rest.len()];
            let (here, there) = (inside(point), inside(before));
            if (here > 0.0) != (there > 0.0) {
                kept.push(before + (point - before) * (there / (there - here)));
            }
            if here > 0.0 {
                kept.push(point);
            }
        }
        rest = kept;
    }
    let Some(&anchor) = rest.first() else { return 0.0 };
    rest.windows(2).map(|pair| (pair[0] - anchor).perp_dot(pair[1] - anchor)).sum::<f64>().max(0.0) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_share_what_plane_geometry_says() {
        let triangle = |corners: [[f64; 2]; 3]| corners.map(DVec2::from);
        let half = triangle([[0., 0.], [2., 0.], [0., 2.]]);
        assert_eq!(shared(half, half), 2.0);
        assert_eq!(shared(half, triangle([[2., 2.], [0., 2.], [2., 0.]])), 0.0);
        assert_eq!(shared(half, triangle([[1., 0.], [3., 0.], [1., 2.]])), 0.5);
        assert_eq!(shared(half, triangle([[0.5, 0.5], [0.75, 0.5], [0.5, 0.75]])), 0.03125);
        assert_eq!(shared(half, triangle([[5., 5.], [6., 5.], [5., 6.]])), 0.0);
    }
}
