//! Pictures of scenes whose pixels are known.
use radiosity::expose::{Exposure, srgb};
use radiosity::formfactor::PlanarPolygon;
use radiosity::glam::DVec3;
use radiosity::picture::{LinearFormat, draw};
use radiosity::{Camera, Element, Mesh, Patch, Quality, Record, Scene};

/// Looks from the origin along −z, 90 degrees high.
fn camera(aspect: f64) -> Camera {
    Camera {
        name: "eye".into(),
        position: DVec3::ZERO,
        direction: DVec3::NEG_Z,
        up: DVec3::Y,
        vertical_fov: std::f64::consts::FRAC_PI_2,
        aspect,
    }
}

/// Quads of four corners each, counter-clockwise seen from their fronts.
fn quads(corners: &[[[f64; 3]; 4]]) -> Mesh {
    let mut mesh = Mesh::default();
    for (patch, quad) in corners.iter().enumerate() {
        let first = mesh.vertices.len();
        mesh.vertices.extend(quad.map(DVec3::from));
        let triangles = [[0, 1, 2], [0, 2, 3]];
        mesh.elements
            .extend(triangles.map(|picks| Element { patch, corners: picks.map(|pick| first + pick) }));
    }
    mesh
}

/// A square of half side `half` at depth `depth`, facing the eye.
fn square(half: f64, depth: f64) -> [[f64; 3]; 4] {
    [[-half, -half, -depth], [half, -half, -depth], [half, half, -depth], [-half, half, -depth]]
}

struct Pixels {
    width: usize,
    height: usize,
    bytes: Vec<u8>,
}

impl Pixels {
    fn at(&self, x: usize, y: usize) -> [u8; 3] {
        let start = 3 * (y * self.width + x);
        self.bytes[start..start + 3].try_into().unwrap()
    }
}

fn drawn(mesh: &Mesh, radiosity: &[[f64; 3]], aspect: f64, width: u32) -> Pixels {
    let file = draw(mesh, radiosity, &camera(aspect), Exposure::new(1.0).unwrap(), width);
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.color_type, info.bit_depth), (png::ColorType::Rgb, png::BitDepth::Eight));
    let (width, height) = (usize::try_from(info.width).unwrap(), usize::try_from(info.height).unwrap());
    Pixels { width, height, bytes }
}

/// The byte of a radiosity at K = 1.
fn byte(radiosity: f64) -> f64 {
    255.0 * srgb(1.0 - (-radiosity).exp())
}

#[test]
fn a_wall_of_one_radiosity_is_of_one_colour_without_cracks() {
    // A grid of quads whose corners are no round numbers, wider than the picture.
    let place = |i: i32| 3.0 * f64::from(i) / 13.0;
    let quad = |i: i32, j: i32| {
        let (x, y, x1, y1) = (place(i), place(j), place(i + 1), place(j + 1));
        [[x, y, -1.0 - 0.1 * x], [x1, y, -1.0 - 0.1 * x1], [x1, y1, -1.0 - 0.1 * x1], [x, y1, -1.0 - 0.1 * x]]
    };
    let all: Vec<_> = (-13..13).flat_map(|i| (-13..13).map(move |j| quad(i, j))).collect();
    let mesh = quads(&all);
    let pixels = drawn(&mesh, &vec![[0.5, 1.0, 2.0]; mesh.vertices.len()], 2.0, 128);
    assert_eq!((pixels.width, pixels.height), (128, 64));
    // The largest part decides how bright it is; the others keep their shares of it.
    let expected = [0.25, 0.5, 1.0].map(|share| {
        let intensity = share * (1.0 - (-2.0_f64).exp());
        format!("{:.0}", 255.0 * srgb(intensity)).parse::<u8>().unwrap()
    });
    assert!((0..64).all(|y| (0..128).all(|x| pixels.at(x, y) == expected)));
}

#[test]
fn a_square_covers_what_perspective_says() {
    // Half side 1 at depth 2 under 90 degrees: the middle half of the picture, to the pixel.
    let pixels = drawn(&quads(&[square(1.0, 2.0)]), &[[50.0; 3]; 4], 1.0, 64);
    for (x, y) in (0..64).flat_map(|x| (0..64).map(move |y| (x, y))) {
        let inside = (16..48).contains(&x) && (16..48).contains(&y);
        assert_eq!(pixels.at(x, y), if inside { [255; 3] } else { [0; 3] }, "{x} {y}");
    }
}

#[test]
fn edges_are_smoothed_by_the_covered_share() {
    // The right edge at a quarter, a half, three quarters of pixel column 48.
    for quarter in 1..4 {
        let half = 1.0 + f64::from(quarter) / 4.0 / 16.0;
        let pixels = drawn(&quads(&[square(half, 2.0)]), &[[50.0; 3]; 4], 1.0, 64);
        let expected = 255.0 * srgb(f64::from(quarter) / 4.0);
        assert!(
            (f64::from(pixels.at(48, 32)[0]) - expected).abs() < 1.0,
            "{quarter}: {:?}",
            pixels.at(48, 32)
        );
    }
}

#[test]
fn the_nearer_surface_hides_the_other_in_either_order() {
    let (near, far) = (square(1.0, 2.0), square(3.0, 3.0));
    for (order, colours) in [([near, far], [50.0, 0.1]), ([far, near], [0.1, 50.0])] {
        let light: Vec<[f64; 3]> = colours.iter().flat_map(|colour| [[*colour; 3]; 4]).collect();
        let pixels = drawn(&quads(&order), &light, 1.0, 64);
        assert_eq!(pixels.at(32, 32), [255; 3]);
        assert!((f64::from(pixels.at(2, 2)[0]) - byte(0.1)).abs() < 1.0);
    }
}

