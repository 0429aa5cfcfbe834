//! What may hide a polygon from a point, found once for the polygon and its parts.
use super::enclosure::Enclosure;
use crate::buffers::Buffers;
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker, each};
use crate::quick;
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};

/// The polygons of an [`Enclosure`] that may hide some of a polygon, or of a part of one, from a differential area.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blockers {
    ids: Vec<usize>,
    /// A bound on the form factor of what others may hide.
    others: f64,
}

impl Blockers {
    /// Those of the last target, behind which others may hide so little.
    fn of(buffers: &Buffers, others: f64) -> Self {
        let mut ids = buffers.quick.blockers.clone();
        ids.sort_unstable();
        ids.dedup();
        Self { ids, others: others + buffers.quick.others }
    }

    /// Their ids, in ascending order.
    #[must_use]
    pub fn ids(&self) -> &[usize] {
        &self.ids
    }
}

impl Enclosure {
    /// [`Self::form_factor_within`], and what may hide some of the part: nothing else hides any of a part of it.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let strip = |x: [f64; 2]| PlanarPolygon::new([[[x[0], 1.0, 2.0], [x[1], 1.0, 2.0], [x[1], -1.0, 2.0], [x[0], -1.0, 2.0]]]);
    /// let (lamp, halves) = (strip([-1.0, 1.0])?, [strip([-1.0, 0.0])?, strip([0.0, 1.0])?]);
    /// let board = PlanarPolygon::new([[[-2.0, -2.0, 1.0], [0.0, -2.0, 1.0], [0.0, 2.0, 1.0], [-2.0, 2.0, 1.0]]])?;
    /// let room = Enclosure::new(vec![lamp.clone(), board]);
    /// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    /// let (half, blockers) = room.form_factor_and_blockers(&floor, 0, &lamp, 1e-12);
    /// assert_eq!(blockers.ids(), [1]);
    /// let [hidden, seen] = halves.map(|part| room.form_factor_behind(&floor, 0, &part, &blockers, 1e-12).0);
    /// assert_eq!(hidden.value, 0.0);
    /// assert!((seen.value - half.value).abs() < 1e-12);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_and_blockers(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        tolerance: f64,
    ) -> (FormFactor, Blockers) {
        let (factor, blockers) =
            self.past_found(from, id, part, Some(tolerance), |found| Blockers::of(found, 0.0));
        (factor, blockers.unwrap_or_default())
    }

    /// The form factor to a part of what [`Self::form_factor_and_blockers`] or this looked at from the same place, past what may hide some of
    /// that; and what may hide some of the part.
    ///
    /// Takes no search among the polygons, and nothing of those that hide other parts only.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_behind(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        blockers: &Blockers,
        tolerance: f64,
    ) -> (FormFactor, Blockers) {
        let of_part = |found: &Buffers| Blockers::of(found, blockers.others);
        let (mut factor, of_part) =
            self.past(from, (id, part), self.behind(blockers), Some(tolerance), of_part);
        factor.error_bound += blockers.others;
        (factor, of_part.unwrap_or_default())
    }

    /// What may hide some of a part of what [`Self::form_factor_and_blockers`] or [`Self::form_factor_behind`] looked at from the same place;
    /// nothing where one of these hides all of the part.
    ///
    /// Costs a fraction of what a form factor does. May name more than that would.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn blockers_of_part(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        blockers: &Blockers,
    ) -> Option<Blockers> {
        self.pool.lend(|buffers| {
            let part = self.on_plane(id, part);
            match quick::is_open(from, &part, self.with_ids(blockers), &mut buffers.quick) {
                Some(true) => Some(Blockers::of(buffers, blockers.others)),
                Some(false) => None,
                None => Some(blockers.clone()),
            }
        })
    }

    fn behind<'p>(&'p self, blockers: &Blockers) -> impl Fn(&Reach, Taker<'_, 'p>) {
        move |_: &Reach, taker: Taker<'_, 'p>| each(self.with_ids(blockers), taker)
    }

    fn with_ids(&self, blockers: &Blockers) -> impl Iterator<Item = (usize, &PlanarPolygon)> {
        blockers.ids.iter().map(|id| (*id, &self.polygons()[*id]))
    }
}
