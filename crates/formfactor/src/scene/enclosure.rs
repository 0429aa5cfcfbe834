//! Enclosures: many polygons that see and hide each other.
use super::{
    body::{Around, Bodies},
    looks::Looks,
    pool::Pool,
    shell::Adjacency,
    surfaces::Surfaces,
    tree::Tree,
};
use crate::buffers::Buffers;
use crate::centroid::with_centroid;
use crate::exact::deviation::unseen;
use crate::form_factor::FormFactor;
use crate::occluders::{Reach, Taker, each};
use crate::pipeline;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use crate::stats::Stats;
use glam::DVec3;
use std::borrow::Cow;
use std::cmp::Ordering;
use std::sync::OnceLock;

/// A set of polygons, each of which is a target and an occluder of the others.
///
/// Build it once and query it often: it keeps the polygons in a tree of boxes and reuses its buffers. It is `Sync`: many
/// threads may query one enclosure, and a result depends on the query alone.
///
/// ```
/// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
/// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
/// let board = PlanarPolygon::new([[[-2.0, -2.0, 1.0], [0.0, -2.0, 1.0], [0.0, 2.0, 1.0], [-2.0, 2.0, 1.0]]])?;
/// let room = Enclosure::new(vec![lamp, board]);
/// // The board hides half of the lamp, and turns its back to the floor.
/// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
/// let row = room.row(&floor);
/// assert!((row[0].value - 0.239_456_470_460_773_54 / 2.0).abs() < 1e-15);
/// assert_eq!(row[1].value, 0.0);
/// # Ok::<(), formfactor::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Enclosure {
    polygons: Vec<PlanarPolygon>,
    tree: Tree,
    bodies: Bodies,
    looks: Looks,
    /// The largest deviation of a vertex from where it stands.
    deviation: f64,
    pub(super) pool: Pool,
    /// What form factors between areas need, once there is one.
    surfaces: OnceLock<Surfaces>,
}

impl Enclosure {
    /// An enclosure of these polygons. A polygon's index is its id. The polygons need not enclose anything.
    ///
    /// Takes O(n log^2 n) for n vertices. The first form factor between areas takes as much again, and more where many polygons lie in a plane.
    #[must_use]
    pub fn new(polygons: Vec<PlanarPolygon>) -> Self {
        let adjacency = Adjacency::of(&polygons);
        let deviation = polygons.iter().map(PlanarPolygon::deviation).fold(0.0, f64::max);
        let tree = Tree::over(&polygons);
        Self {
            surfaces: OnceLock::new(),
            tree,
            bodies: Bodies::among(&polygons, &adjacency),
            looks: Looks::of(&polygons),
            polygons,
            deviation,
            pool: Pool::default(),
        }
    }

    /// The polygons, in the order of their ids.
    #[must_use]
    pub fn polygons(&self) -> &[PlanarPolygon] {
        &self.polygons
    }

    /// The boxes around them.
    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// How large they look.
    pub(super) fn looks(&self) -> &Looks {
        &self.looks
    }

    /// How far a vertex may lie from where it stands.
    pub(crate) fn deviation(&self) -> f64 {
        self.deviation
    }

    /// Found when first asked for: form factors from points need none of it.
    pub(crate) fn surfaces(&self) -> &Surfaces {
        let find = || Surfaces::of(&self.polygons, &Adjacency::of(&self.polygons), &self.tree);
        self.surfaces.get_or_init(find)
    }

