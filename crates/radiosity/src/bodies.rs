//! Surfaces that are connected by edges, and which of them are closed.
use crate::repair::weld::{PointKey, Welds, key};
use crate::scene::{Scene, patch::Patch};
use crate::union_find::UnionFind;
use glam::DVec3;
use std::collections::BTreeMap;

/// Patches that are connected by edges.
#[derive(Debug)]
pub(crate) struct ConnectedBody {
    /// Its first patch.
    pub(crate) first: usize,
    /// For a closed body whose faces are all turned the same way, whether their fronts are turned in.
    pub(crate) turned_in: Option<bool>,
    /// Whether some edge of it connects more than two patches: it may be several bodies that share edges.
    pub(crate) is_joined: bool,
    pub(crate) emits: bool,
}

/// The bodies of a scene.
#[derive(Debug)]
pub(crate) struct Bodies {
    pub(crate) bodies: Vec<ConnectedBody>,
    pub(crate) of_patch: Vec<usize>,
}

/// The patches that have an edge, each with how often more it runs along it forwards than backwards.
type EdgeUses = BTreeMap<usize, i32>;

impl Bodies {
    /// The bodies that first sides make.
    pub(crate) fn of_first_sides(scene: &Scene, welds: &Welds) -> Bodies {
        Bodies::collect(scene, welds, |patch| !patch.is_back)
    }

    /// The bodies that all patches make: what has two sides is none that is closed.
    pub(crate) fn of_all_sides(scene: &Scene, welds: &Welds) -> Bodies {
        Bodies::collect(scene, welds, |_| true)
    }

    /// The bodies that patches make of which some count. Every edge of a closed body is run along as often one way as the other.
    fn collect(scene: &Scene, welds: &Welds, counts: impl Fn(&Patch) -> bool) -> Bodies {
        let edges = edges(scene, welds, &counts);
        let surfaces = surfaces(scene, &edges);
        let mut groups = UnionFind::new(scene.patches.len());
        let (mut open, mut joined) = (Vec::new(), Vec::new());
        for uses in edges.values() {
            for connected in connected(scene, uses, &surfaces) {
                connected.windows(2).for_each(|pair| groups.join(pair[0], pair[1]));
                let turns: i32 = connected.iter().map(|patch| uses[patch]).sum();
                open.extend(connected.first().filter(|_| turns != 0).copied());
                joined.extend(connected.first().filter(|_| connected.len() > 2).copied());
            }
        }
        (1..scene.patches.len())
            .filter(|&index| is_other_side(scene, index))
            .for_each(|index| groups.join(index - 1, index));
        let (of_patch, firsts) = groups.number();
        let mut is_closed = vec![true; firsts.len()];
        open.into_iter().for_each(|patch| is_closed[of_patch[patch]] = false);
        let volumes = volumes(scene, &of_patch, firsts.len(), &counts);
        let body = |(index, first): (usize, usize)| ConnectedBody {
            first,
            is_joined: false,
            turned_in: (is_closed[index] && volumes[index] != 0.0).then_some(volumes[index] < 0.0),
            emits: false,
        };
        let mut bodies: Vec<ConnectedBody> = firsts.into_iter().enumerate().map(body).collect();
        joined.into_iter().for_each(|patch| bodies[of_patch[patch]].is_joined = true);
        scene.patches.iter().zip(&of_patch).for_each(|(patch, &body)| bodies[body].emits |= patch.emits());
        Bodies { bodies, of_patch }
    }

    /// The body of a patch.
    pub(crate) fn of(&self, patch: usize) -> &ConnectedBody {
        &self.bodies[self.of_patch[patch]]
    }
}

/// Whether a patch is the second side of the one before it.
pub(crate) fn is_other_side(scene: &Scene, index: usize) -> bool {
    let patch = &scene.patches[index];
    patch.is_back
        && index > 0
        && !scene.patches[index - 1].is_back
        && scene.patches[index - 1].origin == patch.origin
}

/// The edges of patches that count.
fn edges(scene: &Scene, welds: &Welds, counts: impl Fn(&Patch) -> bool) -> BTreeMap<[PointKey; 2], EdgeUses> {
    let mut edges: BTreeMap<[PointKey; 2], EdgeUses> = BTreeMap::new();
    for (patch, _) in scene.patches.iter().enumerate().filter(|(_, patch)| counts(patch)) {
        for [a, b] in sides(scene, patch, welds) {
            let uses = edges.entry([a.min(b), a.max(b)]).or_default();
            *uses.entry(patch).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges
}

/// For each patch the number of the surface that it is of, which edges of two patches connect.
fn surfaces(scene: &Scene, edges: &BTreeMap<[PointKey; 2], EdgeUses>) -> Vec<usize> {
    let mut surfaces = UnionFind::new(scene.patches.len());
    for uses in edges.values().filter(|uses| uses.len() == 2) {
        uses.keys().zip(uses.keys().skip(1)).for_each(|(a, b)| surfaces.join(*a, *b));
    }
    surfaces.number().0
}

/// The patches of an edge that it connects: those of each surface that is closed there, of each object of the file that is, and all others.
/// What is closed at an edge by itself only touches the others there.
fn connected(scene: &Scene, uses: &EdgeUses, surfaces: &[usize]) -> Vec<Vec<usize>> {
    let (mut closed, open) = closed_apart(uses, uses.keys().copied(), |patch| surfaces[patch]);
    let (objects, open) = closed_apart(uses, open.into_iter(), |patch| scene.patches[patch].origin.instance);
    closed.extend(objects);
    closed.push(open);
    closed
}

/// The groups of patches of an edge that are closed there, and all other patches.
fn closed_apart(
    uses: &EdgeUses,
    patches: impl Iterator<Item = usize>,
    group: impl Fn(usize) -> usize,
) -> (Vec<Vec<usize>>, Vec<usize>) {
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    patches.for_each(|patch| groups.entry(group(patch)).or_default().push(patch));
    let is_closed = |group: &Vec<usize>| group.iter().map(|patch| uses[patch]).sum::<i32>() == 0;
    let (closed, open): (Vec<_>, Vec<_>) = groups.into_values().partition(is_closed);
    (closed, open.concat())
}

/// The directed edges of a patch between places that are not one.
fn sides(scene: &Scene, patch: usize, welds: &Welds) -> Vec<[PointKey; 2]> {
    let place = |point: &DVec3| key(welds.place(*point));
    let loops = scene.patches[patch].polygon.loops();
    let pairs = loops.flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)));
    pairs.map(|(a, b)| [place(a), place(b)]).filter(|[a, b]| a != b).collect()
}

/// Six times the signed volume of each body: positive where fronts are turned out.
fn volumes(scene: &Scene, of_patch: &[usize], count: usize, counts: impl Fn(&Patch) -> bool) -> Vec<f64> {
    let mut volumes = vec![0.0; count];
    let [low, high] = scene.extent();
    let origin = low.midpoint(high);
    for (patch, &body) in scene.patches.iter().zip(of_patch).filter(|(patch, _)| counts(patch)) {
        let corner = patch.polygon.loops().flatten().next().copied().unwrap_or(origin);
        volumes[body] += 2.0 * patch.polygon.area() * (corner - origin).dot(patch.polygon.normal());
    }
    volumes
}
