//! How far pictures are from the light that their own solution sends: at the point behind each pixel an exact gather from all
//! elements.
use super::sources::Sources;
use radiosity::formfactor::Error;
use radiosity::glam::DVec3;
use radiosity::{Camera, Record, Scene, Solution};
use rayon::prelude::*;

/// The errors of the pixels, as shares of the brightest reflected light of the picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelErrors {
    pub(crate) pixels: usize,
    pub(crate) mean: f64,
    /// What one pixel in a hundred exceeds.
    pub(crate) percentile: f64,
    pub(crate) worst: f64,
    /// Where that is, in pixels from the top left.
    pub(crate) place: [u32; 2],
}

/// The point behind a pixel.
struct Hit {
    place: [u32; 2],
    element: usize,
    point: DVec3,
    weights: [f64; 3],
}

/// Compares what is reflected at the middle of every pixel, interpolated as in the picture, with an exact gather. A picture on a patch
/// counts as its mean.
pub(crate) fn pixel_errors(
    scene: &Scene,
    solution: &Solution,
    camera: &Camera,
    width: u32,
) -> Result<PixelErrors, Error> {
    let record = Record::new("pixels", scene, solution);
    let sources = Sources::new(scene, solution)?;
    let bands = scene.bands;
    let compared = |hit: Hit| {
        let [patch, corners @ ..] = record.elements[hit.element];
        let exact = sources.gather(patch, hit.point)?;
        let rho = &scene.patches[patch].reflectance;
        let shown = |band: usize| {
            let at =
                |(corner, weight): (&usize, f64)| weight * record.vertex_irradiance[corner * bands + band];
            corners.iter().zip(hit.weights).map(at).sum::<f64>()
        };
        let off = (0..bands).map(|band| rho[band] * (shown(band) - exact[band]).abs()).fold(0.0, f64::max);
        let bright = (0..bands).map(|band| rho[band] * exact[band]).fold(0.0, f64::max);
        Ok((off, bright, hit.place))
    };
    let hits = hits(&record, camera, width);
    let all: Vec<(f64, f64, [u32; 2])> = hits.into_par_iter().map(compared).collect::<Result<_, Error>>()?;
    let brightest = all.iter().map(|pixel| pixel.1).fold(f64::MIN_POSITIVE, f64::max);
    let mut errors: Vec<(f64, [u32; 2])> = all.iter().map(|pixel| (pixel.0 / brightest, pixel.2)).collect();
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    let pixels = errors.len();
    let mean = errors.iter().map(|error| error.0).sum::<f64>() / pixels.max(1) as f64;
    let (worst, place) = errors.last().copied().unwrap_or_default();
    let percentile = errors.get(pixels * 99 / 100).map_or(0.0, |error| error.0);
    Ok(PixelErrors { pixels, mean, percentile, worst, place })
}

/// What the middle of every pixel shows, where that is something.
fn hits(record: &Record, camera: &Camera, width: u32) -> Vec<Hit> {
    let is_enough = |rows: &u32| (f64::from(*rows) + 0.5) * camera.aspect > f64::from(width);
    let height = (1..).find(is_enough).expect("a picture has an end");
    let forward = camera.direction.normalize();
    let right = forward.cross(camera.up).normalize();
    let up = right.cross(forward);
    let tangent = (camera.vertical_fov / 2.0).tan();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).collect::<Vec<_>>();
    let ray = |[x, y]: [u32; 2]| {
        let across = (2.0 * (f64::from(x) + 0.5) / f64::from(width) - 1.0) * tangent * camera.aspect;
        let rise = (1.0 - 2.0 * (f64::from(y) + 0.5) / f64::from(height)) * tangent;
        forward + across * right + rise * up
    };
    pixels.into_par_iter().filter_map(|place| nearest(record, camera.position, ray(place), place)).collect()
}

/// The nearest element that a ray meets from its front.
fn nearest(record: &Record, eye: DVec3, ray: DVec3, place: [u32; 2]) -> Option<Hit> {
    let mut best: Option<(f64, Hit)> = None;
    for (element, [_, corners @ ..]) in record.elements.iter().enumerate() {
        let [a, b, c] = corners.map(|corner| record.vertices[corner] - eye);
        let planes = [c.cross(b), a.cross(c), b.cross(a)];
        let weights = planes.map(|plane| plane.dot(ray));
        let (sum, volume) = (weights.iter().sum::<f64>(), a.dot(planes[0]));
        if volume <= 0.0 || weights.iter().any(|weight| *weight < 0.0) || sum <= 0.0 {
            continue;
        }
        let depth = volume / sum;
        if best.as_ref().is_none_or(|(nearest, _)| depth < *nearest) {
            let weights = weights.map(|weight| weight / sum);
            best = Some((depth, Hit { place, element, point: eye + depth * ray, weights }));
        }
    }
    best.map(|(_, hit)| hit)
}
