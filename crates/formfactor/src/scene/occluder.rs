//! Convex occluders: plates and convex bodies, as what is in front of them sees them.
use crate::numeric::rounding::rounding_of;
use glam::DVec3;
use std::cmp::Ordering;

/// An edge between two faces of a convex occluder, its left face counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ridge {
    pub(crate) ends: [DVec3; 2],
    /// Faces, by number; [`CAP`] is one that is never seen.
    pub(crate) sides: [usize; 2],
}

/// A face that turns away from whoever asks.
pub(crate) const CAP: usize = usize::MAX;

/// A face's plane: a point on it, and the unit normal outward.
pub(crate) type Face = [DVec3; 2];

/// A ball around points: the middle of their box, and how far the farthest is.
pub(crate) fn ball(points: &[DVec3]) -> (DVec3, f64) {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(none, |(low, high), p| (low.min(*p), high.max(*p)));
    let middle = low.midpoint(high);
    (middle, points.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max).sqrt())
}

/// A convex body, or a convex plate that is a body without thickness.
#[derive(Clone, Debug)]
pub(crate) struct Occluder {
    pub(crate) ridges: Vec<Ridge>,
    pub(crate) faces: Vec<Face>,
    /// The corners, each once.
    pub(crate) corners: Vec<DVec3>,
    pub(crate) is_plate: bool,
    pub(crate) middle: DVec3,
    pub(crate) radius: f64,
    /// No shadow along parallel rays is larger: half of the area of all faces.
    pub(crate) breadth: f64,
    /// How far corners may be off the planes of their faces: roundings, and deviation.
    blur: f64,
}

impl Occluder {
    /// A plate from its corners, counter-clockwise seen from where `normal` points to, each at most `deviation` off its plane.
    pub(crate) fn plate(corners: &[DVec3], normal: DVec3, deviation: f64) -> Self {
        let next = corners.iter().cycle().skip(1);
        let ridges = corners.iter().zip(next).map(|(a, b)| Ridge { ends: [*a, *b], sides: [0, 1] });
        let faces = vec![[corners[0], normal], [corners[0], -normal]];
        Self::of(ridges.collect(), faces, true, deviation + rounding_of(corners.iter().copied()))
    }

    /// A convex body from its ridges, their ends at most `deviation` off the faces' planes.
    pub(crate) fn body(ridges: Vec<Ridge>, faces: Vec<Face>, deviation: f64) -> Self {
        let blur = deviation + rounding_of(ridges.iter().flat_map(|ridge| ridge.ends));
        Self::of(ridges, faces, false, blur)
    }

    fn of(ridges: Vec<Ridge>, faces: Vec<Face>, is_plate: bool, blur: f64) -> Self {
        let mut corners: Vec<DVec3> = ridges.iter().flat_map(|ridge| ridge.ends).collect();
        corners.sort_by(|a, b| a.to_array().partial_cmp(&b.to_array()).unwrap_or(Ordering::Equal));
        corners.dedup();
        let (middle, radius) = ball(&corners);
        let breadth = breadth(&ridges, faces.len(), middle);
        Self { ridges, faces, corners, is_plate, middle, radius, breadth, blur }
    }

    /// Whether a point sees each face, as far as doubles say. A face of a body is seen by what touches it: from on its plane a
    /// shadow is the same with the face and without it, but one that sees no face at all is inside.
    pub(crate) fn facing(&self, point: DVec3, facing: &mut Vec<bool>) {
        let touch = self.touch();
        facing.clear();
        facing.extend(self.faces.iter().map(|[on, normal]| normal.dot(point - *on) > -touch));
    }

    /// What is no farther than this behind a face of a body touches it.
    fn touch(&self) -> f64 {
        if self.is_plate { 0.0 } else { self.blur + LEAST * self.radius }
    }

    /// Whether all points of a cell see the same faces.
    pub(crate) fn turns_alike(&self, cell: &[DVec3]) -> bool {
        self.faces.iter().all(|face| {
            let [low, high] = extent(cell, face, self.touch());
            -low <= SLIGHT * high || high <= -SLIGHT * low
        })
    }

    /// Whether some points of a cell see each face, and whether some do not: inside of it, so that corners on a face's plane
    /// see what the others see.
    pub(crate) fn sides(&self, cell: &[DVec3], sides: &mut Vec<[bool; 2]>) {
        sides.clear();
        sides.extend(self.faces.iter().map(|face| {
            let [low, high] = extent(cell, face, self.touch());
            [high > -SLIGHT * low, low < -SLIGHT * high || high == 0.0]
        }));
    }

