//! What hides light: patches that continue each other in one plane, as one polygon.
//!
//! A wall that comes as a thousand triangles hides what the wall hides, at a thousandth of the cost. Which edges lie
//! inside a wall is read off the vertices, which neighbours share.
use crate::plane::Plane;
use crate::scene::{Scene, patch::Patch};
use crate::union_find::UnionFind;
use formfactor::PlanarPolygon;
use glam::DVec3;
use polycsg::Scratch;
use std::collections::BTreeMap;

/// How near two planes, or a vertex and a straight line, are one, in shares of the coordinates' size: what rounding
/// leaves of a wall that was cut in parts.
const NEAR: f64 = 1e-12;

type Key = [u64; 3];

/// The polygons, and which of them each patch is a part of.
#[derive(Clone, Debug)]
pub(crate) struct Occluders {
    pub(crate) polygons: Vec<PlanarPolygon>,
    pub(crate) of_patch: Vec<usize>,
}

impl Occluders {
    /// Joins the patches of a scene. O(n log n) for n vertices.
    pub(crate) fn join(scene: &Scene) -> Occluders {
        let mut occluders = Occluders { polygons: Vec::new(), of_patch: vec![0; scene.patches.len()] };
        groups(scene, |_| true).iter().for_each(|patches| occluders.add(scene, patches));
        occluders
    }

    /// Adds a group as one polygon, or each patch by itself where the whole is none.
    fn add(&mut self, scene: &Scene, patches: &[usize]) {
        let whole = if patches.len() > 1 { outline(scene, patches) } else { None };
        match whole {
            Some(whole) => {
                patches.iter().for_each(|&patch| self.of_patch[patch] = self.polygons.len());
                self.polygons.push(whole);
            }
            None => {
                for &patch in patches {
                    self.of_patch[patch] = self.polygons.len();
                    self.polygons.push(straight(&scene.patches[patch].polygon));
                }
            }
        }
    }
}

/// The patches that continue each other, where that joins them: each group in ascending order, by their first ones. O(n log n) for n vertices.
pub(crate) fn groups(scene: &Scene, joins: impl Fn([usize; 2]) -> bool) -> Vec<Vec<usize>> {
    let mut sides: BTreeMap<[Key; 2], usize> = BTreeMap::new();
    let mut groups = UnionFind::new(scene.patches.len());
    for (index, patch) in scene.patches.iter().enumerate() {
        for [a, b] in edges(patch) {
            let other = sides.get(&[key(b), key(a)]).copied();
            let joined = |other: &usize| continues(&scene.patches[*other], patch) && joins([*other, index]);
            if let Some(other) = other.filter(joined) {
                groups.join(other, index);
            }
            sides.insert([key(a), key(b)], index);
        }
    }
    let (numbers, firsts) = groups.number();
    let mut members = vec![Vec::new(); firsts.len()];
    numbers.iter().enumerate().for_each(|(patch, &group)| members[group].push(patch));
    members
}

/// A place as a key of a map; −0.0 reads as 0.0.
fn key(place: DVec3) -> Key {
    place.to_array().map(|coordinate| (coordinate + 0.0).to_bits())
}

/// The directed edges of all loops.
fn edges(patch: &Patch) -> impl Iterator<Item = [DVec3; 2]> {
    let loops = patch.polygon.loops();
    loops.flat_map(|points| points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]))
}

/// Whether a patch lies in the plane of another one and faces the same way.
fn continues(one: &Patch, other: &Patch) -> bool {
    let (normal, points) = (one.polygon.normal(), || other.polygon.loops().flatten());
    let Some(&origin) = one.polygon.loops().flatten().next() else { return false };
    let size = points().map(|point| point.abs().max_element()).fold(origin.abs().max_element(), f64::max);
    normal.dot(other.polygon.normal()) > 0.0
        && points().all(|point| (*point - origin).dot(normal).abs() <= NEAR * size)
}

/// The polygon that patches cover together: the edges that only one of them has, straight ones as one.
pub(crate) fn outline(scene: &Scene, patches: &[usize]) -> Option<PlanarPolygon> {
    let mut rim: BTreeMap<[Key; 2], [DVec3; 2]> = BTreeMap::new();
    for [a, b] in patches.iter().flat_map(|&patch| edges(&scene.patches[patch])) {
        if rim.remove(&[key(b), key(a)]).is_none() {
            rim.insert([key(a), key(b)], [a, b]);
        }
    }
    let normal = scene.patches[patches[0]].polygon.normal();
    simple(&largest_first(link(rim).into_iter().map(straighten).collect(), normal)?)
}

