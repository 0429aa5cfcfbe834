//! Whether many operands lie apart, by boxes: those of the fields of a board, of tiles or pixels have no inner point in common.
//! Then no place is in two of them, and where each winds once at most, all of them together do.

use super::csg::Token;
use super::simple_ring::winds_once;
use crate::base::corners::corners;
use crate::base::meter::{Meter, Refusal};
use crate::region::rings::Rings;
use crate::spatial::strips::Strips;
use glam::DVec2;

/// For each box, so many blocks of others are looked at.
const BLOCKS_PER_BOX: usize = 32;

/// Boxes that lie apart cover no more than the box around them, but for rounding.
const ROUNDING: f64 = 1.0 + 1.0 / (1 << 20) as f64;

/// Whether no place is in two of the operands, so that their union is their symmetric difference.
pub(super) fn operands_are_apart<'t, 'c: 't>(
    operands: impl Iterator<Item = &'t Token<'c>>,
    boxes: &mut Vec<[DVec2; 2]>,
    strips: &mut Strips,
    meter: &Meter<'_>,
) -> Result<bool, Refusal> {
    boxes.clear();
    let mut tally = meter.tally();
    for operand in operands {
        match operand {
            Token::Rings(rings, _) => boxes.extend(rings.iter().map(corners)),
            Token::Region(region) => boxes.push(corners(region.rings_of().points())),
            Token::Prepared(_) | Token::Edge(_) | Token::Operator(..) => return Ok(false),
        }
        tally.add(1)?;
    }
    boxes_are_apart(boxes, strips, meter)
}

/// 1 or -1 if each of the rings winds so, and no two around one place.
pub(super) fn rings_wind_once(
    rings: &Rings,
    boxes: &mut Vec<[DVec2; 2]>,
    strips: &mut Strips,
    meter: &Meter<'_>,
) -> Result<Option<i32>, Refusal> {
    boxes.clear();
    meter.extend(boxes, rings.iter().map(corners))?;
    if !boxes_are_apart(boxes, strips, meter)? {
        return Ok(None);
    }
    let (mut first, mut tally) = (None, meter.tally());
    for ring in 0..rings.len() {
        let closed = rings.closed(ring);
        tally.add(closed.len())?;
        match (winds_once(closed), first) {
            (None, _) => return Ok(None),
            (way, Some(_)) if way != first => return Ok(None),
            (way, _) => first = way,
        }
    }
    Ok(first)
}

fn boxes_are_apart(boxes: &[[DVec2; 2]], strips: &mut Strips, meter: &Meter<'_>) -> Result<bool, Refusal> {
    let around = |[low, high]: [DVec2; 2], b: &[DVec2; 2]| [low.min(b[0]), high.max(b[1])];
    let whole = boxes.iter().fold([DVec2::MAX, DVec2::MIN], around);
    if boxes.iter().map(quarter).sum::<f64>() > quarter(&whole) * ROUNDING {
        return Ok(false);
    }
    strips.build(boxes.iter().copied(), meter)?;
    strips.pairs_within(0..strips.len(), BLOCKS_PER_BOX * boxes.len(), meter, |a, b| {
        let [[low, high], [other_low, other_high]] = [a, b].map(|i| boxes[i as usize]);
        Ok(low.max(other_low).cmpge(high.min(other_high)).any())
    })
}

/// A quarter of the area of a box, so that it overflows less soon.
fn quarter(&[low, high]: &[DVec2; 2]) -> f64 {
    let half = high * 0.5 - low * 0.5;
    half.x * half.y
}

#[cfg(test)]
mod tests {
    use super::{Meter, Strips, rings_wind_once};
    use crate::region::rings::Rings;
    use glam::DVec2;

    fn winds(squares: &[[f64; 3]]) -> Option<i32> {
        let mut rings = Rings::default();
        for &[x, y, size] in squares {
            let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
            rings.extend(&corners.map(|corner| DVec2::new(x, y) + corner * DVec2::new(size, size.abs())));
            rings.close();
        }
        let meter = Meter::default();
        rings_wind_once(&rings, &mut Vec::new(), &mut Strips::default(), &meter).expect("no limit was given")
    }

    #[test]
    fn squares_that_touch_are_apart() {
        let board = |size: f64| -> Vec<[f64; 3]> {
            (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10), size]).collect()
        };
        assert_eq!(winds(&board(1.0)), Some(1));
        assert_eq!(winds(&board(-1.0)), Some(-1));
        assert_eq!(winds(&[&board(1.0)[..], &[[9.5, 9.5, 1.0]]].concat()), None, "overlaps a corner");
        assert_eq!(winds(&[&board(1.0)[..], &[[11.0, 0.0, -1.0]]].concat()), None, "lies on another");
        assert_eq!(winds(&[&board(1.0)[..], &[[12.0, 0.0, -1.0]]].concat()), None, "runs the other way");
    }
}
