//! What two surfaces see of each other inside of hollow solids that count as full: nothing is in between there.
use super::clip::before;
use super::contour;
use super::integral::Integral;
use crate::scene::surfaces::{Hollow, Surface};
use glam::DVec3;

/// The double integral of the kernel over the parts of two surfaces that look into the same solid.
pub(super) fn exchange(one: &Surface, other: &Surface, tolerance: f64) -> Integral {
    let mut found = Integral::default();
    for a in &one.hollows {
        for b in other.hollows.iter().filter(|b| b.solid == a.solid && b.side != a.side) {
            for p in within(one, a) {
                for q in within(other, b) {
                    let [value, error] = contour::exchange(&edges(&p), &edges(&q), tolerance);
                    found = found.plus(Integral { value, error, evaluations: 0 });
                }
            }
        }
    }
    found
}

/// The pieces of a surface within a side of a solid.
fn within(surface: &Surface, hollow: &Hollow) -> Vec<Vec<DVec3>> {
    let inward = |[a, b]: [DVec3; 2]| [a, surface.face[1].cross(b - a)];
    hollow.edges().fold(surface.pieces.clone(), |left, edge| before(&left, inward(edge)))
}

fn edges(ring: &[DVec3]) -> Vec<[DVec3; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]).collect()
}
