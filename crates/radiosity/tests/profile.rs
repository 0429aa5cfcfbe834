//! Radiosity along a line: laws that hold on every mesh.
#![allow(clippy::unwrap_used, reason = "a test that cannot unwrap has failed")]
use radiosity::glam::DVec3;
use radiosity::profile::{Profile, ProfileError, profile};
use radiosity::{Method, Options, Record, scenes, solve};
use std::ops::ControlFlow;

/// A solution of a built-in scene, of so many elements.
fn solved(name: &str, elements: usize) -> Record {
    let scene = scenes::scene(name).unwrap();
    let options = Options::mesh(elements);
    let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap();
    Record::new(name, &scene, &solution)
}

/// The same mesh with a value at every place: the interpolated radiosity of each vertex, the element's own at its centroid.
fn painted(record: &Record, value: impl Fn(DVec3) -> f64) -> Record {
    let mesh = record.mesh();
    let spread = |value: f64| std::iter::repeat_n(value, record.bands);
    let vertex_radiosity = record.vertices.iter().flat_map(|place| spread(value(*place))).collect();
    let own = (0..mesh.elements.len()).flat_map(|element| spread(value(mesh.centroid(element))));
    Record { vertex_radiosity, radiosity: own.collect(), ..record.clone() }
}

/// How far the crossings are from covering the line once, in order.
fn assert_covers(profile: &Profile) {
    let length = profile.ends[0].distance(profile.ends[1]);
    let mut last = 0.0;
    for crossing in &profile.crossings {
        let [from, to] = [0, 1].map(|end| crossing.ends[end].distance);
        assert!((from - last).abs() < 1e-9 * length && to > from, "{from} after {last}");
        last = to;
    }
    assert!((last - length).abs() < 1e-9 * length, "{last} of {length}");
}

#[test]
fn every_line_across_a_floor_is_covered_once_and_what_is_linear_stays_so() {
    let record = solved("cornell-box", 900);
    let value = |place: DVec3| 2.0 + place.dot(DVec3::new(0.003, 0.0, -0.001));
    let painted = painted(&record, value);
    for index in 0..60 {
        let [a, b] = [index, index + 7]
            .map(|k| DVec3::new(f64::from(k * 73 % 540) + 3.0, 0.0, f64::from(k * 131 % 550)));
        let found = profile(&painted, [a, b], None).unwrap();
        assert_covers(&found);
        for crossing in &found.crossings {
            assert_eq!(crossing.patch, "floor");
            for end in &crossing.ends {
                assert!((end.radiosity[0] - value(end.place)).abs() < 1e-9, "{end:?}");
                assert!((end.place - a).length() - end.distance < 1e-9);
            }
        }
    }
}

#[test]
fn a_line_back_is_the_line_there_reversed() {
    let record = solved("cornell-box", 700);
    let [a, b] = [DVec3::new(11.0, 0.0, 20.0), DVec3::new(500.0, 0.0, 400.0)];
    let [there, back] = [[a, b], [b, a]].map(|ends| profile(&record, ends, None).unwrap());
    assert_eq!(there.crossings.len(), back.crossings.len());
    let length = a.distance(b);
    for (one, other) in there.points().zip(back.points().collect::<Vec<_>>().into_iter().rev()) {
        assert!((one.distance + other.distance - length).abs() < 1e-9 * length);
        assert!((one.radiosity[0] - other.radiosity[0]).abs() < 1e-9);
    }
}

#[test]
fn along_edges_of_elements_every_place_is_told_once() {
    let record = solved("furnace", 300);
    for element in &record.elements {
        let [a, b] = [element[1], element[2]].map(|corner| record.vertices[corner]);
        let name = &record.patches[element[0]].name;
        let found = profile(&record, [a, b], Some(name)).unwrap();
        assert_covers(&found);
        assert!(found.points().all(|point| (point.radiosity[0] - 1.0).abs() < 1e-3));
    }
}

#[test]
fn a_line_goes_on_over_patches_of_one_plane() {
    // A cube of 36 patches a side.
    let cube = solved("cube", 1);
    let found = profile(&cube, [DVec3::new(0.01, 0.02, 0.0), DVec3::new(0.97, 0.88, 0.0)], None).unwrap();
    assert_covers(&found);
    let mut names: Vec<&str> = found.crossings.iter().map(|crossing| crossing.patch.as_str()).collect();
    names.dedup();
    assert!(names.len() > 6, "{names:?}");
    let off = [DVec3::new(0.1, 0.1, 0.1), DVec3::new(0.9, 0.1, 0.2)];
    assert_eq!(profile(&cube, off, None), Err(ProfileError::Beside { on: "any patch".to_owned() }));
}

