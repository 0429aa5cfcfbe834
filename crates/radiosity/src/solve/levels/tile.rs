//! Tiles: convex parts of patches, over which light is linear.
use crate::mesh::convex::PlacedCorner;
use glam::{DVec2, DVec3};

/// Over how many standard deviations the points stand beside the centroid: so few that those of a triangle are inside of it.
const REACH: f64 = 1.38;
/// By so much of the axes the points are moved, so that they see no two edges in line because scenes are symmetric: form factors
/// are quicker then.
const NUDGE: f64 = 1e-5;
/// The mean square of a basis function.
pub(super) const SQUARE: f64 = 1.0 / (REACH * REACH);
/// What each of the outer points weighs in a mean, and what the centroid does: exact for quadratic functions.
pub(super) const OUTER: f64 = SQUARE / 2.0;
pub(super) const INNER: f64 = 1.0 - 4.0 * OUTER;

/// What is nearer to a side than this share of how far the other corners are is on it.
const ON: f64 = 1e-9;

/// No tile is made longer than this many times its width.
const SLENDER: f64 = 3.0;

/// A convex polygon in the frame of its patch, with what integrals over it need.
///
/// Light on it is a combination of 1 and two linear functions, which are orthogonal: zero at the centroid, 1 at the tips of
/// the axes, the principal ones.
///
/// ```text
/// +-----------------+
/// |        2        |
/// |                 |
/// | 1'     0      1 |    points of cubature: the centroid and the tips
/// |                 |
/// |        2'       |
/// +-----------------+
/// ```
#[derive(Clone, Debug)]
pub(super) struct Outline {
    /// Counter-clockwise, each with its place in space.
    pub(super) corners: Vec<(DVec2, DVec3)>,
    pub(super) area: f64,
    pub(super) centroid: DVec2,
    pub(super) axes: [DVec2; 2],
}

impl Outline {
    /// Nothing for what has no area.
    pub(super) fn new(corners: Vec<(DVec2, DVec3)>) -> Option<Outline> {
        let origin = corners.first()?.0;
        let [mut area, mut xx, mut xy, mut yy] = [0.0; 4];
        let mut moment = DVec2::ZERO;
        for [p, q] in edges(&corners).map(|ends| ends.map(|end| end - origin)) {
            let weight = p.perp_dot(q) / 2.0;
            area += weight;
            moment += (p + q) * (weight / 3.0);
            xx += weight / 6.0 * (p.x * p.x + p.x * q.x + q.x * q.x);
            yy += weight / 6.0 * (p.y * p.y + p.y * q.y + q.y * q.y);
            xy += weight / 12.0 * (2.0 * (p.x * p.y + q.x * q.y) + p.x * q.y + q.x * p.y);
        }
        let middle = moment / area;
        let covariance = [
            xx / area - middle.x * middle.x,
            xy / area - middle.x * middle.y,
            yy / area - middle.y * middle.y,
        ];
        let axes = principal(covariance);
        let is_sound = area > 0.0 && axes.iter().all(|axis| axis.length_squared() > 0.0 && axis.is_finite());
        is_sound.then_some(Outline { corners, area, centroid: origin + middle, axes })
    }

    /// The places of the corners.
    pub(super) fn places(&self) -> impl Iterator<Item = DVec3> {
        self.corners.iter().map(|corner| corner.1)
    }

    /// The centroid and the tips of the axes: the first, its opposite, the second, its opposite.
    pub(super) fn points(&self) -> [DVec2; 5] {
        let [a, b] = self.axes;
        let [aside, askew] = [a * NUDGE, b * (NUDGE * 0.618)];
        let arms = [DVec2::ZERO, a, -a, b, -b];
        let nudges = [aside + askew, askew, aside - askew, -aside, askew * 0.5 - aside];
        [0, 1, 2, 3, 4].map(|k| self.centroid + arms[k] + nudges[k])
    }

    /// The point of an axis at so many times its length from the centroid.
    pub(super) fn on_axis(&self, axis: usize, at: f64) -> DVec2 {
        self.centroid + self.axes[axis] * at + self.axes[1 - axis] * NUDGE
    }

    /// The two linear functions at a point.
    pub(super) fn linear(&self, point: DVec2) -> [f64; 2] {
        self.axes.map(|axis| (point - self.centroid).dot(axis) / axis.length_squared())
    }

    /// The parts on both sides of a line, where it passes inside; `lift` gives new corners their places.
    pub(super) fn cut(
        &self,
        [point, along]: [DVec2; 2],
        lift: impl Fn(DVec2) -> DVec3,
    ) -> Option<[Outline; 2]> {
        let heights: Vec<f64> = self.corners.iter().map(|(p, _)| along.perp_dot(*p - point)).collect();
        let near = 1e-9 * heights.iter().fold(0.0, |most: f64, height| most.max(height.abs()));
        let mut parts = [Vec::new(), Vec::new()];
        for (k, &corner) in self.corners.iter().enumerate() {
            let next = (k + 1) % self.corners.len();
            let (here, there) = (heights[k], heights[next]);
            parts
                .iter_mut()
                .zip([here, -here])
                .filter(|(_, height)| *height >= -near)
                .for_each(|(part, _)| part.push(corner));
            if here.abs() > near && there.abs() > near && (here > 0.0) != (there > 0.0) {
                let (start, end) = (corner.0, self.corners[next].0);
                let crossing = start + (end - start) * (here / (here - there));
                parts.iter_mut().for_each(|part| part.push((crossing, lift(crossing))));
            }
        }
        let [left, right] = parts.map(Outline::new);
        let (left, right) = (left?, right?);
        (left.area.min(right.area) > 1e-7 * self.area).then_some([left, right])
    }

