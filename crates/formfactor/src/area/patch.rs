//! Small convex polygons, without allocation.
use crate::scene::surfaces::area;
use glam::DVec3;

/// A patch has at most so many corners.
pub(super) const MOST_CORNERS: usize = 12;

/// A small convex polygon.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub(super) at: [DVec3; MOST_CORNERS],
    pub(super) count: usize,
}

impl Patch {
    /// The first corners of a polygon, which are all if it has few.
    pub(super) fn of(corners: &[DVec3]) -> Self {
        let mut patch = Self { at: [DVec3::ZERO; MOST_CORNERS], count: 0 };
        corners.iter().for_each(|corner| patch.push(*corner));
        patch
    }

    fn push(&mut self, corner: DVec3) {
        if self.count < MOST_CORNERS {
            self.at[self.count] = corner;
            self.count += 1;
        }
    }

    pub(super) fn corners(&self) -> &[DVec3] {
        &self.at[..self.count]
    }

    pub(super) fn area(&self) -> f64 {
        if self.count < 3 { 0.0 } else { area(self.corners()) }
    }

    /// The parts at positive and at negative heights.
    pub(super) fn split(&self, height: impl Fn(DVec3) -> f64) -> [Self; 2] {
        let mut parts = [Self::of(&[]); 2];
        let Some(mut a) = self.corners().last().copied() else { return parts };
        let mut there = height(a);
        for &b in self.corners() {
            let here = height(b);
            if (there < 0.0 && here > 0.0) || (there > 0.0 && here < 0.0) {
                let at = a + (b - a) * (there / (there - here));
                parts.iter_mut().for_each(|part| part.push(at));
            }
            if here >= 0.0 {
                parts[0].push(b);
            }
            if here <= 0.0 {
                parts[1].push(b);
            }
            (a, there) = (b, here);
        }
        parts
    }
}
