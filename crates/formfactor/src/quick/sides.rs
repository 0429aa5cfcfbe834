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
//!
//! Polygons of a mesh share corners, and those lie in planes of both. Their signs are those of cones that are a little smaller, one
//! much less than the other: that moves no boundary, and two that only touch are apart.
use super::cone::{CornerId, Edge, OneCone};
use super::inside::{CLEAR, Inside, crossing};
use super::interval::{Interval, Parameter};
use super::lanes::{Lanes, MOST};
use std::cmp::Ordering;

/// On which sides of the planes of one cone the corners of another are.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides {
    /// How far inside each plane each corner is.
    depths: [Lanes; MOST],
    /// The corners inside each plane, and the edges that cross it, one bit each.
    inside: [u8; MOST],
    straddling: [u8; MOST],
    /// The corners in each plane: they are ends of its edge; and whether there are any.
    shared: [u8; MOST],
    shares: bool,
    /// The corners inside all planes.
    inside_all: u8,
    /// The edges that the other cone has, too, the same way.
    along: u8,
    corners: usize,
}

/// What the sides of corners say about two cones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Standing {
    /// A plane separates them.
    Apart,
    /// A plane separates them, and both have its edge: the number of that among the corners' edges, and among the planes.
    Beside([usize; 2]),
    /// All corners are inside all planes.
    Contained,
    /// Every sign is certain.
    Certain,
    Open,
}

impl Sides {
    /// Finds on which sides of the planes of one cone the corners of another are: neither has more than `MOST`. Where they share corners,
    /// that with the planes is smaller by much less if `is_smaller`, by much more if not.
    #[inline]
    pub(super) fn find(&mut self, planes: &OneCone, cone: &OneCone, is_smaller: bool) -> Standing {
        let (count, spread) = (cone.spread.corners.count, cone.spread);
        let all = u8::MAX >> (MOST - count);
        (self.inside_all, self.along, self.corners) = (all, 0, count);
        (self.shared, self.shares) = ([0; MOST], false);
        let mut is_open = false;
        let rows = self.depths.iter_mut().zip(&mut self.inside).zip(&mut self.straddling);
        for (number, (plane, ((depths, inside), straddling))) in planes.edges.iter().zip(rows).enumerate() {
            let (least, outside) = spread.corners.dots(plane.inward, depths);
            let (mut outside, clear) = (outside & all, CLEAR * spread.error(plane));
            let mut is_clear = least > clear;
            if !is_clear && let Some((shared, others)) = shared(depths, clear, cone.ids, planes.ends(number))
            {
                (is_clear, self.shared[number], self.shares) = (true, shared, true);
                let is_inside = others == Ordering::Greater;
                outside = if is_smaller && is_inside { outside & !shared } else { outside | shared };
                let edges = shared & after(shared, count);
                if edges != 0 && !is_inside {
                    return Standing::Beside([edges.trailing_zeros() as usize, number]);
                }
                self.along |= edges;
            }
            if is_clear && outside == all {
                return Standing::Apart;
            }
            is_open |= !is_clear;
            *inside = all ^ outside;
            // Bit i compares corners i and i + 1, the last one and the first.
            *straddling = (outside ^ after(outside, count)) & all;
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
        if self.along >> index & 1 == 1 {
            return Inside::Along { part: Interval::WHOLE, is_same_way: true };
        }
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
            let found = if self.shares && self.shared[other] >> index & 1 == 1 {
                Parameter::START
            } else if self.shares && self.shared[other] >> next & 1 == 1 {
                Parameter::END
            } else {
                crossing(edge, &planes[other], [depths[index], depths[next]])
            };
            if is_leaving {
                part.high = found;
            } else {
                part.low = found;
            }
        }
        let is_inside = is_crossed || self.inside_all >> index & 1 == 1;
        let is_empty = self.shares && (part.low == Parameter::END || part.high == Parameter::START);
        if is_inside && !is_empty { Inside::Part(part) } else { Inside::Nothing }
    }
}

/// Bit i is that of corner i + 1, of so many; bits beyond that may be set.
fn after(corners: u8, count: usize) -> u8 {
    corners >> 1 | corners << (count - 1)
}

