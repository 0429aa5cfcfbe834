//! Laws of the mesh.
use super::Subdivision;
use crate::{Patch, Scene};
use formfactor::PlanarPolygon;
use glam::DVec3;

/// A scene of one patch with the given loops.
fn scene(loops: &[Vec<[f64; 3]>]) -> Scene {
    let loops: Vec<Vec<DVec3>> =
        loops.iter().map(|points| points.iter().map(|&p| p.into()).collect()).collect();
    let patch = Patch {
        name: "patch".to_owned(),
        polygon: PlanarPolygon::new(&loops).unwrap(),
        reflectance: vec![0.5],
        emission: vec![0.0],
        origin: Default::default(),
    };
    Scene { patches: vec![patch], bands: 1, ..Scene::default() }
}

/// A rectangle of 3 × 2 in general position.
fn rectangle() -> Vec<[f64; 3]> {
    let (x, y) = (DVec3::new(2.0, 1.0, 2.0) / 3.0, DVec3::new(1.0, 2.0, -2.0) / 3.0);
    let corner = |a: f64, b: f64| (DVec3::new(0.1, 0.2, 0.3) + 3.0 * a * x + 2.0 * b * y).to_array();
    vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]
}

fn l_with_hole() -> Vec<Vec<[f64; 3]>> {
    let outer = [[0., 0.], [4., 0.], [4., 1.5], [1.7, 1.5], [1.7, 3.1], [0., 3.1]];
    let hole = [[0.4, 0.3], [0.5, 1.2], [1.1, 0.9]];
    [&outer[..], &hole[..]].iter().map(|points| points.iter().map(|&[x, y]| [x, y, 2.0]).collect()).collect()
}

#[test]
fn a_rectangle_is_a_regular_grid_of_triangles() {
    let subdivision = Subdivision::new(&scene(&[rectangle()]), 2 * 6 * 4).unwrap();
    let mesh = &subdivision.mesh;
    assert_eq!(mesh.elements.len(), 48);
    assert_eq!(mesh.vertices.len(), 35);
    for element in 0..48 {
        assert!((mesh.area(element) - 0.125).abs() < 1e-14);
    }
}

#[test]
fn the_polygon_s_own_vertices_stay_bit_for_bit() {
    for loops in [vec![rectangle()], l_with_hole()] {
        let mesh = Subdivision::new(&scene(&loops), 200).unwrap().mesh;
        for vertex in loops.concat() {
            assert!(mesh.vertices.contains(&vertex.into()), "{vertex:?}");
        }
    }
}

#[test]
fn elements_cover_every_patch_once_and_face_its_front() {
    for loops in [vec![rectangle()], l_with_hole(), vec![l_with_hole()[0].clone()]] {
        for target in [1, 30, 1000] {
            let scene = scene(&loops);
            let mesh = Subdivision::new(&scene, target).unwrap().mesh;
            let polygon = &scene.patches[0].polygon;
            let signed: f64 = (0..mesh.elements.len())
                .map(|element| {
                    let [a, b, c] = mesh.triangle(element);
                    (b - a).cross(c - a).dot(polygon.normal()) / 2.0
                })
                .inspect(|&area| assert!(area > 0.0))
                .sum();
            assert!((signed / polygon.area() - 1.0).abs() < 1e-13);
        }
    }
}

#[test]
fn outlines_of_the_pieces_tile_the_patch() {
    for loops in [vec![rectangle()], l_with_hole()] {
        let Subdivision { mesh, nodes, flat } = Subdivision::new(&scene(&loops), 300).unwrap();
        let area = |node: usize| {
            let elements = &mesh.elements[nodes[node].elements.clone()];
            flat.outline(&mesh, elements).unwrap().area()
        };
        for (index, node) in nodes.iter().enumerate() {
            let triangles: f64 = node.elements.clone().map(|element| mesh.area(element)).sum();
            assert!((area(index) - triangles).abs() < 1e-13);
            if let Some([a, b]) = node.halves {
                assert_eq!(nodes[a].elements.start, node.elements.start);
                assert_eq!(nodes[a].elements.end, nodes[b].elements.start);
                assert_eq!(nodes[b].elements.end, node.elements.end);
                assert!(!nodes[a].elements.is_empty() && !nodes[b].elements.is_empty());
            }
        }
    }
}

#[test]
fn pieces_of_a_rectangle_are_rectangles() {
    let Subdivision { mesh, nodes, flat } = Subdivision::new(&scene(&[rectangle()]), 48).unwrap();
    for node in &nodes {
        let outline = flat.outline(&mesh, &mesh.elements[node.elements.clone()]).unwrap();
        assert_eq!(outline.loops().map(<[DVec3]>::len).collect::<Vec<_>>(), [4]);
    }
}

#[test]
fn patches_that_share_an_edge_share_its_points() {
    let first = vec![vec![[0.3, 0., 0.], [5.1, 0.7, 0.], [5.1, 3., 0.], [0.3, 3., 0.]]];
    let second = vec![vec![[5.1, 0.7, 0.], [0.3, 0., 0.], [0.3, 0., -3.], [5.1, 0.7, -3.]]];
    let mut both = scene(&first);
    both.patches.extend(scene(&second).patches);
    let mesh = Subdivision::new(&both, 200).unwrap().mesh;
    let on_edge = |patch: usize| {
        let elements = mesh.elements.iter().filter(|element| element.patch == patch);
        let points = elements.flat_map(|element| element.corners).map(|corner| mesh.vertices[corner]);
        let line = DVec3::new(4.8, 0.7, 0.0);
        let near = |p: &DVec3| (*p - DVec3::new(0.3, 0., 0.)).cross(line).length() < 1e-12;
        let mut points: Vec<_> = points.filter(near).map(|p| p.to_array()).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points.dedup();
        points
    };
    assert!(on_edge(0).len() > 5);
    assert_eq!(on_edge(0), on_edge(1));
}
