//! Laws that form factors obey, on random input.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::glam::{self, Vec3Swizzles};
use formfactor::{
    DVec3, DifferentialArea, Enclosure, FormFactor, PlanarPolygon, by_hierarchy, form_factor, unoccluded,
};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn triangle(points: [DVec3; 3]) -> Option<PlanarPolygon> {
    PlanarPolygon::new([points]).ok()
}

/// A point of a small lattice: coincidences of every kind are common.
fn lattice(size: i32) -> impl Strategy<Value = DVec3> + Clone {
    let part = -size..=size;
    (part.clone(), part.clone(), part).prop_map(|(x, y, z)| glam::IVec3::new(x, y, z).as_dvec3())
}

fn anywhere() -> impl Strategy<Value = DVec3> + Clone {
    (-3.0..3.0, -3.0..3.0, -3.0..3.0).prop_map(DVec3::from)
}

fn triangles(
    points: impl Strategy<Value = DVec3> + Clone,
    count: usize,
) -> impl Strategy<Value = Vec<PlanarPolygon>> {
    let corners = prop::array::uniform3(points);
    prop::collection::vec(corners, 0..=count).prop_map(|all| all.into_iter().filter_map(triangle).collect())
}

fn area() -> impl Strategy<Value = DifferentialArea> {
    lattice(2).prop_filter_map("a normal", |normal| DifferentialArea::new(DVec3::ZERO, normal).ok())
}

fn facing(corners: [DVec3; 3]) -> Option<PlanarPolygon> {
    let polygon = triangle(corners)?;
    let [a, b, c] = corners;
    if polygon.normal().dot(a) < 0.0 { Some(polygon) } else { triangle([a, c, b]) }
}

fn target(points: impl Strategy<Value = DVec3> + Clone) -> impl Strategy<Value = PlanarPolygon> {
    prop::array::uniform3(points).prop_filter_map("a triangle", facing)
}

fn agree(a: FormFactor, b: FormFactor) -> Result<(), TestCaseError> {
    let allowed = a.error_bound + b.error_bound;
    prop_assert!((a.value - b.value).abs() <= allowed, "{a:?} and {b:?}");
    prop_assert!(allowed < 1e-9, "{allowed:e} says too little");
    Ok(())
}

/// Stratified rays over the hemisphere, cosine-weighted: the fraction that reaches the target first.
fn by_rays(from: &DifferentialArea, to: &PlanarPolygon, occluders: &[PlanarPolygon]) -> f64 {
    const SIDE: u32 = 96;
    let normal = from.normal();
    let across = normal.any_orthonormal_vector();
    let along = normal.cross(across);
    let meets = |direction: DVec3, polygon: &PlanarPolygon| {
        let corners: Vec<DVec3> = polygon.loops().flatten().map(|p| *p - from.position()).collect();
        let turns = [0, 1, 2].map(|i| corners[i].cross(corners[(i + 1) % 3]).dot(direction));
        let plane = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let t = plane.dot(corners[0]) / plane.dot(direction);
        let inside = turns.iter().all(|s| *s > 0.0) || turns.iter().all(|s| *s < 0.0);
        (inside && t > 0.0).then_some(t)
    };
    let reaches = |i: u32, j: u32| {
        let (u, v) = ((f64::from(i) + 0.5) / f64::from(SIDE), (f64::from(j) + 0.4) / f64::from(SIDE));
        let (r, phi) = (u.sqrt(), TAU * v);
        let direction = r * phi.cos() * across + r * phi.sin() * along + (1.0 - u).sqrt() * normal;
        meets(direction, to)
            .is_some_and(|t| !occluders.iter().any(|o| meets(direction, o).is_some_and(|s| s < t)))
    };
    let hits =
        (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))).filter(|(i, j)| reaches(*i, *j)).count();
    f64::from(u32::try_from(hits).unwrap()) / f64::from(SIDE * SIDE)
}

