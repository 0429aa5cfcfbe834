//! A group's state evaluated.
use super::components::components;
use super::group::Aggregate;
use super::state::{self, by_point};
use crate::error::Error;
use geo_types::{Coord, MultiPolygon, Polygon};
use polycsg::{Csg, DVec2, FillRule, Scratch};
use std::cmp::Ordering;

/// For each byte of the largest state, evaluating it takes up to so many more, where edges do not meet more often than those of
/// thousands of stars over one another (`tests/memory.rs`). What meets more often is stopped by the limit on contacts.
const BYTES_PER_BYTE: usize = 80;

/// Sorting its features and cancelling their edges takes up to so many more, whatever their parts.
const SORTED_BYTES_PER_BYTE: usize = 20;

/// What evaluating a group may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct GroupLimits {
    pub(crate) contacts: usize,
    pub(crate) bytes: usize,
}

impl GroupLimits {
    /// What evaluating a state of so many bytes may take, in bytes: what is not taken at once is its parts.
    pub(crate) fn taken_by(self, length: usize) -> usize {
        let in_parts = length.saturating_mul(SORTED_BYTES_PER_BYTE).saturating_add(self.bytes);
        length.saturating_mul(BYTES_PER_BYTE).min(in_parts)
    }

    fn check(self, length: usize) -> Result<(), String> {
        let taken = length.saturating_mul(BYTES_PER_BYTE);
        if taken <= self.bytes {
            return Ok(());
        }
        let most = self.bytes;
        Err(format!(
            "its largest part takes up to {taken} bytes, and {most} are allowed; group by more, or raise Functions::bytes"
        ))
    }
}

/// The multipolygon of a group; none, if it holds nothing but NULL. Its polygons stand from left to right.
pub(crate) fn evaluated(
    aggregate: Aggregate,
    bytes: &[u8],
    limits: GroupLimits,
    scratch: &mut Scratch,
) -> Result<Option<MultiPolygon>, Error> {
    let features = state::sorted(bytes)?;
    let boxes: Vec<[DVec2; 2]> =
        features.iter().map(|feature| state::bounds(feature)).collect::<Result<_, _>>()?;
    let parts = match aggregate {
        _ if features.is_empty() => return Ok(None),
        Aggregate::Union => components(&boxes),
        Aggregate::Intersection => vec![(0..features.len()).collect()],
    };
    let mut polygons = Vec::new();
    for part in parts {
        let part: Vec<&[u8]> = part.into_iter().map(|i| features[i]).collect();
        let combined = combined(aggregate, &part, limits, scratch);
        polygons.extend(combined.or_else(|why| Err(named(&features, &boxes, why)?))?);
    }
    polygons.sort_by(from_left_to_right);
    Ok(Some(MultiPolygon::new(polygons)))
}

/// All features, and as one more what the rings of outlines wind around.
fn combined(
    aggregate: Aggregate,
    features: &[&[u8]],
    limits: GroupLimits,
    scratch: &mut Scratch,
) -> Result<MultiPolygon, String> {
    limits.check(features.iter().map(|feature| feature.len()).sum())?;
    let read = |feature| state::rings(feature).map_err(|error| error.to_string());
    let operand = |rings: &[_], rule| Csg::from_rings(rings, rule).map_err(|error| error.to_string());
    let (mut operands, mut outline) = (Vec::new(), Vec::new());
    for feature in features {
        match state::is_outline(feature) {
            true => outline.extend(read(feature)?),
            false => operands.push(operand(&read(feature)?, FillRule::EvenOdd)?),
        }
    }
    if !outline.is_empty() {
        operands.push(operand(&outline, FillRule::Positive)?);
    }
    let expression = match aggregate {
        Aggregate::Union => Csg::union(operands),
        Aggregate::Intersection => Csg::intersection(operands),
    };
    let found = expression.try_evaluate_with(scratch, limits.contacts).map_err(|error| error.to_string())?;
    Ok(MultiPolygon::from(&found))
}

/// The error of a group, which is named by what it holds.
fn named(features: &[&[u8]], boxes: &[[DVec2; 2]], why: String) -> Result<Error, Error> {
    let low = boxes.iter().fold(DVec2::INFINITY, |low, bounds| low.min(bounds[0]));
    let high = boxes.iter().fold(DVec2::NEG_INFINITY, |high, bounds| high.max(bounds[1]));
    let members = features.iter().map(|feature| Ok(state::members(feature)?.unwrap_or(1) as usize));
    Ok(Error::Group { features: members.sum::<Result<_, Error>>()?, low, high, why })
}

/// By the points of the outer rings, which start at their lowest point from the left. So the order does not depend on which parts
/// were evaluated together.
fn from_left_to_right(a: &Polygon, b: &Polygon) -> Ordering {
    let points = |polygon: &Polygon| polygon.exterior().0.clone().into_iter().map(vector);
    let different = points(a).zip(points(b)).map(|(a, b)| by_point(&a, &b)).find(|order| order.is_ne());
    different.unwrap_or(a.exterior().0.len().cmp(&b.exterior().0.len()))
}

fn vector(Coord { x, y }: Coord) -> DVec2 {
    DVec2::new(x, y)
}
