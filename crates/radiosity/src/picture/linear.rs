//! Pictures whose values have no upper limit.
use image::{ImageFormat, Rgb32FImage};
use std::io::Cursor;

/// A kind of file that holds linear values: red, green and blue radiance with sRGB's primaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinearFormat {
    /// OpenEXR, 32-bit floats.
    Exr,
    /// Radiance HDR: 8 bits for each part and a common exponent. Negative parts, of colours that no screen shows, become 0.
    Hdr,
}

/// The bytes of a file of pixels, row by row.
///
/// # Errors
/// What the encoder says.
pub(super) fn file(
    mut pixels: Vec<f32>,
    [width, height]: [usize; 2],
    format: LinearFormat,
) -> Result<Vec<u8>, String> {
    let format = match format {
        LinearFormat::Exr => ImageFormat::OpenExr,
        LinearFormat::Hdr => {
            pixels.iter_mut().for_each(|part| *part = part.max(0.0));
            ImageFormat::Hdr
        }
    };
    let [width, height] =
        [width, height].map(|side| u32::try_from(side).expect("sides are at most MAX_SIDE"));
    let image = Rgb32FImage::from_raw(width, height, pixels).expect("three parts for every pixel");
    let mut file = Cursor::new(Vec::new());
    image.write_to(&mut file, format).map_err(|error| error.to_string())?;
    Ok(file.into_inner())
}