    /// A line through the centroid across an axis, or across the long one of what is slender.
    pub(super) fn across(&self, axis: usize) -> [DVec2; 2] {
        let [long, short] = self.axes;
        let axis = if long.length() > SLENDER * short.length() { 0 } else { axis };
        [self.centroid, self.axes[1 - axis]]
    }

    /// How the functions of a parent read on a part of it: 1 adds to 1 only; a linear function adds its value at the centroid to 1, and its
    /// climbs along both axes to the linear functions.
    pub(super) fn restriction(&self, parent: &Outline) -> [f64; 6] {
        let [a, b] = parent.linear(self.centroid);
        let climb = |axis: DVec2| parent.axes.map(|of| axis.dot(of) / of.length_squared());
        let [[aa, ab], [ba, bb]] = self.axes.map(climb);
        [a, b, aa, ab, ba, bb]
    }

    /// Whether a line passes through from rim to rim.
    pub(super) fn is_crossed_by(&self, [start, end]: [DVec2; 2]) -> bool {
        let far = (end - start).normalize_or_zero() * self.axes[0].length() * 1e3;
        let whole = self.within([start - far, end + far]);
        whole > 1e-4 * self.axes[0].length() && self.within([start, end]) > (1.0 - 1e-6) * whole
    }

    /// The diagonal of a box along a line around what is on one side of it: the larger of both.
    pub(super) fn diagonal_of_parts(&self, [start, end]: [DVec2; 2]) -> f64 {
        let way = (end - start).normalize_or_zero();
        let heights = || self.corners.iter().map(|(corner, _)| way.perp_dot(*corner - start));
        let (low, high) = (heights().fold(0.0, f64::min), heights().fold(0.0, f64::max));
        let along = || self.corners.iter().map(|(corner, _)| way.dot(*corner - start));
        let length = along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min);
        high.max(-low).hypot(length)
    }

    /// How much of a line is inside: the length of that part.
    pub(super) fn within(&self, [start, end]: [DVec2; 2]) -> f64 {
        let way = (end - start).normalize_or_zero();
        let (mut low, mut high) = (0.0f64, (end - start).length());
        let near = 1e-7 * self.axes[0].length();
        for [p, q] in edges(&self.corners) {
            let side = (q - p).normalize_or_zero();
            let (height, climb) = (side.perp_dot(start - p) - near, side.perp_dot(way));
            if climb.abs() < 1e-12 {
                high = if height <= 0.0 { f64::NEG_INFINITY } else { high };
            } else if climb > 0.0 {
                low = low.max(-height / climb);
            } else {
                high = high.min(-height / climb);
            }
        }
        (high - low).max(0.0)
    }
}

/// What of a convex polygon is within another one, both counter-clockwise; of a line and its reverse new corners have the same bits.
pub(super) fn clipped(polygon: Vec<PlacedCorner>, within: &[PlacedCorner]) -> Vec<PlacedCorner> {
    edges(within).fold(polygon, |rest, [start, end]| {
        let is_forth = start.to_array() < end.to_array();
        let [low, high] = if is_forth { [start, end] } else { [end, start] };
        let height = |at: DVec2| (high - low).perp_dot(at - low) * if is_forth { 1.0 } else { -1.0 };
        left_of(&rest, height)
    })
}

/// The part of a convex polygon where a linear function is positive.
fn left_of(polygon: &[PlacedCorner], height: impl Fn(DVec2) -> f64) -> Vec<PlacedCorner> {
    let heights: Vec<f64> = polygon.iter().map(|corner| height(corner.0)).collect();
    let near = ON * heights.iter().fold(0.0, |most: f64, height| most.max(height.abs()));
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &corner) in polygon.iter().enumerate() {
        let next = (k + 1) % polygon.len();
        let (here, there) = (heights[k], heights[next]);
        if here >= -near {
            kept.push(corner);
        }
        if here.abs() > near && there.abs() > near && (here > 0.0) != (there > 0.0) {
            kept.push(between([(corner, here), (polygon[next], there)]));
        }
    }
    if heights.iter().any(|height| *height > near) { kept } else { Vec::new() }
}

/// The point of a side where a linear function is 0: the same from both ends.
fn between(ends: [(PlacedCorner, f64); 2]) -> PlacedCorner {
    let [(one, here), (other, there)] =
        if ends[0].0.0.to_array() < ends[1].0.0.to_array() { ends } else { [ends[1], ends[0]] };
    let share = here / (here - there);
    (one.0 + (other.0 - one.0) * share, one.1 + (other.1 - one.1) * share)
}

fn edges(corners: &[(DVec2, DVec3)]) -> impl Iterator<Item = [DVec2; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| [a.0, b.0])
}

/// The principal axes of a covariance, the longer one first.
fn principal([xx, xy, yy]: [f64; 3]) -> [DVec2; 2] {
    let long = DVec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
    let deviation = |e: DVec2| (xx * e.x * e.x + 2.0 * xy * e.x * e.y + yy * e.y * e.y).max(0.0).sqrt();
    [long, long.perp()].map(|way| way * (REACH * deviation(way)))
}
