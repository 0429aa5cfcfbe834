//! The methods that the exact one is compared with: that they converge, to what, how fast, and where they stop.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
use formfactor::approx::{
    Baum, Disk, Division, Exact, Hemicube, Method, MonteCarlo, Paraboloid, Pietrek, Rotation, Sampling,
    SinglePlane, VisibilityIndex, Wallace,
};
use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon, unoccluded};

fn quad(corners: [[f64; 3]; 4]) -> PlanarPolygon {
    PlanarPolygon::new([corners]).unwrap()
}

/// The six faces of a box, fronts inward, the floor first.
fn walls([x, y, z]: [f64; 3]) -> Vec<PlanarPolygon> {
    [
        [[0.0, 0.0, 0.0], [x, 0.0, 0.0], [x, y, 0.0], [0.0, y, 0.0]],
        [[0.0, 0.0, z], [0.0, y, z], [x, y, z], [x, 0.0, z]],
        [[0.0, 0.0, 0.0], [0.0, 0.0, z], [x, 0.0, z], [x, 0.0, 0.0]],
        [[0.0, y, 0.0], [x, y, 0.0], [x, y, z], [0.0, y, z]],
        [[0.0, 0.0, 0.0], [0.0, y, 0.0], [0.0, y, z], [0.0, 0.0, z]],
        [[x, 0.0, 0.0], [x, 0.0, z], [x, y, z], [x, y, 0.0]],
    ]
    .map(quad)
    .to_vec()
}

/// A room with a twisted frame in it, a board with a hole, of triangles front and back.
fn room() -> Enclosure {
    let outer = [[1.1, 0.7, 1.0], [2.3, 0.9, 1.4], [2.1, 1.9, 1.7], [0.9, 1.7, 1.2]].map(DVec3::from);
    let middle = outer.iter().sum::<DVec3>() / 4.0;
    let inner = outer.map(|p| middle + (p - middle) / 2.0);
    let mut polygons = walls([4.0, 3.0, 2.5]);
    for i in 0..4 {
        let [a, b, c, d] = [outer[i], outer[(i + 1) % 4], inner[(i + 1) % 4], inner[i]];
        for corners in [[a, b, c], [c, b, a], [a, c, d], [d, c, a]] {
            polygons.push(PlanarPolygon::new([corners]).unwrap());
        }
    }
    Enclosure::new(polygons)
}

/// Points of the floor that looks up, away from symmetry.
fn floor_points() -> Vec<DifferentialArea> {
    let at = |i: u32| DVec3::new(0.31 + 0.47 * f64::from(i % 8), 0.23 + 0.61 * f64::from(i % 5), 0.0);
    (0..24).map(|i| DifferentialArea::new(at(i), DVec3::Z).unwrap().owned_by(0)).collect()
}

/// The root mean square error over all points and targets.
fn error(method: &dyn Method, room: &Enclosure) -> f64 {
    let targets: Vec<usize> = (0..room.polygons().len()).collect();
    let mut squares = Vec::new();
    for from in floor_points() {
        let (found, exact) = (method.row(room, &from, &targets), Exact.row(room, &from, &targets));
        squares.extend(found.iter().zip(exact).map(|(a, b)| (a - b) * (a - b)));
    }
    (squares.iter().sum::<f64>() / f64::from(u32::try_from(squares.len()).unwrap())).sqrt()
}

/// Asserts that the errors fall by at least `factor` from the first method to the last, to at most `last`.
fn converges(methods: &[&dyn Method], room: &Enclosure, factor: f64, last: f64) {
    let errors: Vec<f64> = methods.iter().map(|method| error(*method, room)).collect();
    let names: Vec<String> = methods.iter().map(|method| method.name()).collect();
    let (coarse, fine) = (errors[0], errors[errors.len() - 1]);
    assert!(fine * factor <= coarse && fine <= last, "{names:?}: {errors:?}");
}

/// One of every kind, as good as is quick.
fn one_of_each() -> Vec<Box<dyn Method>> {
    let hemicube = Hemicube::new(64);
    vec![
        Box::new(Exact),
        Box::new(Wallace { division: Division::Uniform(16) }),
        Box::new(Wallace { division: Division::Adaptive { size: 0.1, depth: 7 } }),
        Box::new(Pietrek { division: Division::Uniform(16), near: 0.2 }),
        Box::new(VisibilityIndex { near: 0.0, samples: 3, depth: 4 }),
        Box::new(hemicube.clone()),
        Box::new(hemicube.clone().rotated(Rotation::Random(7))),
        Box::new(Baum { hemicube, near: 0.4, divisions: 16 }),
        Box::new(SinglePlane { half_width: 40.0, smallest: 1e-4 }),
        Box::new(MonteCarlo { rays: 4096, sampling: Sampling::Random, seed: 5 }),
        Box::new(MonteCarlo { rays: 4096, sampling: Sampling::Stratified, seed: 5 }),
        Box::new(Paraboloid::new(64)),
    ]
}

