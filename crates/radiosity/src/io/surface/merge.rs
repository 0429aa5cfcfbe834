//! Triangles back to the polygons that an exporter cut.
//!
//! Two triangles are joined when they share an edge, run along it in opposite directions, lie in one plane exactly and
//! on different sides of the edge. What is joined becomes a polygon, possibly with holes, only if its triangles overlap
//! nowhere; otherwise they stay triangles. All decisions are exact, so that no gap and no overlap can arise.
use super::polygon::{Corner, Facet, Polygon, bits};
use crate::predicates::{is_coplanar, turn};
use crate::union_find::UnionFind;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};
use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};

type Corners = [Corner; 3];

/// The triangles, those of a plane joined, in the order of each polygon's first triangle.
pub(super) fn merge(triangles: &[Corners]) -> Vec<Facet> {
    let roots = joined(triangles);
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, root) in roots.into_iter().enumerate() {
        groups.entry(root).or_default().push(index);
    }
    let facets = groups.into_values().flat_map(|group| match polygons(triangles, &group) {
        Some(facets) => facets,
        None => group.iter().map(|&index| single(index, triangles[index])).collect(),
    });
    let mut facets: Vec<Facet> = facets.collect();
    facets.sort_by_key(|facet| facet.number);
    facets
}

fn single(number: usize, triangle: Corners) -> Facet {
    Facet { number, loops: vec![triangle.to_vec()], parts: Vec::new(), members: vec![number] }
}

/// For each triangle the first one of those that it is joined with.
fn joined(triangles: &[Corners]) -> Vec<usize> {
    let mut edges: HashMap<[[u64; 5]; 2], Vec<usize>> = HashMap::new();
    for (index, triangle) in triangles.iter().enumerate() {
        for side in 0..3 {
            edges.entry([key(&triangle[side]), key(&triangle[(side + 1) % 3])]).or_default().push(index);
        }
    }
    let mut planes = UnionFind::new(triangles.len());
    for (index, triangle) in triangles.iter().enumerate() {
        for side in 0..3 {
            let [from, to] = [&triangle[side], &triangle[(side + 1) % 3]].map(key);
            let lone = |edge| edges.get(&edge).filter(|found| found.len() == 1).map(|found| found[0]);
            let (Some(_), Some(other)) = (lone([from, to]), lone([to, from])) else { continue };
            if is_continued(triangle, side, &triangles[other]) {
                planes.join(index, other);
            }
        }
    }
    (0..triangles.len()).map(|index| planes.first(index)).collect()
}

/// A corner as a key: its point and its place in the picture.
fn key(corner: &Corner) -> [u64; 5] {
    let [x, y, z] = bits(corner.point);
    [x, y, z, (corner.place.x + 0.0).to_bits(), (corner.place.y + 0.0).to_bits()]
}

/// Whether the other triangle, which shares this side, goes on in the same plane beyond it.
fn is_continued(triangle: &Corners, side: usize, other: &Corners) -> bool {
    let [a, b, c] = [0, 1, 2].map(|turn| triangle[(side + turn) % 3].point);
    let shared = [a, b].map(bits);
    let Some(apex) = other.iter().map(|corner| corner.point).find(|p| !shared.contains(&bits(*p))) else {
        return false;
    };
    if !is_coplanar([a, b, c], apex) {
        return false;
    }
    // Seen in a projection in which the first has area: both turn the same way.
    let [u, v] = axes([a, b, c]);
    let seen = |corners: [DVec3; 3]| turn(corners.map(|p| DVec2::new(p[u], p[v])));
    let this = seen([a, b, c]);
    this != Ordering::Equal && this == seen([b, a, apex])
}

/// The two axes that remain when the normal's longest is dropped.
fn axes([a, b, c]: [DVec3; 3]) -> [usize; 2] {
    let dropped = (b - a).cross(c - a).abs().max_position();
    [(dropped + 1) % 3, (dropped + 2) % 3]
}