/// Loops of more than two vertices, the largest one first.
fn largest_first(mut loops: Vec<Vec<DVec3>>, normal: DVec3) -> Option<PlanarPolygon> {
    loops.retain(|walk| walk.len() > 2);
    let outer =
        (0..loops.len()).max_by(|&a, &b| area(&loops[a], normal).total_cmp(&area(&loops[b], normal)))?;
    loops.swap(0, outer);
    PlanarPolygon::new(&loops).ok()
}

/// The polygon without vertices that lie straight between others.
fn straight(polygon: &PlanarPolygon) -> PlanarPolygon {
    let loops: Vec<Vec<DVec3>> = polygon.loops().map(|walk| straighten(walk.to_vec())).collect();
    if loops.iter().map(Vec::len).eq(polygon.loops().map(<[DVec3]>::len)) {
        return polygon.clone();
    }
    PlanarPolygon::new(&loops).unwrap_or_else(|_| polygon.clone())
}

/// The same polygon, without edges that cross or cover each other: of those every view would take a polygon Boolean.
fn simple(polygon: &PlanarPolygon) -> Option<PlanarPolygon> {
    let plane = Plane::of(polygon);
    let flat = polygon.loops().map(|walk| walk.iter().map(|point| plane.flatten(*point)).collect::<Vec<_>>());
    if polycsg::flaw([flat.collect::<Vec<_>>()], &mut Scratch::default()).is_none() {
        return Some(polygon.clone());
    }
    let parts = plane.lift(&plane.region(polygon), polygon.loops().flatten().copied());
    let loops = parts.iter().flat_map(PlanarPolygon::loops).map(<[DVec3]>::to_vec);
    largest_first(loops.collect(), polygon.normal())
}

/// Closed walks over directed edges; each is used once.
fn link(mut rim: BTreeMap<[Key; 2], [DVec3; 2]>) -> Vec<Vec<DVec3>> {
    let mut walks = Vec::new();
    while let Some((_, [start, mut end])) = rim.pop_first() {
        let mut walk = vec![start];
        while key(end) != key(start) {
            walk.push(end);
            let onward = rim.range([key(end), [0; 3]]..).next().filter(|(edge, _)| edge[0] == key(end));
            let Some(next) = onward.map(|(edge, _)| *edge) else { break };
            end = rim.remove(&next).map_or(start, |edge| edge[1]);
        }
        walks.push(walk);
    }
    walks
}

/// Leaves out the vertices that lie straight between their neighbours, and tips of spikes without width, which patches leave that meet along
/// an edge of one and several of others.
fn straighten(mut walk: Vec<DVec3>) -> Vec<DVec3> {
    loop {
        let mut kept: Vec<DVec3> = Vec::new();
        for (index, &point) in walk.iter().enumerate() {
            let before = kept.last().copied().unwrap_or(walk[walk.len() - 1]);
            if !bounds_nothing(before, point, walk[(index + 1) % walk.len()]) {
                kept.push(point);
            }
        }
        if kept.len() == walk.len() {
            return kept;
        }
        walk = kept;
    }
}

/// Whether a triangle has no width, and its tip is a corner of no more.
fn bounds_nothing(before: DVec3, tip: DVec3, after: DVec3) -> bool {
    let [one, other] = [before - tip, after - tip];
    let (short, long) =
        if one.length_squared() < other.length_squared() { (one, other) } else { (other, one) };
    let across = if short.dot(long) > 0.0 { long } else { after - before };
    across.cross(short).length() <= NEAR * tip.abs().max_element() * across.length()
}

