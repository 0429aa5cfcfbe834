//! What a point that moves in a cell sees within curtains: a convex polygon of directions, cut by others.
use super::chart::Chart;
use super::curtain::{Bearing, Curtain, Divide, Sign, linear_sign};
use super::factor::Sight;
use crate::scene::occluder::{CAP, Occluder, silhouette};
use glam::DVec3;

/// Corners, each with the curtain to the next, counter-clockwise as the point sees them.
#[derive(Clone, Debug)]
pub(super) struct Sector {
    pub(super) corners: Vec<(Bearing, Curtain)>,
}

/// What of a sector is inside of others.
#[derive(Debug)]
pub(super) enum Common {
    Nothing,
    Part(Sector),
    All,
}

/// What a sector that was cut may be off by, where some corners are on the other side from points of some of the cell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Doubt {
    /// What triangles at corners add to the mean at most.
    pub(super) stray: f64,
    /// The share of the cell on which it may be anything.
    pub(super) share: f64,
}

/// The curtains of an occluder's silhouette.
pub(super) type Cast = Vec<Curtain>;

/// The silhouette of an occluder, seen from all of a cell; nothing where it hides nothing.
///
/// # Errors
/// What parts the cell, where some of it sees a face and some does not.
pub(super) fn cast(chart: &Chart, occluder: &Occluder, deviation: f64) -> Result<Option<Cast>, Divide> {
    let mut facing = Vec::with_capacity(occluder.faces.len());
    for [on, normal] in &occluder.faces {
        let [c, a, b] = chart.toward(*on).map(|way| -normal.dot(way));
        match linear_sign(chart, [c, a, b], 2.0 * deviation) {
            Sign::Inside(0.0) => facing.push(true),
            Sign::Outside(0.0) => facing.push(false),
            // What touches a body is not inside.
            Sign::On => facing.push(!occluder.is_plate),
            Sign::Unclear(divide) => return Err(divide),
            Sign::Inside(_) | Sign::Outside(_) => return Err(Divide::Line([c, a, b])),
        }
    }
    debug_assert!(occluder.ridges.iter().flat_map(|r| r.sides).all(|s| s == CAP || s < facing.len()));
    let mut found = Cast::new();
    silhouette(&occluder.ridges, &facing, |ends| found.push(Curtain { ends }));
    // No face of a body is seen from inside of it.
    let is_around = found.is_empty() && !occluder.is_plate;
    join(&mut found, JOINED * deviation);
    Ok((is_around || found.len() > 2).then_some(found))
}

/// Vertices nearer to each other than so many deviations are one: what clipping leaves of an edge may run anywhere.
const JOINED: f64 = 4.0;

/// Makes the ends of short edges one, and leaves such edges out.
fn join(cast: &mut Cast, near: f64) {
    while let Some(i) = cast.iter().position(|curtain| curtain.ends[0].distance(curtain.ends[1]) <= near) {
        let [kept, other] = cast.swap_remove(i).ends;
        let ends = cast.iter_mut().flat_map(|curtain| &mut curtain.ends);
        ends.filter(|end| **end == other).for_each(|end| *end = kept);
    }
}

impl Sector {
    /// A convex polygon, counter-clockwise seen from its front; nothing unless it has three corners apart.
    pub(super) fn of(points: &[DVec3], deviation: f64) -> Option<Self> {
        let mut apart: Vec<DVec3> = Vec::with_capacity(points.len());
        for point in points {
            let is_near =
                |other: Option<&DVec3>| other.is_some_and(|p| p.distance(*point) <= JOINED * deviation);
            if !is_near(apart.last()) && !is_near(apart.first()) {
                apart.push(*point);
            }
        }
        let next = apart.iter().cycle().skip(1);
        let corner = |(a, b): (&DVec3, &DVec3)| (Bearing::Point(*a), Curtain { ends: [*a, *b] });
        let corners: Vec<_> = apart.iter().zip(next).map(corner).collect();
        (corners.len() > 2).then_some(Self { corners })
    }

    /// What of it is inside of all curtains, and what that may be off by.
    ///
    /// # Errors
    /// What parts the cell, where that has one shape from some points and another one from others.
    pub(super) fn within(&self, cast: &Cast, sight: &Sight) -> Result<(Common, Doubt), Divide> {
        let mut order: Vec<(bool, &Curtain)> = Vec::with_capacity(cast.len());
        for curtain in cast {
            let signs = self.signs(curtain, sight);
            if signs.iter().all(|sign| matches!(sign, Sign::Outside(_) | Sign::On)) {
                return Ok((Common::Nothing, self.doubt(curtain, &signs, sight)));
            }
            order.push((signs.iter().any(|sign| matches!(sign, Sign::Unclear(_))), curtain));
        }
        // What is cut off by curtains that are clear need not be asked of others.
        order.sort_by_key(|(is_unclear, _)| *is_unclear);
        let (mut left, mut doubt, mut is_cut) = (self.clone(), Doubt::default(), false);
        for (_, curtain) in order {
            let signs = left.signs(curtain, sight);
            if let Some(divide) = signs.iter().find_map(|sign| sign.divide()) {
                return Err(divide);
            }
            let own = left.doubt(curtain, &signs, sight);
            doubt = Doubt { stray: doubt.stray + own.stray, share: doubt.share + own.share };
            if !signs.iter().any(|sign| matches!(sign, Sign::Outside(_))) {
                continue;
            }
            if !signs.iter().any(|sign| matches!(sign, Sign::Inside(_))) {
                return Ok((Common::Nothing, doubt));
            }
            left = left.cut(curtain, &signs, sight.chart);
            is_cut = true;
        }
        Ok((if is_cut { Common::Part(left) } else { Common::All }, doubt))
    }

