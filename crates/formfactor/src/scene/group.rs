//! What many points near each other see of one polygon, or of a place.
use super::{enclosure::Enclosure, line::LineOfSight, shaft::Shaft, sight::is_above_horizon};
use crate::buffers::Buffers;
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker, each};
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::DVec3;
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

    /// Whether many points see a place, each as [`Self::sees`] says.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let board = PlanarPolygon::new([[[-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, 1.0], [-1.0, 1.0, 1.0]]])?;
    /// let room = Enclosure::new(vec![board]);
    /// let floor = [0.0, 0.9].map(|x| DifferentialArea::new(DVec3::X * x, DVec3::Z)).into_iter().collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(room.each_sees(&floor, DVec3::new(1.5, 0.0, 2.0)), [false, true]);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    #[must_use]
    pub fn each_sees(&self, points: &[DifferentialArea], there: DVec3) -> Vec<bool> {
        if let [from] = points {
            return vec![self.sees(from, there)];
        }
        let mut near = OnceCell::new();
        let sees = |from: &DifferentialArea| {
            if !is_above_horizon(from, there) {
                return false;
            }
            let line = LineOfSight::between(from.position(), there);
            near.get_or_init(|| self.on_ways(points, there));
            let Some(near) = near.get_mut() else { return false };
            let first = near.iter().position(|&id| self.blocks(id, from, &line));
            // What is in the way of one may be in that of the next.
            first.inspect(|&first| near[..=first].rotate_right(1)).is_none()
        };
        points.iter().map(sees).collect()
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
        let (around, mut shaft) = shaft(points, part.points());
        // What lies behind the part hides nothing of it.
        shaft.cut_off(-part.normal(), part.points().iter().copied());
        let deviation = self.deviation() + part.deviation();
        let mut near = self.in_shaft(&shaft, deviation);
        near.retain(|other| *other != id);
        self.looks().sort(around.low.midpoint(around.high), &mut near);
        near
    }

    /// The polygons that can be on the way from some of the points to a place.
    fn on_ways(&self, points: &[DifferentialArea], there: DVec3) -> Vec<usize> {
        let (_, shaft) = shaft(points, &[there]);
        self.in_shaft(&shaft, self.deviation())
    }

    /// The polygons that are not all outside of a shaft.
    fn in_shaft(&self, shaft: &Shaft, deviation: f64) -> Vec<usize> {
        let mut near = self.tree().find(|extent| shaft.misses_box(extent, deviation));
        near.retain(|other| !shaft.misses(&self.polygons()[*other], deviation));
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

/// The box around some points, and the shaft to others, without what lies below all horizons.
fn shaft(points: &[DifferentialArea], others: &[DVec3]) -> (Extent, Shaft) {
    let positions = || points.iter().map(DifferentialArea::position);
    let around = positions().fold(Extent::NOTHING, |all, p| all.with(Extent { low: p, high: p }));
    let mut shaft = Shaft::between([around, Extent::around(others)]);
    if points.iter().all(|point| point.normal() == points[0].normal()) {
        shaft.cut_off(-points[0].normal(), positions());
    }
    (around, shaft)
}

/// Puts some of the polygons before the others.
fn put_first(near: &mut [usize], some: &[usize]) {
    let are_first = near.iter().take(some.len()).all(|id| some.contains(id));
    if !are_first {
        near.sort_by_key(|id| !some.contains(id));
    }
}
