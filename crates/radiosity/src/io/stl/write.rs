//! STL out, binary.
use crate::io::error::FileError;
use crate::io::surface::cut;
use crate::io::upright::z_up;
use crate::io::words::TOOL;
use crate::scene::Scene;

/// A scene's triangles in single precision, turned to z up. The format has neither materials nor light.
///
/// # Errors
/// [`FileError::Size`] for more triangles than the format can count.
pub fn stl(scene: &Scene) -> Result<Vec<u8>, FileError> {
    let (mut rows, turn) = (Vec::new(), z_up(scene.asset.up));
    let mut count: usize = 0;
    for patch in &scene.patches {
        let normal = patch.polygon.normal();
        for triangle in cut(patch) {
            let vectors = std::iter::once(normal).chain(triangle.map(|corner| corner.point));
            rows.extend(
                vectors
                    .flat_map(|vector| (turn * vector).to_array())
                    .flat_map(|number| single(number).to_le_bytes()),
            );
            rows.extend([0, 0]);
            count += 1;
        }
    }
    let number = u32::try_from(count).map_err(|_| FileError::Size { bytes: rows.len() })?;
    let mut bytes = format!("{TOOL:<80}").into_bytes();
    bytes.extend(number.to_le_bytes());
    bytes.extend(rows);
    Ok(bytes)
}

#[allow(clippy::cast_possible_truncation, reason = "rounding is what is asked for")]
fn single(number: f64) -> f32 {
    (number as f32).clamp(f32::MIN, f32::MAX)
}