#[test]
fn surfaces_are_not_seen_from_behind_nor_behind_the_eye() {
    let mut back = square(1.0, 2.0);
    back.reverse();
    let mut behind = square(1.0, -2.0);
    for quad in [back, behind] {
        assert!(drawn(&quads(&[quad]), &[[50.0; 3]; 4], 1.0, 16).bytes.iter().all(|byte| *byte == 0));
    }
    behind.reverse();
    assert!(drawn(&quads(&[behind]), &[[50.0; 3]; 4], 1.0, 16).bytes.iter().all(|byte| *byte == 0));
}

/// A floor under the eye that runs from behind it to far away: no clipping is needed, and interpolation is in space, not
/// on the screen.
#[test]
fn a_floor_that_passes_under_the_eye_is_interpolated_in_space() {
    let floor = [[-50.0, -1.0, 10.0], [50.0, -1.0, 10.0], [50.0, -1.0, -90.0], [-50.0, -1.0, -90.0]];
    let light = [[0.0; 3], [0.0; 3], [2.0; 3], [2.0; 3]];
    let pixels = drawn(&quads(&[floor]), &light, 1.0, 200);
    for y in 110..200 {
        // Through the pixel's middle the ray goes down by `slope` per unit of depth, and meets the floor at depth 1/slope.
        let slope = (f64::from(u32::try_from(y).unwrap()) + 0.5 - 100.0) / 100.0;
        let radiosity = 2.0 * (10.0 + 1.0 / slope) / 100.0;
        for x in [3, 100, 190] {
            let found = f64::from(pixels.at(x, y)[0]);
            assert!((found - byte(radiosity)).abs() < 1.5, "{x} {y}: {found} {}", byte(radiosity));
        }
    }
    assert!((0..95).all(|y| pixels.at(100, y) == [0; 3]));
}

#[test]
fn the_number_of_threads_does_not_change_a_byte() {
    let mesh = quads(&[square(1.0, 2.0), square(1.3, 2.5), square(7.0, 7.1)]);
    let light: Vec<[f64; 3]> = (0..12).map(|i| [f64::from(i), 1.0, 0.3]).collect();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&mesh, &light, &camera(1.3), Exposure::new(0.7).unwrap(), 150))
    };
    assert_eq!(with(1), with(2));
    assert_eq!(with(1), with(5));
}

#[test]
fn extreme_sizes_are_kept_in_range() {
    let mesh = quads(&[square(1.0, 2.0)]);
    assert_eq!(drawn(&mesh, &[[1.0; 3]; 4], 1e-9, 1).height, 16_384);
    assert_eq!(drawn(&mesh, &[[1.0; 3]; 4], 1e9, 0).height, 1);
}

/// In a furnace the radiosity is 1 everywhere, so that the radiance of every pixel is 1 / π.
#[test]
fn linear_pictures_hold_radiance() {
    let scene = radiosity::scenes::scene("furnace").unwrap();
    let solution =
        radiosity::solve(&scene, &Quality::Draft.options(), |_| std::ops::ControlFlow::Continue(())).unwrap();
    let record = Record::new("furnace", &scene, &solution);
    let camera = record.camera(None).unwrap();
    for (format, kind, off) in [
        (LinearFormat::Exr, image::ImageFormat::OpenExr, 1e-2),
        (LinearFormat::Hdr, image::ImageFormat::Hdr, 2e-2),
    ] {
        let bytes = record.draw_linear(&camera, format, 40).unwrap();
        let pixels = image::load_from_memory_with_format(&bytes, kind).unwrap().into_rgb32f();
        assert_eq!(pixels.dimensions(), (40, 30));
        let wanted = std::f64::consts::FRAC_1_PI;
        assert!(pixels.iter().all(|part| (f64::from(*part) / wanted - 1.0).abs() < off), "{format:?}");
    }
}

/// A dark room, of which the camera sees none, does not make what it sees white.
#[test]
fn what_a_camera_does_not_see_does_not_change_its_exposure() {
    let mut scene = Scene { bands: 1, ..Scene::default() };
    let square = |name: &str, z: f64, emission: f64| {
        let corners = [[-1.0, -1.0, z], [1.0, -1.0, z], [1.0, 1.0, z], [-1.0, 1.0, z]];
        Patch::new(name, PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![emission])
    };
    let lamp = [[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [-1.0, -1.0, 1.0]];
    let lamp = Patch::new("lamp", PlanarPolygon::new([lamp]).unwrap(), vec![0.0], vec![10.0]);
    scene.patches = vec![square("seen", -1.0, 0.0), lamp];
    let exposure = |scene: &Scene| {
        let options = Quality::Draft.options();
        let solution = radiosity::solve(scene, &options, |_| std::ops::ControlFlow::Continue(())).unwrap();
        Record::new("squares", scene, &solution).exposure_for(&camera(1.0)).k()
    };
    let alone = exposure(&scene);
    scene.patches.extend((0..20).map(|at| square(&format!("hidden-{at}"), -10.0 - f64::from(at), 1e-17)));
    let beside = exposure(&scene);
    assert!((beside / alone - 1.0).abs() < 0.02, "{alone} {beside}");
}
