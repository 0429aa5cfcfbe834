//! Vertices torn apart where the light of the elements around them jumps.
//!
//! ```text
//!    \  bright /            \  bright /
//!   --o-------o--    ->    --o-------o--    one vertex for each side: it is looked from there
//!    /  dark   \            --o-----o--
//!                            /  dark \
//! ```
use crate::mesh::element::Mesh;
use crate::union_find::UnionFind;
use std::collections::BTreeMap;

/// Gives the elements around a vertex one vertex for each group that is connected, around that vertex, by elements that are alike. The first
/// group keeps the vertex; the others' come behind all vertices.
pub(super) fn tear(mesh: &Mesh, is_alike: impl Fn(usize, usize) -> bool) -> Mesh {
    let mut torn = mesh.clone();
    let mut fans = vec![Vec::new(); mesh.vertices.len()];
    for (element, corners) in mesh.elements.iter().map(|element| element.corners).enumerate() {
        (0..3).for_each(|corner| fans[corners[corner]].push((element, corner)));
    }
    for (vertex, fan) in fans.iter().enumerate() {
        let groups = groups(mesh, vertex, fan, &is_alike);
        let mut vertices = BTreeMap::new();
        for (&(element, corner), group) in fan.iter().zip(groups) {
            let next = if vertices.is_empty() { vertex } else { torn.vertices.len() };
            let own = *vertices.entry(group).or_insert(next);
            if own == torn.vertices.len() {
                torn.vertices.push(mesh.vertices[vertex]);
            }
            torn.elements[element].corners[corner] = own;
        }
    }
    torn
}

/// For each corner around a vertex the group that it is in.
fn groups(
    mesh: &Mesh,
    vertex: usize,
    fan: &[(usize, usize)],
    is_alike: impl Fn(usize, usize) -> bool,
) -> Vec<usize> {
    let mut groups = UnionFind::new(fan.len());
    let mut known = BTreeMap::new();
    for (at, (element, _)) in fan.iter().enumerate() {
        for other in mesh.elements[*element].corners.into_iter().filter(|corner| *corner != vertex) {
            let beside = *known.entry(other).or_insert(at);
            if is_alike(*element, fan[beside].0) {
                groups.join(beside, at);
            }
        }
    }
    groups.number().0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::element::Element;
    use glam::DVec3;

    /// A fan of six elements around vertex 0.
    fn fan() -> Mesh {
        let around = (0..6).map(|k| (f64::from(k) * std::f64::consts::FRAC_PI_3).sin_cos());
        let vertices = std::iter::once(DVec3::ZERO).chain(around.map(|(y, x)| DVec3::new(x, y, 0.0)));
        let element = |k: usize| Element { patch: 0, corners: [0, 1 + k, 1 + (k + 1) % 6] };
        Mesh { vertices: vertices.collect(), elements: (0..6).map(element).collect() }
    }

    #[test]
    fn what_is_alike_stays_as_it_is() {
        let torn = tear(&fan(), |_, _| true);
        assert_eq!((torn.vertices.len(), torn.elements), (7, fan().elements));
    }

    #[test]
    fn each_side_of_a_jump_has_its_own_vertices() {
        let torn = tear(&fan(), |one, other| (one < 3) == (other < 3));
        let corner = |element: usize, k: usize| torn.elements[element].corners[k];
        for element in 0..6 {
            assert_eq!(corner(element, 0), corner(element / 3 * 3, 0), "one vertex for a side");
            assert_eq!(torn.triangle(element), fan().triangle(element), "no place changes");
        }
        assert_ne!(corner(0, 0), corner(3, 0));
        assert_ne!(corner(2, 2), corner(3, 1), "where the jump leaves the fan");
        assert_eq!(corner(0, 2), corner(1, 1));
        assert_eq!(torn.vertices.len(), 10);
    }

    /// Around the end of a jump light changes little by little: only where the jump leaves the fan are there two vertices.
    #[test]
    fn where_a_jump_ends_the_vertex_stays_whole() {
        let torn = tear(&fan(), |one, other| one.abs_diff(other) < 2);
        assert!(torn.elements.iter().all(|element| element.corners[0] == 0));
        assert_ne!(torn.elements[0].corners[1], torn.elements[5].corners[2]);
        assert_eq!(torn.vertices.len(), 8);
    }
}
