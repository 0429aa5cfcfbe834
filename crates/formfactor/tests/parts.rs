//! Parts of polygons: their factors add up to the whole's.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::{DVec3, DifferentialArea, Enclosure, Error, Limits, Part, PlanarPolygon};

fn polygon(corners: &[DVec3]) -> PlanarPolygon {
    PlanarPolygon::new([corners]).unwrap()
}

/// The corners of a box, low and high along each axis.
fn corner([low, high]: [DVec3; 2], which: [usize; 3]) -> DVec3 {
    DVec3::from([0, 1, 2].map(|axis| [low, high][which[axis]][axis]))
}

/// The six sides of a box with their fronts outward.
fn sides(ends: [DVec3; 2]) -> Vec<PlanarPolygon> {
    let side = |(axis, end): (usize, usize)| {
        let [u, v] = if end == 1 { [1, 2] } else { [2, 1] }.map(|next| (axis + next) % 3);
        let ring = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[i, j]| {
            let mut which = [end; 3];
            (which[u], which[v]) = (i, j);
            corner(ends, which)
        });
        polygon(&ring)
    };
    (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]).map(side).collect()
}

/// A tilted rectangle, a box above it and a wall beside it.
fn room() -> Enclosure {
    let [a, along, up] = [DVec3::ZERO, DVec3::new(2.0, 0.5, 0.25), DVec3::new(-0.25, 1.0, 0.0)];
    let floor = polygon(&[a, a + along, a + along + up, a + up]);
    let block = sides([DVec3::new(0.5, 0.3, 1.0), DVec3::new(1.5, 1.2, 1.5)]);
    let wall = polygon(&[
        DVec3::new(3.0, -1.0, 0.0),
        DVec3::new(3.0, -1.0, 4.0),
        DVec3::new(3.0, 3.0, 4.0),
        DVec3::new(3.0, 3.0, 0.0),
    ]);
    Enclosure::new([vec![floor, wall], block].concat())
}

/// A convex quad cut by two lines between opposite sides.
fn quarters(quad: &PlanarPolygon) -> Vec<PlanarPolygon> {
    let corners: Vec<DVec3> = quad.loops().next().unwrap().to_vec();
    let at = |u: f64, v: f64| corners[0].lerp(corners[1], u).lerp(corners[3].lerp(corners[2], u), v);
    let (us, vs) = ([0.0, 0.375, 1.0], [0.0, 0.625, 1.0]);
    let cells = (0..4).map(|i| (i % 2, i / 2));
    cells
        .map(|(i, j)| {
            polygon(&[at(us[i], vs[j]), at(us[i + 1], vs[j]), at(us[i + 1], vs[j + 1]), at(us[i], vs[j + 1])])
        })
        .collect()
}

fn estimate<'p>(room: &Enclosure, from: impl Into<Part<'p>>, to: impl Into<Part<'p>>) -> [f64; 2] {
    let found = room.area_form_factor(from, to, 1e-7, &Limits::default()).unwrap().unwrap();
    [found.value, found.error_estimate]
}

#[test]
fn parts_of_the_target_add_up_and_parts_of_the_source_have_the_mean() {
    let room = room();
    for [from, to] in [[0, 1], [1, 0], [0, 6], [6, 0], [1, 3], [3, 1]] {
        let [whole, error] = estimate(&room, from, to);
        let parts = quarters(&room.polygons()[to]);
        let sum: f64 = parts.iter().map(|part| estimate(&room, from, (to, part))[0]).sum();
        assert!((sum - whole).abs() <= 4e-7 + error, "{from} to {to}: {sum} {whole}");
        let own = &room.polygons()[from];
        let mean: f64 = quarters(own)
            .iter()
            .map(|part| part.area() / own.area() * estimate(&room, (from, part), to)[0])
            .sum();
        assert!((mean - whole).abs() <= 2e-7 + error, "{from} to {to}: {mean} {whole}");
    }
}

