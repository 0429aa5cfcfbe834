//! Lamps, suns and skies: closed forms, CIE 171, and laws.
use crate::build::{patch, polygon, room, scene, solved};
use radiosity::formfactor::{DifferentialArea, unoccluded};
use radiosity::glam::{DMat3, DQuat, DVec3};
use radiosity::{
    Asset, Cone, Distribution, Lamp, Method, Options, Record, Rim, Scene, Sky, SkyKind, Solution, Sun,
};
use std::f64::consts::PI;

const METHODS: [Method; 4] = [Method::Hierarchical, Method::Shoot, Method::Cg, Method::Matrix];

fn by(method: Method) -> Options {
    Options { method, elements: 300, tolerance: 1e-6, ..Options::default() }
}

/// The floor from (−2, −2) to (2, 2), z up, without reflection.
fn floor() -> Scene {
    let corners = [[-2., -2., 0.], [2., -2., 0.], [2., 2., 0.], [-2., 2., 0.]];
    let up = Asset { up: DVec3::Z, unit: 1.0 };
    Scene { asset: up, ..scene(vec![patch("floor", &corners, 0.0, 0.0)]) }
}

/// A board that looks up, from (−h, −h) to (h, h).
fn board(h: f64, z: f64) -> radiosity::Patch {
    patch("board", &[[-h, -h, z], [h, -h, z], [h, h, z], [-h, h, z]], 0.0, 0.0)
}

fn down(name: &str, position: [f64; 3], distribution: Distribution, intensity: f64) -> Lamp {
    let frame = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NEG_Z);
    Lamp { frame, distribution, ..Lamp::even(name, DVec3::from(position), vec![intensity]) }
}

fn means(scene: &Scene, solution: &Solution) -> Vec<f64> {
    solution.patch_means(&solution.irradiance, scene.patches.len()).concat()
}

fn near(found: f64, wanted: f64, share: f64) {
    assert!((found - wanted).abs() <= share * wanted.abs(), "{found} {wanted}");
}

/// Every vertex within the floor has what `wanted` says.
fn at_vertices(solution: &Solution, wanted: impl Fn(DVec3) -> f64) {
    for (place, found) in solution.mesh.vertices.iter().zip(solution.vertex_irradiance()) {
        let is_inside = place.x.abs().max(place.y.abs()) < 1.999;
        near(found, wanted(*place), if is_inside { 1e-9 } else { 5e-3 });
    }
}

#[test]
fn cie_171_case_5_2_a_lambertian_lamp_over_a_floor() {
    let lamp = down("lamp", [0., 0., 3.], Distribution::Cone(Cone::LAMBERTIAN), 1000.0);
    let wanted = |x: f64, y: f64| 9000.0 / (9.0 + x * x + y * y).powi(2);
    for ([x, y], printed) in [([0., 0.], 111.111), ([0.5, 0.5], 99.723), ([1.5, 1.5], 49.383)] {
        assert!((wanted(x, y) - printed).abs() < 5e-4);
    }
    for method in METHODS {
        let scene = Scene { lamps: vec![lamp.clone()], ..floor() };
        let solution = solved(&scene, &by(method));
        at_vertices(&solution, |place| wanted(place.x, place.y));
        let eye = DifferentialArea::new(lamp.position, DVec3::NEG_Z).unwrap();
        let mean = PI * 1000.0 * unoccluded(&eye, &scene.patches[0].polygon).value / 16.0;
        near(means(&scene, &solution)[0], mean, if method == Method::Hierarchical { 1e-6 } else { 1e-2 });
        near(solution.ledger.emitted[0], 1000.0 * PI, 1e-9);
        near(solution.ledger.absorbed[0] + solution.ledger.escaped[0], 1000.0 * PI, 1e-9);
    }
}

