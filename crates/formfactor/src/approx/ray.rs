//! Rays from dA against an enclosure, by the exact method's rules: occluders block for 0 < t < 1, the owner never, nor
//! does what is coplanar with the target or whose plane contains dA. Each polygon has a cone around it, to skip it by.
use crate::scene::enclosure::Enclosure;
use crate::shapes::{differential_area::DifferentialArea, extent::Extent, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// A polygon as dA sees it.
#[derive(Debug)]
pub(super) struct Item<'a> {
    pub(super) id: usize,
    pub(super) polygon: &'a PlanarPolygon,
    /// Whether dA is on its front: if not, it hides and is not seen.
    pub(super) is_front: bool,
    /// Its loops relative to dA.
    pub(super) loops: Vec<Vec<DVec3>>,
    /// Distance of its plane from dA along its normal: not zero.
    height: f64,
    /// The id of one of those in its plane: they do not hide each other.
    pub(super) plane: usize,
    cone: Cone,
}

impl<'a> Item<'a> {
    /// `None` for what is never seen and never hides: the owner, and what lies below the horizon or edge-on.
    fn of(from: &DifferentialArea, id: usize, polygon: &'a PlanarPolygon) -> Option<Self> {
        let position = from.position();
        let side = polygon.plane().side(position);
        let is_above = |p: &DVec3| from.normal().dot(*p - position) > 0.0;
        if from.owner() == Some(id) || side.sign == Ordering::Equal || !polygon.points().iter().any(is_above)
        {
            return None;
        }
        let loops: Vec<Vec<DVec3>> =
            polygon.loops().map(|l| l.iter().map(|p| *p - position).collect()).collect();
        Some(Self {
            id,
            polygon,
            plane: id,
            is_front: side.sign == Ordering::Greater,
            height: -side.value.round() / polygon.plane().normal.round().length(),
            cone: Cone::around(loops.iter().flatten()),
            loops,
        })
    }

    /// 1/t for a direction, whose length is that of t = 1: not positive when the plane lies behind.
    pub(super) fn nearness(&self, direction: DVec3) -> f64 {
        self.polygon.normal().dot(direction) / self.height
    }

    /// Where along a direction it is met, as 1/t.
    fn hit(&self, direction: DVec3) -> Option<f64> {
        let nearness = self.nearness(direction);
        let is_met = nearness > 0.0 && self.cone.holds(direction) && self.is_inside(direction);
        is_met.then_some(nearness)
    }

    /// Whether the line of a direction passes an odd number of loops. What is shared between polygons is found alike from
    /// both: no ray slips through an edge between two triangles.
    fn is_inside(&self, direction: DVec3) -> bool {
        let size = direction.abs();
        let axis = if size.z >= size.x && size.z >= size.y {
            2
        } else if size.y >= size.x {
            1
        } else {
            0
        };
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let slope = DVec2::new(direction[u], direction[v]) / direction[axis];
        let flat = |p: &DVec3| DVec2::new(p[u], p[v]) - p[axis] * slope;
        self.loops.iter().filter(|l| winds(l.iter().map(flat))).count() % 2 == 1
    }
}

/// Whether a loop's edges cross the positive x axis an odd number of times.
fn winds(points: impl Iterator<Item = DVec2> + Clone) -> bool {
    let next = points.clone().cycle().skip(1);
    let crosses = |(a, b): &(DVec2, DVec2)| {
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        (low.y > 0.0) != (high.y > 0.0) && low.perp_dot(*high) > 0.0
    };
    points.zip(next).filter(crosses).count() % 2 == 1
}

/// Directions around an axis: a bound on those to a polygon.
#[derive(Clone, Copy, Debug)]
struct Cone {
    axis: DVec3,
    /// Of the half angle; negative when the cone is no bound.
    cosine: f64,
}

impl Cone {
    fn around<'p>(points: impl Iterator<Item = &'p DVec3> + Clone) -> Self {
        let toward = points.map(|p| p.normalize_or_zero());
        let axis = toward.clone().sum::<DVec3>().normalize_or_zero();
        // Rounding may only widen it.
        let cosine = toward.map(|d| d.dot(axis)).fold(1.0, f64::min) - 1e-12;
        Self { axis, cosine: if cosine > 0.0 { cosine } else { -1.0 } }
    }

    fn holds(&self, direction: DVec3) -> bool {
        self.cosine < 0.0 || direction.dot(self.axis) >= self.cosine * direction.length()
    }

    fn meets(&self, other: &Self) -> bool {
        let open = self.cosine < 0.0 || other.cosine < 0.0;
        // The angles' sum is below a half turn: its cosine falls.
        let sine = |c: f64| (1.0 - c * c).max(0.0).sqrt();
        open || self.axis.dot(other.axis)
            >= self.cosine * other.cosine - sine(self.cosine) * sine(other.cosine) - 1e-12
    }
}