#[test]
fn disks_converge_as_one_over_their_number() {
    let open = Enclosure::new(walls([4.0, 3.0, 2.5]));
    let wallace = |n| Wallace { division: Division::Uniform(n) };
    // Fine enough that parts are small against the distance to the nearest wall.
    converges(&[&wallace(16), &wallace(64)], &open, 12.0, 3e-4);
    let adaptive = |size, depth| Wallace { division: Division::Adaptive { size, depth } };
    converges(&[&adaptive(0.4, 9), &adaptive(0.1, 9)], &open, 8.0, 5e-4);
}

/// The closed form: a disk of radius r, h above dA, F = r² / (r² + h²).
#[test]
fn a_disk_over_its_axis_is_exact() {
    for (radius, height) in [(0.1, 1.0), (1.0, 1.0), (5.0, 0.5)] {
        let corner = |i: u32| {
            let (sine, cosine) = (-f64::from(i) / 500.0 * std::f64::consts::PI).sin_cos();
            DVec3::new(radius * cosine, radius * sine, height)
        };
        let lid = PlanarPolygon::new([(0..1000).map(corner).collect::<Vec<_>>()]).unwrap();
        let below = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
        let found = Disk.row(&Enclosure::new(vec![lid]), &below, &[0])[0];
        let known = radius * radius / (radius * radius + height * height);
        assert!((found / known - 1.0).abs() < 1e-5, "{found} is not {known}");
    }
}

#[test]
fn shadow_edges_slow_parts_down() {
    let room = room();
    let wallace = |n| Wallace { division: Division::Uniform(n) };
    converges(&[&wallace(4), &wallace(16), &wallace(64)], &room, 12.0, 1e-3);
    let pietrek = |n| Pietrek { division: Division::Uniform(n), near: 0.5 / f64::from(n) };
    converges(&[&pietrek(4), &pietrek(16), &pietrek(64)], &room, 12.0, 1e-3);
}

#[test]
fn item_buffers_converge_with_their_resolution() {
    let room = room();
    converges(&[&Hemicube::new(32), &Hemicube::new(256)], &room, 6.0, 4e-4);
    let turned = |n| Hemicube::new(n).rotated(Rotation::Random(11));
    converges(&[&turned(32), &turned(256)], &room, 6.0, 2e-4);
    converges(&[&Paraboloid::new(32), &Paraboloid::new(256)], &room, 8.0, 5e-4);
    let baum = |n| Baum { hemicube: Hemicube::new(16 * n), near: 0.5, divisions: n };
    converges(&[&baum(4), &baum(16)], &room, 4.0, 1e-3);
}

#[test]
fn a_single_plane_converges_to_what_its_rim_lets_through() {
    let room = room();
    let plane = |smallest| SinglePlane { half_width: 1e4, smallest };
    converges(&[&plane(1e-3), &plane(1e-7)], &room, 60.0, 3e-5);
    let targets: Vec<usize> = (0..room.polygons().len()).collect();
    let narrow = SinglePlane { half_width: 4.0, smallest: 1e-6 };
    // What the square itself receives: 1 less what passes below its rim.
    let corner = |w: f64| {
        let square = quad([[-w, w, 1.0], [w, w, 1.0], [w, -w, 1.0], [-w, -w, 1.0]]);
        unoccluded(&DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap(), &square).value
    };
    for from in floor_points() {
        let sum: f64 = narrow.row(&room, &from, &targets).iter().sum();
        assert!((sum - corner(4.0)).abs() < 1e-12, "{sum}");
        assert!(1.0 - sum <= 1.0 / 17.0);
    }
}

#[test]
fn rays_converge_by_their_number() {
    let room = room();
    let rays = |rays, sampling| MonteCarlo { rays, sampling, seed: 3 };
    converges(&[&rays(1 << 8, Sampling::Random), &rays(1 << 16, Sampling::Random)], &room, 10.0, 1.5e-3);
    converges(
        &[&rays(1 << 8, Sampling::Stratified), &rays(1 << 16, Sampling::Stratified)],
        &room,
        32.0,
        2e-4,
    );
}

#[test]
fn a_visibility_index_converges_with_its_rays() {
    let index = |samples| VisibilityIndex { near: 0.0, samples, depth: 7 };
    converges(&[&index(2), &index(8)], &room(), 16.0, 5e-4);
}

