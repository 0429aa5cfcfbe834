//! Solutions beside path tracing.
use radiosity::formfactor::{self, PlanarPolygon};
use radiosity::{Patch, Scene, Solution};
use tests::light::{Estimate, Surface};

/// Errors are in shares of a face's own mean or, where that is more, of this share of the mean of all that are compared.
const DARK: f64 = 0.01;

/// The scene that some surfaces make.
pub(crate) fn scene(surfaces: &[Surface]) -> Result<Scene, formfactor::Error> {
    let patch = |surface: &Surface| {
        let polygon = PlanarPolygon::new(&surface.loops)?;
        Ok(Patch::new(&surface.name, polygon, surface.reflectance.to_vec(), surface.radiance.to_vec()))
    };
    let patches = surfaces.iter().map(patch).collect::<Result<_, _>>()?;
    Ok(Scene { patches, bands: 3, ..Scene::default() })
}

/// The errors of the mean irradiance of some of all faces in each band, three standard errors of the path tracer taken off; each with its face, and
/// whether what the solution says of it is less.
pub(crate) fn errors(
    solution: &Solution,
    all: usize,
    faces: &[usize],
    references: &[[Estimate; 3]],
) -> Vec<(f64, usize, bool)> {
    let means = solution.patch_means(&solution.irradiance, all);
    let whole =
        |band: usize| references.iter().map(|face| face[band].mean).sum::<f64>() / references.len() as f64;
    let error = |face: usize, reference: &[Estimate; 3], band: usize| {
        let Estimate { mean, error } = reference[band];
        let off = ((means[face][band] - mean).abs() - 3.0 * error).max(0.0);
        let is_low = solution.estimate.is_some() && solution.patch_estimate(face)[band] < off;
        (off / mean.max(DARK * whole(band)), face, is_low)
    };
    let of_face =
        |(face, reference): (&usize, &[Estimate; 3])| [0, 1, 2].map(|band| error(*face, reference, band));
    faces.iter().zip(references).flat_map(of_face).collect()
}

/// The root mean square of errors.
pub(crate) fn root_mean_square(errors: &[(f64, usize, bool)]) -> f64 {
    (errors.iter().map(|(error, ..)| error * error).sum::<f64>() / errors.len() as f64).sqrt()
}