/// The corners that are ends of a plane's edge, if all that are not clear of the plane are, and on which side of it the others are as a whole.
#[inline(never)]
fn shared(depths: &Lanes, clear: f64, corners: &[CornerId], ends: [CornerId; 2]) -> Option<(u8, Ordering)> {
    let (mut shared, mut others) = (0, 0.0);
    for (index, (corner, depth)) in corners.iter().zip(depths.as_flattened()).enumerate() {
        if depth.abs() > clear {
            others += depth;
        } else if ends.contains(corner) {
            shared |= 1 << index;
        } else {
            return None;
        }
    }
    (f64::abs(others) > clear).then_some((shared, others.total_cmp(&0.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::predicates::Plane;
    use crate::quick::cone::{Cones, Corner, Kind};
    use crate::quick::{exact_side::Span, inside::inside};
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

    /// A convex polygon of some of a few places, counter-clockwise seen from the origin.
    fn of_places() -> impl Strategy<Value = Vec<Corner>> {
        const PLACES: [[i8; 2]; 7] = [[0, 0], [4, 1], [1, 5], [-3, 2], [-2, -4], [3, -3], [6, 4]];
        let place = |[x, y]: [i8; 2]| DVec3::new(f64::from(x), f64::from(y), 3.0 + 0.1 * f64::from(x * y));
        prop::sample::subsequence(PLACES.map(place).to_vec(), 3..=4).prop_filter_map(
            "not convex",
            |mut places| {
                let middle = places.iter().sum::<DVec3>() / places.len() as f64;
                let angle =
                    |p: &DVec3| f64::atan2(p.x / p.z - middle.x / middle.z, p.y / p.z - middle.y / middle.z);
                places.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
                let next = |i: usize| places[i % places.len()];
                let is_convex =
                    (0..places.len()).all(|i| next(i).dot(next(i + 1).cross(next(i + 2))) < -1e-9);
                is_convex.then(|| places.iter().map(|p| Corner::given(*p, DVec3::ZERO, 0.0)).collect())
            },
        )
    }

    /// What of an edge is inside, as far as that is more than a point, and which way it runs along an edge of the other cone.
    fn measured(part: Inside) -> Option<([f64; 2], Option<bool>)> {
        match part {
            Inside::Part(part) if part.high.at - part.low.at > 1e-9 => {
                Some(([part.low.at, part.high.at], None))
            }
            Inside::Along { is_same_way, .. } => Some(([0.0, 1.0], Some(is_same_way))),
            _ => None,
        }
    }

    /// Some plane beyond all polygons.
    fn beyond() -> Plane {
        let corners = [[1e3, 0.0, 1e3], [0.0, 1e3, 1e3], [0.0, 0.0, 1e3]];
        Plane::through(corners.map(DVec3::from)).expect("three points that span a plane")
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn shared_corners_move_no_boundary(polygons in prop::array::uniform2(of_places()), is_smaller in any::<bool>()) {
            let mut cones = Cones::default();
            for polygon in &polygons {
                cones.push(polygon, Kind::Flat);
            }
            let [a, b] = [cones.cone(0), cones.cone(1)];
            let [mut there, mut back] = [Sides::default(); 2];
            let standings = [there.find(&b, &a, is_smaller), back.find(&a, &b, !is_smaller)];
            for (index, edge) in a.edges.iter().enumerate() {
                let clipped = inside(&Span { origin: DVec3::ZERO, plane: &beyond() }, (&a, index), &b);
                let found = match standings {
                    [Standing::Beside([own, _]), _] | [_, Standing::Beside([_, own])] if own == index => {
                        Inside::Along { part: Interval::WHOLE, is_same_way: false }
                    }
                    [Standing::Apart | Standing::Beside(_), _] | [_, Standing::Apart | Standing::Beside(_)] => Inside::Nothing,
                    [Standing::Open, _] | [_, Standing::Open] => continue,
                    _ => there.part(edge, index, b.edges, &back),
                };
                match (measured(found), measured(clipped)) {
                    (Some((found, found_way)), Some((clipped, clipped_way))) => {
                        prop_assert_eq!(found_way, clipped_way);
                        prop_assert!((found[0] - clipped[0]).abs() < 1e-9 && (found[1] - clipped[1]).abs() < 1e-9);
                    }
                    (found, clipped) => prop_assert_eq!(found, clipped),
                }
            }
        }

        #[test]
        fn signs_find_the_parts_that_clipping_finds(polygons in prop::array::uniform2(polygon())) {
            let mut cones = Cones::default();
            for polygon in polygons {
                cones.push(&corners(polygon), Kind::Flat);
            }
            let [a, b] = [cones.cone(0), cones.cone(1)];
            let [mut there, mut back] = [Sides::default(); 2];
            let standings = [there.find(&b, &a, false), back.find(&a, &b, true)];
            for (index, edge) in a.edges.iter().enumerate() {
                let clipped = inside(&Span { origin: DVec3::ZERO, plane: &beyond() }, (&a, index), &b);
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
