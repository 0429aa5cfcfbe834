//! Where shadows begin and end: the lines on a patch along which the light of the strongest emitters starts or ceases to be
//! hidden.
//!
//! The border of a penumbra or an umbra lies in a plane through a vertex of the emitter and an edge of what hides it, or the
//! other way round, that touches both bodies and crosses neither (Nishita and Nakamae 1985; Lischinski 1992). A body is a
//! set of patches that share vertices, or a single loop of a patch that shares none. Lines that are missing cost some
//! sharpness, lines too many some elements: so plain arithmetic will do.
use super::spacing::strongest;
use crate::scene::{Scene, patch::Patch};
use crate::union_find::UnionFind;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// How far from a plane counts as on it, in shares of the distances.
const NEAR: f64 = 1e-9;

/// Vertices, and edges between them.
#[derive(Debug, Default)]
struct Body {
    points: Vec<DVec3>,
    edges: Vec<[DVec3; 2]>,
    patches: BTreeSet<usize>,
}

/// The lines on every patch, in the light of its `emitters` strongest emitters.
pub(crate) fn shadows(scene: &Scene, emitters: usize) -> Vec<Vec<[DVec3; 2]>> {
    let bodies = bodies(scene);
    let emitters = strongest(scene, emitters);
    let on_patch = |patch: usize| {
        let seen = emitters.iter().filter(|&&emitter| emitter != patch && faces(scene, patch, emitter));
        let lit = |&emitter: &usize| {
            let hiding = bodies
                .iter()
                .filter(move |body| !body.patches.contains(&patch) && !body.patches.contains(&emitter));
            hiding
                .flat_map(move |body| lines(&scene.patches[patch], &Body::of(&scene.patches[emitter]), body))
        };
        seen.flat_map(lit).collect()
    };
    (0..scene.patches.len()).map(on_patch).collect()
}

/// Whether some of the emitter is before the patch, and some of the patch before the emitter.
fn faces(scene: &Scene, patch: usize, emitter: usize) -> bool {
    let before = |one: &Patch, other: &Patch| {
        let origin = one.polygon.loops().flatten().next().copied().unwrap_or_default();
        other.polygon.loops().flatten().any(|&point| (point - origin).dot(one.polygon.normal()) > 0.0)
    };
    let (patch, emitter) = (&scene.patches[patch], &scene.patches[emitter]);
    before(patch, emitter) && before(emitter, patch)
}

/// What may hide light.
fn bodies(scene: &Scene) -> Vec<Body> {
    let mut groups = UnionFind::new(scene.patches.len());
    let mut first = BTreeMap::new();
    for (index, patch) in scene.patches.iter().enumerate() {
        for point in patch.polygon.loops().flatten() {
            groups.join(*first.entry(point.to_array().map(f64::to_bits)).or_insert(index), index);
        }
    }
    let (numbers, firsts) = groups.number();
    let mut members = vec![Vec::new(); firsts.len()];
    numbers.iter().enumerate().for_each(|(patch, &group)| members[group].push(patch));
    members.iter().flat_map(|patches| body(scene, patches)).collect()
}

/// One body of several patches; of a single patch each loop is one: a hole lets light through as its outline does.
fn body(scene: &Scene, patches: &[usize]) -> Vec<Body> {
    let named = |body: Body| Body { patches: patches.iter().copied().collect(), ..body };
    let [patch] = patches else {
        let mut whole = Body::default();
        patches
            .iter()
            .flat_map(|&patch| scene.patches[patch].polygon.loops())
            .for_each(|points| whole.add(points));
        whole.unify();
        return vec![named(whole)];
    };
    let ring = |points: &[DVec3]| {
        let mut ring = Body::default();
        ring.add(points);
        named(ring)
    };
    scene.patches[*patch].polygon.loops().map(ring).collect()
}

impl Body {
    /// A patch as a body.
    fn of(patch: &Patch) -> Body {
        let mut body = Body::default();
        patch.polygon.loops().for_each(|points| body.add(points));
        body
    }

    /// Adds a loop.
    fn add(&mut self, points: &[DVec3]) {
        self.points.extend(points);
        self.edges.extend(points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]));
    }

    /// Leaves each point and each edge once.
    fn unify(&mut self) {
        let key = |point: &DVec3| point.to_array().map(f64::to_bits);
        let mut seen = BTreeSet::new();
        self.points.retain(|point| seen.insert(key(point)));
        let mut seen = BTreeSet::new();
        self.edges.retain(|[a, b]| seen.insert([key(a).min(key(b)), key(a).max(key(b))]));
    }

    /// Whether no two points are on different sides of the plane through three points.
    fn is_on_one_side(&self, apex: DVec3, edge: [DVec3; 2]) -> bool {
        let normal = (edge[0] - apex).cross(edge[1] - apex);
        let sides = self.points.iter().map(|point| {
            let arm = *point - apex;
            let height = normal.dot(arm);
            if height.abs() <= NEAR * normal.length() * arm.length() { 0.0 } else { height.signum() }
        });
        let (low, high) = sides.fold((0.0f64, 0.0f64), |(low, high), side| (low.min(side), high.max(side)));
        low == 0.0 || high == 0.0
    }
}

/// The borders of the shadow that a body casts on a patch in an emitter's light.
fn lines(patch: &Patch, emitter: &Body, body: &Body) -> Vec<[DVec3; 2]> {
    let normal = patch.polygon.normal();
    let origin = patch.polygon.loops().flatten().next().copied().unwrap_or_default();
    let height = |point: DVec3| (point - origin).dot(normal);
    let touches =
        |apex: DVec3, edge: [DVec3; 2]| emitter.is_on_one_side(apex, edge) && body.is_on_one_side(apex, edge);
    let cast = |from: DVec3, past: DVec3| {
        let (above, below) = (height(from), height(past).max(0.0));
        (above > 0.0 && below < above * (1.0 - NEAR))
            .then(|| from + (past - from) * (above / (above - below)))
    };
    let past_edges = emitter.points.iter().flat_map(|&apex| body.edges.iter().map(move |&edge| (apex, edge)));
    let past_edges = past_edges
        .filter(|&(apex, edge)| touches(apex, edge))
        .filter_map(|(apex, [a, b])| Some([cast(apex, a)?, cast(apex, b)?]));
    let past_points =
        body.points.iter().flat_map(|&apex| emitter.edges.iter().map(move |&edge| (apex, edge)));
    let past_points = past_points
        .filter(|&(apex, edge)| touches(apex, edge))
        .filter_map(|(apex, [a, b])| Some([cast(a, apex)?, cast(b, apex)?]));
    past_edges.chain(past_points).filter(|[a, b]| a != b).collect()
}