/// The six faces of a cuboid, their fronts inward, or outward when `solid`.
fn cuboid(center: DVec3, half: DVec3, frame: glam::DMat3, solid: bool) -> Vec<[DVec3; 4]> {
    let corner = |i: usize| {
        let sign = |bit: usize| if i & bit == 0 { -1.0 } else { 1.0 };
        center + frame * (half * DVec3::new(sign(1), sign(2), sign(4)))
    };
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let oriented = faces.map(|[a, b, c, d]| if solid { [a, d, c, b] } else { [a, b, c, d] });
    oriented.map(|face| face.map(corner)).to_vec()
}

fn in_triangles(faces: &[[DVec3; 4]]) -> Vec<PlanarPolygon> {
    let halves = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    halves.map(|t| triangle(t).expect("half a face")).collect()
}

fn as_they_are(faces: &[[DVec3; 4]]) -> Vec<PlanarPolygon> {
    faces.iter().map(|face| PlanarPolygon::new([face]).expect("planar but for rounding")).collect()
}

/// A room with a block in the half that holds no point, and dA in the other half.
fn room() -> impl Strategy<Value = (Vec<[DVec3; 4]>, DifferentialArea)> {
    let sizes = (0.5..3.0, 0.5..3.0, 0.5..3.0).prop_map(DVec3::from);
    let at = (-0.9..-0.5, -0.9..0.9, -0.9..0.9).prop_map(DVec3::from);
    let room = |(half, frame, inner, at, normal): (DVec3, _, _, DVec3, DVec3)| {
        let frame: glam::DMat3 = frame;
        let mut faces = cuboid(DVec3::ZERO, half, frame, false);
        let block = DVec3::splat(0.1 * half.min_element());
        faces.extend(cuboid(frame * (half * DVec3::new(0.3, 0.0, 0.0)), block, inner, true));
        Some((faces, DifferentialArea::new(frame * (half * at), normal).ok()?))
    };
    (sizes, rotation(), rotation(), at, anywhere()).prop_filter_map("a normal", room)
}

fn seen_once(polygons: Vec<PlanarPolygon>, from: &DifferentialArea) -> Result<(), TestCaseError> {
    let row = Enclosure::new(polygons).row(from);
    let sum: f64 = row.iter().map(|f| f.value).sum();
    let bound: f64 = row.iter().map(|f| f.error_bound).sum();
    prop_assert!((sum - 1.0).abs() <= bound + 1e-15, "the sum is off by {:e}, bound {bound:e}", sum - 1.0);
    prop_assert!(bound < 1e-11, "{bound:e} says too little");
    Ok(())
}