    /// What of it is before a plane, by a point on the plane and its normal: itself, a part, or nothing.
    pub(crate) fn before(&self, [on, normal]: Face) -> Before {
        let height = |p: DVec3| normal.dot(p - on);
        let middle = height(self.middle);
        let least = self.blur + LEAST * (self.radius + self.middle.distance(on));
        if middle > self.radius {
            return Before::All;
        }
        let (low, high) = self
            .corners
            .iter()
            .map(|p| height(*p))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        if high <= least || middle < -self.radius {
            Before::Nothing
        } else if low >= -least {
            Before::All
        } else {
            // A ridge that roundings leave of an edge may run anywhere: a vertex that is on the plane up to them is on it.
            Before::Part(self.clip(|p| if height(p).abs() <= least { 0.0 } else { height(p) }))
        }
    }

    /// The part at positive heights. The plane becomes a face that is never seen.
    fn clip(&self, height: impl Fn(DVec3) -> f64) -> Self {
        let mut ridges = Vec::with_capacity(self.ridges.len() + 2);
        // Where each face's boundary leaves the part, and where it comes back.
        let mut cuts: Vec<[Option<DVec3>; 2]> = vec![[None; 2]; self.faces.len()];
        for Ridge { ends: [a, b], sides } in &self.ridges {
            let [from, to] = [height(*a), height(*b)];
            if from <= 0.0 && to <= 0.0 {
                continue;
            }
            let at = *a + (*b - *a) * (from / (from - to));
            let ends = if from < 0.0 {
                [at, *b]
            } else if to < 0.0 {
                [*a, at]
            } else {
                [*a, *b]
            };
            if from <= 0.0 || to <= 0.0 {
                let leaves = to <= 0.0;
                let point = if from == 0.0 {
                    *a
                } else if to == 0.0 {
                    *b
                } else {
                    at
                };
                for (side, is_left) in sides.iter().zip([true, false]) {
                    if *side != CAP {
                        cuts[*side][usize::from(leaves != is_left)] = Some(point);
                    }
                }
            }
            ridges.push(Ridge { ends, sides: *sides });
        }
        for (face, cut) in cuts.iter().enumerate().take(if self.is_plate { 1 } else { usize::MAX }) {
            if let [Some(out), Some(back)] = cut {
                ridges
                    .push(Ridge { ends: [*out, *back], sides: [face, if self.is_plate { 1 } else { CAP }] });
            }
        }
        Self::of(ridges, self.faces.clone(), self.is_plate, self.blur)
    }
}

/// Half of the area of a convex body's faces; one that is never seen has what the others do not close.
fn breadth(ridges: &[Ridge], faces: usize, middle: DVec3) -> f64 {
    let mut areas = vec![DVec3::ZERO; faces];
    for Ridge { ends: [a, b], sides } in ridges {
        let part = (*a - middle).cross(*b - middle) / 2.0;
        for (side, part) in sides.iter().zip([part, -part]) {
            if let Some(area) = areas.get_mut(*side) {
                *area += part;
            }
        }
    }
    let open: DVec3 = areas.iter().sum();
    (areas.iter().map(|area| area.length()).sum::<f64>() + open.length()) / 2.0
}

/// Calls with each ridge that is an edge of the silhouette, as a point sees it that sees the faces `facing`: edges that run
/// counter-clockwise.
pub(crate) fn silhouette(ridges: &[Ridge], facing: &[bool], mut with: impl FnMut([DVec3; 2])) {
    // A cap is no face: none is seen.
    let sees = |side: usize| facing.get(side).is_some_and(|sees| *sees);
    for Ridge { ends: [a, b], sides: [left, right] } in ridges {
        let is_left = sees(*left);
        if is_left != sees(*right) {
            with(if is_left { [*a, *b] } else { [*b, *a] });
        }
    }
}

/// How far points are below a plane at most, and above it, if it were `lower` by so much.
fn extent(points: &[DVec3], [on, normal]: &Face, lower: f64) -> [f64; 2] {
    let heights = points.iter().map(|p| normal.dot(*p - *on) + lower);
    heights.fold([0.0; 2], |[low, high], h| [low.min(h), high.max(h)])
}

/// What lies behind a plane by no more than this of its distance from the plane's point counts as before it.
const LEAST: f64 = 1e-13;

/// What lies behind a plane by no more than this of another distance counts as on it.
const SLIGHT: f64 = 1e-9;

/// What of an occluder is before a plane.
#[derive(Clone, Debug)]
pub(crate) enum Before {
    All,
    Part(Occluder),
    Nothing,
}
