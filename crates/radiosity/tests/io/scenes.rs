//! The sources' scenes: fresh, and what they say they are.
use crate::samples::{names, scene};
use radiosity::glam::DVec3;
use radiosity::{Scene, scenes};

fn cornell() -> Scene {
    scene(&scenes::write_scene("cornell-box").unwrap())
}

#[test]
fn the_committed_files_are_what_the_code_writes() {
    for name in scenes::names() {
        let path = format!("{}/scenes/{name}.dae", env!("CARGO_MANIFEST_DIR"));
        let committed = std::fs::read_to_string(&path).unwrap_or_default();
        let written = scenes::write_scene(name).unwrap();
        assert!(committed == written, "{path} is stale: cargo run --release -- scene {name} -o {path}");
    }
    assert!(scenes::write_scene("no such scene").is_none());
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