/// Signed area of a closed walk, seen from the front.
fn area(walk: &[DVec3], normal: DVec3) -> f64 {
    let origin = walk[0];
    let next = walk.iter().cycle().skip(1);
    walk.iter().zip(next).map(|(a, b)| (*a - origin).cross(*b - origin)).sum::<DVec3>().dot(normal) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec2};
    use proptest::prelude::*;

    /// A rectangle with a hole, cut in triangles around the hole.
    fn cut_frame() -> Scene {
        let outer = [[0., 0.], [3., 0.], [3., 3.], [0., 3.]];
        let inner = [[1., 1.], [2., 1.], [2., 2.], [1., 2.]];
        let place = |[x, y]: [f64; 2]| DVec3::new(x, y, 0.5 * x + 0.25 * y);
        let triangle = |corners: [[f64; 2]; 3]| {
            let polygon = PlanarPolygon::new([corners.map(place)]).unwrap();
            Patch::new("triangle", polygon, vec![0.5], vec![0.0])
        };
        let pieces = (0..4).flat_map(|k| {
            let next = (k + 1) % 4;
            [triangle([outer[k], outer[next], inner[k]]), triangle([outer[next], inner[next], inner[k]])]
        });
        Scene { patches: pieces.collect(), bands: 1, ..Scene::default() }
    }

    #[test]
    fn triangles_of_a_wall_hide_as_the_wall_with_its_hole() {
        let occluders = Occluders::join(&cut_frame());
        assert_eq!(occluders.of_patch, [0; 8]);
        let whole = &occluders.polygons[0];
        assert_eq!(whole.loops().map(<[DVec3]>::len).collect::<Vec<_>>(), [4, 4]);
        let parts: f64 = cut_frame().patches.iter().map(|patch| patch.polygon.area()).sum();
        assert!((whole.area() / parts - 1.0).abs() < 1e-14);
        assert!(whole.normal().distance(cut_frame().patches[0].polygon.normal()) < 1e-14);
    }

    #[test]
    fn a_bend_and_a_turned_back_part_surfaces() {
        let square = |corners: [[f64; 3]; 4]| {
            Patch::new("square", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0])
        };
        let floor = square([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
        let wall = square([[0., 0., 0.], [0., 0., 1.], [1., 0., 1.], [1., 0., 0.]]);
        let beside = square([[1., 0., 0.], [1., 1., 0.], [2., 1., 0.], [2., 0., 0.]]);
        let scene = Scene { patches: vec![floor, wall, beside], bands: 1, ..Scene::default() };
        assert_eq!(Occluders::join(&scene).of_patch, [0, 1, 2]);
    }

    /// A wall of four by four squares: bricks take two or three of them, where these are free, and some squares are left out.
    fn wall(bricks: &[(usize, usize, bool, usize)], left_out: &[bool], turn: DQuat) -> Scene {
        let mut patches = Vec::new();
        let mut is_free = left_out.iter().map(|is_left_out| !is_left_out).collect::<Vec<_>>();
        let squares = (0..4).flat_map(|x| (0..4).map(move |y| (x, y, true, 1)));
        for (x, y, is_level, count) in bricks.iter().copied().chain(squares) {
            let [w, h] = if is_level { [count, 1] } else { [1, count] };
            let within: Vec<usize> = (x..x + w).flat_map(|x| (y..y + h).map(move |y| 4 * y + x)).collect();
            if x + w > 4 || y + h > 4 || !within.iter().all(|square| is_free[*square]) {
                continue;
            }
            within.iter().for_each(|square| is_free[*square] = false);
            let place = |x: usize, y: usize| turn * DVec3::new(x as f64 / 3.0, y as f64 / 3.0, 0.5);
            let corners = [place(x, y), place(x + w, y), place(x + w, y + h), place(x, y + h)];
            patches.push(Patch::new("brick", PlanarPolygon::new([corners]).unwrap(), vec![0.5], vec![0.0]));
        }
        Scene { patches, bands: 1, ..Scene::default() }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        /// Bricks meet along an edge of one and several of others, whose ends are off that edge by roundings in a turned wall.
        #[test]
        fn no_edge_of_a_wall_crosses_another(
            bricks in prop::collection::vec((0..4usize, 0..4usize, any::<bool>(), 2..4usize), 0..6),
            left_out in prop::collection::vec(prop::bool::weighted(0.2), 16),
            axis in prop_oneof![Just([0.0; 3]), prop::array::uniform3(-2.0..2.0)],
        ) {
            let scene = wall(&bricks, &left_out, DQuat::from_scaled_axis(DVec3::from(axis)));
            let occluders = Occluders::join(&scene);
            for polygon in &occluders.polygons {
                let plane = Plane::of(polygon);
                let flat: Vec<Vec<DVec2>> =
                    polygon.loops().map(|walk| walk.iter().map(|point| plane.flatten(*point)).collect()).collect();
                if plane.region(polygon).polygons().count() == 1 {
                    prop_assert_eq!(polycsg::flaw([&flat], &mut Scratch::default()), None);
                }
            }
            let area = |polygons: &mut dyn Iterator<Item = f64>| polygons.sum::<f64>();
            let parts = area(&mut scene.patches.iter().map(|patch| patch.polygon.area()));
            prop_assert!((area(&mut occluders.polygons.iter().map(PlanarPolygon::area)) - parts).abs() < 1e-12);
        }
    }
}
