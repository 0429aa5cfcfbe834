//! Geometry `3a`: surfaces in planes given by angles, as in the program BLAST.
//!
//! Behind a surface's line stand the plane's origin, its azimuth (degrees clockwise from north, which is y) and its tilt (0
//! faces up, 90 is vertical, 180 faces down); then the width and height of a rectangle, whose lower left corner as seen from
//! the front is the origin, or the points of a triangle or quadrangle in that plane.
use super::fields::Fields;
use crate::io::error::{Fault, Wrong};
use glam::{DVec2, DVec3};

/// The corners of the surface on a line, from the lines behind it, which are passed over.
pub(super) fn corners(
    surface: &Fields<'_>,
    lines: &[Fields<'_>],
    at: &mut usize,
) -> Result<Vec<DVec3>, Wrong> {
    let shape = surface.word(2)?;
    let count = match shape.to_ascii_uppercase().as_str() {
        "R" => 2,
        "T" => 6,
        "Q" => 8,
        _ => {
            let found = shape.chars().take(40).collect();
            return Err((surface.line, Fault::Word { found, wanted: "R, T or Q" }));
        }
    };
    let numbers = numbers(5 + count, surface, lines, at)?;
    let plane = TiltedPlane::new(&numbers[..5]);
    let flat: Vec<DVec2> = match numbers[5..] {
        [width, height] => [[0.0, height], [0.0, 0.0], [width, 0.0], [width, height]].map(DVec2::from).into(),
        ref numbers => numbers.chunks(2).map(DVec2::from_slice).collect(),
    };
    Ok(flat.into_iter().map(|point| plane.lift(point)).collect())
}

/// So many numbers, on as many lines as they take.
fn numbers(
    count: usize,
    surface: &Fields<'_>,
    lines: &[Fields<'_>],
    at: &mut usize,
) -> Result<Vec<f64>, Wrong> {
    let mut numbers = Vec::new();
    while numbers.len() < count {
        let is_number = |fields: &&Fields<'_>| !fields.letter().is_ascii_alphabetic();
        let fault = Fault::Count { found: numbers.len(), wanted: count };
        let fields = lines.get(*at).filter(is_number).ok_or((surface.line, fault))?;
        *at += 1;
        let is_comment = |word: &&str| word.starts_with(['!', '/']);
        let said = fields.words.iter().position(is_comment).unwrap_or(fields.words.len());
        for word in 0..said.min(count - numbers.len()) {
            numbers.push(fields.number(word)?);
        }
    }
    Ok(numbers)
}

/// A plane with an origin and two axes.
struct TiltedPlane {
    origin: DVec3,
    across: DVec3,
    up: DVec3,
}

impl TiltedPlane {
    /// From x, y, z, azimuth and tilt.
    fn new(numbers: &[f64]) -> TiltedPlane {
        let [(sin_azimuth, cos_azimuth), (sin_tilt, cos_tilt)] =
            [numbers[3], numbers[4]].map(sin_cos_of_degrees);
        TiltedPlane {
            origin: DVec3::from_slice(numbers),
            across: DVec3::new(-cos_azimuth, sin_azimuth, 0.0),
            up: DVec3::new(-cos_tilt * sin_azimuth, -cos_tilt * cos_azimuth, sin_tilt),
        }
    }

    fn lift(&self, point: DVec2) -> DVec3 {
        self.origin + point.x * self.across + point.y * self.up
    }
}

/// Right angles have sines and cosines that are exact, so that walls and floors are in the axes' planes.
fn sin_cos_of_degrees(angle: f64) -> (f64, f64) {
    match angle.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}
