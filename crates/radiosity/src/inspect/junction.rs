//! T-junctions: a vertex of one patch in the middle of an edge of another one.
//!
//! Form factors do not mind them; but elements on both sides do not share vertices there, so that interpolated light can
//! show a seam.
use crate::plane::slack;
use crate::scene::{
    Scene,
    finding::{Finding, Kind},
};
use glam::DVec3;
use std::collections::BTreeMap;

pub(super) fn findings(scene: &Scene) -> Vec<Finding> {
    let mut vertices: Vec<(DVec3, usize)> = Vec::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        vertices.extend(patch.polygon.loops().flatten().map(|point| (*point, index)));
    }
    vertices.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.cmp(&b.1)));
    let mut pairs: BTreeMap<[usize; 2], (usize, DVec3)> = BTreeMap::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        for points in patch.polygon.loops() {
            for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
                let near = slack(&[*a, *b]);
                for (point, other) in along(&vertices, [*a, *b], near) {
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

/// The vertices between the edge's ends in x.
fn along(vertices: &[(DVec3, usize)], [a, b]: [DVec3; 2], near: f64) -> impl Iterator<Item = (DVec3, usize)> {
    let (low, high) = (a.x.min(b.x) - near, a.x.max(b.x) + near);
    let first = vertices.partition_point(|(point, _)| point.x < low);
    vertices[first..].iter().take_while(move |(point, _)| point.x <= high).copied()
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
