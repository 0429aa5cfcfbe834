//! Pictures: a mesh with its light, as a camera sees it, exposed in PNG, or linear in OpenEXR and Radiance HDR.
//!
//! ```text
//! raster     triangles to samples
//! painting   what is drawn
//! linear     pixels without an upper limit to the bytes of a file
//! png        pixels to the bytes of a file
//! framing    a camera for scenes that have none
//! ```
pub(crate) mod framing;
pub(crate) mod linear;
pub(crate) mod painting;
pub(crate) mod png;
mod raster;

pub use framing::framing;
pub use linear::LinearFormat;

use crate::expose::{Exposure, srgb};
use crate::mesh::element::Mesh;
use crate::scene::camera::Camera;
use painting::Painting;
use raster::{Eye, SAMPLES, raster};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Rows drawn at a time by one thread.
const BAND: usize = 8;
/// How many pixels wide a picture is that exposures are chosen by.
const GLANCE: u32 = 256;
/// The longest side, in pixels.
const MAX_SIDE: u32 = 16_384;

/// Draws a mesh as a camera sees it. Returns the bytes of a PNG with 8 bits per channel, sRGB.
///
/// `radiosity` holds red, green and blue at every vertex of the mesh; it is interpolated over the triangles, then exposed.
/// `width` is in pixels; the height follows from the camera's aspect, and both are kept between 1 and 16384. Patches are not
/// drawn from behind, so that a camera outside sees into a closed room. The background is black. Each pixel is the mean of 16
/// samples. The bytes do not depend on the number of threads.
///
/// # Panics
/// When `radiosity` is shorter than the mesh's vertices.
#[must_use]
pub fn draw(mesh: &Mesh, radiosity: &[[f64; 3]], camera: &Camera, exposure: Exposure, width: u32) -> Vec<u8> {
    paint(&Painting { mesh, light: radiosity, places: &[], images: &[] }, camera, exposure, width)
}

/// Draws as [`draw`] does; pictures are multiplied with the light that falls on them.
pub(crate) fn paint(painting: &Painting<'_>, camera: &Camera, exposure: Exposure, width: u32) -> Vec<u8> {
    let size = size(camera, width);
    png::rgb(&pixels(painting, camera, size, |samples| pixel_of(samples, exposure)), size)
}

/// The radiance of every pixel, W/m²/sr, in a file without an upper limit; drawn as by [`paint`].
pub(crate) fn radiance(
    painting: &Painting<'_>,
    camera: &Camera,
    format: LinearFormat,
    width: u32,
) -> Result<Vec<u8>, String> {
    let size = size(camera, width);
    linear::file(pixels(painting, camera, size, radiance_of), size, format)
}

/// The colours that a camera sees, evenly picked; nothing where it sees nothing.
pub(crate) fn seen(painting: &Painting<'_>, camera: &Camera) -> Vec<[f64; 3]> {
    let size = size(camera, GLANCE);
    let middle = |samples: &[[f64; 3]]| samples[SAMPLES / 2];
    pixels(painting, camera, size, middle).chunks_exact(3).map(|row| [row[0], row[1], row[2]]).collect()
}

/// Every pixel, row by row, out of its samples.
fn pixels<T: Copy + Default + Send>(
    painting: &Painting<'_>,
    camera: &Camera,
    [width, height]: [usize; 2],
    pixel_of: impl Fn(&[[f64; 3]]) -> [T; 3] + Sync,
) -> Vec<T> {
    let triangles = Eye::new(camera, width, height).triangles(painting);
    let mut parts = vec![T::default(); 3 * width * height];
    parts.par_chunks_mut(3 * width * BAND).enumerate().for_each(|(band, parts)| {
        let top = band * BAND;
        let samples = raster(&triangles, top..top + parts.len() / (3 * width), width);
        for (pixel, samples) in parts.chunks_mut(3).zip(samples.chunks(SAMPLES)) {
            pixel.copy_from_slice(&pixel_of(samples));
        }
    });
    parts
}

/// Width as asked, height by the aspect.
fn size(camera: &Camera, width: u32) -> [usize; 2] {
    let width = width.clamp(1, MAX_SIDE);
    let height = (f64::from(width) / camera.aspect).round().clamp(1.0, f64::from(MAX_SIDE));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and MAX_SIDE")]
    let height = height as usize;
    [width as usize, height]
}

/// The mean of the samples' intensities, encoded.
fn pixel_of(samples: &[[f64; 3]], exposure: Exposure) -> [u8; 3] {
    let mut sum = [0.0; 3];
    for sample in samples.iter().filter(|sample| **sample != [0.0; 3]) {
        let intensity = exposure.intensity(*sample);
        sum = std::array::from_fn(|band| sum[band] + intensity[band]);
    }
    let samples = SAMPLES as f64;
    sum.map(|band| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
        let byte = (255.0 * srgb(band / samples)).round() as u8;
        byte
    })
}

/// The mean of the samples' radiances, B / π.
fn radiance_of(samples: &[[f64; 3]]) -> [f32; 3] {
    let sum =
        samples.iter().fold([0.0; 3], |sum: [f64; 3], sample| std::array::from_fn(|k| sum[k] + sample[k]));
    sum.map(|part| {
        #[allow(clippy::cast_possible_truncation, reason = "the file's precision")]
        let part = (part / (PI * SAMPLES as f64)) as f32;
        part
    })
}
