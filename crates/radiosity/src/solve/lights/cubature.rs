//! Integrals over triangles.
use glam::DVec3;

/// A place on a polygon, and two linear functions there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) at: DVec3,
    pub(crate) linear: [f64; 2],
}

/// The integrals of an irradiance E, of E times each of two linear functions, and of E².
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moments {
    pub(crate) whole: f64,
    pub(crate) linear: [f64; 2],
    pub(crate) square: f64,
}

/// Integrals are right within this share of what is lit.
const EXACT: f64 = 1e-7;
/// No triangle is halved more often, and none more often than this for its size alone.
const DEEPEST: u32 = 9;
const DEEPEST_BY_SIZE: u32 = 7;

impl Moments {
    fn add(&mut self, other: Moments) {
        self.whole += other.whole;
        self.square += other.square;
        self.linear[0] += other.linear[0];
        self.linear[1] += other.linear[1];
    }

    /// The largest difference, in shares of what counts as 1.
    fn off(&self, other: &Moments, unit: &Moments) -> f64 {
        let linear = (self.linear[0] - other.linear[0]).abs().max((self.linear[1] - other.linear[1]).abs());
        let first = (self.whole - other.whole).abs().max(linear);
        let share = |off: f64, unit: f64| if off == 0.0 { 0.0 } else { off / unit };
        share(first, unit.whole).max(share((self.square - other.square).abs(), unit.square))
    }
}

/// The moments of `irradiance` over triangles of a plane: those that run clockwise count as negative. `size` says how large a triangle is
/// beside what can be taken at once, and 0 where there is nothing to take.
pub(super) fn moments(
    triangles: &[[Place; 3]],
    normal: DVec3,
    irradiance: impl Fn(DVec3) -> f64,
    size: impl Fn(&[Place; 3]) -> f64,
) -> Moments {
    let mut open: Vec<([Place; 3], u32)> = Vec::new();
    let mut coarse: Vec<([Place; 3], u32)> = triangles.iter().map(|triangle| (*triangle, 0)).collect();
    while let Some((triangle, depth)) = coarse.pop() {
        if size(&triangle) > 1.0 && depth < DEEPEST_BY_SIZE {
            coarse.extend(quarters(&triangle).map(|part| (part, depth + 1)));
        } else {
            open.push((triangle, depth));
        }
    }
    let rule = |triangle: &[Place; 3]| radon(triangle, normal, &irradiance);
    let mut open: Vec<([Place; 3], u32, Moments)> =
        open.into_iter().map(|(triangle, depth)| (triangle, depth, rule(&triangle))).collect();
    let unit = open.iter().fold(Moments::default(), |mut sum, (.., found)| {
        sum.add(Moments { whole: found.whole.abs(), square: found.square.abs(), ..Moments::default() });
        sum
    });
    let mut all = Moments::default();
    while let Some((triangle, depth, before)) = open.pop() {
        let parts = quarters(&triangle).map(|part| (part, depth + 1, rule(&part)));
        let mut finer = Moments::default();
        parts.iter().for_each(|(.., found)| finer.add(*found));
        if depth >= DEEPEST || finer.off(&before, &unit) <= EXACT {
            all.add(finer);
        } else {
            open.extend(parts);
        }
    }
    all
}

/// A triangle cut through the middles of its sides.
fn quarters(&[a, b, c]: &[Place; 3]) -> [[Place; 3]; 4] {
    let middle = |p: Place, q: Place| Place {
        at: p.at.midpoint(q.at),
        linear: [0, 1].map(|k| f64::midpoint(p.linear[k], q.linear[k])),
    };
    let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// The rule of seven points, exact to degree 5 (Radon 1948).
fn radon(corners: &[Place; 3], normal: DVec3, irradiance: impl Fn(DVec3) -> f64) -> Moments {
    let [a, b, c] = corners.map(|place| place.at);
    let area = (b - a).cross(c - a).dot(normal) / 2.0;
    let root = 15f64.sqrt();
    let rings =
        [((6.0 - root) / 21.0, (155.0 - root) / 1200.0), ((6.0 + root) / 21.0, (155.0 + root) / 1200.0)];
    let mut sum = Moments::default();
    let mut take = |shares: [f64; 3], weight: f64| {
        let at = shares[0] * a + shares[1] * b + shares[2] * c;
        let linear = |k: usize| (0..3).map(|corner| shares[corner] * corners[corner].linear[k]).sum::<f64>();
        let light = irradiance(at);
        let power = area * weight * light;
        sum.add(Moments {
            whole: power,
            linear: [power * linear(0), power * linear(1)],
            square: power * light,
        });
    };
    take([1.0 / 3.0; 3], 0.225);
    for (near, weight) in rings {
        let far = 1.0 - 2.0 * near;
        take([far, near, near], weight);
        take([near, far, near], weight);
        take([near, near, far], weight);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_integrated_exactly_and_cut_off_light_nearly() {
        let corner = |x: f64, y: f64| Place { at: DVec3::new(x, y, 0.0), linear: [x, y] };
        let triangle = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)];
        let found = moments(&[triangle], DVec3::Z, |at| at.x * at.y, |_| 0.0);
        // ∫ xᵃ yᵇ = a! b! / (a + b + 2)!
        assert!((found.whole - 1.0 / 24.0).abs() < 1e-15);
        assert!((found.linear[0] - 2.0 / 120.0).abs() < 1e-15 && (found.square - 4.0 / 720.0).abs() < 1e-15);
        let turned = [triangle[0], triangle[2], triangle[1]];
        let hole = moments(&[triangle, turned], DVec3::Z, |at| at.x, |_| 0.0);
        assert!(hole.whole.abs() < 1e-15);
        let step = moments(&[triangle], DVec3::Z, |at| f64::from(at.x < 0.3), |_| 2.0);
        assert!((step.whole - (0.5 - 0.7 * 0.7 / 2.0)).abs() < 1e-4, "{}", step.whole);
    }
}
