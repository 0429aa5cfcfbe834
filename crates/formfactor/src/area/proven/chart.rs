//! A cell of the source as part of a square, in which all that is seen from it is a function of two variables.
use crate::area::patch::Patch;
use crate::numeric::{
    gauss::RULE_3,
    taylor::{TERMS, Taylor},
};
use crate::shapes::cell::{fan, nodes};
use glam::{DVec2, DVec3};

/// A vector as `c + a u + b v`.
pub(super) type Varying = [DVec3; 3];

/// A convex cell, and a rectangle around it as the square of (u, v): `middle + u axes[0] + v axes[1]`.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    pub(super) patch: Patch,
    middle: DVec3,
    axes: [DVec3; 2],
    /// The corners of the cell in the square.
    corners: Vec<DVec2>,
    pub(super) area: f64,
}

impl Chart {
    /// The rectangle lies along the cell's longest side.
    pub(super) fn of(patch: Patch) -> Self {
        let points = patch.corners();
        let sides = points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| *b - *a);
        let longest = sides.fold(DVec3::ZERO, |longest, side| {
            if side.length_squared() > longest.length_squared() { side } else { longest }
        });
        let along = longest.normalize_or(DVec3::X);
        let off = points.iter().map(|p| (*p - points[0]).reject_from_normalized(along));
        let across = off
            .fold(DVec3::ZERO, |most, p| if p.length_squared() > most.length_squared() { p } else { most });
        let across = across.normalize_or(along.any_orthonormal_vector());
        let flat: Vec<DVec2> =
            points.iter().map(|p| *p - points[0]).map(|p| DVec2::new(p.dot(along), p.dot(across))).collect();
        let (low, high) = flat.iter().fold((flat[0], flat[0]), |(low, high), p| (low.min(*p), high.max(*p)));
        let (middle, half) = (low.midpoint(high), (high - low) / 2.0 * WIDER);
        let half = half.max(DVec2::splat(f64::MIN_POSITIVE));
        Self {
            middle: points[0] + along * middle.x + across * middle.y,
            axes: [along * half.x, across * half.y],
            corners: flat.into_iter().map(|p| (p - middle) / half).collect(),
            area: patch.area(),
            patch,
        }
    }

    /// From a point of the cell to `point`.
    pub(super) fn toward(&self, point: DVec3) -> Varying {
        [point - self.middle, -self.axes[0], -self.axes[1]]
    }

    /// The least and the greatest of `c + a u + b v` on the cell.
    pub(super) fn range(&self, [c, a, b]: [f64; 3]) -> (f64, f64) {
        let values = self.corners.iter().map(|p| c + a * p.x + b * p.y);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    }

    /// The share of the cell on which `c + a u + b v` is negative.
    pub(super) fn share_below(&self, [c, a, b]: [f64; 3]) -> f64 {
        let height = |p: DVec2| c + a * p.x + b * p.y;
        let (mut below, mut all) = (0.0, 0.0);
        let first = self.corners[0];
        for pair in self.corners[1..].windows(2) {
            let triangle = [first, pair[0], pair[1]];
            let area = (triangle[1] - first).perp_dot(triangle[2] - first).abs();
            all += area;
            below += area * part_below(triangle.map(height));
        }
        if all > 0.0 { (below / all).min(1.0) } else { 1.0 }
    }

    /// The parts of the cell at positive and at negative `c + a u + b v`.
    pub(super) fn cut(&self, [c, a, b]: [f64; 3]) -> [Patch; 2] {
        let [along, across] = self.axes.map(|axis| axis / axis.length_squared());
        self.patch.split(|p| c + a * along.dot(p - self.middle) + b * across.dot(p - self.middle))
    }

    /// Two halves across one of the axes.
    pub(super) fn halves(&self, axis: usize) -> [Patch; 2] {
        self.cut([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]][axis])
    }

    /// The axis along which directions to points turn most.
    pub(super) fn turning_axis(&self, points: impl Iterator<Item = DVec3>) -> usize {
        let turn = |axis: DVec3, way: DVec3| axis.cross(way).length() / way.length_squared();
        let most = points.fold([0.0_f64; 2], |[u, v], point| {
            let nearest = self.patch.corners().iter().map(|corner| point - *corner);
            nearest
                .fold([u, v], |[u, v], way| [u.max(turn(self.axes[0], way)), v.max(turn(self.axes[1], way))])
        });
        let most = if most.iter().all(|x| x.is_finite()) { most } else { self.axes.map(DVec3::length) };
        usize::from(most[1] > most[0])
    }

    /// The integral of a model over the cell, and what it may be off by.
    pub(super) fn integral(&self, model: &Taylor) -> [f64; 2] {
        let moments = self.moments();
        let value = model.terms.iter().zip(moments).map(|(c, moment)| c * moment).sum();
        // Nodes and weights are within some roundings of what they should be.
        [value, (model.rest + 64.0 * f64::EPSILON * model.reach()) * self.area]
    }

    /// The integrals of the monomials, by a rule that is exact for them.
    fn moments(&self) -> [f64; TERMS] {
        let mut moments = [0.0; TERMS];
        let [along, across] = self.axes.map(|axis| axis / axis.length_squared());
        for cell in fan(self.patch.corners()) {
            for (point, weight) in nodes(&cell, &RULE_3) {
                let (u, v) = (along.dot(point - self.middle), across.dot(point - self.middle));
                let monomials = [1.0, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v];
                moments.iter_mut().zip(monomials).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        moments
    }
}

/// A rectangle is so much wider than its cell, so that roundings leave no point outside.
const WIDER: f64 = 1.0 + 1e-12;

/// The share of a triangle at negative heights.
fn part_below(heights: [f64; 3]) -> f64 {
    let mut h = heights;
    h.sort_by(f64::total_cmp);
    let [low, middle, high] = h;
    if high <= 0.0 {
        1.0
    } else if low >= 0.0 {
        0.0
    } else if middle <= 0.0 {
        1.0 - high * high / ((high - low) * (high - middle))
    } else {
        low * low / ((low - middle) * (low - high))
    }
}
