//! One pair of polygons.
use super::cubature::Cubature;
use super::integral::{Allowed, Integral, least_whole};
use super::lambert::lambert;
use super::point::{Eye, Near};
use super::proven::Proof;
use super::swept::{rounded, swept};
use super::{contour, hollow, kernel};
use crate::numeric::gauss::{RULE_3, RULE_4, RULE_6};
use crate::numeric::rounding::rounding_of;
use crate::scene::apart::are_apart;
use crate::scene::occluder::{Before, Face};
use crate::scene::surfaces::{Hider, Origin, Surface, Surfaces};
use crate::shapes::cell::nodes;
use glam::DVec3;
use std::{borrow::Cow, f64::consts::PI};

/// The share of what is allowed that integrals with nothing in between may err by: they cost little, and errors of what is hidden add to
/// theirs.
const EASY: f64 = 0.1;

/// A polygon, and what is before its plane.
#[derive(Debug)]
pub(super) struct Outlook<'e> {
    surfaces: &'e Surfaces,
    own: &'e Surface,
    /// What of each occluder is before it, or of those toward the one polygon that is looked at.
    near: Vec<Option<(Origin, Near<'e>)>>,
    /// The numbers of those that some is of, or of all toward the one polygon.
    all: Vec<usize>,
    is_toward_one: bool,
}

impl<'e> Outlook<'e> {
    pub(super) fn from(surfaces: &'e Surfaces, own: &'e Surface) -> Self {
        let near: Vec<_> = surfaces.hiders.iter().map(|hider| seen(hider, own)).collect();
        let all = (0..near.len()).filter(|id| near[*id].is_some()).collect();
        Self { surfaces, own, near, all, is_toward_one: false }
    }

    /// The same for a look at one polygon alone: nothing aside of both is looked at.
    pub(super) fn toward(surfaces: &'e Surfaces, own: &'e Surface, other: &Surface) -> Self {
        if surfaces.hiders.len() <= FEW {
            return Self::from(surfaces, own);
        }
        let all = in_hull(surfaces, [own, other]);
        let near = all.iter().map(|id| seen(&surfaces.hiders[*id], own)).collect();
        Self { surfaces, own, near, all, is_toward_one: true }
    }

    /// What of an occluder is before this polygon.
    fn near(&self, id: usize) -> Option<&(Origin, Near<'e>)> {
        let at = if self.is_toward_one { self.all.binary_search(&id).ok()? } else { id };
        self.near.get(at)?.as_ref()
    }

    /// The double integral of the kernel over this polygon and another one that it faces.
    pub(super) fn exchange(
        &self,
        target: &Surface,
        allowed: &Allowed,
        eye: &mut Eye,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        let past = self.past_solids(target, allowed, eye, is_cancelled)?;
        let through = hollow::exchange(self.own, target, EASY * allowed.error(past.value, past.value));
        Some(past.plus(through))
    }

    /// The same past solids, as if none were hollow.
    fn past_solids(
        &self,
        target: &Surface,
        allowed: &Allowed,
        eye: &mut Eye,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        let [one, other] = [self.own, target];
        let Some(occluders) = self.between(other, eye) else { return Some(Integral::default()) };
        if occluders.is_empty() {
            let found = unobstructed(one, other, &allowed.part(EASY));
            if let Some(found) = found.or_else(|| unobstructed(one, other, allowed)) {
                return Some(found);
            }
        }
        let unhidden =
            if occluders.is_empty() { None } else { unobstructed(one, other, &allowed.part(EASY)) };
        let (one, other) = in_order(one, other, &occluders);
        Cubature::new(one, other, &occluders, eye).integrate(unhidden, allowed, is_cancelled)
    }

    /// The same as an interval that holds. What is given may lie `deviation` from where it stands.
    pub(super) fn proven(
        &self,
        target: &Surface,
        allowed: &Allowed,
        deviation: f64,
        is_cancelled: &(impl Fn() -> bool + ?Sized),
    ) -> Option<Integral> {
        let [one, other] = [self.own, target];
        let between = self.between(other, &mut Eye::default());
        let occluders = between.as_deref().unwrap_or_default();
        let (one, other) = in_order(one, other, occluders);
        let deviation = deviation + rounded([one, other], occluders);
        let swept = swept([one, other], occluders, deviation);
        let through = hollow::exchange(one, other, 0.0);
        let through = Integral { error: SURE * through.error + swept, ..through };
        if between.is_none() {
            return Some(through);
        }
        if occluders.is_empty() && contour::is_closed(one, other) && are_before([one, other]) {
            let [value, error] = contour::exchange(&one.edges, &other.edges, 0.0);
            return Some(through.plus(Integral { value, error: SURE * error, evaluations: 0 }));
        }
        let past =
            Proof::new(one, other, occluders, deviation).integrate(through.error, allowed, is_cancelled)?;
        Some(Integral { value: past.value + through.value, ..past })
    }

