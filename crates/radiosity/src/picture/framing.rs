//! A camera for scenes that have none.
use crate::scene::camera::Camera;
use glam::DVec3;

/// A camera that sees all of the box between two corners, from the front and somewhat from the right and from above.
///
/// The front is −y where z is up, else +z. The vertical field of view is 40 degrees, the aspect 4:3.
#[must_use]
pub fn framing([low, high]: [DVec3; 2], up: DVec3) -> Camera {
    let (centre, radius) = (low.midpoint(high), (high - low).length() / 2.0);
    let front = if up.z > 0.0 { DVec3::NEG_Y } else { DVec3::Z };
    let toward_viewer = (front + 0.5 * up.cross(front) + 0.4 * up).normalize();
    let vertical_fov = 40_f64.to_radians();
    let distance = radius / (vertical_fov / 2.0).sin();
    Camera {
        name: "framing".into(),
        position: centre + distance * toward_viewer,
        direction: -toward_viewer,
        up,
        vertical_fov,
        aspect: 4.0 / 3.0,
    }
}
