//! The sources' scenes: fresh, and what they say they are.
use crate::samples::{names, scene};
use radiosity::glam::DVec3;
use radiosity::{Patch, Scene, scenes};

fn cornell() -> Scene {
    scene(&scenes::write_scene("cornell-box").unwrap())
}

#[test]
fn the_committed_files_are_what_the_code_writes() {
    let folder = format!("{}/scenes", env!("CARGO_MANIFEST_DIR"));
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let files: Vec<_> = files.filter(|path| path.extension().is_some_and(|kind| kind == "dae")).collect();
    assert!(!files.is_empty());
    for path in files {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let written = scenes::write_scene(name).unwrap();
        let fresh = std::fs::read_to_string(&path).unwrap() == written;
        assert!(fresh, "{0} is stale: cargo run --release -- scene {name} -o {0}", path.display());
    }
    assert!(scenes::write_scene("no such scene").is_none());
    assert!(scenes::write_scene("furnace-1").is_none());
}

#[test]
fn every_scene_is_read_without_a_word_and_has_its_patches() {
    let patches = [
        ("cornell-box", 17),
        ("cornell-76", 17),
        ("cornell-3842", 3842),
        ("emission", 1 + 1 + 100),
        ("obstruction", 104),
        ("beams", 1 + 1 + 8 * 6),
        ("small-occluders", 1 + 1 + 25),
        ("perforated", 3),
        ("perforated-cut", 1 + 1 + 12),
        ("wall", 3),
        ("chessboard", 1 + 2 + 80),
        ("furnace", 6),
        ("cube", 216),
        ("separating-wall", 9),
        ("colour-bleeding", 6),
        ("sphere-lamp", 81),
    ];
    assert!(scenes::names().eq(patches.iter().map(|(name, _)| *name)));
    for (name, count) in patches {
        let scene = scenes::scene(name).unwrap();
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
        assert_eq!((scene.patches.len(), scene.cameras.len()), (count, 1), "{name}");
        assert!(scene.patches.iter().any(|patch| patch.emits()), "{name} is dark");
    }
}

/// The sum of the areas, as vectors along the normals: zero for a closed surface.
fn area_vector<'p>(patches: impl Iterator<Item = &'p Patch>) -> DVec3 {
    patches.map(|patch| patch.polygon.area() * patch.polygon.normal()).sum()
}

#[test]
fn closed_surfaces_are_closed() {
    for (name, part) in [
        ("beams", "lower-1"),
        ("beams", "upper-4"),
        ("furnace", ""),
        ("cube", ""),
        ("colour-bleeding", ""),
        ("sphere-lamp", "lamp"),
        ("chessboard", "lamp"),
    ] {
        let scene = scenes::scene(name).unwrap();
        let vector = area_vector(scene.patches.iter().filter(|patch| patch.name.starts_with(part)));
        assert!(vector.length() < 1e-12, "{name}, {part}: {vector}");
    }
}

#[test]
fn a_lamp_of_one_polygon_and_one_of_a_hundred_have_the_same_area() {
    let scene = scenes::scene("emission").unwrap();
    let area = |lamp: &str| -> f64 {
        let part = scene.patches.iter().filter(|patch| patch.name.starts_with(lamp));
        part.map(|patch| patch.polygon.area()).sum()
    };
    assert!((area("lamp-left") - area("lamp-right")).abs() < 1e-12);
}

#[test]
fn both_panels_cover_the_same_points() {
    let areas = ["perforated", "perforated-cut"].map(|name| {
        let scene = scenes::scene(name).unwrap();
        let panel = scene.patches.iter().filter(|patch| patch.name.starts_with("panel"));
        panel.map(|patch| patch.polygon.area()).sum::<f64>()
    });
    assert!(areas.iter().all(|area| (area - (7.07 * 7.07 - 9.0 * 1.44)).abs() < 1e-12), "{areas:?}");
}

#[test]
fn beams_rise_as_stated_and_clear_each_other() {
    let scene = scenes::scene("beams").unwrap();
    let heights = |part: &str| {
        let patches = scene.patches.iter().filter(move |patch| patch.name.starts_with(part));
        let points = patches.flat_map(|patch| patch.polygon.loops().flatten().map(|point| point.z));
        points.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)))
    };
    assert_eq!(heights("lower"), (0.5, 2.8));
    assert_eq!(heights("upper"), (3.0, 4.8));
}

#[test]
fn the_furnace_emits_what_it_does_not_reflect() {
    for (name, reflectance) in [("furnace", 0.5), ("furnace-0.999999", 0.999_999)] {
        for patch in scenes::scene(name).unwrap().patches {
            assert_eq!(patch.reflectance, [reflectance; 3]);
            assert!(
                patch.emission.iter().all(|l| (l * std::f64::consts::PI - (1.0 - reflectance)).abs() < 1e-15)
            );
        }
    }
}