#[test]
fn a_part_has_its_polygons_front_and_bounds_hold() {
    let room = room();
    let own = &room.polygons()[0];
    let far = &quarters(&room.polygons()[1])[2];
    for part in quarters(own) {
        let turned: Vec<DVec3> = part.loops().next().unwrap().iter().rev().copied().collect();
        let found = estimate(&room, (0, &part), (1, far));
        assert_eq!(estimate(&room, (0, &polygon(&turned)), (1, far))[0].to_bits(), found[0].to_bits());
        let bounded = room.bounded_area_form_factor((0, &part), (1, far), 1e-4, &Limits::default());
        let bounded = bounded.unwrap().unwrap();
        assert!(bounded.error_bound <= 1e-4);
        assert!((bounded.value - found[0]).abs() <= bounded.error_bound + found[1], "{bounded:?} {found:?}");
    }
    // All of a polygon is a part of it; parts of one polygon do not see each other.
    assert_eq!(estimate(&room, (0, own), 1), estimate(&room, 0, 1));
    assert_eq!(estimate(&room, (0, &quarters(own)[0]), (0, &quarters(own)[3])), [0.0; 2]);
}

#[test]
fn a_part_of_a_polygon_with_a_hole_may_have_one() {
    let frame = |z: f64, at: f64| {
        let square = |r: f64| [[-r, -r, z], [r, -r, z], [r, r, z], [-r, r, z]];
        PlanarPolygon::new([square(2.0), square(at)]).unwrap()
    };
    let ceiling =
        polygon(&[[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]| DVec3::new(x, y, 1.0)));
    let room = Enclosure::new(vec![frame(0.0, 0.5), ceiling]);
    let inner =
        PlanarPolygon::new([1.0, 0.5].map(|r| [[-r, -r, 0.0], [r, -r, 0.0], [r, r, 0.0], [-r, r, 0.0]]))
            .unwrap();
    let parts = [frame(0.0, 1.0), inner].map(|part| part.area() * estimate(&room, (0, &part), 1)[0]);
    let whole = room.polygons()[0].area() * estimate(&room, 0, 1)[0];
    assert!((parts[0] + parts[1] - whole).abs() < 1e-5, "{parts:?} {whole}");
}

#[test]
fn a_part_off_its_polygons_plane_is_refused() {
    let room = room();
    let lifted: Vec<DVec3> =
        room.polygons()[1].loops().next().unwrap().iter().map(|p| *p + DVec3::X * 1e-3).collect();
    let error = room.area_form_factor(0, (1, &polygon(&lifted)), 1e-3, &Limits::default()).unwrap_err();
    assert!(matches!(error, Error::OffSurface { loop_index: 0, .. }), "{error}");
    assert!(error.to_string().starts_with("loop 0, vertex 0 of the part: 9.99999"), "{error}");
}

/// Walls as exporters of single precision leave them, a little off upright: what is next to a part of one hides nothing of it.
#[test]
fn parts_are_on_the_plane_of_the_whole() {
    let [low, high] = [DVec3::new(-2.5, -3.0, 0.0), DVec3::new(2.5, 3.0, 2.7)];
    let lean = DVec3::new(1.0, 1.0 - 1.967_016_7e-8, 1.0);
    let walls = sides([low, high]).into_iter().map(|side| {
        let leaning = |p: &DVec3| if p.z > 0.0 { *p * lean } else { *p };
        let mut ring: Vec<DVec3> = side.loops().flatten().map(leaning).collect();
        ring.reverse();
        polygon(&ring)
    });
    let room = Enclosure::new(walls.collect());
    let share = |k: i32, n: i32| f64::from(k) / f64::from(n);
    for (id, wall) in room.polygons().iter().enumerate() {
        let [a, b, c, d] = wall.loops().next().unwrap().try_into().unwrap();
        let at = |i: i32, j: i32| a.lerp(b, share(i, 7)).lerp(d.lerp(c, share(i, 7)), share(j, 3));
        let part =
            |i: i32, j: i32| wall.part([[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]]).unwrap();
        let parts: Vec<PlanarPolygon> = (0..21).map(|k| part(k % 7, k / 7)).collect();
        assert!(parts.iter().all(|part| part.normal() == wall.normal()));
        let backward = wall.part([[at(0, 1), at(1, 1), at(1, 0), at(0, 0)]]).unwrap();
        assert_eq!(backward.area(), parts[0].area());
        for (k, normal) in (0..40).flat_map(|k| [DVec3::X, -DVec3::Y, DVec3::Z].map(|normal| (k, normal))) {
            let position = low.lerp(high, 0.5)
                + DVec3::new(share(k % 5 - 2, 2), share(k % 7 - 3, 2), share(k % 9 - 4, 4));
            let from = DifferentialArea::new(position, normal).unwrap();
            let whole = room.form_factor(&from, id);
            let sum: f64 = parts.iter().map(|part| room.form_factor_to_part(&from, id, part).value).sum();
            let near: f64 =
                parts.iter().map(|part| room.form_factor_within(&from, id, part, 1e-11).value).sum();
            assert!((sum - whole.value).abs() < 1e-12, "{sum} is not {whole:?}");
            assert!((near - whole.value).abs() < 21e-11, "{near} is not {whole:?}");
        }
    }
}

