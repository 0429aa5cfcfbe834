//! How often a closed body winds around a point.
use crate::numeric::predicates::turn_in_plane;
use crate::numeric::rounding::rounding_of;
use crate::scene::tree::Tree;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// Polygons and the lids that close them.
#[derive(Clone, Debug)]
pub(super) struct Body {
    faces: Vec<usize>,
    lids: Vec<PlanarPolygon>,
    /// The boxes around the faces, then the lids.
    extents: Vec<Extent>,
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
        Self { faces, lids, tree: Tree::around(&extents), extents, extent }
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
    ) -> impl Iterator<Item = &'b PlanarPolygon> {
        self.tree.find(outside).into_iter().map(|index| self.side(polygons, index))
    }

    /// A face, or a lid, by its number.
    fn side<'b>(&'b self, polygons: &'b [PlanarPolygon], index: usize) -> &'b PlanarPolygon {
        self.faces.get(index).map_or_else(|| &self.lids[index - self.faces.len()], |id| &polygons[*id])
    }

    /// How often it winds around a point, counter-clockwise as its fronts see it; nothing where the point may touch it. A point on its
    /// `owner` is taken as just before that, though rounding may have put it on the plane or behind.
    ///
    /// Counted on the shortest way out of its box: one less for each front on the way, one more for each back.
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
        let way = Way::out_of(&self.extent, point);
        let turns = |index: usize| {
            let side = self.side(polygons, index);
            let own = owner.filter(|owner| std::ptr::eq(owner.polygon, side));
            let before = if let Some(owner) = own {
                owner.is_below(point).then_some(Ordering::Greater)
            } else if self.extents[index].misses(&near) {
                Some(side.plane().side_of(point))
            } else {
                let is_level = owner.is_some_and(|owner| side.lies_in_plane_of(owner.polygon));
                side.plane().quick_side(point).filter(|_| !is_level)
            };
            before.map(|before| way.passes(side, before))
        };
        self.tree.find(|extent| way.misses(extent, &near)).into_iter().map(turns).sum()
    }
}

/// A way along an axis, out of the box around a body.
#[derive(Clone, Copy, Debug)]
struct Way {
    axis: usize,
    /// Whether it leads to larger coordinates.
    is_up: bool,
    start: DVec3,
}

impl Way {
    fn out_of(extent: &Extent, start: DVec3) -> Self {
        let ways = [0, 1, 2].into_iter().flat_map(|axis| {
            let lengths = [start[axis] - extent.low[axis], extent.high[axis] - start[axis]];
            [false, true].map(|is_up| (lengths[usize::from(is_up)], Self { axis, is_up, start }))
        });
        let shortest = ways.min_by(|a, b| a.0.total_cmp(&b.0));
        shortest.map_or(Self { axis: 0, is_up: true, start }, |(_, way)| way)
    }

    /// Whether a box is neither on the way nor `near` its start.
    fn misses(&self, extent: &Extent, near: &Extent) -> bool {
        let [u, v] = self.across();
        let is_beside =
            |axis: usize| extent.high[axis] < near.low[axis] || near.high[axis] < extent.low[axis];
        let is_back = if self.is_up {
            extent.high[self.axis] < near.low[self.axis]
        } else {
            near.high[self.axis] < extent.low[self.axis]
        };
        is_beside(u) || is_beside(v) || is_back
    }

    /// The axes across it, of which a quarter turn leads from the first to the second as seen from above.
    fn across(&self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }

    /// How it passes a polygon, its start being before the plane (`Greater`) or behind: 1 out of the front, -1 into it.
    ///
    /// ```text
    ///   b         Seen along the way, an edge counts where it passes above the start, from one side to the other. An end just above the
    ///   |\        start counts as on one side: edges that polygons share are passed alike from both.
    ///   | · a
    /// ```
    fn passes(&self, side: &PlanarPolygon, before: Ordering) -> i32 {
        let [u, v] = self.across();
        let flat = |p: &DVec3| DVec2::new(p[u], p[v]);
        let at = flat(&self.start);
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
            piece.iter().zip(next).map(|(a, b)| crossing((flat(a), flat(b)))).sum::<i32>()
        };
        // Its front looks up where it runs counter-clockwise.
        let upward = side.convex_pieces().map(around).sum::<i32>();
        let turns = if self.is_up { upward } else { -upward };
        let meets = if turns > 0 { before == Ordering::Less } else { before == Ordering::Greater };
        if meets { turns } else { 0 }
    }
}

/// Whether a point that is close to a polygon's plane is away from the polygon's boundary, seen along one axis.
fn is_strictly_inside(polygon: &PlanarPolygon, point: DVec3) -> bool {
    let at = polygon.flat(point);
    let is_left =
        |(a, b): (&DVec3, &DVec3)| turn_in_plane(polygon.flat(*a), polygon.flat(*b), at) == Ordering::Greater;
    polygon.convex_pieces().any(|piece| piece.iter().zip(piece.iter().cycle().skip(1)).all(is_left))
}
