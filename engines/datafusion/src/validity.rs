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
    if features.is_finite(feature) && !cannot_exceed(contacts, features.point_count(feature)) {
        let within = features.operand(feature)?.try_boundary(scratch, contacts).map(drop);
        within.map_err(|error| features.at_row_of(feature, error))?;
    }
    Ok(flaw(polygons, scratch))
}

/// Whether no edges cross, so that to evaluate them rounds nothing. Flaws of the rings' places do not matter, others are found first.
pub(crate) fn is_exact(rings: &[Vec<DVec2>], contacts: usize, scratch: &mut Scratch) -> bool {
    let Ok(read) = Csg::from_rings(rings, FillRule::EvenOdd) else { return false };
    let count = rings.iter().map(Vec::len).sum();
    let is_within = cannot_exceed(contacts, count) || read.try_boundary(scratch, contacts).is_ok();
    let stops_before =
        |flaw| matches!(flaw, Flaw::Short { .. } | Flaw::NonFinite { .. } | Flaw::Crossing { .. });
    is_within && !flaw([rings], scratch).is_some_and(stops_before)
}

/// Whether so few edges never meet more often than a limit allows, so that nothing has to be evaluated to see it: two edges have at most
/// four contacts, the ends of what they share.
fn cannot_exceed(contacts: usize, edges: usize) -> bool {
    edges.saturating_mul(edges).saturating_mul(2) <= contacts
}
