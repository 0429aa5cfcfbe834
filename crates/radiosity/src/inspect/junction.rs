//! T-junctions: a vertex of one patch in the middle of an edge of another one.
//!
//! Form factors do not mind them; but elements on both sides do not share vertices there, so that interpolated light can
//! show a seam.
use crate::extent::{BoxTree, Extent};
use crate::plane::slack;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
    patch::Patch,
};
use glam::DVec3;
use std::collections::BTreeMap;

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let corners = |(index, patch): (usize, &Patch)| {
        patch.polygon.loops().flatten().map(|point| (*point, index)).collect::<Vec<_>>()
    };
    let vertices: Vec<(DVec3, usize)> = scene.patches.iter().enumerate().flat_map(corners).collect();
    let tree = BoxTree::new(vertices.iter().map(|(point, _)| Extent { low: *point, high: *point }));
    let mut pairs: BTreeMap<[usize; 2], (usize, DVec3)> = BTreeMap::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        for points in patch.polygon.loops() {
            for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                let near = slack(&[*a, *b]);
                for vertex in tree.meeting(&Extent::holding([a, b]).grown(near)) {
                    let (point, other) = vertices[vertex];
                    if other != index && is_inside([*a, *b], point, near) {
                        pairs.entry([other, index]).or_insert((0, point)).0 += 1;
                    }
                }
            }
        }
    }
    let finding = |([other, index], (count, point)): ([usize; 2], (usize, DVec3))| Finding {
        kind: Kind::TJunction,
        patches: [other, index].map(|patch| scene.patches[patch].name.clone()).into(),
        what: format!("{count} vertices of the first end within edges of the second, one at {point}"),
        repair: "add the vertex to that edge, if a seam shows; form factors do not mind".into(),
        places: Vec::new(),
    };
    pairs.into_iter().map(finding).collect()
}

/// Whether a point lies on the edge, away from its ends.
fn is_inside([a, b]: [DVec3; 2], point: DVec3, near: f64) -> bool {
    let (edge, arm) = (b - a, point - a);
    let along = arm.dot(edge) / edge.length_squared();
    let foot = a + along * edge;
    (0.0..=1.0).contains(&along)
        && point.distance(foot) <= near
        && point.distance(a) > near
        && point.distance(b) > near
}
