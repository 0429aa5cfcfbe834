//! Closed meshes, whose faces share corners and edges: from outside a mesh in a closed room all that is seen adds up to the hemisphere, and
//! each face has the value that polygon Booleans find.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "which of the jags a vertex has: a number from 0 to 150"
)]
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon, by_hierarchy};
use proptest::prelude::*;

type Triangle = [DVec3; 3];

/// The faces of an octahedron, in four parts each `times` over, as directions.
fn ball(times: usize) -> Vec<Triangle> {
    let signs = [1.0, -1.0];
    let octants =
        signs.into_iter().flat_map(|x| signs.into_iter().flat_map(move |y| signs.map(|z| [x, y, z])));
    let face = |[x, y, z]: [f64; 3]| {
        let [a, b, c] = [DVec3::X * x, DVec3::Y * y, DVec3::Z * z];
        if x * y * z > 0.0 { [a, b, c] } else { [a, c, b] }
    };
    (0..times).fold(octants.map(face).collect(), |faces: Vec<Triangle>, _| {
        faces.into_iter().flat_map(quarters).collect()
    })
}

fn quarters([a, b, c]: Triangle) -> [Triangle; 4] {
    // In one order for both faces, so that they share the middle.
    let middle = |a: DVec3, b: DVec3| (a + b).normalize();
    let [d, e, f] = [middle(b, c), middle(c, a), middle(a, b)];
    [[a, f, e], [f, b, d], [e, d, c], [d, e, f]]
}

/// A jagged body around a place, fronts outward, and a room around it, fronts inward. All vertices come through `rounded`.
fn scene(jags: &[f64], place: DVec3, rounded: impl Fn(DVec3) -> DVec3) -> Vec<PlanarPolygon> {
    let out = |way: &DVec3| {
        let number = (way.x * 5.0 + way.y * 7.0 + way.z * 11.0 + 23.0) * 3.0;
        place + *way * jags[number as usize % jags.len()]
    };
    let body = ball(2).into_iter().map(|face| face.map(|way| out(&way)));
    let corner = |i: usize| DVec3::new([-3.0, 4.0][i & 1], [-2.5, 3.0][i >> 1 & 1], [-2.0, 3.5][i >> 2]);
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let room = sides.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]].map(|half| half.map(corner)));
    body.chain(room).map(|face| PlanarPolygon::new([face.map(&rounded)]).unwrap()).collect()
}

/// In double or single precision, at some scale.
fn rounding() -> impl Strategy<Value = (bool, f64)> {
    (any::<bool>(), prop_oneof![Just(1.0), Just(1e-6), Just(39.37), Just(1e5)])
}

fn seen_once(
    (is_single, scale): (bool, f64),
    jags: &[f64],
    place: DVec3,
    at: (usize, [f64; 2]),
) -> Result<(), TestCaseError> {
    let single = |p: DVec3| if is_single { p.as_vec3().as_dvec3() } else { p };
    let polygons = scene(jags, place, |p| single(p * scale));
    let (owner, [u, v]) = (at.0 % polygons.len(), at.1);
    let [a, b, c] = polygons[owner].loops().next().unwrap().try_into().unwrap();
    let position = a + (b - a) * u * (1.0 - v) + (c - a) * v;
    let from = DifferentialArea::new(position, polygons[owner].normal()).unwrap().owned_by(owner);
    let enclosure = Enclosure::new(polygons.clone());
    let row = enclosure.row(&from);
    let [sum, bound] = [row.iter().map(|f| f.value).sum::<f64>(), row.iter().map(|f| f.error_bound).sum()];
    prop_assert!((sum - 1.0).abs() <= bound + 1e-14, "the sum is off by {:e}, bound {bound:e}", sum - 1.0);
    let worst = row.iter().map(|f| f.error_bound).fold(0.0, f64::max);
    prop_assert!(worst < 1e-7, "{worst:e} says too little");
    let target = at.0 / 7 % polygons.len();
    let others = polygons.iter().enumerate().filter(|(id, _)| *id != target && *id != owner);
    let others: Vec<PlanarPolygon> = others.map(|(_, polygon)| polygon.clone()).collect();
    if target != owner {
        let [found, other] = [row[target], by_hierarchy(&from, &polygons[target], &others)];
        let off = (found.value - other.value).abs();
        prop_assert!(off <= found.error_bound + other.error_bound + 1e-15, "{found:?} is not {other:?}");
    }
    Ok(())
}

/// A neighbour rises above the face by a rounding of its vertices, behind others that do so: the bound on what is seen of it was 1.
#[test]
fn neighbours_that_hardly_rise() {
    let place = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let jags = [0.9, 0.5, 1.5, 1.6, 0.9, 1.3, 1.0];
    seen_once((true, 1.0), &jags, place(0.3, -0.1, 0.5 - f64::EPSILON / 4.0), (49, [0.75, 0.65])).unwrap();
    let jags = [0.4 + 0.2, 0.4 + 0.8, 0.4 + 0.8, 1.0, 1.0, 0.7, 0.4];
    seen_once((true, 1.0), &jags, place(0.0, 0.8 - 0.2, 0.8 - 0.2), (7, [0.75, 0.55])).unwrap();
    let jags = [1.4, 0.4, 1.5, 0.7, 1.1, 0.4, 0.5];
    seen_once((true, 1.0), &jags, place(0.0, 0.3, 0.6 - 0.2), (51, [0.65, 0.65])).unwrap();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_mesh_in_a_room_is_seen_once(
        how in rounding(),
        jags in prop::collection::vec(prop_oneof![Just(1.0), 0.4..1.6], 5..40),
        place in prop::array::uniform3(-0.25..0.75),
        at in (0usize..10_000, prop::array::uniform2(0.05..0.95)),
    ) {
        seen_once(how, &jags, DVec3::from(place), at)?;
    }
}