    fn signs(&self, curtain: &Curtain, sight: &Sight) -> Vec<Sign> {
        let side = |(bearing, _): &(Bearing, Curtain)| curtain.side_of(sight.chart, bearing, sight.deviation);
        self.corners.iter().map(side).collect()
    }

    /// What cutting by a curtain may be off by.
    ///
    /// Cut with a wrong sign of one corner, the sector gains or loses the triangle between that corner and the curtain, which is small where
    /// the sign is in doubt; with several wrong signs, one after the other, as many triangles. Lambert's sum over what then may turn
    /// around itself counts each direction as often as it is wound around, and what is cut from it later takes parts of the
    /// triangles away at most.
    fn doubt(&self, curtain: &Curtain, signs: &[Sign], sight: &Sight) -> Doubt {
        let mut doubt = Doubt::default();
        for (i, sign) in signs.iter().enumerate().filter(|(_, sign)| sign.doubt() > 0.0) {
            let triangle = self.triangle(i, curtain, signs, sight);
            match triangle.and_then(|corners| sight.factor(&corners)) {
                Some(factor) => doubt.stray += sign.doubt() * factor.reach(),
                None => doubt.share += sign.doubt(),
            }
        }
        doubt
    }

    /// The triangle between a corner and a curtain, where the corners beside it are not in doubt.
    fn triangle(
        &self,
        i: usize,
        curtain: &Curtain,
        signs: &[Sign],
        sight: &Sight,
    ) -> Option<[(Bearing, Curtain); 3]> {
        let count = self.corners.len();
        let (before, after) = ((i + count - 1) % count, (i + 1) % count);
        let (inward, outward) = (self.corners[before].1, self.corners[i].1);
        let beside = |k: usize, both: [Curtain; 2]| match signs[k] {
            Sign::Inside(0.0) => Some(meeting(sight.chart, both, true)),
            Sign::Outside(0.0) => Some(meeting(sight.chart, both, false)),
            Sign::On => Some(on(sight.chart, &self.corners[k].0, both)),
            _ => None,
        };
        let (first, last) = (beside(before, [*curtain, inward])?, beside(after, [outward, *curtain])?);
        Some([(first, inward), (self.corners[i].0, outward), (last, *curtain)])
    }

    /// What is inside of a curtain, some being inside and some outside.
    fn cut(&self, curtain: &Curtain, signs: &[Sign], chart: &Chart) -> Self {
        let count = self.corners.len();
        let is_outside = |i: usize| matches!(signs[i % count], Sign::Outside(_));
        let is_inside = |i: usize| matches!(signs[i % count], Sign::Inside(_));
        let mut corners = Vec::with_capacity(count + 1);
        for (i, (bearing, along)) in self.corners.iter().enumerate() {
            let before = self.corners[(i + count - 1) % count].1;
            if is_inside(i) {
                corners.push((*bearing, *along));
            } else if !is_outside(i) {
                // On it: a corner that is left by another curtain, or entered by it.
                let [enters, leaves] = [is_outside(i + count - 1), is_outside(i + 1)];
                let both = [if enters { *curtain } else { before }, if leaves { *curtain } else { *along }];
                corners.push((on(chart, bearing, both), both[1]));
            }
            if is_inside(i) && is_outside(i + 1) {
                corners.push((meeting(chart, [*along, *curtain], false), *curtain));
            } else if is_outside(i) && is_inside(i + 1) {
                corners.push((meeting(chart, [*curtain, *along], false), *along));
            }
        }
        Self { corners }
    }
}

impl Sign {
    fn divide(self) -> Option<Divide> {
        if let Self::Unclear(divide) = self { Some(divide) } else { None }
    }
}

/// A corner that lies on both of two curtains.
fn on(chart: &Chart, bearing: &Bearing, both: [Curtain; 2]) -> Bearing {
    if let Bearing::Point(_) = bearing {
        return *bearing;
    }
    let is_turned = Bearing::Crossing(both).middle(chart).dot(bearing.middle(chart)) < 0.0;
    meeting(chart, both, is_turned)
}

/// Where one curtain comes to the next, or away from there: at a vertex that both have, unless that is the other way, or where
/// they cross.
fn meeting(chart: &Chart, both: [Curtain; 2], is_turned: bool) -> Bearing {
    let crossing = if is_turned { Bearing::Opposite(both) } else { Bearing::Crossing(both) };
    let shared = both[0].ends.into_iter().find(|end| both[1].ends.contains(end));
    let vertex = shared.filter(|end| chart.toward(*end)[0].dot(crossing.middle(chart)) > 0.0);
    vertex.map_or(crossing, Bearing::Point)
}
