//! The hemicube: an item buffer on half a cube.
use super::frame::{Rotation, frame};
use super::screen::{Screen, steps};
use super::{delta, method::Method, ray::items};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;
use glam::DVec3;

/// Draws what dA sees on the five faces of half a cube around it, of half-width and height 1. Each cell holds the id of the
/// polygon nearest at its middle; F is the sum of the delta factors of the target's cells [Cohen & Greenberg 1985]:
///
/// dF = dA / (pi (x^2 + y^2 + 1)^2) in the top, z dA / (pi (y^2 + z^2 + 1)^2) in a side.
///
/// Delta factors are integrals over the cell in closed form, scaled to add to 1 [Gomes 2010, 4.4]. The error is of the order of
/// the cells' width, and it aliases: a polygon smaller than a cell fills the cell or is not seen. Of coplanar polygons that
/// overlap it sees one.
#[derive(Clone, Debug, PartialEq)]
pub struct Hemicube {
    resolution: u32,
    rotation: Rotation,
    /// Cell by cell, the top first.
    weights: Vec<f64>,
}

impl Hemicube {
    /// With `resolution` x `resolution` cells in the top and half as many in each side; rounded up to an even number.
    #[must_use]
    pub fn new(resolution: u32) -> Self {
        let resolution = resolution.max(2).next_multiple_of(2);
        let (across, up) = (steps(-1.0..1.0, resolution), steps(0.0..1.0, resolution / 2));
        let top = across.clone().flat_map(|y| across.clone().map(move |x| delta::top(&x, &y)));
        let side: Vec<f64> = up.flat_map(|z| across.clone().map(move |y| delta::side(&y, &z))).collect();
        let mut weights: Vec<f64> = top.collect();
        (0..4).for_each(|_| weights.extend(&side));
        delta::normalise(&mut weights);
        Self { resolution, rotation: Rotation::Angle(0.0), weights }
    }

    /// The same hemicube, turned about the normal.
    #[must_use]
    pub fn rotated(mut self, rotation: Rotation) -> Self {
        self.rotation = rotation;
        self
    }

    /// The five faces with all that dA sees.
    pub(super) fn draw(&self, enclosure: &Enclosure, from: &DifferentialArea) -> [Screen; 5] {
        let [u, v, n] = frame(from, self.rotation);
        let face = |axes: [DVec3; 3], rows: std::ops::Range<f64>, count: u32| {
            Screen::new(axes, steps(-1.0..1.0, self.resolution), steps(rows, count))
        };
        let side = |right: DVec3, forward: DVec3| face([right, n, forward], 0.0..1.0, self.resolution / 2);
        let top = face([u, v, n], -1.0..1.0, self.resolution);
        let mut screens = [top, side(v, u), side(-u, v), side(-v, -u), side(u, -v)];
        for item in &items(enclosure, from) {
            screens.iter_mut().for_each(|screen| screen.draw(item));
        }
        screens
    }

    /// The sums of delta factors, by id.
    pub(super) fn sums(&self, screens: &[Screen; 5], polygons: usize) -> Vec<f64> {
        let mut factors = vec![0.0; polygons];
        let ids = screens.iter().flat_map(Screen::ids);
        for (id, weight) in ids.zip(&self.weights).filter_map(|(id, weight)| Some((id?, weight))) {
            factors[id] += weight;
        }
        factors
    }
}

impl Method for Hemicube {
    fn name(&self) -> String {
        let turned = match self.rotation {
            Rotation::Angle(_) => "",
            Rotation::Random(_) => ", turned at random",
        };
        format!("hemicube, {0} x {0}{turned}", self.resolution)
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let factors = self.sums(&self.draw(enclosure, from), enclosure.polygons().len());
        targets.iter().map(|id| factors[*id]).collect()
    }
}
