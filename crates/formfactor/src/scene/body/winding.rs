//! How often a closed body winds around a point.
use crate::numeric::predicates::turn_in_plane;
use crate::numeric::rounding::rounding_of;
use crate::scene::tree::Tree;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::{DVec2, DVec3, Vec3Swizzles};
use std::cmp::Ordering;

/// Polygons and the lids that close them.
#[derive(Clone, Debug)]
pub(super) struct Body {
    faces: Vec<usize>,
    lids: Vec<PlanarPolygon>,
    /// The boxes around the faces, then the lids.
    tree: Tree,
    extent: Extent,
}

/// The polygon that a differential area lies on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Owner<'p> {
    polygon: &'p PlanarPolygon,
    /// Whether the area faces as the polygon does.
    is_alike: bool,
}

impl<'p> Owner<'p> {
    pub(super) fn of(from: &DifferentialArea, polygon: &'p PlanarPolygon) -> Self {
        let (one, other) = (from.normal(), polygon.normal());
        let is_alike = one.dot(other) > 0.0 && one.cross(other).length() <= ALIKE;
        Self { polygon, is_alike }
    }

    /// Whether a point that lies on the polygon, but for roundings, may be taken as just before it.
    fn is_below(&self, point: DVec3) -> bool {
        let is_before = self.polygon.plane().side_of(point) == Ordering::Greater;
        self.is_alike && (is_before || is_strictly_inside(self.polygon, point))
    }
}

/// Normals whose angle is no larger are one but for roundings.
const ALIKE: f64 = 16.0 * f64::EPSILON;

impl Body {
    pub(super) fn new(polygons: &[PlanarPolygon], faces: Vec<usize>, lids: Vec<PlanarPolygon>) -> Self {
        let sides = faces.iter().map(|id| &polygons[*id]).chain(&lids);
        let extents: Vec<Extent> = sides.map(|side| Extent::around(side.points())).collect();
        let extent = extents.iter().fold(Extent::NOTHING, |all, extent| all.with(*extent));
        Self { faces, lids, tree: Tree::around(&extents), extent }
    }

    /// The ids of its polygons.
    pub(super) fn faces(&self) -> &[usize] {
        &self.faces
    }

    /// The lids of which something is true, a bit for each.
    pub(super) fn lids_that(&self, is_true: impl Fn(&PlanarPolygon) -> bool) -> u64 {
        self.lids.iter().zip(0..).filter(|(lid, _)| is_true(lid)).map(|(_, number)| 1 << number).sum()
    }

    /// The lids that face a point, and are in boxes that are not `outside`.
    pub(super) fn facing_lids(&self, point: DVec3, outside: impl Fn(&Extent) -> bool) -> u64 {
        self.lids_that(|lid| {
            lid.plane().side_of(point) == Ordering::Greater && !outside(&Extent::around(lid.points()))
        })
    }

    /// Its faces and lids in boxes that are not `outside`, and others near them.
    pub(super) fn near<'b>(
        &'b self,
        polygons: &'b [PlanarPolygon],
        outside: impl Fn(&Extent) -> bool,
    ) -> Vec<&'b PlanarPolygon> {
        let side = |index: usize| match self.faces.get(index) {
            Some(id) => &polygons[*id],
            None => &self.lids[index - self.faces.len()],
        };
        self.tree.find(outside).into_iter().map(side).collect()
    }

    /// How often it winds around a point, counter-clockwise as its fronts see it; nothing where the point may touch it. A point on its
    /// `owner` is taken as just before that, though rounding may have put it on the plane or behind.
    ///
    /// Counted along x: one less for each front on the way, one more for each back.
    pub(super) fn turns_around(
        &self,
        polygons: &[PlanarPolygon],
        point: DVec3,
        owner: Option<Owner<'_>>,
    ) -> Option<i32> {
        let near = Extent::around(&[point]).grown(rounding_of([point]));
        if self.extent.misses(&near) {
            return Some(0);
        }
        let is_off = |extent: &Extent| {
            extent.high.x < near.low.x
                || extent.low.yz().cmpgt(near.high.yz()).any()
                || extent.high.yz().cmplt(near.low.yz()).any()
        };
        let turns = |side: &PlanarPolygon| {
            let own = owner.filter(|owner| std::ptr::eq(owner.polygon, side));
            let before = if let Some(owner) = own {
                owner.is_below(point).then_some(Ordering::Greater)
            } else if Extent::around(side.points()).misses(&near) {
                Some(side.plane().side_of(point))
            } else {
                let is_level = owner.is_some_and(|owner| side.lies_in_plane_of(owner.polygon));
                side.plane().quick_side(point).filter(|_| !is_level)
            };
            before.map(|before| passes(side, point, before))
        };
        self.near(polygons, is_off).into_iter().map(turns).sum()
    }
}

/// How a ray along x from a point passes a polygon, the point being before its plane (`Greater`) or behind: 1 out of its front, -1 into it.
///
/// ```text
///   b         Seen along x, an edge counts where it passes above the point, from one side to the other. An end just above the point
///   |\        counts as on one side: edges that polygons share are passed alike from both.
///   | · a
/// ```
fn passes(side: &PlanarPolygon, point: DVec3, before: Ordering) -> i32 {
    let at = point.yz();
    let is_right = |p: DVec2| p.x > at.x;
    let is_above = |a: DVec2, b: DVec2| {
        let is_higher = a.y.min(b.y) > at.y;
        is_higher || (a.y.max(b.y) >= at.y && turn_in_plane(a, b, at) == Ordering::Less)
    };
    let crossing = |(a, b): (DVec2, DVec2)| match (is_right(a), is_right(b)) {
        (false, true) if is_above(a, b) => -1,
        (true, false) if is_above(b, a) => 1,
        _ => 0,
    };
    let around = |piece: &[DVec3]| {
        let next = piece.iter().cycle().skip(1);
        piece.iter().zip(next).map(|(a, b)| crossing((a.yz(), b.yz()))).sum::<i32>()
    };
    // Its front looks along x where it runs counter-clockwise in y and z.
    let turns = side.convex_pieces().map(around).sum::<i32>();
    let meets = if turns > 0 { before == Ordering::Less } else { before == Ordering::Greater };
    if meets { turns } else { 0 }
}

/// Whether a point that is close to a polygon's plane is away from the polygon's boundary, seen along one axis.
fn is_strictly_inside(polygon: &PlanarPolygon, point: DVec3) -> bool {
    let at = polygon.flat(point);
    let is_left =
        |(a, b): (&DVec3, &DVec3)| turn_in_plane(polygon.flat(*a), polygon.flat(*b), at) == Ordering::Greater;
    polygon.convex_pieces().any(|piece| piece.iter().zip(piece.iter().cycle().skip(1)).all(is_left))
}