#[test]
fn cie_171_case_5_8_a_lamp_in_a_cube() {
    for reflectance in [0.0, 0.3, 0.6, 0.9] {
        let wanted = 10_000.0 / (96.0 * (1.0 - reflectance));
        let lamp = Lamp::even("lamp", DVec3::splat(2.0), vec![10_000.0 / (4.0 * PI)]);
        let cube = scene(room([0.0; 3], [4.0; 3], 1, reflectance, 0.0));
        let cube = Scene { lamps: vec![lamp], ..cube };
        for method in if reflectance == 0.6 { &METHODS[..] } else { &METHODS[..1] } {
            let solution = solved(&cube, &Options { error: 3e-3, ..by(*method) });
            let share = if *method == Method::Hierarchical { 3e-3 } else { 2e-2 };
            means(&cube, &solution).into_iter().for_each(|mean| near(mean, wanted, share));
            assert!(solution.ledger.escaped[0].abs() < share * 10_000.0);
            assert!(solution.ledger.defect[0].abs() < 1e-8 * 10_000.0);
        }
    }
}

/// The solid angle of the square |x|, |y| <= h seen from a height over its middle.
fn solid_angle(h: f64, height: f64) -> f64 {
    4.0 * (h * h / (height * (2.0 * h * h + height * height).sqrt())).atan()
}

#[test]
fn shadows_of_points_have_exact_edges() {
    let lamp = Lamp::even("lamp", DVec3::new(0., 0., 3.), vec![7.0]);
    let mut covered = floor();
    covered.patches.push(board(0.3, 2.0));
    covered.lamps = vec![lamp];
    let solution = solved(&covered, &by(Method::Hierarchical));
    let found = means(&covered, &solution);
    near(found[0] * 16.0, 7.0 * (solid_angle(2.0, 3.0) - solid_angle(0.3, 1.0)), 1e-6);
    near(found[1] * 0.36, 7.0 * solid_angle(0.3, 1.0), 1e-6);
    // The edge of the shadow is an edge of elements, on both sides of which vertices have their own light.
    let light = |place: DVec3| 21.0 / (9.0 + place.x * place.x + place.y * place.y).powf(1.5);
    let vertices = solution.mesh.vertices.iter().zip(solution.vertex_irradiance());
    let mut on_edge = [0, 0];
    for (place, found) in vertices.filter(|(place, _)| place.z == 0.0) {
        let reach = place.x.abs().max(place.y.abs());
        if (reach - 0.9).abs() < 1e-9 {
            on_edge[usize::from(found > 0.0)] += 1;
        } else if reach < 0.9 {
            assert_eq!(found, 0.0, "{place}");
        } else {
            near(found, light(*place), 5e-3);
        }
    }
    assert!(on_edge[0] >= 4 && on_edge[1] >= 4, "{on_edge:?}");
    assert!(solution.mesh.elements.len() < 2000, "{}", solution.mesh.elements.len());
}

#[test]
fn a_spot_lights_what_is_in_its_cone() {
    let cosine = 0.95f64;
    for (inner, outer, rim) in
        [(cosine, cosine, Rim::Squared), (0.97, 0.93, Rim::Squared), (0.97, 0.93, Rim::Smooth)]
    {
        let cone = Cone { exponent: 0.0, inner, outer, rim };
        let lamp = down("spot", [0., 0., 3.], Distribution::Cone(cone), 10.0);
        let within = 1.0 - inner + (inner - outer) * if rim == Rim::Squared { 1.0 / 3.0 } else { 0.5 };
        near(lamp.power()[0], 10.0 * 2.0 * PI * within, 1e-6);
        let spot = Scene { lamps: vec![lamp], ..floor() };
        let solution = solved(&spot, &by(Method::Hierarchical));
        near(means(&spot, &solution)[0] * 16.0, 10.0 * 2.0 * PI * within, 2e-4);
        assert!(solution.ledger.escaped[0].abs() < 2e-4 * 10.0 * 2.0 * PI * within);
    }
}