/// The polygons that dA may see or that may hide others, in the order of their ids.
pub(super) fn items<'a>(enclosure: &'a Enclosure, from: &DifferentialArea) -> Vec<Item<'a>> {
    let polygons = enclosure.polygons().iter().enumerate();
    let mut items: Vec<Item> = polygons.filter_map(|(id, polygon)| Item::of(from, id, polygon)).collect();
    share_planes(&mut items);
    items
}

/// Gives those in one plane the id of one of them. Takes O(n log n) where few planes are at one distance from dA.
fn share_planes(items: &mut [Item]) {
    let mut order: Vec<usize> = (0..items.len()).collect();
    order.sort_by(|a, b| items[*a].height.abs().total_cmp(&items[*b].height.abs()));
    let reach = items.iter().map(|item| item.loops[0][0].length()).fold(0.0, f64::max);
    // Coplanar polygons' distances differ by roundings of the coordinates; 1e-9 is far more.
    let is_level = |a: &Item, b: &Item| b.height.abs() - a.height.abs() <= 1e-9 * reach;
    let mut firsts: Vec<usize> = Vec::new();
    for place in order {
        let level = firsts.iter().rev().take_while(|first| is_level(&items[**first], &items[place]));
        match level.copied().find(|first| is_coplanar(&items[*first], &items[place])) {
            Some(first) => items[place].plane = items[first].plane,
            None => firsts.push(place),
        }
    }
}

/// The items whose boxes a ray meets, in some order.
pub(super) fn along_ray<'i, 'a>(
    enclosure: &Enclosure,
    items: &'i [Item<'a>],
    origin: DVec3,
    direction: DVec3,
) -> impl Iterator<Item = &'i Item<'a>> {
    let found = enclosure.tree().find(|extent| extent.misses_ray(origin, direction));
    found.into_iter().filter_map(|id| item_of(items, id))
}

/// The item of a polygon.
fn item_of<'i, 'a>(items: &'i [Item<'a>], id: usize) -> Option<&'i Item<'a>> {
    items.binary_search_by_key(&id, |item| item.id).ok().map(|place| &items[place])
}

/// The polygons seen along a direction: the nearest, with those coplanar to it that overlap there.
pub(super) fn seen<'i, 'a: 'i>(
    items: impl IntoIterator<Item = &'i Item<'a>>,
    direction: DVec3,
) -> Vec<&'i Item<'a>> {
    let found = items.into_iter().filter_map(|item| item.hit(direction).map(|nearness| (nearness, item)));
    let hits: Vec<(f64, &Item)> = found.collect();
    let is_seen = |&(nearness, item): &(f64, &Item)| {
        let hides = |&(other, by): &(f64, &Item)| other > nearness && by.plane != item.plane;
        item.is_front && !hits.iter().any(hides)
    };
    hits.iter().filter(|hit| is_seen(hit)).map(|hit| hit.1).collect()
}

/// A target, and what may hide some of it.
#[derive(Debug)]
pub(super) struct RayTarget<'i, 'a> {
    pub(super) item: &'i Item<'a>,
    occluders: Vec<&'i Item<'a>>,
}

impl<'i, 'a> RayTarget<'i, 'a> {
    /// `None` when the target is not seen whatever stands in between.
    pub(super) fn new(
        enclosure: &Enclosure,
        items: &'i [Item<'a>],
        origin: DVec3,
        id: usize,
    ) -> Option<Self> {
        let item = item_of(items, id).filter(|item| item.is_front)?;
        let hides = |other: &&Item| {
            other.plane != item.plane
                && other.cone.meets(&item.cone)
                && is_before(other.polygon, item.polygon)
        };
        let around = Extent::around(&[item.polygon.points(), &[origin]].concat());
        let mut near = enclosure.tree().find(|extent| extent.misses(&around));
        near.sort_unstable();
        let near = near.into_iter().filter_map(|other| item_of(items, other));
        Some(Self { item, occluders: near.filter(hides).collect() })
    }

    /// Whether nothing blocks the way from dA to a point of the target, given relative to dA.
    pub(super) fn is_reached(&self, point: DVec3) -> bool {
        !self.occluders.iter().any(|o| o.hit(point).is_some_and(|nearness| nearness > 1.0))
    }
}

/// Whether some of a polygon lies on the front side of another's plane.
fn is_before(polygon: &PlanarPolygon, other: &PlanarPolygon) -> bool {
    polygon.points().iter().any(|p| other.plane().side_of(*p) == Ordering::Greater)
}

/// Whether two polygons lie in one plane, as nearly as their vertices are known.
fn is_coplanar(a: &Item, b: &Item) -> bool {
    if a.polygon.normal().dot(b.polygon.normal()).abs() < 0.999 {
        return false;
    }
    let plane = a.polygon.plane();
    let height = 2.0 * (a.polygon.deviation() + b.polygon.deviation()) * plane.normal.round().length();
    b.polygon.points().iter().all(|p| plane.side(*p).value.hi.abs() <= height)
}