#[test]
fn a_visibility_index_stops_at_what_slips_between_its_rays() {
    let lamp = quad([[-2.0, 2.0, 2.0], [2.0, 2.0, 2.0], [2.0, -2.0, 2.0], [-2.0, -2.0, 2.0]]);
    // Its shadow lies between the rays to the lamp.
    let mote = quad([[0.2, 0.2, 1.0], [0.4, 0.2, 1.0], [0.4, 0.4, 1.0], [0.2, 0.4, 1.0]]);
    let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
    let found = |room: &Enclosure, depth: u32| {
        let method = VisibilityIndex { near: 0.0, samples: 3, depth };
        method.row(room, &from, &[0])[0] - Exact.row(room, &from, &[0])[0]
    };
    let hidden = unoccluded(&from, &lamp).value
        - formfactor::form_factor(&from, &lamp, std::slice::from_ref(&mote)).value;
    let missed = Enclosure::new(vec![lamp, mote]);
    for depth in [0, 4, 10] {
        assert!((found(&missed, depth) - hidden).abs() < 1e-15, "no depth finds the mote");
    }
}

#[test]
fn a_disk_is_right_for_a_disk_on_the_axis() {
    let (radius, height) = (1.5, 2.0);
    let corners: Vec<DVec3> = (0..720_u32)
        .map(|i| {
            let (sine, cosine) = (-f64::from(i) * std::f64::consts::PI / 360.0).sin_cos();
            DVec3::new(radius * cosine, radius * sine, height)
        })
        .collect();
    let room = Enclosure::new(vec![PlanarPolygon::new([corners]).unwrap()]);
    let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
    let (found, exact) = (Disk.row(&room, &from, &[0])[0], Exact.row(&room, &from, &[0])[0]);
    assert!((found - radius * radius / (radius * radius + height * height)).abs() < 1e-4);
    assert!((found - exact).abs() < 1e-8, "of one area, {found} and {exact}");
}

#[test]
fn parts_by_the_contour_sum_are_exact_where_nothing_hides_them() {
    let room = Enclosure::new(walls([4.0, 3.0, 2.5]));
    let pietrek = Pietrek { division: Division::Uniform(3), near: 0.0 };
    let index = VisibilityIndex { near: 0.0, samples: 2, depth: 3 };
    // In the open and tilted, so that walls cross the horizon.
    for normal in [DVec3::Z, DVec3::new(0.3, -0.4, 1.0), DVec3::new(-1.0, 0.2, -0.1)] {
        let from = DifferentialArea::new(DVec3::new(1.3, 0.9, 0.7), normal).unwrap();
        let targets = [0, 1, 2, 3, 4, 5];
        let exact = Exact.row(&room, &from, &targets);
        for row in [pietrek.row(&room, &from, &targets), index.row(&room, &from, &targets)] {
            row.iter().zip(&exact).for_each(|(a, b)| assert!((a - b).abs() < 1e-14, "{a} is not {b}"));
        }
    }
}

#[test]
fn a_closed_room_is_seen_once() {
    let room = room();
    let targets: Vec<usize> = (0..room.polygons().len()).collect();
    let once: [Box<dyn Method>; 6] = [
        Box::new(Hemicube::new(2)),
        Box::new(Hemicube::new(63)),
        Box::new(Hemicube::new(128).rotated(Rotation::Random(1))),
        Box::new(Paraboloid::new(64)),
        Box::new(MonteCarlo { rays: 1000, sampling: Sampling::Random, seed: 1 }),
        Box::new(MonteCarlo { rays: 1000, sampling: Sampling::Stratified, seed: 1 }),
    ];
    for from in floor_points() {
        for method in &once {
            let sum: f64 = method.row(&room, &from, &targets).iter().sum();
            assert!((sum - 1.0).abs() < 1e-12, "{}: {:e}", method.name(), sum - 1.0);
        }
    }
}

#[test]
fn rows_are_a_function_of_the_question() {
    let room = room();
    let from = floor_points()[7];
    for method in one_of_each() {
        let row = method.row(&room, &from, &[1, 9, 4]);
        assert_eq!(row, method.row(&room, &from, &[1, 9, 4]), "{}", method.name());
        let others = method.row(&room, &from, &[4, 1]);
        assert_eq!([row[2], row[0]], [others[0], others[1]], "{}", method.name());
        assert_eq!(method.row(&room, &from, &[]), []);
    }
}