#[test]
fn the_sun_shines_by_the_cosine_and_casts_the_shadow_of_parallel_light() {
    let direction = DVec3::new(1.0, 0.0, -2.0);
    let mut sunny = floor();
    sunny.patches.push(board(0.5, 1.0));
    sunny.suns = vec![Sun { name: "sun".into(), direction, irradiance: vec![1000.0] }];
    let cosine = 2.0 / 5f64.sqrt();
    for method in METHODS {
        let solution = solved(&sunny, &by(method));
        let found = means(&sunny, &solution);
        let (share, of_board) = if method == Method::Hierarchical { (1e-6, 1e-6) } else { (3e-2, 1e-12) };
        near(found[0], 1000.0 * cosine * 15.0 / 16.0, share);
        near(found[1], 1000.0 * cosine, of_board);
        let ledger = &solution.ledger;
        near(ledger.emitted[0], ledger.absorbed[0], 1e-9);
    }
}

fn under(kind: SkyKind, scene: Scene) -> Scene {
    Scene { sky: Some(Sky { radiance: vec![2.0], kind }), ..scene }
}

#[test]
fn a_sky_lights_level_and_upright_surfaces_by_its_closed_forms() {
    let wall = patch("wall", &[[5., -1., 0.], [5., 1., 0.], [5., 1., 2.], [5., -1., 2.]], 0.0, 0.0);
    let tilted = patch("tilted", &[[-9., -1., 0.], [-8., -1., 1.], [-8., 1., 1.], [-9., 1., 0.]], 0.0, 0.0);
    for (kind, level, upright, slope) in [
        (SkyKind::Uniform, PI, PI / 2.0, PI * (1.0 + 0.5f64.sqrt()) / 2.0),
        (SkyKind::Overcast, 7.0 / 9.0 * PI, PI / 6.0 + 4.0 / 9.0, f64::NAN),
    ] {
        for method in [Method::Hierarchical, Method::Shoot] {
            let mut open = under(kind, floor());
            open.patches.push(wall.clone());
            open.patches.push(tilted.clone());
            let black = Scene { patches: vec![open.patches[0].clone()], ..open.clone() };
            near(means(&black, &solved(&black, &by(method)))[0], 2.0 * level, 1e-6);
            let alone = Scene { patches: vec![wall.clone()], ..open.clone() };
            near(means(&alone, &solved(&alone, &by(method)))[0], 2.0 * upright, 1e-6);
            let sloping = Scene { patches: vec![tilted.clone()], ..open.clone() };
            let found = means(&sloping, &solved(&sloping, &by(method)))[0];
            let wanted = if slope.is_nan() { 2.0 * overcast(polygon_normal(&tilted)) } else { 2.0 * slope };
            near(found, wanted, 1e-4);
        }
    }
}

fn polygon_normal(patch: &radiosity::Patch) -> DVec3 {
    patch.polygon.normal()
}

/// The irradiance from a whole overcast sky, by a sum over directions.
fn overcast(normal: DVec3) -> f64 {
    let (rings, parts) = (400, 800);
    let mut sum = 0.0;
    for ring in 0..rings {
        let sine = (f64::from(ring) + 0.5) / f64::from(rings);
        for part in 0..parts {
            let azimuth = 2.0 * PI * (f64::from(part) + 0.5) / f64::from(parts);
            let level = (1.0 - sine * sine).sqrt();
            let way = DVec3::new(level * azimuth.cos(), level * azimuth.sin(), sine);
            sum += (1.0 + 2.0 * sine) / 3.0 * way.dot(normal).max(0.0);
        }
    }
    sum * 2.0 * PI / f64::from(rings * parts)
}

/// No rounding is solved for as if it were light.
#[test]
fn a_sealed_room_is_dark_under_any_sky_and_costs_nothing() {
    let sealed = scene(room([0., 0., 0.], [4., 3., 2.5], 1, 0.5, 0.0));
    let sealed = Scene { asset: Asset { up: DVec3::Y, unit: 1.0 }, ..sealed };
    for kind in [SkyKind::Uniform, SkyKind::Overcast] {
        let options = Options { method: Method::Mesh, ..Options::default() };
        let solution = solved(&under(kind, sealed.clone()), &options);
        assert!(solution.converged && solution.ledger.emitted == [0.0], "{:?}", solution.ledger.emitted);
        assert_eq!(solution.shots, 0);
        let shown = Record::new("sealed", &sealed, &solution).elements.len();
        assert!(2 * shown < 3 * solution.mesh.elements.len(), "{shown} elements are shown");
    }
}

