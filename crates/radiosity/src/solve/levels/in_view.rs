//! Which patches a camera sees.
//!
//! ```text
//!            /|  a patch is in view where a part of its front is within the picture's
//!    eye  <   |  four sides, and not all of that is hidden by the fronts of others:
//!            \|  pictures show nothing from behind
//! ```
use super::look::rises;
use super::tiling::{Tile, Tiling};
use crate::error::Error;
use crate::scene::camera::Camera;
use crate::solve::workers::attempt;
use formfactor::{DifferentialArea, Enclosure};
use glam::DVec3;
use rayon::prelude::*;

/// What is seen of a patch is more than this form factor, as from a surface that faces the picture: less is no pixel.
const LEAST: f64 = 1e-9;

/// Whether each patch is seen.
///
/// Takes a form factor for each convex part of a patch that is within the picture.
///
/// # Errors
/// [`Error::Camera`] where the camera's numbers make no view, or none of the patches is seen; [`Error::Defect`] when a form factor fails.
pub(super) fn in_view(tiling: &Tiling<'_>, camera: &Camera) -> Result<Vec<bool>, Error> {
    let refused = |reason: String| Error::Camera { camera: camera.name.clone(), reason };
    if !camera.is_sound() {
        return Err(refused("its numbers make no view".into()));
    }
    let eye = DifferentialArea::new(camera.position, camera.direction)
        .map_err(|error| refused(error.to_string()))?;
    let sides = sides(camera);
    let faces = |tile: &&Tile| tile.parent.is_none() && rises(eye.position(), &tile.points[0]);
    let fronts: Vec<&Tile> = tiling.tiles.iter().filter(faces).collect();
    let enclosure = Enclosure::new(fronts.iter().map(|tile| tile.polygon.clone()).collect());
    let sees = |(id, tile): (usize, &&Tile)| sees(&enclosure, &eye, within(&sides, &eye, tile), id);
    let find = || fronts.par_iter().enumerate().map(sees).collect();
    let found: Vec<bool> = attempt("what the camera sees", find)?;
    let mut seen = vec![false; tiling.scene.patches.len()];
    fronts.iter().zip(found).for_each(|(tile, is_seen)| seen[tile.patch] |= is_seen);
    if seen.contains(&true) { Ok(seen) } else { Err(refused("it sees the front of no surface".into())) }
}

/// The inner normals of the planes through the eye and the sides of the picture.
fn sides(camera: &Camera) -> [DVec3; 4] {
    let ahead = camera.direction.normalize();
    let right = ahead.cross(camera.up).normalize();
    let up = right.cross(ahead);
    let height = (camera.vertical_fov / 2.0).tan();
    let width = camera.aspect * height;
    [width * ahead + right, width * ahead - right, height * ahead + up, height * ahead - up]
}

/// What of a tile is within the picture.
fn within(sides: &[DVec3; 4], eye: &DifferentialArea, tile: &Tile) -> Vec<DVec3> {
    let whole: Vec<DVec3> = tile.outline.places().collect();
    sides.iter().fold(whole, |corners, side| clipped(&corners, eye.position(), *side))
}

/// Whether an eye sees something of a part of polygon `id`.
fn sees(enclosure: &Enclosure, eye: &DifferentialArea, part: Vec<DVec3>, id: usize) -> bool {
    if part.len() < 3 {
        return false;
    }
    let whole = &enclosure.polygons()[id];
    // What is too thin to be outlined is looked at with all of its tile.
    let part = whole.part([part]).unwrap_or_else(|_| whole.clone());
    enclosure.form_factor_within(eye, id, &part, LEAST).value > LEAST
}

/// What of a convex polygon is inward of a plane through a point.
fn clipped(corners: &[DVec3], through: DVec3, inward: DVec3) -> Vec<DVec3> {
    let depth = |corner: DVec3| inward.dot(corner - through);
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (&corner, &next) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let [here, there] = [corner, next].map(depth);
        if here > 0.0 {
            kept.push(corner);
        }
        if (here > 0.0) != (there > 0.0) {
            kept.push(corner.lerp(next, here / (here - there)));
        }
    }
    kept
}
