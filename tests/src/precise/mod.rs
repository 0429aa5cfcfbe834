//! Form factors from a point with more than 90 digits: integers decide what is seen, big fixed-point numbers sum it.
//!
//! The direction from dA to a point is a homogeneous point of the target's plane. So projecting an occluder changes no
//! coordinate, lines are cross products, and all of the visible boundary is found in integers: every edge is cut where it meets
//! another one, and a piece counts where what is just left of it is seen and what is just right of it is not, or the other way.
//! Only Lambert's sum over these pieces is rounded.
mod fixed;
mod outline;
mod space;

use crate::exact::{Grid, nearest, ratio};
use crate::sweep::Loops;
use fixed::Fixed;
use glam::{DVec2, DVec3};
use num_rational::BigRational;
use num_traits::Signed;
use outline::Outline;
use space::{Vector, above, dot, minus, newell, sign};

/// A form factor, known to more than 90 digits after the point.
#[derive(Clone, Debug)]
pub struct Precise(BigRational);

impl Precise {
    /// The nearest double.
    pub fn round(&self) -> f64 {
        nearest(&self.0)
    }

    /// How far a number is from it.
    pub fn distance(&self, value: f64) -> f64 {
        nearest(&(ratio(value) - &self.0).abs())
    }

    /// 1 less this.
    #[must_use]
    pub fn complement(&self) -> Precise {
        Precise(ratio(1.0) - &self.0)
    }
}

/// The form factor from a differential area at `position` that looks along `normal` to `target` past `occluders`.
///
/// Vertices must be exactly coplanar; rules as in `formfactor`.
pub fn form_factor(position: DVec3, normal: DVec3, target: &Loops, occluders: &[Loops]) -> Precise {
    let all = || std::iter::once(target).chain(occluders).flatten().flatten().chain([&position]);
    let doubles = |p: &DVec3| [p.truncate(), DVec2::splat(p.z)];
    let points: Vec<DVec2> = all().flat_map(doubles).collect();
    let grid = Grid::of(&points);
    let steps = |p: DVec3| p.to_array().map(|x| grid.steps(x));
    let origin = steps(position);
    let seen = |loops: &Loops| -> Vec<Vec<Vector>> {
        loops.iter().map(|l| l.iter().map(|p| minus(&steps(*p), &origin)).collect()).collect()
    };
    let (target, occluders): (_, Vec<_>) = (seen(target), occluders.iter().map(seen).collect());
    let scale = Grid::of(&doubles(&normal));
    let normal = normal.to_array().map(|x| scale.steps(x));
    Precise(sum(&normal, &target, &occluders).by(&Fixed::tau()).ratio())
}

/// Whether a position lies on or behind a polygon's plane.
pub fn turns_its_back(position: DVec3, polygon: &Loops) -> bool {
    let points: Vec<DVec3> = polygon.iter().flatten().copied().chain([position]).collect();
    let doubles: Vec<DVec2> = points.iter().flat_map(|p| [p.truncate(), DVec2::splat(p.z)]).collect();
    let grid = Grid::of(&doubles);
    let seen =
        |p: &DVec3| minus(&p.to_array().map(|x| grid.steps(x)), &position.to_array().map(|x| grid.steps(x)));
    let outer: Vec<Vector> = polygon[0].iter().map(seen).collect();
    !dot(&newell(&outer), &outer[0]).is_negative()
}

/// Lambert's sum times 2 pi.
fn sum(normal: &Vector, target: &[Vec<Vector>], occluders: &[Vec<Vec<Vector>>]) -> Fixed {
    // dA must be on the side to which the target's normal points.
    let facing = newell(&target[0]);
    let height = -dot(&facing, &target[0][0]);
    if !height.is_positive() {
        return Fixed::zero();
    }
    let depth = facing.map(|x| -x);
    let clipped = above(target, |p| dot(normal, p));
    if clipped.iter().all(Vec::is_empty) {
        return Fixed::zero();
    }
    let mut outline = Outline::of(clipped, &depth, &height);
    for occluder in occluders {
        let own = newell(&occluder[0]);
        let is_edge_on = sign(&dot(&own, &occluder[0][0])) == 0;
        let before = |p: &Vector| &height - dot(&depth, p);
        let is_coplanar = occluder.iter().flatten().all(|p| sign(&before(p)) == 0);
        if !is_edge_on && !is_coplanar {
            outline.hide(above(occluder, before));
        }
    }
    outline.sum(normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(half: f64, z: f64) -> Loops {
        vec![
            [[-half, half], [half, half], [half, -half], [-half, -half]]
                .map(|[x, y]| DVec3::new(x, y, z))
                .to_vec(),
        ]
    }

    #[test]
    fn a_square_over_its_axis_is_the_closed_form() {
        let found = form_factor(DVec3::ZERO, DVec3::Z, &square(1.0, 1.0), &[]);
        assert_eq!(found.round(), 0.554_126_423_979_572);
    }

    #[test]
    fn a_board_hides_what_its_shadow_covers() {
        let whole = form_factor(DVec3::ZERO, DVec3::Z, &square(1.0, 2.0), &[]);
        let shadow = form_factor(DVec3::ZERO, DVec3::Z, &square(0.5, 2.0), &[]);
        let left =
            form_factor(DVec3::ZERO, DVec3::Z, &square(1.0, 2.0), &[square(0.25, 1.0), square(0.25, 1.0)]);
        assert!((whole.0 - shadow.0 - &left.0).abs() < ratio(1e-90));
        assert_eq!(left.round(), 0.165_978_835_648_252_17);
    }

    #[test]
    fn a_board_through_the_targets_plane_and_past_the_point_hides_before_the_target_alone() {
        let rectangle = |x: f64| {
            vec![
                [[-1.0, 1.0], [x, 1.0], [x, -1.0], [-1.0, -1.0]].map(|[x, y]| DVec3::new(x, y, 1.0)).to_vec(),
            ]
        };
        let corners = [[-9.0, 2.0], [-9.0, -3.0], [9.0, -3.0], [9.0, 2.0]];
        let board = vec![corners.map(|[y, z]| DVec3::new(0.5, y, z)).to_vec()];
        let left = form_factor(DVec3::ZERO, DVec3::Z, &rectangle(1.0), &[board]);
        let wanted = form_factor(DVec3::ZERO, DVec3::Z, &rectangle(0.5), &[]);
        assert!((left.0 - wanted.0).abs() < ratio(1e-90));
    }
}
