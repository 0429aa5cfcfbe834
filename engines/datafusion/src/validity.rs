//! Whether an area is valid as it is.
use crate::column::features::Features;
use crate::error::Error;
use polycsg::{Csg, DVec2, FillRule, Flaw, Scratch, flaw};

/// The first flaw of a feature; none, if it is valid. A point is.
///
/// # Errors
/// Its edges meet more often than the limit allows.
pub(crate) fn flaw_of(
    features: &Features,
    feature: usize,
    contacts: usize,
    scratch: &mut Scratch,
) -> Result<Option<Flaw>, Error> {
    let polygons: Vec<Vec<&[DVec2]>> = features.polygons(feature);
    if features.is_finite(feature) {
        let within = features.operand(feature)?.try_boundary(scratch, contacts).map(drop);
        within.map_err(|error| features.at_row_of(feature, error))?;
    }
    Ok(flaw(polygons, scratch))
}

/// Whether no edges cross, so that to evaluate them rounds nothing. Flaws of the rings' places do not matter, others are found first.
pub(crate) fn is_exact(rings: &[Vec<DVec2>], contacts: usize, scratch: &mut Scratch) -> bool {
    let Ok(read) = Csg::from_rings(rings, FillRule::EvenOdd) else { return false };
    let is_within = read.try_boundary(scratch, contacts).is_ok();
    let stops_before =
        |flaw| matches!(flaw, Flaw::Short { .. } | Flaw::NonFinite { .. } | Flaw::Crossing { .. });
    is_within && !flaw([rings], scratch).is_some_and(stops_before)
}
