//! What is thinner than rounding is left out: slivers, and spikes of polygons.
use super::findings::{WIDTH, sliver};
use crate::mesh::subdivide::can_be_divided;
use crate::plane::slack;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use formfactor::PlanarPolygon;
use glam::DVec3;

/// So many patches are looked at before `stop` is asked.
const BATCH: usize = 4096;

/// Leaves out slivers and spikes, and what could not be divided into elements; nothing when `stop` says to stop.
pub(super) fn leave_out(scene: &mut Scene, stop: &dyn Fn() -> bool) -> Option<Vec<Finding>> {
    let mut findings = Vec::new();
    let mut kept = Vec::with_capacity(scene.patches.len());
    for (index, mut patch) in std::mem::take(&mut scene.patches).into_iter().enumerate() {
        if index % BATCH == 0 && stop() {
            return None;
        }
        let found = sliver(&patch).or_else(|| spike(&mut patch));
        let is_lost = found.is_some() && (sliver(&patch).is_some() || !can_be_divided(&patch.polygon));
        findings.extend(found);
        if !is_lost {
            kept.push(patch);
        }
    }
    scene.patches = kept;
    Some(findings)
}

/// Takes the spikes off a patch; tells of them, and of a patch that nothing can be made of.
fn spike(patch: &mut Patch) -> Option<Finding> {
    let points: Vec<DVec3> = patch.polygon.loops().flatten().copied().collect();
    let smooth = without_spikes(&patch.polygon, WIDTH * slack(&points));
    let what = match smooth {
        Some(polygon) if polygon.loops().flatten().count() < points.len() => {
            patch.polygon = polygon;
            "it has spikes that are thinner than its coordinates can tell"
        }
        _ if !can_be_divided(&patch.polygon) => "it is thinner in places than its coordinates can tell",
        _ => return None,
    };
    Some(Finding {
        kind: Kind::Sliver,
        patches: vec![patch.name.clone()],
        what: what.into(),
        repair: "remove it, or give it a width that its coordinates can hold".into(),
        places: Vec::new(),
    })
}

/// A polygon without vertices at which its outline turns back on itself, up to a width; `None` where nothing remains.
///
/// ```text
///   ┌──────────┐
///   │          a─────────b     c is nearer than the width to the edge from a to b,
///   │          c─────────┘     so b is left out
///   └──────────┘
/// ```
fn without_spikes(polygon: &PlanarPolygon, width: f64) -> Option<PlanarPolygon> {
    let mut loops: Vec<Vec<DVec3>> = polygon.loops().map(|ring| smooth(ring, width)).collect();
    let is_left = |ring: &Vec<DVec3>| ring.len() > 2;
    if !loops.first().is_some_and(is_left) {
        return None;
    }
    if loops.iter().map(Vec::len).eq(polygon.loops().map(<[DVec3]>::len)) {
        return Some(polygon.clone());
    }
    loops.retain(is_left);
    PlanarPolygon::new(&loops).ok()
}

fn smooth(ring: &[DVec3], width: f64) -> Vec<DVec3> {
    let mut ring = ring.to_vec();
    let mut at = 0;
    while at < ring.len() && ring.len() > 2 {
        let count = ring.len();
        let [a, b, c] = [at, (at + 1) % count, (at + 2) % count].map(|index| ring[index]);
        if is_near(c, [a, b], width) || is_near(a, [b, c], width) {
            ring.remove((at + 1) % count);
            // The vertices before may be a spike now.
            at = at.saturating_sub(2);
        } else {
            at += 1;
        }
    }
    ring
}

/// Whether a point is nearer to an edge than the width; to an edge of no length any point is.
fn is_near(point: DVec3, [a, b]: [DVec3; 2], width: f64) -> bool {
    let (edge, arm) = (b - a, point - a);
    let along = (arm.dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
    edge.length_squared() == 0.0 || point.distance(a + along * edge) <= width
}
