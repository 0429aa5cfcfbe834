//! The hemisphere in one image, by a paraboloid.
use super::frame::{Rotation, along, frame};
use super::{delta::normalise, method::Method, monte_carlo::cast};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// Takes a square image of the hemisphere mirrored in the paraboloid z = 1/2 - (x^2 + y^2)/2 [Heidrich & Seidel 1998]. The
/// direction d is seen at (x, y) = (d_x, d_y) / (1 + d_z), and the cell there receives
///
/// dF = 4 (1 - s) / (pi (1 + s)^3) dx dy, s = x^2 + y^2 <= 1.
///
/// The weights of the cells whose middles lie in the disk are scaled to add to 1. Straight edges are curved in the image, so
/// that each cell casts its own ray: joining projected vertices by straight lines would be wrong by much for large polygons. The
/// error is of the order of the cells' width; what is smaller than a cell is seen or not.
#[derive(Clone, Debug, PartialEq)]
pub struct Paraboloid {
    resolution: u32,
    /// Directions by their components along dA's axes.
    directions: Vec<[f64; 3]>,
    weights: Vec<f64>,
}

impl Paraboloid {
    /// With `resolution` x `resolution` cells, of which those in the disk count; 0 is taken as 1.
    #[must_use]
    pub fn new(resolution: u32) -> Self {
        let resolution = resolution.max(1);
        let at = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(resolution) - 1.0;
        let (mut directions, mut weights) = (Vec::new(), Vec::new());
        for (x, y) in (0..resolution).flat_map(|j| (0..resolution).map(move |i| (at(i), at(j)))) {
            let s = x * x + y * y;
            if s < 1.0 {
                directions.push([2.0 * x / (1.0 + s), 2.0 * y / (1.0 + s), (1.0 - s) / (1.0 + s)]);
                weights.push((1.0 - s) / (1.0 + s).powi(3));
            }
        }
        normalise(&mut weights);
        Self { resolution, directions, weights }
    }
}

impl Method for Paraboloid {
    fn name(&self) -> String {
        format!("paraboloid, {0} x {0}", self.resolution)
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let axes = frame(from, Rotation::Angle(0.0));
        let rays = self.directions.iter().zip(&self.weights).map(|(d, weight)| (along(&axes, *d), *weight));
        let factors = cast(enclosure, from, rays);
        targets.iter().map(|id| factors[*id]).collect()
    }
}
