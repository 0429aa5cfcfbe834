//! Company for a case: rings far from it, which change nothing about it but the ways in which its edges are looked at.
use crate::Ring;
use crate::against::shapes;
use crate::validity::Shape;
use glam::DVec2;
use polycsg::Region;

/// Who keeps company.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Company {
    /// A few squares: boxes are sorted, not compared each with each.
    Squares,
    /// Squares enough that no stage takes its edges for few.
    ManySquares,
    /// Long edges beside one another, all in one another's boxes: the whole arrangement is looked at by slabs.
    Bundle,
}

impl Company {
    /// All kinds.
    pub const ALL: [Company; 3] = [Company::Squares, Company::ManySquares, Company::Bundle];

    /// The rings: to the right of all points whose coordinates are no larger than `size`. None where there is no place.
    pub fn rings(self, size: f64) -> Option<Vec<Ring>> {
        let scale = power_of_two_above(size.max(f64::MIN_POSITIVE * 2.0_f64.powi(60)));
        let unit = scale / 1024.0;
        let at = |x: u32, y: u32| DVec2::new(4.0 * scale + f64::from(x) * unit, f64::from(y) * unit);
        let square = |x: u32, y: u32| vec![at(x, y), at(x + 2, y), at(x + 2, y + 2), at(x, y + 2)];
        let needle = |k: u32| vec![at(0, 4 * k), at(1000, 4 * k + 1000), at(1000, 4 * k + 1002)];
        if !(16.0 * scale).is_finite() {
            return None;
        }
        Some(match self {
            Company::Squares => (0..20).map(|k| square(4 * k, k)).collect(),
            Company::ManySquares => (0..200).map(|k| square(4 * (k % 20), 4 * (k / 20))).collect(),
            Company::Bundle => (0..150).map(needle).collect(),
        })
    }
}

/// A power of two above a normal number, less than four times as large.
fn power_of_two_above(size: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits(size.to_bits() & EXPONENT) * 2.0
}

/// The polygons of a region without those of the company.
pub fn without_company(region: &Region, size: f64) -> Vec<Shape> {
    let is_own = |shape: &Shape| shape.outer.iter().all(|p| p.x <= size);
    shapes(region).into_iter().filter(is_own).collect()
}
