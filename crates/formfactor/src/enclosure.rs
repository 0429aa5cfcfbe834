//! Many polygons that see and hide each other.
use crate::cull::Pyramid;
use crate::exact::{by_csg, unseen};
use crate::pool::{Buffers, Pool};
use crate::quick::{self, Target};
use crate::tree::Tree;
use crate::{DifferentialArea, FormFactor, PlanarPolygon, Stats};
use std::cmp::Ordering;

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
    /// A polygon in the owner's plane, such as the other side of a thin wall, is seen edge-on even where rounding put
    /// `from` a last bit off that plane: exactly 0 to it, and it hides nothing.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor(&self, from: &DifferentialArea, id: usize) -> FormFactor {
        self.find(from, id, &self.polygons[id]).0
    }

    /// [`Self::form_factor`], and what had to be looked at and what was left out to find it.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_with_stats(&self, from: &DifferentialArea, id: usize) -> (FormFactor, Stats) {
        self.find(from, id, &self.polygons[id])
    }

    /// The form factor to `part`, a part of polygon `id` that lies in its plane; that polygon does not hide it.
    #[must_use]
    pub fn form_factor_to_part(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
    ) -> FormFactor {
        self.find(from, id, part).0
    }

    fn find(&self, from: &DifferentialArea, id: usize, part: &PlanarPolygon) -> (FormFactor, Stats) {
        let unhidden = Stats { none: 1, ..Stats::default() };
        if self.is_edge_on(from, id) {
            return (FormFactor::default(), unhidden);
        }
        // Rounding may have put the part a last bit off the polygon's plane, which decides.
        let whole = &self.polygons[id];
        if whole.plane().side_of(from.position()) != Ordering::Greater {
            return (unseen(from, whole), unhidden);
        }
        self.pool.lend(|Buffers { quick, scratch, stats }| {
            *stats = Stats::default();
            let slack = self.deviation;
            let near = |t: &Target| self.others(from, id, self.tree.find(|e| t.misses_box(e, slack)));
            let found = quick::form_factor(from, part, near, quick, stats).unwrap_or_else(|| {
                let slack = self.deviation + part.deviation();
                let near = |p: &Pyramid| self.others(from, id, self.tree.find(|e| p.misses_box(e, slack)));
                by_csg(from, part, near, scratch, stats)
            });
            (found, *stats)
        })
    }

    /// Those of the polygons that can hide polygon `id`.
    fn others(
        &self,
        from: &DifferentialArea,
        id: usize,
        found: Vec<usize>,
    ) -> impl Iterator<Item = &PlanarPolygon> {
        let found = found.into_iter();
        found.filter(move |i| *i != id && !self.is_edge_on(from, *i)).map(|i| &self.polygons[i])
    }

    /// Whether polygon `id` owns `from` or lies in the plane of the one that does.
    fn is_edge_on(&self, from: &DifferentialArea, id: usize) -> bool {
        from.owner()
            .is_some_and(|owner| id == owner || self.polygons[id].lies_in_plane_of(&self.polygons[owner]))
    }

    /// The form factors to every polygon, by id.
    #[must_use]
    pub fn row(&self, from: &DifferentialArea) -> Vec<FormFactor> {
        (0..self.polygons.len()).map(|id| self.form_factor(from, id)).collect()
    }
}
