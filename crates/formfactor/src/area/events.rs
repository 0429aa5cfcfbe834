//! Where on a polygon the view of another one changes its shape: lines along which a form factor from a point has kinks.
//!
//! From there a vertex of the target lies behind an edge of an occluder, or an edge of the target behind a vertex of one; or
//! the target turns from its front to its back; or an occluder's vertex lies behind another one's edge, which may open or
//! close a slit. Kinks that three edges make together are curved and left to refinement.
use crate::shapes::polygon::PlanarPolygon;
use glam::{DVec2, DVec3};

/// More events than this are not looked for: refinement does better.
const MOST: usize = 1 << 14;

/// A segment in the source's two kept coordinates.
pub(super) type Event = [DVec2; 2];

/// The events on `source` of its view of `target` past `occluders`; those among the occluders where they are asked for.
pub(super) fn events(
    source: &PlanarPolygon,
    target: &PlanarPolygon,
    occluders: &[&PlanarPolygon],
    is_fine: bool,
) -> Vec<Event> {
    let vertices: usize = occluders.iter().map(|o| o.points().len()).sum();
    let mut found: Vec<Event> = turn(source, target).into_iter().collect();
    if 2 * vertices * target.points().len() <= MOST {
        found.extend(occluders.iter().flat_map(|occluder| between(source, target, occluder)));
    }
    if is_fine {
        found.extend(occluders.iter().filter_map(|occluder| edge_on(source, target, occluder)));
    }
    if is_fine && vertices * vertices <= MOST {
        let apart = |one: &PlanarPolygon, other: &PlanarPolygon| {
            one.points().iter().all(|p| !other.points().contains(p))
        };
        for (i, one) in occluders.iter().enumerate() {
            let others = occluders[..i].iter().filter(|other| apart(one, other));
            found.extend(
                others.flat_map(|other| [between(source, one, other), between(source, other, one)].concat()),
            );
        }
    }
    found.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal));
    found.dedup();
    found
}

/// Where vertices of one polygon are seen behind edges of a nearer one, or the other way round.
fn between(source: &PlanarPolygon, far: &PlanarPolygon, near: &PlanarPolygon) -> Vec<Event> {
    let vertices = far.points().iter().flat_map(|t| near.edges().map(|(a, b)| ([*t, *t], [a, b])));
    let edges = far.edges().flat_map(|(s, t)| near.points().iter().map(move |a| ([s, t], [*a, *a])));
    vertices.chain(edges).filter_map(|(from, through)| shadow(source, from, through)).collect()
}

fn key([a, b]: &Event) -> [f64; 4] {
    [a.x, a.y, b.x, b.y]
}

/// Where the rays from the points of one segment through the like points of another one meet the source's plane.
///
/// When one of them is parallel to the plane in between, the shadow goes on for ever from there; so it does along the
/// plane where both segments stand on it.
fn shadow(source: &PlanarPolygon, from: [DVec3; 2], through: [DVec3; 2]) -> Option<Event> {
    let ends = [0, 1].map(|i| meet(source, from[i], through[i]));
    if let [Some(a), Some(b)] = ends {
        return event([a, b]);
    }
    let standing = (0..2).find(|i| is_on(source, from[*i]) && is_on(source, through[*i]));
    let start = ends[0].or(ends[1]).or_else(|| standing.map(|i| source.flat(through[i])))?;
    let drop = [0, 1].map(|i| height(source, from[i]) - height(source, through[i]));
    let share = drop[0] / (drop[0] - drop[1]);
    let along = source.flat(through[0].lerp(through[1], share) - from[0].lerp(from[1], share));
    let reach = source.points().iter().map(|p| source.flat(*p).distance(start)).fold(0.0, f64::max);
    let end = start + 2.0 * reach * along.normalize_or_zero();
    end.is_finite().then(|| event([start, end])).flatten()
}

/// Where the ray from one point down through another one meets the source's plane; `None` too where it seems parallel.
fn meet(source: &PlanarPolygon, from: DVec3, through: DVec3) -> Option<DVec2> {
    let (high, low) = (height(source, from), height(source, through));
    let point = from + (through - from) * (high / (high - low));
    let is_steep = high - low > 1e-6 * from.distance(through);
    (is_steep && point.is_finite()).then(|| source.flat(point))
}

fn height(source: &PlanarPolygon, point: DVec3) -> f64 {
    source.normal().dot(point - source.points()[0])
}

/// Whether a point seems to lie on the source's plane. Only the way in which cells are cut depends on it.
fn is_on(source: &PlanarPolygon, point: DVec3) -> bool {
    height(source, point).abs() <= 1e-12 * point.distance(source.points()[0])
}

/// Where an occluder is seen edge-on before the target: it begins to hide there, or another edge of its body takes over.
fn edge_on(source: &PlanarPolygon, target: &PlanarPolygon, occluder: &PlanarPolygon) -> Option<Event> {
    let [first, last] = chord(source, occluder)?;
    let chord = chord(target, occluder)?;
    let rays = chord.iter().flat_map(|t| occluder.points().iter().map(move |a| meet(source, *t, *a)));
    let met: Option<Vec<DVec2>> = rays.collect();
    // Where some ray does not come down to the source the shadow goes on for ever.
    met.map_or_else(|| event([source.flat(first), source.flat(last)]), event)
}

/// Where the target's plane meets the source.
fn turn(source: &PlanarPolygon, target: &PlanarPolygon) -> Option<Event> {
    event(chord(source, target)?.map(|p| source.flat(p)))
}

/// The ends of the part of a polygon that lies in another one's plane.
fn chord(polygon: &PlanarPolygon, other: &PlanarPolygon) -> Option<[DVec3; 2]> {
    let crossing = |(a, b): (DVec3, DVec3)| {
        let (from, to) = (height(other, a), height(other, b));
        ((from > 0.0) != (to > 0.0)).then(|| a + (b - a) * (from / (from - to)))
    };
    let along = polygon.normal().cross(other.normal());
    let mut met: Vec<DVec3> = polygon.edges().filter_map(crossing).collect();
    met.sort_by(|a, b| along.dot(*a).total_cmp(&along.dot(*b)));
    Some([*met.first()?, *met.last()?])
}

/// The segment that points on a line span.
fn event(points: impl IntoIterator<Item = DVec2>) -> Option<Event> {
    let mut points: Vec<DVec2> = points.into_iter().collect();
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let (first, last) = (points.first()?, points.last()?);
    (first != last).then_some([*first, *last])
}