fn rotation() -> impl Strategy<Value = glam::DMat3> {
    (anywhere(), 0.0..TAU).prop_filter_map("an axis", |(axis, angle)| {
        Some(glam::DMat3::from_axis_angle(axis.try_normalize()?, angle))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn occlusion_takes_away_and_never_all_plus_more(
        from in area(), to in target(lattice(3)), occluders in triangles(lattice(3), 8),
    ) {
        let (free, seen) = (unoccluded(&from, &to), form_factor(&from, &to, &occluders));
        prop_assert!(seen.value >= 0.0 && free.value <= 1.0);
        prop_assert!(seen.value <= free.value + free.error_bound + seen.error_bound);
    }

    #[test]
    fn both_routes_agree_on_lattices(from in area(), to in target(lattice(3)), occluders in triangles(lattice(3), 8)) {
        agree(form_factor(&from, &to, &occluders), by_hierarchy(&from, &to, &occluders))?;
    }

    #[test]
    fn both_routes_agree_anywhere(from in area(), to in target(anywhere()), occluders in triangles(anywhere(), 8)) {
        agree(form_factor(&from, &to, &occluders), by_hierarchy(&from, &to, &occluders))?;
    }

    #[test]
    fn rays_agree_roughly(from in area(), to in target(anywhere()), occluders in triangles(anywhere(), 6)) {
        let exact = form_factor(&from, &to, &occluders).value;
        let sampled = by_rays(&from, &to, &occluders);
        prop_assert!((exact - sampled).abs() < 0.012, "{exact} is not {sampled}");
    }

    #[test]
    fn the_order_of_occluders_does_not_matter(
        from in area(), to in target(lattice(3)), occluders in triangles(lattice(3), 8),
    ) {
        let backward: Vec<PlanarPolygon> = occluders.iter().rev().cloned().collect();
        agree(form_factor(&from, &to, &occluders), form_factor(&from, &to, &backward))?;
    }

    #[test]
    fn a_target_is_the_sum_of_its_halves(
        from in area(), corners in prop::array::uniform3(lattice(3)), occluders in triangles(lattice(3), 6),
    ) {
        // Doubled, so that the midpoint is a lattice point too.
        let [a, b, c] = corners.map(|p| 2.0 * p);
        let middle = (b + c) / 2.0;
        let (Some(whole), Some(left), Some(right)) = (facing([a, b, c]), facing([a, b, middle]), facing([a, middle, c])) else {
            return Ok(());
        };
        let [whole, left, right] = [whole, left, right].map(|part| form_factor(&from, &part, &occluders));
        let sum = FormFactor { value: left.value + right.value, error_bound: left.error_bound + right.error_bound };
        agree(whole, sum)?;
    }

    #[test]
    fn an_occluder_in_two_halves_hides_the_same(
        from in area(), to in target(lattice(3)), corners in prop::array::uniform3(lattice(3)),
        others in triangles(lattice(3), 4),
    ) {
        let [a, b, c] = corners.map(|p| p / 4.0);
        let middle = (b + c) / 2.0;
        let (Some(whole), Some(left), Some(right)) = (triangle([a, b, c]), triangle([a, b, middle]), triangle([a, middle, c])) else {
            return Ok(());
        };
        let past = |more: &[PlanarPolygon]| form_factor(&from, &to, &[&others[..], more].concat());
        agree(past(&[whole]), past(&[left, right]))?;
    }

    #[test]
    fn moving_everything_changes_nothing(
        from in area(), to in target(lattice(3)), occluders in triangles(lattice(3), 8), by in lattice(1000),
    ) {
        // Sixteenths and whole numbers: every coordinate is exact.
        let moved = |p: &PlanarPolygon, by: DVec3| {
            PlanarPolygon::new(p.loops().map(|l| l.iter().map(|v| *v / 16.0 + by).collect::<Vec<_>>())).expect("as good")
        };
        let there = DifferentialArea::new(by, from.normal()).expect("as good");
        let here = DifferentialArea::new(DVec3::ZERO, from.normal()).expect("as good");
        let all = |by: DVec3| -> Vec<PlanarPolygon> { occluders.iter().map(|o| moved(o, by)).collect() };
        agree(
            form_factor(&here, &moved(&to, DVec3::ZERO), &all(DVec3::ZERO)),
            form_factor(&there, &moved(&to, by), &all(by)),
        )?;
    }

    #[test]
    fn an_occluder_pulled_toward_the_point_hides_the_same(
        from in area(), to in target(lattice(3)), occluders in triangles(lattice(3), 8), halvings in 1i32..60,
    ) {
        let plane = to.loops().next().expect("a loop")[0];
        let before = |p: &PlanarPolygon| p.loops().flatten().all(|v| (*v - plane).dot(to.normal()) > 0.1);
        let pull = |p: &PlanarPolygon, by: f64| {
            PlanarPolygon::new(p.loops().map(|l| l.iter().map(|v| *v * by).collect::<Vec<_>>())).expect("as good")
        };
        let here: Vec<PlanarPolygon> = occluders.iter().filter(|p| before(p)).cloned().collect();
        // Each by another power of two: all exact.
        let there = here.iter().zip(0i32..).map(|(p, i)| pull(p, 0.5f64.powi(halvings * (i % 3)))).collect::<Vec<_>>();
        agree(form_factor(&from, &to, &here), form_factor(&from, &to, &there))?;
    }

    #[test]
    fn no_axis_is_special(from in area(), to in target(anywhere()), occluders in triangles(anywhere(), 8)) {
        let turned = |p: &PlanarPolygon| {
            PlanarPolygon::new(p.loops().map(|l| l.iter().map(|v| v.yzx()).collect::<Vec<_>>())).expect("as good")
        };
        let there = DifferentialArea::new(DVec3::ZERO, from.normal().yzx()).expect("as good");
        let others: Vec<PlanarPolygon> = occluders.iter().map(turned).collect();
        agree(form_factor(&from, &to, &occluders), form_factor(&there, &turned(&to), &others))?;
    }

    #[test]
    fn what_is_close_to_a_plane_is_seen_as_exactly(
        normal in lattice(2), to in prop::array::uniform3(lattice(3)), occluders in triangles(lattice(3), 8),
        at in lattice(3), lift in 20i32..60,
    ) {
        // dA in the lattice, lifted off it by a tiny step that keeps every coordinate exact after another shift.
        let step = DVec3::new(1.0, 1.0, 1.0) * 0.5f64.powi(lift);
        let Ok(from) = DifferentialArea::new(at / 2.0 + step, normal) else { return Ok(()) };
        let Some(to) = triangle(to) else { return Ok(()) };
        let (seen, other) = (form_factor(&from, &to, &occluders), by_hierarchy(&from, &to, &occluders));
        prop_assert!((seen.value - other.value).abs() <= seen.error_bound + other.error_bound);
        let free = unoccluded(&from, &to);
        prop_assert!(seen.value <= free.value + free.error_bound + seen.error_bound);
    }

    #[test]
    fn an_edge_that_passes_next_to_the_point_hides_as_exactly(
        from in area(), to in target(lattice(3)), tips in prop::collection::vec((lattice(3), lattice(3), anywhere()), 1..6),
        halvings in 4i32..50,
    ) {
        let past = |(way, tip, off): &(DVec3, DVec3, DVec3)| triangle([*way + *off * 0.5f64.powi(halvings), -*way, *tip]);
        let occluders: Vec<PlanarPolygon> = tips.iter().filter_map(past).collect();
        let (seen, other) = (form_factor(&from, &to, &occluders), by_hierarchy(&from, &to, &occluders));
        prop_assert!(seen.error_bound >= 0.0 && seen.error_bound < 1e-9, "{seen:?}");
        prop_assert!((seen.value - other.value).abs() <= seen.error_bound + other.error_bound, "{seen:?} and {other:?}");
    }

    #[test]
    fn occluders_that_touch_the_target_hide_as_exactly(
        from in area(), to in target(anywhere()), others in prop::collection::vec((0usize..3, 0usize..4, anywhere(), anywhere()), 1..4),
    ) {
        // From a vertex of the target or from a point between two, rounded: a little before its plane, or behind, or on it.
        let corners: Vec<DVec3> = to.loops().flatten().copied().collect();
        let touching = |(i, share, a, b): &(usize, usize, DVec3, DVec3)| {
            let share = f64::from(u32::try_from(*share).expect("small")) / 4.0;
            triangle([corners[*i] + (corners[(i + 1) % 3] - corners[*i]) * share, *a, *b])
        };
        let occluders: Vec<PlanarPolygon> = others.iter().filter_map(touching).collect();
        agree(form_factor(&from, &to, &occluders), by_hierarchy(&from, &to, &occluders))?;
    }

    #[test]
    fn an_enclosure_finds_every_occluder(from in area(), polygons in triangles(anywhere(), 40), shift in anywhere()) {
        // Small and all over the place, so that most can be skipped.
        let small = |(i, p): (u32, &PlanarPolygon)| {
            let at = shift * f64::from(i % 7) + DVec3::Z * f64::from(i % 3);
            PlanarPolygon::new(p.loops().map(|l| l.iter().map(|v| *v / 4.0 + at).collect::<Vec<_>>())).expect("as good")
        };
        let polygons: Vec<PlanarPolygon> = (0..).zip(&polygons).map(small).collect();
        let enclosure = Enclosure::new(polygons.clone());
        for (id, row) in enclosure.row(&from).into_iter().enumerate() {
            let others = [&polygons[..id], &polygons[id + 1..]].concat();
            agree(row, form_factor(&from, &polygons[id], &others))?;
        }
    }

    #[test]
    fn an_owner_neither_sees_itself_nor_blocks(corners in prop::array::uniform3(anywhere()), to in target(anywhere())) {
        let Some(owner) = triangle(corners) else { return Ok(()) };
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        let from = DifferentialArea::new(middle, owner.normal()).expect("a point of it").owned_by(0);
        let row = Enclosure::new(vec![owner, to.clone()]).row(&from);
        prop_assert_eq!(row[0], FormFactor::default());
        prop_assert_eq!(row[1], unoccluded(&from, &to));
    }

    #[test]
    fn a_closed_room_of_triangles_is_seen_once((faces, from) in room()) {
        seen_once(in_triangles(&faces), &from)?;
    }

    #[test]
    fn a_closed_room_of_rounded_faces_is_seen_once((faces, from) in room()) {
        seen_once(as_they_are(&faces), &from)?;
    }
}

proptest! {
    /// What a light sees of a polygon is where the polygon sees the light.
    #[test]
    fn a_point_sees_a_light_where_the_light_sees_the_point(
        occluders in triangles(anywhere(), 12), target in prop::array::uniform3(anywhere()),
        shares in prop::array::uniform2(0.0f64..1.0),
    ) {
        let light = DVec3::new(0.1, 0.2, 0.3);
        let Some(target) = triangle(target) else { return Ok(()) };
        let side = (light - target.loops().next().unwrap()[0]).dot(target.normal());
        prop_assume!(side > 1e-3 && target.area() > 1e-3);
        let from = DifferentialArea::new(light, -target.normal()).unwrap();
        let all = Enclosure::new([vec![target.clone()], occluders.clone()].concat());
        let seen = all.visible_part(&from, 0, &target);
        let alone = formfactor::visible_part(&from, &target, &occluders);
        prop_assert!((seen.area() - alone.area()).abs() <= 1e-12 * target.area());
        let [a, b, c] = [0, 1, 2].map(|k| target.loops().next().unwrap()[k]);
        let (u, v) = (shares[0].min(1.0 - shares[1]), shares[1]);
        let place = a + (u + 0.01) / 1.04 * (b - a) + (v + 0.01) / 1.04 * (c - a);
        let point = DifferentialArea::new(place, target.normal()).unwrap().owned_by(0);
        let axis = (0..3).max_by(|i, j| target.normal()[*i].abs().total_cmp(&target.normal()[*j].abs())).unwrap();
        let flat = |p: DVec3| {
            let (u, v) = (p[(axis + 1) % 3], p[(axis + 2) % 3]);
            if target.normal()[axis] > 0.0 { [u, v] } else { [v, u] }
        };
        let near = |ring: &[DVec3]| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(p, q)| {
                let share = ((place - *p).dot(*q - *p) / (*q - *p).length_squared()).clamp(0.0, 1.0);
                place.distance(*p + share * (*q - *p))
            }).fold(f64::INFINITY, f64::min)
        };
        // Rounding decides on the rim.
        prop_assume!(seen.rings().all(|ring| near(&ring) > 1e-9));
        let inside = seen.region().locate(flat(place).into()) == polycsg::Location::Inside;
        prop_assert_eq!(all.sees(&point, light), inside);
    }
}