#[test]
fn targets_are_one_sided_and_the_owner_is_not_seen() {
    let facing = quad([[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]);
    let turned = quad([[2.0, -1.0, 2.0], [4.0, -1.0, 2.0], [4.0, 1.0, 2.0], [2.0, 1.0, 2.0]]);
    let below = quad([[-1.0, -1.0, -1.0], [1.0, -1.0, -1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]]);
    let edge_on = quad([[0.0, -1.0, 1.0], [0.0, 1.0, 1.0], [0.0, 1.0, 2.0], [0.0, -1.0, 2.0]]);
    let room = Enclosure::new(vec![facing, turned, below, edge_on]);
    let from = DifferentialArea::new(DVec3::ZERO, DVec3::Z).unwrap();
    for method in one_of_each().iter().chain(std::iter::once(&(Box::new(Disk) as Box<dyn Method>))) {
        let row = method.row(&room, &from, &[0, 1, 2, 3]);
        assert!(row[0] > 0.2 && row[0] < 0.28, "{}: {row:?}", method.name());
        assert_eq!(row[1..], [0.0; 3], "{}", method.name());
        assert_eq!(method.row(&room, &from.owned_by(0), &[0]), [0.0], "{}", method.name());
    }
}

#[test]
fn what_lies_in_the_targets_plane_does_not_hide_it() {
    let at = |w: f64| [[-w, w, 2.0], [w, w, 2.0], [w, -w, 2.0], [-w, -w, 2.0]].map(DVec3::from);
    let turned = |[a, b, c, d]: [DVec3; 4]| [a, d, c, b];
    let (lamp, sheet) = (at(1.0), turned(at(1.5)));
    // A sheet behind the lamp's very plane that faces away: what it is first or second in the list must not matter.
    let orders = [[lamp, sheet], [sheet, lamp]];
    let from = DifferentialArea::new(DVec3::new(0.3, 0.1, 0.0), DVec3::new(0.1, 0.0, 1.0)).unwrap();
    for (lamp, order) in orders.iter().enumerate() {
        let room = Enclosure::new(order.iter().map(|p| PlanarPolygon::new([*p]).unwrap()).collect());
        let exact = Exact.row(&room, &from, &[lamp])[0];
        for method in one_of_each() {
            let found = method.row(&room, &from, &[lamp])[0];
            assert!((found - exact).abs() < 0.02, "{}: {found} is not {exact}", method.name());
        }
    }
}

#[test]
fn targets_with_holes_and_notches_are_divided() {
    let loops = [
        vec![[0.0, 0.0, 2.0], [0.0, 4.0, 2.0], [3.0, 4.0, 2.0], [1.0, 2.0, 2.0], [4.0, 0.0, 2.0]],
        vec![[0.2, 0.2, 2.0], [1.2, 0.3, 2.0], [0.5, 1.0, 2.0]],
    ];
    let frame =
        PlanarPolygon::new(loops.map(|l| l.into_iter().map(DVec3::from).collect::<Vec<_>>())).unwrap();
    let board = quad([[0.5, 0.5, 1.0], [1.0, 0.5, 1.0], [1.0, 1.0, 1.0], [0.5, 1.0, 1.0]]);
    let room = Enclosure::new(vec![frame, board]);
    let from = DifferentialArea::new(DVec3::new(0.6, 0.7, 0.0), DVec3::Z).unwrap();
    let exact = Exact.row(&room, &from, &[0])[0];
    for method in one_of_each() {
        let found = method.row(&room, &from, &[0])[0];
        assert!((found - exact).abs() < 0.02, "{}: {found} is not {exact}", method.name());
    }
}

#[test]
fn parameters_without_sense_give_numbers() {
    let room = room();
    let targets: Vec<usize> = (0..room.polygons().len()).collect();
    let strange = [f64::NAN, f64::INFINITY, 0.0, -1.0];
    let mut methods: Vec<Box<dyn Method>> = vec![
        Box::new(Hemicube::new(0).rotated(Rotation::Angle(1e300))),
        Box::new(Paraboloid::new(0)),
        Box::new(MonteCarlo { rays: 0, sampling: Sampling::Random, seed: u64::MAX }),
        Box::new(MonteCarlo { rays: 0, sampling: Sampling::Stratified, seed: 0 }),
        Box::new(VisibilityIndex { near: f64::NAN, samples: 0, depth: 0 }),
        Box::new(Baum { hemicube: Hemicube::new(1), near: f64::NAN, divisions: 0 }),
        Box::new(Pietrek { division: Division::Uniform(0), near: f64::NEG_INFINITY }),
    ];
    for value in strange {
        methods.push(Box::new(SinglePlane { half_width: value, smallest: 1e-3 }));
        methods.push(Box::new(SinglePlane { half_width: 2.0, smallest: value.min(1e-6) }));
        methods.push(Box::new(Wallace { division: Division::Adaptive { size: value, depth: 3 } }));
    }
    for method in methods {
        let row = method.row(&room, &floor_points()[3], &targets);
        assert!(row.iter().all(|factor| (0.0..=1.5).contains(factor)), "{}: {row:?}", method.name());
    }
}
