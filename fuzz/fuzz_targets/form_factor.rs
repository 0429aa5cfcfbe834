//! Triangles and quadrilaterals on a small lattice, seen from a lattice point: the laws of a form factor.
#![no_main]
use arbitrary::Arbitrary;
use formfactor::{DVec3, DifferentialArea, FormFactor, PlanarPolygon, by_hierarchy, form_factor, unoccluded};
use libfuzzer_sys::fuzz_target;

#[derive(Arbitrary, Debug)]
struct Input {
    position: [i8; 3],
    normal: [i8; 3],
    target: Face,
    occluders: Vec<Face>,
    is_scaled: bool,
}

/// Two edges from a corner: a triangle, or a parallelogram, which is planar whatever the edges are.
#[derive(Arbitrary, Debug, Clone, Copy)]
struct Face {
    corner: [i8; 3],
    edges: [[i8; 3]; 2],
    is_triangle: bool,
}

const MOST_OCCLUDERS: usize = 5;

fuzz_target!(|input: Input| {
    let scale = if input.is_scaled { 0.1 } else { 1.0 };
    let Ok(from) = DifferentialArea::new(point(input.position) * scale, point(input.normal)) else { return };
    let Some(target) = polygon(&input.target, scale) else { return };
    let faces = input.occluders.iter().take(MOST_OCCLUDERS);
    let mut occluders: Vec<PlanarPolygon> = faces.filter_map(|f| polygon(f, scale)).collect();
    let all = unoccluded(&from, &target);
    let found = form_factor(&from, &target, &occluders);
    assert!(
        found.value >= 0.0 && found.error_bound >= 0.0 && found.value <= 1.0 + found.error_bound,
        "{found:?}"
    );
    let reach = found.error_bound + all.error_bound;
    assert!(found.value <= all.value + reach, "occluders add light: {found:?} > {all:?}");
    assert_agree(found, by_hierarchy(&from, &target, &occluders), "by hierarchy");
    occluders.reverse();
    assert_agree(found, form_factor(&from, &target, &occluders), "in reverse order");
    occluders.extend(occluders.clone());
    assert_agree(found, form_factor(&from, &target, &occluders), "with every occluder twice");
});

fn assert_agree(a: FormFactor, b: FormFactor, how: &str) {
    assert!((a.value - b.value).abs() <= a.error_bound + b.error_bound, "{how}: {a:?} and {b:?}");
}

fn polygon(face: &Face, scale: f64) -> Option<PlanarPolygon> {
    let [u, v] = face.edges.map(point);
    let corner = point(face.corner);
    let points = if face.is_triangle {
        vec![corner, corner + u, corner + v]
    } else {
        vec![corner, corner + u, corner + u + v, corner + v]
    };
    let scaled: Vec<DVec3> = points.into_iter().map(|p| p * scale).collect();
    PlanarPolygon::new([scaled]).ok()
}

fn point(p: [i8; 3]) -> DVec3 {
    DVec3::from(p.map(|v| f64::from(v % 9)))
}
