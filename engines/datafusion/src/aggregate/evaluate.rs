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
pub(crate) const BYTES_PER_BYTE: usize = 80;

/// The multipolygon of a group; none, if it holds nothing but NULL. Its polygons stand from left to right.
pub(crate) fn evaluated(
    aggregate: Aggregate,
    bytes: &[u8],
    contacts: usize,
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
        let combined = combined(aggregate, part.iter().map(|&i| features[i]), contacts, scratch);
        polygons.extend(combined.map_err(|why| named(&boxes, why))?);
    }
    polygons.sort_by(from_left_to_right);
    Ok(Some(MultiPolygon::new(polygons)))
}

fn combined<'s>(
    aggregate: Aggregate,
    features: impl Iterator<Item = &'s [u8]>,
    contacts: usize,
    scratch: &mut Scratch,
) -> Result<MultiPolygon, String> {
    let operand = |feature| {
        let rings = state::rings(feature).map_err(|error| error.to_string())?;
        Csg::from_rings(&rings, FillRule::EvenOdd).map_err(|error| error.to_string())
    };
    let operands: Vec<Csg> = features.map(operand).collect::<Result<_, String>>()?;
    let expression = match aggregate {
        Aggregate::Union => Csg::union(operands),
        Aggregate::Intersection => Csg::intersection(operands),
    };
    let found = expression.try_evaluate_with(scratch, contacts).map_err(|error| error.to_string())?;
    Ok(MultiPolygon::from(&found))
}

/// The error of a group, which is named by what it holds.
fn named(boxes: &[[DVec2; 2]], why: String) -> Error {
    let low = boxes.iter().fold(DVec2::INFINITY, |low, bounds| low.min(bounds[0]));
    let high = boxes.iter().fold(DVec2::NEG_INFINITY, |high, bounds| high.max(bounds[1]));
    Error::Group { features: boxes.len(), low, high, why }
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
