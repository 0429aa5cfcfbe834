//! The hemicube for what is far and for what is seen, the contour sum for what is near.
use super::gather::{aim, as_contour};
use super::parts::{Division, Tile, divide, pieces};
use super::{hemicube::Hemicube, method::Method, screen::Screen};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;

/// Uses a hemicube for far targets. A near target is divided into parts, and those whose middle the hemicube shows take the
/// contour sum (2.4) [Baum, Rushmeier & Winget 1989].
///
/// A target is near when some triangle or parallelogram of it has a diameter of more than `near` times its distance.
/// The error is the hemicube's for far targets, and at shadow edges that of the parts and of the cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Baum {
    /// The item buffer.
    pub hemicube: Hemicube,
    /// A target is near when its diameter is more than this times its distance.
    pub near: f64,
    /// Parts of a near target: n x n of each triangle and parallelogram of it; 0 is taken as 1.
    pub divisions: u32,
}

impl Method for Baum {
    fn name(&self) -> String {
        format!("Baum, {}, near {}, {2} x {2} parts", self.hemicube.name(), self.near, self.divisions.max(1))
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let screens = self.hemicube.draw(enclosure, from);
        let far = self.hemicube.sums(&screens, enclosure.polygons().len());
        let factor = |id: &usize| {
            let parts = pieces(&enclosure.polygons()[*id]);
            let is_near = parts.iter().any(|part| part.is_large(from.position(), self.near));
            if is_near { self.by_parts(enclosure, from, *id, &screens) } else { far[*id] }
        };
        targets.iter().map(factor).collect()
    }
}

impl Baum {
    fn by_parts(
        &self,
        enclosure: &Enclosure,
        from: &DifferentialArea,
        id: usize,
        screens: &[Screen; 5],
    ) -> f64 {
        let target = &enclosure.polygons()[id];
        let parts = divide(target, from.position(), Division::Uniform(self.divisions));
        let is_shown = |part: &&Tile| {
            aim(from, part).is_some_and(|toward| screens.iter().any(|s| s.id_toward(toward) == Some(id)))
        };
        parts.iter().filter(is_shown).map(|part| as_contour(from, part)).fold(0.0, |sum, part| sum + part)
    }
}