    /// The numbers of the occluders that balls do not show to be elsewhere than between this polygon and another one.
    fn near_to(&self, other: &Surface) -> Cow<'_, [usize]> {
        if self.is_toward_one || self.near.len() <= FEW {
            return Cow::Borrowed(&self.all);
        }
        Cow::Owned(in_hull(self.surfaces, [self.own, other]))
    }

    /// What can stand between this polygon and another one; `None` where one occluder hides all of it.
    fn between(&self, other: &Surface, eye: &mut Eye) -> Option<Vec<Near<'_>>> {
        let (one, hiders) = (self.own, &self.surfaces.hiders);
        // What hid the last one may hide this one.
        let may_cover = |id: usize| {
            let is_between = |near: &&(Origin, _)| !other.is_of(near.0) && hiders[id].counts(one, other);
            self.near(id).filter(is_between)
        };
        if let Some(part) =
            may_cover(eye.cover).and_then(|near| before(Cow::Borrowed(near.1.as_ref()), other))
        {
            if eye.is_covered(&one.pieces, &other.pieces, &part) {
                return None;
            }
        }
        let mut hull: Vec<DVec3> = Vec::new();
        let mut found = Vec::new();
        for &id in self.near_to(other).iter() {
            let Some((_, occluder)) = may_cover(id) else { continue };
            let Some(away) = to_hull(one, other, occluder.middle, occluder.radius) else { continue };
            if hull.is_empty() {
                hull.extend(one.pieces.iter().chain(&other.pieces).flatten());
            }
            if are_apart(&hull, &occluder.corners, away) {
                continue;
            }
            let Some(part) = before(Cow::Borrowed(occluder.as_ref()), other) else { continue };
            if eye.is_covered(&one.pieces, &other.pieces, &part) {
                eye.cover = id;
                return None;
            }
            found.push(part);
        }
        Some(found)
    }
}

/// So few occluders are looked at one by one: asking for boxes around them first would cost more.
const FEW: usize = 64;

/// The numbers of the occluders that may be in the hull of the balls around two surfaces.
fn in_hull(surfaces: &Surfaces, [one, other]: [&Surface; 2]) -> Vec<usize> {
    let mut found = surfaces.tree.find(|extent| {
        let middle = extent.low.midpoint(extent.high);
        to_hull(one, other, middle, middle.distance(extent.high)).is_none()
    });
    found.sort_unstable();
    found
}

/// What of an occluder is before a polygon that it is no part of.
fn seen<'e>(hider: &'e Hider, own: &Surface) -> Option<(Origin, Near<'e>)> {
    if own.is_of(hider.of) {
        return None;
    }
    Some((hider.of, before(Cow::Borrowed(&hider.shape), own)?))
}

/// What of an occluder is before a surface.
fn before<'o>(occluder: Near<'o>, surface: &Surface) -> Option<Near<'o>> {
    match occluder.before(surface.face) {
        Before::All => Some(occluder),
        Before::Part(part) => Some(Cow::Owned(part)),
        Before::Nothing => None,
    }
}

/// The way from the axis of two surfaces to the middle of a ball, unless the balls around all three show that it is not in between.
///
/// The convex hull of two balls is in the cone around them, of half the angle with the sine (r2 - r1) / d.
fn to_hull(one: &Surface, other: &Surface, middle: DVec3, radius: f64) -> Option<DVec3> {
    let (axis, way) = (other.middle - one.middle, middle - one.middle);
    let square = axis.length_squared();
    let share = way.dot(axis) / square;
    let growth = other.radius - one.radius;
    let width = one.radius + growth * share + radius;
    let across = (way - axis * share).length_squared() * (1.0 - growth * growth / square);
    let is_in_cone = width > 0.0 && across <= width * width || growth * growth >= square;
    let away = way - axis * share.clamp(0.0, 1.0);
    let reach = radius + one.radius.max(other.radius);
    (is_in_cone && away.length_squared() <= reach * reach).then_some(away)
}

