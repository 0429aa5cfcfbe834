//! Where shadows begin and end: the lines on a patch along which the light of the strongest emitters starts or ceases to be
//! hidden.
//!
//! The border of a penumbra or an umbra lies in a plane through a vertex of the emitter and an edge of what hides it, or the
//! other way round, that touches both bodies and crosses neither (Nishita and Nakamae 1985; Lischinski 1992). A body is a
//! set of patches that share vertices, or a single loop of a patch that shares none. Lines that are missing cost some
//! sharpness, lines too many some elements: so plain arithmetic will do.
use super::spacing::power;
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

/// Two rays in one plane that touches a lamp and what hides it: each from a point of the one past a point of the other.
type Wedge = [[DVec3; 2]; 2];

/// A lamp, what hides it, and the planes that touch both.
#[derive(Debug)]
struct Eclipse {
    lamp: usize,
    hiding: BTreeSet<usize>,
    wedges: Vec<Wedge>,
}

/// The borders of the shadows in the light of some lamps.
#[derive(Debug)]
pub(crate) struct Shadows<'s> {
    scene: &'s Scene,
    /// The patches of each lamp.
    lamps: Vec<BTreeSet<usize>>,
    eclipses: Vec<Eclipse>,
}

impl<'s> Shadows<'s> {
    /// The shadows in the light of the strongest lamps, that many of them. A lamp is a set of emitting patches that share vertices.
    pub(crate) fn new(scene: &'s Scene, lamps: usize) -> Shadows<'s> {
        let emits = |patch: &usize| scene.patches[*patch].emits();
        let mut lamps_of: Vec<Body> =
            groups(scene, emits).iter().map(|patches| whole(scene, patches)).collect();
        let strength =
            |lamp: &Body| lamp.patches.iter().map(|&patch| power(&scene.patches[patch])).sum::<f64>();
        lamps_of.sort_by(|a, b| strength(b).total_cmp(&strength(a)));
        lamps_of.truncate(lamps);
        let bodies = if lamps_of.is_empty() { Vec::new() } else { bodies(scene) };
        let mut eclipses = Vec::new();
        for (index, lamp) in lamps_of.iter().enumerate() {
            for body in bodies.iter().filter(|body| body.patches.is_disjoint(&lamp.patches)) {
                let (lamp, hiding, wedges) = (index, body.patches.clone(), wedges(lamp, body));
                eclipses.push(Eclipse { lamp, hiding, wedges });
            }
        }
        Shadows { scene, lamps: lamps_of.into_iter().map(|lamp| lamp.patches).collect(), eclipses }
    }

    /// How many planes the borders of shadows lie in.
    pub(crate) fn planes(&self) -> usize {
        self.eclipses.iter().map(|eclipse| eclipse.wedges.len()).sum()
    }

    /// The borders on a patch.
    pub(crate) fn on(&self, patch: usize) -> Vec<[DVec3; 2]> {
        let scene = self.scene;
        let lit: Vec<bool> = self
            .lamps
            .iter()
            .map(|lamp| !lamp.contains(&patch) && lamp.iter().any(|&emitter| faces(scene, patch, emitter)))
            .collect();
        let seen =
            self.eclipses.iter().filter(|eclipse| lit[eclipse.lamp] && !eclipse.hiding.contains(&patch));
        let wedges = seen.flat_map(|eclipse| &eclipse.wedges);
        wedges.filter_map(|wedge| line(&scene.patches[patch], wedge)).collect()
    }
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

/// The patches that share vertices with each other, of those that are asked for.
fn groups(scene: &Scene, is_wanted: impl Fn(&usize) -> bool) -> Vec<Vec<usize>> {
    let wanted: Vec<usize> = (0..scene.patches.len()).filter(is_wanted).collect();
    let mut groups = UnionFind::new(wanted.len());
    let mut first = BTreeMap::new();
    for (index, &patch) in wanted.iter().enumerate() {
        for point in scene.patches[patch].polygon.loops().flatten() {
            groups.join(*first.entry(point.to_array().map(f64::to_bits)).or_insert(index), index);
        }
    }
    let (numbers, firsts) = groups.number();
    let mut members = vec![Vec::new(); firsts.len()];
    numbers.iter().zip(wanted).for_each(|(&group, patch)| members[group].push(patch));
    members
}

/// What may hide light.
fn bodies(scene: &Scene) -> Vec<Body> {
    groups(scene, |_| true).iter().flat_map(|patches| body(scene, patches)).collect()
}

/// One body of several patches; of a single patch each loop is one: a hole lets light through as its outline does.
fn body(scene: &Scene, patches: &[usize]) -> Vec<Body> {
    let [patch] = patches else { return vec![whole(scene, patches)] };
    let ring = |points: &[DVec3]| {
        let mut ring = Body { patches: [*patch].into(), ..Body::default() };
        ring.add(points);
        ring
    };
    scene.patches[*patch].polygon.loops().map(ring).collect()
}

/// One body of some patches.
fn whole(scene: &Scene, patches: &[usize]) -> Body {
    let mut whole = Body { patches: patches.iter().copied().collect(), ..Body::default() };
    let loops = patches.iter().flat_map(|&patch| scene.patches[patch].polygon.loops());
    loops.for_each(|points| whole.add(points));
    whole.unify();
    whole
}

impl Body {
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
        let (mut before, mut behind) = (false, false);
        for point in &self.points {
            let arm = *point - apex;
            let height = normal.dot(arm);
            let is_off = height.abs() > NEAR * normal.length() * arm.length();
            before |= is_off && height > 0.0;
            behind |= is_off && height < 0.0;
            if before && behind {
                return false;
            }
        }
        true
    }
}

/// The planes that touch a lamp and a body.
fn wedges(lamp: &Body, body: &Body) -> Vec<Wedge> {
    let touches =
        |apex: DVec3, edge: [DVec3; 2]| lamp.is_on_one_side(apex, edge) && body.is_on_one_side(apex, edge);
    let mut wedges = Vec::new();
    for (points, edges, is_from_apex) in
        [(&lamp.points, &body.edges, true), (&body.points, &lamp.edges, false)]
    {
        for &apex in points {
            let touching = edges.iter().filter(|edge| touches(apex, **edge));
            wedges.extend(
                touching.map(|ends| ends.map(|end| if is_from_apex { [apex, end] } else { [end, apex] })),
            );
        }
    }
    wedges
}

/// Where the plane of a wedge meets a patch, if its rays get there.
fn line(patch: &Patch, wedge: &Wedge) -> Option<[DVec3; 2]> {
    let normal = patch.polygon.normal();
    let origin = patch.polygon.loops().flatten().next().copied().unwrap_or_default();
    let height = |point: DVec3| (point - origin).dot(normal);
    let cast = |[from, past]: [DVec3; 2]| {
        let (above, below) = (height(from), height(past).max(0.0));
        (above > 0.0 && below < above * (1.0 - NEAR))
            .then(|| from + (past - from) * (above / (above - below)))
    };
    let (a, b) = (cast(wedge[0])?, cast(wedge[1])?);
    (a != b).then_some([a, b])
}
