//! What paths are traced in.
use radiosity::{Patch, Scene};
use tests::light::{Bands, Surface};

/// The patches of a scene, in its order.
pub(crate) fn surfaces(scene: &Scene) -> Vec<Surface> {
    scene.patches.iter().map(surface).collect()
}

fn surface(patch: &Patch) -> Surface {
    let bands = |values: &[f64]| -> Bands { [0, 1, 2].map(|band| values[band.min(values.len() - 1)]) };
    Surface {
        name: patch.name.clone(),
        loops: patch.polygon.loops().map(<[_]>::to_vec).collect(),
        reflectance: bands(&patch.reflectance),
        radiance: bands(&patch.emission),
    }
}
