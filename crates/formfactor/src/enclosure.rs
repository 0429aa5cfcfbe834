//! Many polygons that see and hide each other.
use crate::{DifferentialArea, FormFactor, PlanarPolygon, form_factor};

/// A set of polygons, each of which is a target and hides the others.
#[derive(Clone, Debug)]
pub struct Enclosure {
    polygons: Vec<PlanarPolygon>,
}

impl Enclosure {
    /// An enclosure of these polygons; a polygon's index is its id.
    #[must_use]
    pub fn new(polygons: Vec<PlanarPolygon>) -> Self {
        Self { polygons }
    }

    /// The polygons, by id.
    #[must_use]
    pub fn polygons(&self) -> &[PlanarPolygon] {
        &self.polygons
    }

    /// The form factor to polygon `id`, all others being occluders.
    #[must_use]
    pub fn form_factor(&self, from: &DifferentialArea, id: usize) -> FormFactor {
        self.form_factor_to_part(from, id, &self.polygons[id])
    }

    /// The form factor to `part`, a part of polygon `id`, which does not hide it; all others do.
    #[must_use]
    pub fn form_factor_to_part(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
    ) -> FormFactor {
        if from.owner() == Some(id) {
            return FormFactor::default();
        }
        form_factor(from, part, &[])
    }

    /// The form factors to every polygon.
    #[must_use]
    pub fn row(&self, from: &DifferentialArea) -> Vec<FormFactor> {
        (0..self.polygons.len()).map(|id| self.form_factor(from, id)).collect()
    }
}
