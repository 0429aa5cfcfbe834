//! Light for a camera.
use crate::build::{patch, scene, solved};
use crate::levels::{furnished, options};
use radiosity::formfactor::PlanarPolygon;
use radiosity::{Camera, Error, Options, Scene, glam::DVec3, solve};
use std::ops::ControlFlow;

/// A square picture.
fn camera(position: [f64; 3], toward: [f64; 3], degrees: f64) -> Camera {
    let position = DVec3::from(position);
    Camera {
        name: "eye".into(),
        position,
        direction: DVec3::from(toward) - position,
        up: DVec3::Z,
        vertical_fov: degrees.to_radians(),
        aspect: 1.0,
    }
}

/// The names of the patches in view.
fn seen(scene: &Scene, camera: Camera) -> Vec<String> {
    let solution = solved(scene, &Options { for_camera: Some(camera), ..options(0.3) });
    let in_view = solution.in_view.expect("it was for a camera");
    let seen = scene.patches.iter().zip(in_view).filter(|(_, is_seen)| *is_seen);
    seen.map(|(patch, _)| patch.name.clone()).collect()
}

/// Two plates, one behind the other, and one beside them: what is hidden, outside of the picture, or turned away is not in view.
#[test]
fn a_camera_sees_what_is_within_its_picture_and_not_hidden() {
    let plate = |name: &str, x: f64, y: f64, half: f64, is_turned: bool| {
        let mut corners =
            vec![[x - half, y, -half], [x + half, y, -half], [x + half, y, half], [x - half, y, half]];
        if is_turned {
            corners.reverse();
        }
        patch(name, &corners, 0.5, 1.0)
    };
    let mut scene = scene(vec![
        plate("near", 0.0, 2.0, 0.5, false),
        plate("hidden", 0.0, 3.0, 0.7, false),
        plate("beside", 5.0, 3.0, 1.0, false),
        plate("turned", -1.0, 2.0, 0.3, true),
        plate("rim", 2.0, 3.0, 0.9, false),
    ]);
    let eye = || camera([0.0; 3], [0.0, 1.0, 0.0], 60.0);
    // The picture reaches to y tan 30°: 1.73 at 3, which the plate at the rim begins at 1.1.
    assert_eq!(seen(&scene, eye()), ["near", "rim"]);
    scene.patches[1] = plate("wider", 0.0, 3.0, 0.8, false);
    assert_eq!(seen(&scene, eye()), ["near", "wider", "rim"]);
    // From outside, through the back of a wall, as pictures show it.
    let within = seen(&furnished(), camera([1.5, -5.0, 1.0], [1.5, 0.0, 1.0], 60.0));
    assert!(within.iter().any(|name| name.starts_with("block-")), "{within:?}");
    for blind in [camera([0.0; 3], [0.0, -1.0, 0.0], 60.0), camera([0.0; 3], [0.0, 0.0, 1.0], 60.0)] {
        let options = Options { for_camera: Some(blind), ..options(0.3) };
        let refused = solve(&scene, &options, |_| ControlFlow::Continue(()));
        assert!(matches!(refused, Err(Error::Camera { .. })), "{refused:?}");
    }
}

/// Two rooms without a door: a camera in the one needs nothing of the other.
#[test]
fn what_a_camera_sees_is_as_right_as_in_a_run_for_all() {
    let mut scene = furnished();
    let mut other = furnished();
    for patch in &mut other.patches {
        let moved: Vec<DVec3> =
            patch.polygon.loops().flatten().map(|corner| *corner + 10.0 * DVec3::X).collect();
        patch.polygon = PlanarPolygon::new([moved]).unwrap();
        patch.name.insert_str(0, "other-");
    }
    scene.patches.extend(other.patches);
    let fine = solved(&scene, &options(0.012));
    let [whole, part] = [None, Some(camera([2.9, 1.0, 1.0], [0.0, 1.0, 0.8], 90.0))]
        .map(|for_camera| solved(&scene, &Options { for_camera, ..options(0.04) }));
    let in_view = part.in_view.as_ref().unwrap();
    assert!(whole.in_view.is_none() && part.converged);
    assert!(
        !in_view.iter().zip(&scene.patches).any(|(seen, patch)| *seen && patch.name.starts_with("other"))
    );
    assert!(part.mesh.elements.len() * 3 < 2 * whole.mesh.elements.len());
    let count = scene.patches.len();
    let [means, finer] = [&part, &fine].map(|solution| solution.patch_means(&solution.irradiance, count));
    for index in (0..count).filter(|index| in_view[*index]) {
        let off = (means[index][0] - finer[index][0]).abs();
        let allowed = part.patch_estimate(index)[0] + fine.patch_estimate(index)[0];
        assert!(off <= allowed, "{}: {off} {allowed}", scene.patches[index].name);
        assert!(part.patch_estimate(index)[0] <= 0.04 * means[index][0]);
    }
}