/// A room with a skylight: its ceiling has a hole of side 1 in its middle.
fn skylit(reflectance: f64) -> Scene {
    let mut patches = room([-2., -2., 0.], [2., 2., 3.], 1, reflectance, 0.0);
    let ceiling = patches.pop().expect("a room has a ceiling");
    let outer: Vec<DVec3> = ceiling.polygon.loops().next().expect("an outline").to_vec();
    let hole = [[-0.5, -0.5, 3.], [0.5, -0.5, 3.], [0.5, 0.5, 3.], [-0.5, 0.5, 3.]].map(DVec3::from).to_vec();
    let polygon = radiosity::formfactor::PlanarPolygon::new([outer, hole]).expect("a ceiling with a hole");
    patches.push(radiosity::Patch::new("ceiling", polygon, vec![reflectance], vec![0.0]));
    Scene { asset: Asset { up: DVec3::Z, unit: 1.0 }, ..scene(patches) }
}

#[test]
fn a_skylight_shows_as_much_of_the_sky_as_it_has_of_a_form_factor() {
    let opening = polygon(&[[-0.5, -0.5, 3.], [-0.5, 0.5, 3.], [0.5, 0.5, 3.], [0.5, -0.5, 3.]]);
    for kind in [SkyKind::Uniform, SkyKind::Overcast] {
        let lit = under(kind, skylit(0.0));
        let solution = solved(&lit, &by(Method::Hierarchical));
        let wanted = |place: DVec3| match kind {
            SkyKind::Uniform => {
                let point = DifferentialArea::new(place, DVec3::Z).unwrap();
                2.0 * PI * unoccluded(&point, &opening).value
            }
            SkyKind::Overcast => 2.0 * through(place),
        };
        let vertices = solution.mesh.vertices.iter().zip(solution.vertex_irradiance());
        let on_floor =
            vertices.filter(|(place, _)| place.z == 0.0 && place.x.abs().max(place.y.abs()) < 1.999);
        let mut count = 0;
        for (place, found) in on_floor {
            near(found, wanted(*place), if kind == SkyKind::Uniform { 1e-9 } else { 1e-3 });
            count += 1;
        }
        assert!(count > 3);
    }
}

/// The irradiance of a point of the floor from an overcast sky of 1 at the zenith through the skylight, by a sum over its parts.
fn through(place: DVec3) -> f64 {
    let parts = 60;
    let mut sum = 0.0;
    for (i, j) in (0..parts).flat_map(|i| (0..parts).map(move |j| (i, j))) {
        let [x, y] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(parts) - 0.5);
        let way = DVec3::new(x, y, 3.0) - place;
        let sine = way.z / way.length();
        sum += (1.0 + 2.0 * sine) / 3.0 * sine * sine / way.length_squared();
    }
    sum / f64::from(parts * parts)
}

#[test]
fn a_sky_lights_no_closed_room() {
    let closed = scene(room([0.0; 3], [1.0, 2.0, 3.0], 2, 0.5, 0.0));
    let closed = under(SkyKind::Overcast, closed);
    for method in METHODS {
        let solution = solved(&closed, &by(method));
        assert!(solution.irradiance.iter().all(|h| *h <= 1e-9), "{:?}", solution.irradiance);
    }
}

/// A room with a window to the sky, a lamp and the sun.
fn mixed() -> Scene {
    let mut mixed = under(SkyKind::Uniform, skylit(0.6));
    mixed.patches.push(board(0.4, 0.8));
    mixed.lamps = vec![down("lamp", [0.3, 0.2, 2.0], Distribution::Cone(Cone::LAMBERTIAN), 3.0)];
    mixed.suns =
        vec![Sun { name: "sun".into(), direction: DVec3::new(0.1, 0.2, -1.0), irradiance: vec![20.0] }];
    mixed
}

