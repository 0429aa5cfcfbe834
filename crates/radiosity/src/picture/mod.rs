//! Pictures: a mesh with its light, as a camera sees it, in PNG.
//!
//! ```text
//! raster     triangles to samples
//! painting   what is drawn
//! png        pixels to the bytes of a file
//! framing    a camera for scenes that have none
//! ```
pub(crate) mod framing;
pub(crate) mod painting;
pub(crate) mod png;
mod raster;

pub use framing::framing;

use crate::expose::{Exposure, srgb};
use crate::mesh::element::Mesh;
use crate::scene::camera::Camera;
use painting::Painting;
use raster::{Eye, SAMPLES, raster};
use rayon::prelude::*;

/// Rows drawn at a time by one thread.
const BAND: usize = 8;
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
    let (width, height) = size(camera, width);
    let eye = Eye::new(camera, width, height);
    let triangles = eye.triangles(painting);
    let mut bytes = vec![0; 3 * width * height];
    let bands = bytes.par_chunks_mut(3 * width * BAND).enumerate();
    bands.for_each(|(band, bytes)| {
        let top = band * BAND;
        let rows = bytes.len() / (3 * width);
        let samples = raster(&triangles, top..top + rows, width);
        for (pixel, samples) in bytes.chunks_mut(3).zip(samples.chunks(SAMPLES)) {
            pixel.copy_from_slice(&pixel_of(samples, exposure));
        }
    });
    png::rgb(&bytes, [width, height])
}

/// Width as asked, height by the aspect.
fn size(camera: &Camera, width: u32) -> (usize, usize) {
    let width = width.clamp(1, MAX_SIDE);
    let height = (f64::from(width) / camera.aspect).round().clamp(1.0, f64::from(MAX_SIDE));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and MAX_SIDE")]
    let height = height as usize;
    (width as usize, height)
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