#[test]
fn ends_beside_the_surface_leave_a_gap_and_ends_a_little_off_it_do_not_matter() {
    let record = solved("furnace", 100);
    let [a, b] = [DVec3::new(-0.5, 0.25, 0.0), DVec3::new(0.5, 0.25, 0.0)];
    let found = profile(&record, [a, b], None).unwrap();
    let start = &found.crossings[0].ends[0];
    assert!((start.distance - 0.5).abs() < 1e-9 && start.place.x.abs() < 1e-9);
    let near = profile(&record, [a + DVec3::Z * 5e-7, b - DVec3::Z * 5e-7], None).unwrap();
    assert_eq!(near.crossings.len(), found.crossings.len());
    let off = profile(&record, [a + DVec3::Z * 1e-3, b], Some("floor"));
    assert!(matches!(off, Err(ProfileError::Off { distance, .. }) if (distance - 1e-3).abs() < 1e-9));
}

#[test]
fn a_line_without_length_or_without_ends_is_refused() {
    let record = solved("furnace", 12);
    let [here, far] = [DVec3::new(0.5, 0.5, 0.0), DVec3::splat(f64::MAX)];
    for ends in [[here, here], [here, DVec3::NAN], [DVec3::INFINITY, here], [far, -far]] {
        assert_eq!(profile(&record, ends, None), Err(ProfileError::Ends), "{ends:?}");
    }
    let unknown = profile(&record, [here, DVec3::X], Some("no such patch"));
    assert_eq!(unknown, Err(ProfileError::Patch { name: "no such patch".to_owned() }));
}

#[test]
fn a_line_on_two_surfaces_is_refused_until_one_is_named() {
    let record = solved("furnace", 100);
    let edge = [DVec3::ZERO, DVec3::X];
    let Err(ProfileError::Two { first, second }) = profile(&record, edge, None) else {
        panic!("an edge lies on two")
    };
    assert_ne!(first, second);
    for name in [first, second] {
        assert_covers(&profile(&record, edge, Some(&name)).unwrap());
    }
}

#[test]
fn what_light_may_be_off_by_is_a_band_in_the_drawing_and_columns_in_the_table() {
    let scene = scenes::scene("cornell-box").unwrap();
    let options = Options { method: Method::Hierarchical, error: 0.1, ..Options::default() };
    let solution = solve(&scene, &options, |_| ControlFlow::Continue(())).unwrap();
    let record = Record::new("cornell-box", &scene, &solution);
    let ends = [DVec3::new(10.0, 0.0, 280.0), DVec3::new(540.0, 0.0, 280.0)];
    let found = profile(&record, ends, None).unwrap();
    let floor = record.patches.iter().position(|patch| patch.name == "floor").unwrap();
    for crossing in &found.crossings {
        for band in 0..3 {
            let wanted = solution.patch_estimate(floor)[band] * record.patches[floor].reflectance[band];
            assert!((crossing.estimate[band] - wanted).abs() < 1e-12 * wanted && wanted > 0.0);
        }
    }
    let table = found.csv();
    assert!(table.lines().next().unwrap().ends_with("element_radiosity.2,estimate.0,estimate.1,estimate.2"));
    let drawing = found.svg();
    assert_eq!(drawing.matches("class=\"estimate\"").count(), 3);
    roxmltree::Document::parse(&drawing).unwrap();
    let plain = profile(&solved("cornell-box", 100), ends, None).unwrap();
    assert!(!plain.csv().contains("estimate") && !plain.svg().contains("estimate"));
    let mut mixed = record;
    mixed.patches[1].estimate.clear();
    assert!(mixed.check().is_err(), "estimates of some patches only");
}

#[test]
fn under_a_block_the_floor_is_dark_and_the_table_says_where() {
    let record = solved("cornell-box", 2000);
    // Through the short block's footprint: 130 65, 82 225, 240 272, 290 114 in x and z.
    let found =
        profile(&record, [DVec3::new(185.0, 0.0, 10.0), DVec3::new(185.0, 0.0, 350.0)], None).unwrap();
    let dark = found.crossings.iter().filter(|crossing| crossing.radiosity[0] < 1e-12);
    let [from, to] = dark.fold([f64::INFINITY, 0.0_f64], |[low, high], crossing| {
        [low.min(crossing.ends[0].place.z), high.max(crossing.ends[1].place.z)]
    });
    // Where the footprint's edges cross x = 185.
    let [near, far] = [65.0 + 49.0 * 55.0 / 160.0, 225.0 + 47.0 * 103.0 / 158.0];
    assert!((from - near).abs() < 1e-6 && (to - far).abs() < 1e-6, "{from} {to}: {near} {far}");
    let table = found.csv();
    assert_eq!(table.lines().count(), 1 + 2 * found.crossings.len());
    assert!(table.lines().nth(1).unwrap().starts_with("0,185,0,10,floor,"), "{table}");
    let drawing = found.svg();
    let document = roxmltree::Document::parse(&drawing).unwrap();
    let drawn = document.descendants().filter(|node| node.attribute("class") == Some("interpolated")).count();
    assert_eq!(drawn, 3);
}
