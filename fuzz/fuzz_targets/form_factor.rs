//! Triangles and quadrilaterals on a small lattice, seen from a lattice point: the laws of a form factor, and its value by
//! the angular sweep.
#![no_main]
use arbitrary::Arbitrary;
use formfactor::{
    DVec3, DifferentialArea, Enclosure, FormFactor, PlanarPolygon, by_hierarchy, form_factor, unoccluded,
};
use libfuzzer_sys::fuzz_target;
use tests::sweep::{self, Loops};

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
    let room = Enclosure::new([std::slice::from_ref(&target), &occluders].concat());
    for tolerance in [1e-11, 1e-8] {
        assert_agree(found, room.form_factor_within(&from, 0, &target, tolerance), "within a tolerance");
    }
    occluders.reverse();
    assert_agree(found, form_factor(&from, &target, &occluders), "in reverse order");
    occluders.extend(occluders.clone());
    assert_agree(found, form_factor(&from, &target, &occluders), "with every occluder twice");
    occluders.truncate(occluders.len() / 2);
    // Numbers that are no doubles make a polygon planar by rounding alone: its halves lie in planes of their own.
    if !input.is_scaled {
        assert_sum(found, &from, &input.target, &occluders);
        let cut: Vec<PlanarPolygon> = input.occluders.iter().take(MOST_OCCLUDERS).flat_map(halves).collect();
        assert_agree(found, form_factor(&from, &target, &cut), "behind occluders in halves");
        assert_swept(found, &from, &target, &occluders);
    }
});

/// A target is the sum of its halves.
fn assert_sum(found: FormFactor, from: &DifferentialArea, target: &Face, occluders: &[PlanarPolygon]) {
    let parts: Vec<FormFactor> =
        halves(target).iter().map(|half| form_factor(from, half, occluders)).collect();
    let value = parts.iter().map(|part| part.value).sum();
    let error_bound = parts.iter().map(|part| part.error_bound).sum::<f64>() + f64::EPSILON * value;
    assert_agree(found, FormFactor { value, error_bound }, "in halves");
}

/// The sweep knows nothing of polygons on a plane; where it says itself that it did not converge, it says nothing.
fn assert_swept(
    found: FormFactor,
    from: &DifferentialArea,
    target: &PlanarPolygon,
    occluders: &[PlanarPolygon],
) {
    let loops = |polygon: &PlanarPolygon| polygon.loops().map(<[DVec3]>::to_vec).collect::<Loops>();
    let others: Vec<Loops> = occluders.iter().map(loops).collect();
    let swept = sweep::form_factor(from.position(), from.normal(), &loops(target), &others);
    let off = (found.value - swept.value).abs();
    assert!(off <= found.error_bound + swept.error + SWEEP_REACH, "{found:?}, but by the sweep {swept:?}");
}

/// How far the sweep may be off beyond what its last two steps say.
const SWEEP_REACH: f64 = 1e-10;

/// A parallelogram as the two triangles on either side of a diagonal; a triangle as it is.
fn halves(face: &Face) -> Vec<PlanarPolygon> {
    let corners = corners(face);
    let triangles = (1..corners.len() - 1).map(|i| [corners[0], corners[i], corners[i + 1]]);
    triangles.filter_map(|triangle| PlanarPolygon::new([triangle]).ok()).collect()
}

fn assert_agree(a: FormFactor, b: FormFactor, how: &str) {
    assert!((a.value - b.value).abs() <= a.error_bound + b.error_bound, "{how}: {a:?} and {b:?}");
}

fn polygon(face: &Face, scale: f64) -> Option<PlanarPolygon> {
    PlanarPolygon::new([corners(face).iter().map(|p| p * scale).collect::<Vec<_>>()]).ok()
}

fn corners(face: &Face) -> Vec<DVec3> {
    let [u, v] = face.edges.map(point);
    let corner = point(face.corner);
    if face.is_triangle {
        vec![corner, corner + u, corner + v]
    } else {
        vec![corner, corner + u, corner + u + v, corner + v]
    }
}

fn point(p: [i8; 3]) -> DVec3 {
    DVec3::from(p.map(|v| f64::from(v % 9)))
}
