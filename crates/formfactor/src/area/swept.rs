//! What a double integral may change by as what is given moves by a deviation.
use super::contact::contact;
use super::point::Near;
use crate::scene::surfaces::{Hollow, Surface};
use glam::DVec3;

/// A deviation moves what edges seem to meet by no more than so many times as much: to either side, and where vertices are joined.
const SWEPT: f64 = 12.0;

/// What may pass the strips that edges sweep as what is given moves by a deviation, and what of the surfaces is not known to be before or
/// behind others.
pub(super) fn swept(pair: [&Surface; 2], occluders: &[Near], deviation: f64) -> f64 {
    let reach = SWEPT * deviation;
    reach * edges(pair, occluders) + touching(pair, occluders, reach)
}

/// How far roundings of clipped corners and of what side they are on may move them.
pub(super) fn rounded(pair: [&Surface; 2], occluders: &[Near]) -> f64 {
    let own = pair.iter().flat_map(|surface| surface.pieces.iter().flatten());
    let points = own.chain(occluders.iter().flat_map(|occluder| &occluder.corners));
    let (middle, mut extent, mut largest) = (pair[0].middle, 0.0_f64, 0.0_f64);
    for point in points {
        extent = extent.max(point.distance(middle));
        largest = largest.max(point.abs().max_element());
    }
    1e-12 * extent + 8.0 * f64::EPSILON * largest
}

/// The length of all edges. What passes the strip that an edge sweeps is no more than the strip's area.
fn edges(pair: [&Surface; 2], occluders: &[Near]) -> f64 {
    let own = pair.iter().flat_map(|surface| &surface.edges).map(|[a, b]| a.distance(*b));
    let own = own.chain(pair.iter().flat_map(|surface| &surface.hollows).map(Hollow::perimeter));
    let ridges = occluders.iter().flat_map(|occluder| &occluder.ridges);
    own.chain(ridges.map(|ridge| ridge.ends[0].distance(ridge.ends[1]))).sum()
}

/// The area of the parts of two surfaces that lie within `reach` of each other or of a plate: what they see there is not known.
fn touching(pair: [&Surface; 2], occluders: &[Near], reach: f64) -> f64 {
    let edges = |piece: &[DVec3]| -> Vec<[DVec3; 2]> {
        piece.iter().zip(piece.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]).collect()
    };
    let [one, other] = pair;
    let mutual =
        other.pieces.iter().map(|piece| contact(&one.pieces, edges(piece).into_iter(), other.face, reach));
    let of_plates = occluders.iter().filter(|occluder| occluder.is_plate).map(|plate| {
        let edges = || plate.ridges.iter().map(|ridge| ridge.ends);
        pair.iter().map(|surface| contact(&surface.pieces, edges(), plate.faces[0], reach)).sum::<f64>()
    });
    mutual.chain(of_plates).sum()
}
