//! On which sides of the planes of one cone the corners of another are, and which edges of two cones cross.
//!
//! ```text
//!          b3 _______ b2       Edge a1 a2 crosses edge b0 b1 where a1 and a2 are on either side of the plane through b0 b1, and
//!            |       |         b0 and b1 on either side of the plane through a1 a2. So the signs of all depths tell which
//!         a2 | ______|__       edges cross, and divisions are needed for those only: of a cone's edges two at most
//!           \|/      |         straddle a plane.
//!      a0 __ |\_______|
//!          b0  a1     b1
//! ```
use super::cone::{Edge, Spread, UNDERFLOW};
use super::inside::{CLEAR, Inside, crossing};
use super::interval::Interval;
use super::lanes::{Lanes, MOST};

/// On which sides of the planes of one cone the corners of another are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides {
    /// How far inside each plane each corner is.
    depths: [Lanes; MOST],
    /// The corners inside each plane, and the edges that cross it, one bit each.
    inside: [u8; MOST],
    straddling: [u8; MOST],
    /// The corners inside all planes.
    inside_all: u8,
    corners: usize,
}

/// What the sides of corners say about two cones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    /// A plane separates them.
    Apart,
    /// All corners are inside all planes.
    Contained,
    /// Every sign is certain.
    Certain,
    Open,
}

impl Sides {
    /// Finds the sides of the corners of a cone: neither it nor that of the planes has more than `MOST`.
    #[inline]
    pub(super) fn find(&mut self, planes: &[Edge], spread: &Spread) -> Standing {
        let count = spread.corners.count;
        let all = u8::MAX >> (MOST - count);
        (self.inside_all, self.corners) = (all, count);
        let mut is_open = false;
        let rows = self.depths.iter_mut().zip(&mut self.inside).zip(&mut self.straddling);
        for (plane, ((depths, inside), straddling)) in planes.iter().zip(rows) {
            let (least, outside) = spread.corners.dots(plane.inward, depths);
            let (outside, is_clear) =
                (outside & all, least > CLEAR * (plane.error * spread.reach + UNDERFLOW));
            if is_clear && outside == all {
                return Standing::Apart;
            }
            is_open |= !is_clear;
            *inside = all ^ outside;
            // Bit i compares corners i and i + 1, the last one and the first.
            *straddling = (outside ^ (outside >> 1 | outside << (count - 1))) & all;
            self.inside_all &= *inside;
        }
        if is_open {
            Standing::Open
        } else if self.inside_all == all {
            Standing::Contained
        } else {
            Standing::Certain
        }
    }

    /// Whether no part of an edge is inside: none crosses its plane, so that it lies beside all or inside of all.
    #[inline]
    fn is_beside(&self, index: usize, back: &Self) -> bool {
        back.straddling[index] == 0 && self.inside_all >> index & 1 == 0
    }

    /// What of edge `index` is inside the cone of these planes: all signs are certain, these and those of the edge's own cone,
    /// `back`, that say where the corners of the other one are.
    #[inline]
    pub(super) fn part(&self, edge: &Edge, index: usize, planes: &[Edge], back: &Self) -> Inside {
        if self.is_beside(index, back) {
            return Inside::Nothing;
        }
        let (mut part, mut is_crossed) = (Interval::WHOLE, false);
        let mut straddling = back.straddling[index];
        while straddling != 0 {
            let other = straddling.trailing_zeros() as usize;
            straddling &= straddling - 1;
            // An edge that leaves the cone sees the crossed one come from its right. Else the two cross behind dA, one of them and
            // the other's opposite.
            let is_leaving = self.inside[other] >> index & 1 == 1;
            let is_from_left = back.inside[index] >> other & 1 == 1;
            if self.straddling[other] >> index & 1 == 0 || is_leaving == is_from_left {
                continue;
            }
            is_crossed = true;
            let depths = self.depths[other].as_flattened();
            let next = if index + 1 == self.corners { 0 } else { index + 1 };
            let found = crossing(edge, &planes[other], [depths[index], depths[next]]);
            if is_leaving {
                part.high = found;
            } else {
                part.low = found;
            }
        }
        if is_crossed || self.inside_all >> index & 1 == 1 { Inside::Part(part) } else { Inside::Nothing }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quick::cone::{Cones, Corner};
    use crate::quick::inside::inside;
    use glam::{DVec2, DVec3};
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// A regular polygon on a plane at some height, counter-clockwise seen from the origin.
    fn corners((count, turn, height, [x, y]): (usize, f64, f64, [f64; 2])) -> Vec<Corner> {
        let step = -height.signum() * TAU / count as f64;
        let corner = |i: usize| DVec2::from_angle(turn + step * i as f64) + DVec2::new(x, y);
        let given = |flat: DVec2| Corner::given(flat.extend(1.0) * height, DVec3::ZERO, 0.0);
        (0..count).map(corner).map(given).collect()
    }

    fn polygon() -> impl Strategy<Value = (usize, f64, f64, [f64; 2])> {
        (
            3usize..=MOST,
            0.0..TAU,
            prop_oneof![3 => 0.5..4.0, 1 => -4.0..-0.5],
            prop::array::uniform2(-1.0..1.0),
        )
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn signs_find_the_parts_that_clipping_finds(polygons in prop::array::uniform2(polygon())) {
            let mut cones = Cones::default();
            for polygon in polygons {
                cones.push(corners(polygon).into_iter());
            }
            let [a, b] = [cones.cone(0), cones.cone(1)];
            let [mut there, mut back] = [Sides::default(); 2];
            let standings = [there.find(b.edges, a.spread), back.find(a.edges, b.spread)];
            for (index, edge) in a.edges.iter().enumerate() {
                let clipped = inside(DVec3::ZERO, (a, index), b);
                let found = match standings {
                    [Standing::Apart, _] | [_, Standing::Apart] => Inside::Nothing,
                    [Standing::Contained, _] => Inside::Part(Interval::WHOLE),
                    [Standing::Certain, Standing::Certain | Standing::Contained] => there.part(edge, index, b.edges, &back),
                    _ => continue,
                };
                match (found, clipped) {
                    (Inside::Part(found), Inside::Part(clipped)) => {
                        prop_assert!((found.low.at - clipped.low.at).abs() <= found.low.error + clipped.low.error);
                        prop_assert!((found.high.at - clipped.high.at).abs() <= found.high.error + clipped.high.error);
                    }
                    // Clipping may leave a little that is empty or not.
                    (Inside::Nothing, Inside::Part(clipped)) => prop_assert!(clipped.high.at - clipped.low.at < 1e-12),
                    (Inside::Nothing, Inside::Nothing) => (),
                    _ => prop_assert!(false, "{found:?} {clipped:?}"),
                }
            }
        }
    }
}