/// Quadrilaterals of a cone with two sides, as meshes have them: roundings put parts of one side a last bit behind the other.
#[test]
fn rounded_parts_are_not_hidden_by_what_lies_on_them() {
    let at = |radius: f64, turn: f64, z: f64| DVec3::new(radius * turn.cos(), radius * turn.sin(), z);
    for step in 0..32 {
        let [from, to] = [0.1, 0.7].map(|turn| turn + 0.2 * f64::from(step));
        let corners = [at(11.3, from, 0.1), at(11.3, to, 0.1), at(2.7, to, 1.9), at(2.7, from, 1.9)];
        let side = |order: [usize; 4]| polygon(&order.map(|i| corners[i]));
        let cone = Enclosure::new(vec![side([0, 1, 2, 3]), side([3, 2, 1, 0])]);
        let middle = corners.iter().sum::<DVec3>() / 4.0;
        let rounded = [0, 1, 2, 3].map(|i| polygon(&[corners[i], corners[(i + 1) % 4], middle]));
        let above = DifferentialArea::new(middle + DVec3::Z * 29.0, DVec3::NEG_Z).unwrap();
        let whole = cone.form_factor(&above, 0).value;
        let sum = |factor: &dyn Fn(&PlanarPolygon) -> f64| rounded.iter().map(factor).sum::<f64>();
        let sums = [
            sum(&|part| cone.form_factor_to_part(&above, 0, part).value),
            sum(&|part| cone.form_factor_within(&above, 0, part, 1e-14).value),
            sum(&|part| cone.form_factor_and_centroid(&above, 0, part, &[1]).0.value),
        ];
        assert!(whole > 0.0 && sums.iter().all(|sum| (sum / whole - 1.0).abs() < 1e-12), "{sums:?} {whole}");
        let area = sum(&|part| cone.visible_part(&above, 0, part).area());
        assert!((area / cone.polygons()[0].area() - 1.0).abs() < 1e-12, "{area}");
    }
}

#[test]
fn what_is_off_the_plane_is_no_part() {
    let wall = polygon(&[DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0)]);
    let off = wall.part([[[0.0, 0.0, 1e-9], [0.5, 0.0, 0.0], [0.5, 0.25, 0.0]]]);
    assert!(matches!(off, Err(Error::NotPlanar { .. })), "{off:?}");
}

/// Its corners were rounded where those of the whole are: by more than their own size says.
#[test]
fn a_small_part_near_the_origin_is_on_the_plane_of_its_whole() {
    let turn = glam::DQuat::from_scaled_axis(DVec3::new(0.3, 0.2, -0.5));
    let whole = [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [0.0, 2.0]].map(|[x, y]| turn * DVec3::new(x, y, 0.0));
    let whole = PlanarPolygon::new([whole]).unwrap();
    let lift = 1e-16 * whole.normal();
    for size in [1e-1, 1e-3, 1e-6] {
        let corners = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]];
        let place = |[x, y]: [f64; 2]| turn * DVec3::new(x, y, 0.0) + lift;
        assert!(whole.part([corners.map(place)]).is_ok(), "{size}");
    }
}
