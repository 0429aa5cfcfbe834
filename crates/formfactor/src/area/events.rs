//! Where on a polygon the view of another one changes its shape: lines along which a form factor from a point has kinks.
//!
//! From there a vertex of the target lies behind an edge of an occluder, or an edge of the target behind a vertex of one; or
//! the target turns from its front to its back; or an occluder's vertex lies behind another one's edge, which may open or
//! close a slit. Kinks that three edges make together are curved and left to refinement.
use crate::PlanarPolygon;
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
    let mut found = turn(source, target);
    if 2 * vertices * target.points().len() <= MOST {
        found.extend(occluders.iter().flat_map(|occluder| between(source, target, occluder)));
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

/// Where two rays, each from one point through another one, meet the source's plane.
fn shadow(source: &PlanarPolygon, from: [DVec3; 2], through: [DVec3; 2]) -> Option<Event> {
    let normal = source.normal();
    let height = |p: DVec3| normal.dot(p - source.points()[0]);
    let meet = |t: DVec3, a: DVec3| {
        let (high, low) = (height(t), height(a));
        let point = t + (a - t) * (high / (high - low));
        (high > low && point.is_finite()).then(|| source.flat(point))
    };
    let mut ends = [meet(from[0], through[0])?, meet(from[1], through[1])?];
    ends.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    (ends[0] != ends[1]).then_some(ends)
}

/// Where the target's plane meets the source.
fn turn(source: &PlanarPolygon, target: &PlanarPolygon) -> Vec<Event> {
    let height = |p: DVec3| target.normal().dot(p - target.points()[0]);
    let crossing = |(a, b): (DVec3, DVec3)| {
        let (from, to) = (height(a), height(b));
        ((from > 0.0) != (to > 0.0)).then(|| source.flat(a + (b - a) * (from / (from - to))))
    };
    let mut met: Vec<DVec2> = source.edges().filter_map(crossing).collect();
    met.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    match (met.first(), met.last()) {
        (Some(a), Some(b)) if a != b => vec![[*a, *b]],
        _ => Vec::new(),
    }
}