/// The polygons that some joined triangles form; none when they overlap.
fn polygons(triangles: &[Corners], group: &[usize]) -> Option<Vec<Facet>> {
    if group.len() == 1 {
        return None;
    }
    let [u, v] = front(&triangles[group[0]]);
    let flat = |corner: &Corner| DVec2::new(corner.point[u], corner.point[v]);
    let rings = || group.iter().map(|&index| triangles[index].map(|corner| flat(&corner)));
    let whole = Region::from_rings(rings(), FillRule::NonZero).ok()?;
    // Where two overlap, the even-odd rule leaves a gap.
    if whole != Region::from_rings(rings(), FillRule::EvenOdd).ok()? {
        return None;
    }
    let corners = group.iter().flat_map(|&index| triangles[index]);
    let known: HashMap<[u64; 2], Corner> = corners.map(|corner| (flat_bits(flat(&corner)), corner)).collect();
    let lift = |ring: &[DVec2]| ring.iter().map(|p| known.get(&flat_bits(*p)).copied()).collect();
    let loops = whole.polygons().map(|polygon| {
        std::iter::once(polygon.outer()).chain(polygon.holes()).map(lift).collect::<Option<Vec<_>>>()
    });
    let parts: Vec<Corners> = group.iter().map(|&index| triangles[index]).collect();
    let facet = |loops: Option<Polygon>| {
        Some(Facet { number: group[0], loops: loops?, parts: parts.clone(), members: group.to_vec() })
    };
    loops.map(facet).collect()
}

/// The two kept axes, in the order in which the triangle is counter-clockwise.
fn front(triangle: &Corners) -> [usize; 2] {
    let corners = triangle.map(|corner| corner.point);
    let [u, v] = axes(corners);
    let seen = corners.map(|p| DVec2::new(p[u], p[v]));
    if turn(seen) == Ordering::Greater { [u, v] } else { [v, u] }
}

fn flat_bits(point: DVec2) -> [u64; 2] {
    [(point.x + 0.0).to_bits(), (point.y + 0.0).to_bits()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(corners: [[f64; 3]; 3]) -> Corners {
        corners.map(|point| Corner { point: point.into(), ..Corner::default() })
    }

    /// The outlines' and holes' numbers of vertices.
    fn shapes(triangles: Vec<Corners>) -> Vec<Vec<usize>> {
        merge(&triangles).iter().map(|facet| facet.loops.iter().map(Vec::len).collect()).collect()
    }

    #[test]
    fn two_halves_are_a_square_again() {
        let [a, b, c, d] = [[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]];
        let facets = merge(&[triangle([a, b, c]), triangle([a, c, d])]);
        let outline: Vec<[f64; 3]> =
            facets[0].loops[0].iter().map(|corner| corner.point.to_array()).collect();
        assert_eq!(outline, [a, b, c, d]);
    }

    #[test]
    fn a_bend_of_one_rounding_is_kept() {
        let [a, b, c, d] = [[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1. + f64::EPSILON]];
        assert_eq!(shapes(vec![triangle([a, b, c]), triangle([a, c, d])]), [[3], [3]]);
    }

    #[test]
    fn a_frame_of_eight_triangles_has_a_hole() {
        let outer = [[0., 0., 0.], [3., 0., 0.], [3., 3., 0.], [0., 3., 0.]];
        let inner = [[1., 1., 0.], [2., 1., 0.], [2., 2., 0.], [1., 2., 0.]];
        let pieces = (0..4).flat_map(|i| {
            let j = (i + 1) % 4;
            [triangle([outer[i], outer[j], inner[j]]), triangle([outer[i], inner[j], inner[i]])]
        });
        assert_eq!(shapes(pieces.collect()), [[4, 4]]);
    }

    #[test]
    fn a_fold_a_double_and_another_picture_stay_apart() {
        let [a, b, c, d] = [[0., 0., 0.], [2., 0., 0.], [0., 2., 0.], [0.5, 0.5, 0.]];
        // Folded back over the same side of the shared edge.
        assert_eq!(shapes(vec![triangle([a, b, c]), triangle([b, a, d])]), [[3], [3]]);
        assert_eq!(shapes(vec![triangle([a, b, c]), triangle([a, b, c])]), [[3], [3]]);
        let mut other = triangle([b, a, [1., -1., 0.]]);
        other[0].place = DVec2::ONE;
        assert_eq!(shapes(vec![triangle([a, b, c]), other]), [[3], [3]]);
    }

    #[test]
    fn a_cube_of_twelve_is_six_squares() {
        let v = |i: usize| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64];
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let halves = sides.iter().flat_map(|s| [[s[0], s[1], s[2]], [s[0], s[2], s[3]]]);
        assert_eq!(shapes(halves.map(|t| triangle(t.map(v))).collect()), vec![vec![4]; 6]);
    }
}