/// The two with the one first that is small as the occluders see it: its points see them alike.
fn in_order<'s>(one: &'s Surface, other: &'s Surface, occluders: &[Near]) -> (&'s Surface, &'s Surface) {
    let size = |surface: &Surface| {
        let each = occluders.iter().map(|o| surface.radius / o.middle.distance(surface.middle));
        each.fold(0.0, f64::max)
    };
    let sizes = [size(one), size(other)];
    if sizes[1] < sizes[0] || (sizes[1] == sizes[0] && other.area < one.area) {
        (other, one)
    } else {
        (one, other)
    }
}

/// Roundings of a closed form are raised by so much.
const SURE: f64 = 8.0;

/// Whether each of two is wholly before the other's plane.
fn are_before([one, other]: [&Surface; 2]) -> bool {
    is_wholly_before(one, other.face) && is_wholly_before(other, one.face)
}

/// Whether all of a surface is before a plane.
fn is_wholly_before(surface: &Surface, [on, normal]: Face) -> bool {
    let middle = surface.middle - on;
    let least = -1e-13 * (middle.length() + surface.radius) - rounding_of([on, surface.middle]);
    normal.dot(middle) > surface.radius
        || surface.pieces.iter().flatten().all(|p| normal.dot(*p - on) >= least)
}

/// With nothing in between and each wholly before the other's plane: the cheapest rule that is good enough.
pub(super) fn unobstructed(one: &Surface, other: &Surface, allowed: &Allowed) -> Option<Integral> {
    if !are_before([one, other]) {
        return None;
    }
    let square = one.middle.distance_squared(other.middle);
    let rough = kernel::exchange(one, other).min(one.area).min(other.area);
    let tolerance = allowed.error(rough, rough.max(least_whole(one, other)));
    let far = if (one.radius + other.radius).powi(2) < square / 2.0 {
        far_apart(one, other, rough, tolerance)
    } else {
        None
    };
    far.or_else(|| {
        let [value, error] = contour::exchange(&one.edges, &other.edges, tolerance);
        (error <= tolerance).then_some(Integral { value: value.max(0.0), error, evaluations: 0 })
    })
}

/// By nodes on both, or on the smaller one alone.
fn far_apart(one: &Surface, other: &Surface, rough: f64, tolerance: f64) -> Option<Integral> {
    let found = |value: f64, error: f64| Some(Integral { value, error, evaluations: 0 });
    let areas = one.area * other.area;
    let error = kernel::error(one, other, 2) * areas;
    if error <= tolerance {
        return found(rough, error);
    }
    for (rule, nodes) in [(&RULE_3[..], 3), (&RULE_4[..], 4)] {
        let error = kernel::error(one, other, nodes) * areas;
        if error <= tolerance {
            return found(kernel::exchange_by(one, other, rule), error);
        }
    }
    let square = one.middle.distance_squared(other.middle);
    // The largest that the kernel may be.
    let most = areas / (PI * square);
    let (near, far) = if one.radius <= other.radius { (one, other) } else { (other, one) };
    let away = square.sqrt() - far.radius;
    let ratio = near.radius / away.max(near.radius);
    // An edge's part is its angle at most, and they cancel where the view is flat.
    let rounding = 4.0 * f64::EPSILON * far.edges.len() as f64 * (far.radius / away).min(1.0) * near.area;
    for (rule, power) in [(&RULE_3[..], 3), (&RULE_4[..], 4), (&RULE_6[..], 6)] {
        let error = 10.0 * ratio.powi(2 * power - i32::from(near.is_triangular)) * most + rounding;
        if error <= tolerance {
            return found(points(near, far, rule), error);
        }
    }
    None
}

/// By exact point factors.
fn points(one: &Surface, other: &Surface, rule: &[[f64; 2]]) -> f64 {
    let mut relative = Vec::new();
    let mut factor = |from: DVec3| -> f64 {
        let each = other.pieces.iter().map(|piece| {
            relative.clear();
            relative.extend(piece.iter().map(|p| *p - from));
            lambert(one.face[1], &relative)
        });
        each.sum()
    };
    one.cells.iter().flat_map(|cell| nodes(cell, rule)).map(|(point, weight)| weight * factor(point)).sum()
}
