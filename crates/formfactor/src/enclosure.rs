//! Many polygons that see and hide each other.
use crate::cull::Pyramid;
use crate::exact::form_factor_past;
use crate::pool::Pool;
use crate::tree::Tree;
use crate::{DifferentialArea, FormFactor, PlanarPolygon};

/// A set of polygons, each of which is a target and hides the others.
///
/// Many threads may ask one enclosure: it lends them buffers, and what each gets depends on its question alone.
#[derive(Clone, Debug, Default)]
pub struct Enclosure {
    polygons: Vec<PlanarPolygon>,
    tree: Tree,
    /// The largest deviation of a vertex from where it stands.
    deviation: f64,
    pool: Pool,
}

impl Enclosure {
    /// An enclosure of these polygons; a polygon's index is its id. It need not be closed. Takes O(n log^2 n).
    #[must_use]
    pub fn new(polygons: Vec<PlanarPolygon>) -> Self {
        let deviation = polygons.iter().map(PlanarPolygon::deviation).fold(0.0, f64::max);
        Self { tree: Tree::over(&polygons), polygons, deviation, pool: Pool::default() }
    }

    /// The polygons, by id.
    #[must_use]
    pub fn polygons(&self) -> &[PlanarPolygon] {
        &self.polygons
    }

    /// The form factor to polygon `id`; all others, but the one that owns `from`, hide it. Exactly 0 to the owner.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor(&self, from: &DifferentialArea, id: usize) -> FormFactor {
        self.form_factor_to_part(from, id, &self.polygons[id])
    }

    /// The form factor to `part`, a part of polygon `id` that lies in its plane; that polygon does not hide it.
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
        let slack = self.deviation + part.deviation();
        let others = |pyramid: &Pyramid| {
            let found = self.tree.find(|extent| pyramid.misses_box(extent, slack)).into_iter();
            found.filter(|i| *i != id && Some(*i) != from.owner()).map(|i| &self.polygons[i])
        };
        self.pool.lend(|scratch| form_factor_past(from, part, others, scratch))
    }

    /// The form factors to every polygon, by id.
    #[must_use]
    pub fn row(&self, from: &DifferentialArea) -> Vec<FormFactor> {
        (0..self.polygons.len()).map(|id| self.form_factor(from, id)).collect()
    }
}