#[test]
fn all_methods_find_the_same_light_and_their_ledgers_close() {
    let mixed = mixed();
    let exact = solved(&mixed, &Options { error: 5e-3, ..by(Method::Hierarchical) });
    let wanted = means(&mixed, &exact);
    for method in METHODS {
        let solution = solved(&mixed, &Options { elements: 1500, ..by(method) });
        let ledger = &solution.ledger;
        assert!(solution.converged && ledger.defect[0].abs() < 1e-9 * ledger.emitted[0], "{ledger:?}");
        // Elements of the mesh are a fifth as long as what the sun lights: its edges weigh most.
        let allowed = if method == Method::Hierarchical { 0.02 } else { 0.15 };
        for (found, wanted) in means(&mixed, &solution).into_iter().zip(&wanted) {
            assert!((found - wanted).abs() < allowed * wanted, "{method:?} {found} {wanted}");
        }
    }
}

#[test]
fn lights_give_the_same_bits_on_any_number_of_threads() {
    let mixed = mixed();
    for method in [Method::Hierarchical, Method::Shoot] {
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let solution = pool.install(|| solved(&mixed, &by(method)));
            solution.vertex_irradiance().into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(bits(1), bits(3));
    }
}

#[test]
fn a_scene_that_is_turned_with_its_lights_is_as_bright() {
    let (turn, shift) = (DQuat::from_rotation_z(0.7), DVec3::new(5.0, -3.0, 2.0));
    let before = mixed();
    let moved = |place: DVec3| turn * place + shift;
    let mut after = before.clone();
    for patch in &mut after.patches {
        let loops: Vec<Vec<DVec3>> =
            patch.polygon.loops().map(|points| points.iter().map(|p| moved(*p)).collect()).collect();
        patch.polygon = radiosity::formfactor::PlanarPolygon::new(loops).unwrap();
    }
    after.lamps[0].position = moved(after.lamps[0].position);
    after.suns[0].direction = turn * after.suns[0].direction;
    let [one, other] = [&before, &after].map(|scene| means(scene, &solved(scene, &by(Method::Hierarchical))));
    one.into_iter().zip(other).for_each(|(one, other)| near(other, one, 5e-3));
}

#[test]
fn a_unit_of_the_file_scales_lamps_but_not_the_sun() {
    let mut metres = floor();
    metres.lamps = vec![Lamp::even("lamp", DVec3::new(0., 0., 3.), vec![7.0])];
    let mut inches = metres.clone();
    inches.asset.unit = 0.0254;
    let [one, other] = [&metres, &inches].map(|scene| means(scene, &solved(scene, &by(Method::Shoot)))[0]);
    near(other * 0.0254 * 0.0254, one, 1e-12);
}

#[test]
fn lights_that_cannot_shine_are_refused() {
    let refused = |change: fn(&mut Scene)| {
        let mut scene = mixed();
        change(&mut scene);
        let error = radiosity::solve(&scene, &Options::default(), |_| std::ops::ControlFlow::Continue(()));
        error.expect_err("a light that cannot shine").to_string()
    };
    assert!(refused(|scene| scene.lamps[0].position.x = f64::NAN).contains("lamp"));
    assert!(refused(|scene| scene.lamps[0].intensity[0] = -1.0).contains("lamp"));
    assert!(refused(|scene| scene.lamps[0].intensity.push(1.0)).contains("lamp"));
    assert!(refused(|scene| scene.suns[0].direction = DVec3::ZERO).contains("sun"));
    assert!(refused(|scene| scene.suns[0].irradiance[0] = f64::INFINITY).contains("sun"));
    assert!(refused(|scene| scene.sky.as_mut().unwrap().radiance.clear()).contains("sky"));
}
