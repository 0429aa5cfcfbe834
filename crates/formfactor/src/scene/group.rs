//! Form factors from many points near each other to one polygon.
use super::{enclosure::Enclosure, shaft::Shaft};
use crate::buffers::Buffers;
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker, each};
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use std::cell::OnceCell;

impl Enclosure {
    /// The form factors from many points to polygon `id`, each equal to that of [`Self::form_factor`] within the bounds.
    ///
    /// The occluders that can stand between all points and the polygon are found once, and what hid all of it from one point is looked at
    /// first from the next. That pays where the points are near each other, as the vertices of an element or the sample points of a patch
    /// are.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let square = |z: f64, half: f64| PlanarPolygon::new([[[-half, half, z], [half, half, z], [half, -half, z], [-half, -half, z]]]);
    /// let room = Enclosure::new(vec![square(2.0, 1.0)?, square(1.0, 0.25)?]);
    /// let floor = [0.0, 0.1, 0.2].map(|x| DifferentialArea::new(DVec3::X * x, DVec3::Z)).into_iter().collect::<Result<Vec<_>, _>>()?;
    /// for (from, seen) in floor.iter().zip(room.form_factors(&floor, 0)) {
    ///     assert!((seen.value - room.form_factor(from, 0).value).abs() < 1e-15);
    /// }
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factors(&self, points: &[DifferentialArea], id: usize) -> Vec<FormFactor> {
        self.past_between(points, (id, &self.polygons()[id]), None)
    }

    /// [`Self::form_factors`] to a part of polygon `id`, where errors of at most `tolerance` will do; see [`Self::form_factor_within`].
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    /// let room = Enclosure::new(vec![lamp.clone()]);
    /// let floor = [DifferentialArea::new(DVec3::ZERO, DVec3::Z)?; 2];
    /// for seen in room.form_factors_within(&floor, 0, &lamp, 1e-9) {
    ///     assert!(seen.error_bound <= 1e-9 && (seen.value - 0.239_456_470_460_773_54).abs() <= 1e-9);
    /// }
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factors_within(
        &self,
        points: &[DifferentialArea],
        id: usize,
        part: &PlanarPolygon,
        tolerance: f64,
    ) -> Vec<FormFactor> {
        self.past_between(points, (id, part), Some(tolerance))
    }

    /// The form factors past what stands between any of the points and the part, which is found when the first point needs it: none
    /// behind the part does.
    fn past_between<'p>(
        &'p self,
        points: &[DifferentialArea],
        (id, part): (usize, &PlanarPolygon),
        within: Option<f64>,
    ) -> Vec<FormFactor> {
        let part = &*self.on_plane(id, part);
        // One point knows better what it has in reach.
        if let [from] = points {
            return vec![self.past(from, (id, part), self.within_reach(from, id), within, |_| ()).0];
        }
        let mut near = OnceCell::new();
        let past = |from: &DifferentialArea| {
            let among = |reach: &Reach, taker: Taker<'_, 'p>| {
                let near = near.get_or_init(|| self.between(points, (id, part)));
                self.among(from, id, near, reach, taker);
            };
            let hiding = |found: &Buffers| found.quick.blockers.clone();
            let (factor, hiding) = self.past(from, (id, part), among, within, hiding);
            if let (0.0, Some(near), Some(hiding)) = (factor.value, near.get_mut(), hiding) {
                put_first(near, &hiding);
            }
            factor
        };
        points.iter().map(past).collect()
    }

    /// The polygons that can stand between some of the points and a part of polygon `id`, those first that look largest from there.
    fn between(&self, points: &[DifferentialArea], (id, part): (usize, &PlanarPolygon)) -> Vec<usize> {
        let positions = || points.iter().map(DifferentialArea::position);
        let around = positions().fold(Extent::NOTHING, |all, p| all.with(Extent { low: p, high: p }));
        let mut shaft = Shaft::between([around, Extent::around(part.points())]);
        // What lies behind the part, or below all horizons, hides nothing of it.
        shaft.cut_off(-part.normal(), part.points().iter().copied());
        if points.iter().all(|point| point.normal() == points[0].normal()) {
            shaft.cut_off(-points[0].normal(), positions());
        }
        let deviation = self.deviation() + part.deviation();
        let mut near = self.tree().find(|extent| shaft.misses_box(extent, deviation));
        near.retain(|other| *other != id && !shaft.misses(&self.polygons()[*other], deviation));
        self.looks().sort(around.low.midpoint(around.high), &mut near);
        near
    }

    /// Those of the polygons `near` that can hide polygon `id`.
    fn among<'p>(
        &'p self,
        from: &DifferentialArea,
        id: usize,
        near: &[usize],
        reach: &Reach,
        taker: Taker<'_, 'p>,
    ) {
        let outside = |extent: &Extent| reach.misses_box(extent, self.deviation());
        let near = near.iter().copied().filter(|other| !reach.misses(&self.polygons()[*other]));
        each(self.others(from, id, near, outside), taker);
    }
}

/// Puts some of the polygons before the others.
fn put_first(near: &mut [usize], some: &[usize]) {
    let are_first = near.iter().take(some.len()).all(|id| some.contains(id));
    if !are_first {
        near.sort_by_key(|id| !some.contains(id));
    }
}
