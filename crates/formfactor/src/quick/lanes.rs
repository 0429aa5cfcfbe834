//! The corners of a cone in pairs, so that two are multiplied at once.
use super::interval::lesser;
pub(super) use crate::shapes::convex::MOST;
use glam::DVec3;

/// A number for each corner.
pub(super) type Lanes = [[f64; 2]; MOST / 2];

/// The corners of a cone, one coordinate after the other. After the last comes the first again.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Corners {
    x: Lanes,
    y: Lanes,
    z: Lanes,
    /// How many there are, of which the first `MOST` are kept.
    pub(super) count: usize,
}

impl Corners {
    pub(super) fn of(corners: impl ExactSizeIterator<Item = DVec3>) -> Self {
        let mut lanes = Self { count: corners.len(), ..Self::default() };
        let wanted = if lanes.count <= MOST / 2 { MOST / 2 } else { MOST };
        for (i, corner) in corners.take(wanted).enumerate() {
            lanes.set(i, corner);
        }
        let first = DVec3::new(lanes.x[0][0], lanes.y[0][0], lanes.z[0][0]);
        (lanes.count..wanted).for_each(|i| lanes.set(i, first));
        lanes
    }

    #[inline]
    fn set(&mut self, index: usize, corner: DVec3) {
        let (pair, side) = (index / 2, index % 2);
        (self.x[pair][side], self.y[pair][side], self.z[pair][side]) = (corner.x, corner.y, corner.z);
    }

    /// The dot products of the corners with a vector, the least magnitude among them, and which are negative, one bit each.
    #[inline]
    pub(super) fn dots(&self, normal: DVec3, dots: &mut Lanes) -> (f64, u8) {
        if self.count <= MOST / 2 {
            self.first_dots::<2>(normal, dots)
        } else {
            self.first_dots::<4>(normal, dots)
        }
    }

    #[inline(always)]
    fn first_dots<const PAIRS: usize>(&self, normal: DVec3, dots: &mut Lanes) -> (f64, u8) {
        let (mut least, mut negative) = ([f64::INFINITY; 2], 0);
        for (pair, dots) in dots[..PAIRS].iter_mut().enumerate() {
            let (x, y, z) = (self.x[pair], self.y[pair], self.z[pair]);
            let found = [0, 1].map(|i| normal.x * x[i] + normal.y * y[i] + normal.z * z[i]);
            *dots = found;
            least = [lesser(least[0], found[0].abs()), lesser(least[1], found[1].abs())];
        }
        for dot in dots[..PAIRS].as_flattened().iter().rev() {
            negative = 2 * negative + (dot.to_bits() >> 63) as u8;
        }
        (lesser(least[0], least[1]), negative)
    }
}