    /// The form factor from `from` to polygon `id`, with all other polygons as occluders.
    ///
    /// The polygon that [owns](DifferentialArea::owned_by) `from` occludes nothing, and the form factor to it is exactly 0. The
    /// same holds for polygons in the owner's plane, such as the other side of a thin wall, even where rounding put `from` a
    /// last bit off that plane.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor(&self, from: &DifferentialArea, id: usize) -> FormFactor {
        self.past_found(from, id, &self.polygons[id], None, |_| ()).0
    }

    /// A part of polygon `id` on the plane of that polygon. One that is farther off than roundings are stays where it is.
    pub(super) fn on_plane<'p>(&self, id: usize, part: &'p PlanarPolygon) -> Cow<'p, PlanarPolygon> {
        let whole = &self.polygons[id];
        if part.has_plane_of(whole) {
            return Cow::Borrowed(part);
        }
        whole.part(part.loops()).map_or(Cow::Borrowed(part), Cow::Owned)
    }

    /// [`Self::form_factor`], with counts of the work that it took.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_with_stats(&self, from: &DifferentialArea, id: usize) -> (FormFactor, Stats) {
        let (factor, stats) = self.past_found(from, id, &self.polygons[id], None, |buffers| buffers.stats);
        (factor, stats.unwrap_or(Stats { none: 1, ..Stats::default() }))
    }

    /// The form factor from `from` to `part`, a part of polygon `id` in the plane of that polygon, which does not occlude it.
    ///
    /// A part that roundings put off the plane, and so behind what lies on it, as the other side of a thin wall, stands for
    /// [`PlanarPolygon::part`] of the same loops. Making that once saves making it here.
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_to_part(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
    ) -> FormFactor {
        self.past_found(from, id, part, None, |_| ()).0
    }

    /// [`Self::form_factor_to_part`] where an error of at most `tolerance` will do: plain doubles know that far more often than all that
    /// can be known, which may take a polygon Boolean. Where not even that is within the tolerance, the bound says so.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    /// let room = Enclosure::new(vec![lamp.clone()]);
    /// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    /// let rough = room.form_factor_within(&floor, 0, &lamp, 1e-9);
    /// assert!(rough.error_bound <= 1e-9 && (rough.value - 0.239_456_470_460_773_54).abs() <= 1e-9);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_within(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        tolerance: f64,
    ) -> FormFactor {
        self.past_found(from, id, part, Some(tolerance), |_| ()).0
    }

    /// The form factor from `from` to `part`, a convex part of polygon `id` that faces as the polygon does, and the centroid of what is
    /// seen of it, each point weighed by what it contributes to the form factor; where nothing is seen, some point of its plane.
    ///
    /// Only the polygons `among` are looked at as occluders: all that can stand between the two must be among them, others may be. The
    /// centroid is right to about 1e-4 of the part's size. Of two radiosities that vary linearly over the part, the one at the centroid
    /// times the form factor is what is received.
    ///
    /// ```
    /// use formfactor::{DVec3, DifferentialArea, Enclosure, PlanarPolygon};
    /// let lamp = PlanarPolygon::new([[[-1.0, 1.0, 2.0], [1.0, 1.0, 2.0], [1.0, -1.0, 2.0], [-1.0, -1.0, 2.0]]])?;
    /// let board = PlanarPolygon::new([[[-2.0, -2.0, 1.0], [0.0, -2.0, 1.0], [0.0, 2.0, 1.0], [-2.0, 2.0, 1.0]]])?;
    /// let room = Enclosure::new(vec![lamp.clone(), board]);
    /// let floor = DifferentialArea::new(DVec3::ZERO, DVec3::Z)?;
    /// let (half, centroid) = room.form_factor_and_centroid(&floor, 0, &lamp, &[1]);
    /// assert!((half.value - 0.239_456_470_460_773_54 / 2.0).abs() < 1e-15);
    /// assert!(centroid.x > 0.4 && centroid.x < 0.5 && centroid.y.abs() < 1e-12);
    /// # Ok::<(), formfactor::Error>(())
    /// ```
    ///
    /// # Panics
    /// When there is no polygon `id`.
    #[must_use]
    pub fn form_factor_and_centroid(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        among: &[usize],
    ) -> (FormFactor, DVec3) {
        let whole = &self.polygons[id];
        if self.is_edge_on(from, id) || whole.plane().side_of(from.position()) != Ordering::Greater {
            return (FormFactor::default(), part.points()[0]);
        }
        let occluders = self.within_reach_of(from, id, among);
        self.pool.lend(|buffers| with_centroid(from, &self.on_plane(id, part), occluders, buffers))
    }

    /// Some polygons, those of them that are within reach and can hide polygon `id`.
    fn within_reach_of<'p>(
        &'p self,
        from: &DifferentialArea,
        id: usize,
        some: &[usize],
    ) -> impl Fn(&Reach, Taker<'_, 'p>) {
        move |reach: &Reach, taker: Taker<'_, 'p>| {
            let near = some.iter().copied().filter(|i| !reach.misses(&self.polygons[*i]));
            each(self.others(from, id, near, |extent| reach.misses_box(extent, self.deviation)), taker);
        }
    }

    /// The form factor to a part of polygon `id`, past the occluders that the tree finds, and what is taken of how it was found.
    pub(super) fn past_found<T>(
        &self,
        from: &DifferentialArea,
        id: usize,
        part: &PlanarPolygon,
        within: Option<f64>,
        take: impl FnOnce(&Buffers) -> T,
    ) -> (FormFactor, Option<T>) {
        self.past(from, (id, part), self.within_reach(from, id), within, take)
    }

    /// The polygons within reach that can hide polygon `id`, those first that look largest: they may hide all of it.
    pub(super) fn within_reach<'p>(
        &'p self,
        from: &DifferentialArea,
        id: usize,
    ) -> impl Fn(&Reach, Taker<'_, 'p>) {
        move |reach: &Reach, taker: Taker<'_, 'p>| {
            let outside = |extent: &Extent| reach.misses_box(extent, self.deviation);
            let mut near = self.tree.find(outside);
            self.looks.sort(from.position(), &mut near);
            let near = near.into_iter().filter(|i| !reach.misses(&self.polygons[*i]));
            each(self.others(from, id, near, outside), taker);
        }
    }

    /// The form factor to a part of polygon `id` past occluders with their ids, and what is taken of how it was found; nothing of one that is
    /// not seen from its front.
    pub(super) fn past<'p, T>(
        &'p self,
        from: &DifferentialArea,
        (id, part): (usize, &PlanarPolygon),
        occluders: impl Fn(&Reach, Taker<'_, 'p>),
        within: Option<f64>,
        take: impl FnOnce(&Buffers) -> T,
    ) -> (FormFactor, Option<T>) {
        // Rounding may have put the part a last bit off the polygon's plane, which decides.
        let whole = &self.polygons[id];
        let is_before = whole.plane().side_of(from.position()) == Ordering::Greater;
        if (!is_before && whole.deviation() == 0.0) || self.is_edge_on(from, id) {
            return (FormFactor::default(), None);
        }
        if !is_before {
            return (unseen(from, whole), None);
        }
        self.pool.lend(|buffers| {
            let factor = pipeline::past(from, &self.on_plane(id, part), occluders, within, buffers);
            (factor, Some(take(buffers)))
        })
    }

    /// Those of the polygons that can hide polygon `id`, with their ids; nothing in boxes that are `outside` can.
    pub(super) fn others(
        &self,
        from: &DifferentialArea,
        id: usize,
        found: impl IntoIterator<Item = usize>,
        outside: impl Fn(&Extent) -> bool,
    ) -> impl Iterator<Item = (usize, &PlanarPolygon)> {
        let mut around = Around::default();
        // Left out are polygons seen edge-on, faces of the target's own body, which is behind the target, and the far sides of
        // other bodies, which hide nothing that the near sides do not.
        let can_hide = move |i: &usize| {
            *i != id
                && !self.bodies.is_one(id, *i)
                && !self.bodies.is_far_side(&self.polygons, from, *i, &outside, &mut around)
                && !self.is_edge_on(from, *i)
        };
        found.into_iter().filter(can_hide).map(|i| (i, &self.polygons[i]))
    }

    /// Whether polygon `id` owns `from` or lies in the plane of the one that does.
    pub(super) fn is_edge_on(&self, from: &DifferentialArea, id: usize) -> bool {
        from.owner()
            .is_some_and(|owner| id == owner || self.polygons[id].lies_in_plane_of(&self.polygons[owner]))
    }

    /// The form factors from `from` to every polygon, by id.
    #[must_use]
    pub fn row(&self, from: &DifferentialArea) -> Vec<FormFactor> {
        (0..self.polygons.len()).map(|id| self.form_factor(from, id)).collect()
    }
}
