//! PNG files in memory.
use crate::expose::srgb;

/// A PNG of 8 bits per channel: red, green and blue of each pixel, row by row, sRGB.
pub(super) fn rgb(bytes: &[u8], size: [usize; 2]) -> Vec<u8> {
    file(bytes, size, png::ColorType::Rgb, png::BitDepth::Eight)
}

/// A grey PNG of 16 bits per texel, sRGB, of linear intensities from 0 to 1.
pub(crate) fn grey(texels: &[f64], width: usize) -> Vec<u8> {
    let word = |texel: &f64| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 65535")]
        let word = (65_535.0 * srgb(texel.clamp(0.0, 1.0))).round() as u16;
        word.to_be_bytes()
    };
    let bytes: Vec<u8> = texels.iter().flat_map(word).collect();
    file(&bytes, [width, texels.len() / width], png::ColorType::Grayscale, png::BitDepth::Sixteen)
}

fn file(bytes: &[u8], size: [usize; 2], colour: png::ColorType, depth: png::BitDepth) -> Vec<u8> {
    let [width, height] = size.map(|side| u32::try_from(side).expect("sides are at most MAX_SIDE"));
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(colour);
    encoder.set_depth(depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(bytes)?;
        writer.finish()
    });
    written.expect("a picture of the stated size is written to memory");
    file
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image_file::decode;

    #[test]
    fn a_picture_comes_back_as_it_was() {
        let greys = [0.0, 0.05, 0.5, 0.8, 1.0, 0.2];
        let image = decode("six", grey(&greys, 3)).unwrap();
        assert_eq!((image.width, image.mime), (3, "image/png"));
        for (texel, grey) in image.texels.iter().zip(greys) {
            assert!(texel.iter().all(|band| (band - grey).abs() < 3e-5), "{texel:?} {grey}");
        }
    }
}