#[test]
fn the_cornell_box_has_its_patches_in_order() {
    let expected = [
        "floor",
        "ceiling",
        "back",
        "right",
        "left.1",
        "left.2",
        "light",
        "short-top",
        "short-1",
        "short-2",
        "short-3",
        "short-4",
        "tall-top",
        "tall-1",
        "tall-2",
        "tall-3",
        "tall-4",
    ];
    let scene = cornell();
    assert_eq!(names(&scene), expected);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn the_spectra_are_the_published_ones_and_look_like_their_colours() {
    let scene = scenes::scene("cornell-76").unwrap();
    assert_eq!((scene.bands, scene.wavelengths.len()), (76, 76));
    assert_eq!([scene.wavelengths[0], scene.wavelengths[75]], [400.0, 700.0]);
    let patch = |name: &str| scene.patches.iter().find(|patch| patch.name == name).unwrap();
    let [white, red, green] = ["floor", "left.1", "right"].map(|name| &patch(name).reflectance);
    assert_eq!(
        [white[0], white[75], red[0], red[75], green[0], green[75]],
        [0.343, 0.737, 0.04, 0.642, 0.092, 0.159]
    );
    // 400, 500, 600 and 700 nm, and halfway from 500 to 600.
    let light = &patch("light").emission;
    for (band, radiance) in [(0, 0.0), (25, 8.0), (50, 15.6), (75, 18.4)] {
        assert!((light[band] - radiance).abs() < 1e-12, "band {band}: {}", light[band]);
    }
    assert!((light[37] - (8.0 + 7.6 * 0.48)).abs() < 1e-12);
    // Other programs see the red, the green and the white.
    let text = scenes::write_scene("cornell-76").unwrap();
    let plain = text.split("<extra>").map(|part| part.rsplit("</extra>").next().unwrap()).collect::<String>();
    let plain = self::scene(&plain);
    let colour =
        |name: &str| plain.patches.iter().find(|patch| patch.name == name).unwrap().reflectance.clone();
    let [white, red, green] = ["floor", "left.1", "right"].map(colour);
    assert!(red[0] > 3.0 * red[1] && red[0] > 3.0 * red[2], "{red:?}");
    assert!(green[1] > 2.0 * green[2] && green[1] > 1.5 * green[0], "{green:?}");
    assert!(white.iter().all(|band| (0.6..0.8).contains(band)), "{white:?}");
}

#[test]
fn the_ceiling_is_open_where_the_lamp_is() {
    let scene = cornell();
    let (ceiling, light) = (&scene.patches[1].polygon, &scene.patches[6].polygon);
    assert_eq!(ceiling.loops().count(), 2);
    assert_eq!(light.area(), 130.0 * 105.0);
    assert!((ceiling.area() + light.area() - 556.0 * 559.2).abs() < 1e-9);
}

#[test]
fn walls_face_into_the_room_and_blocks_out_of_themselves() {
    let scene = cornell();
    let middle_of = |names: &str| {
        let block = scene.patches.iter().filter(|patch| patch.name.starts_with(names));
        let points: Vec<DVec3> = block.flat_map(|patch| patch.polygon.loops().flatten().copied()).collect();
        points.iter().sum::<DVec3>() / f64::from(u32::try_from(points.len()).unwrap())
    };
    for patch in &scene.patches {
        let corner = patch.polygon.loops().next().unwrap()[0];
        let (outward, middle) = match patch.name.as_str() {
            name if name.starts_with("short") => (true, middle_of("short")),
            name if name.starts_with("tall") => (true, middle_of("tall")),
            _ => (false, DVec3::new(278.0, 270.0, 280.0)),
        };
        assert_eq!(patch.polygon.normal().dot(corner - middle) > 0.0, outward, "{}", patch.name);
    }
}

#[test]
fn the_cornell_camera_and_lamp_are_the_published_ones() {
    let scene = cornell();
    let camera = &scene.cameras[0];
    assert_eq!(camera.position, DVec3::new(278.0, 273.0, -800.0));
    assert_eq!((camera.direction, camera.up, camera.aspect), (DVec3::Z, DVec3::Y, 1.0));
    assert!(((camera.vertical_fov / 2.0).tan() - 0.0125 / 0.035).abs() < 1e-10);
    assert_eq!(scene.patches[6].emission, [17.0, 12.0, 4.0]);
    assert_eq!(scene.patches[4].reflectance, [0.63, 0.065, 0.05]);
}
