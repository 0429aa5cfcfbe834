//! Random sets of polygons around a differential area, each a function of its seed alone. Vertices are exactly coplanar.
use crate::random::Random;
use crate::sweep::Loops;
use glam::DVec3;

/// Polygons in space with a point that sees them.
#[derive(Clone, Debug)]
pub struct Surroundings {
    /// Kind and seed.
    pub name: String,
    /// Where the differential area lies.
    pub position: DVec3,
    /// Where it looks: not a unit vector.
    pub normal: DVec3,
    /// The polygons.
    pub polygons: Vec<Loops>,
}

/// What makes polygons of one kind.
type Maker = fn(&mut Random) -> Vec<Loops>;

const KINDS: [(&str, Maker); 8] = [
    ("tilted triangles", tilted_triangles),
    ("quads on a lattice", lattice_quads),
    ("right triangles with shared edges", right_triangles),
    ("nested frames", nested_frames),
    ("slivers", slivers),
    ("tilted tiles", tilted_tiles),
    ("touching triangles", touching_triangles),
    ("stars on a lattice", lattice_stars),
];

/// The surroundings of a seed, all kinds in turn.
pub fn surroundings(seed: u64) -> Surroundings {
    let kinds = u64::try_from(KINDS.len()).expect("a few");
    let (kind, make) = KINDS[usize::try_from(seed % kinds).expect("below a few")];
    let mut random = Random::new(seed);
    let polygons = make(&mut random);
    let (position, normal) = loop {
        let (position, normal) = (lattice(&mut random, 6) / 2.0, lattice(&mut random, 2));
        // It looks toward the middle.
        if normal != DVec3::ZERO && normal.dot(position) <= 0.0 {
            break (position, normal);
        }
    };
    let shift = if random.one_in(2) { DVec3::ZERO } else { anywhere(&mut random, 0.3) };
    Surroundings { name: format!("{kind}, seed {seed}"), position: position + shift, normal, polygons }
}

fn lattice(random: &mut Random, size: i32) -> DVec3 {
    DVec3::from([0; 3].map(|_| f64::from(random.between(-size, size))))
}

fn anywhere(random: &mut Random, size: f64) -> DVec3 {
    DVec3::from([0; 3].map(|_| random.range(-size, size)))
}

/// Whether a triangle has an area, and not by rounding alone.
fn is_wide([a, b, c]: [DVec3; 3]) -> bool {
    (b - a).cross(c - a).length() > 1e-13
}

/// Triangles anywhere, through each other.
fn tilted_triangles(random: &mut Random) -> Vec<Loops> {
    let count = random.between(2, 12);
    let corners = (0..count).map(|_| [0; 3].map(|_| anywhere(random, 3.0)));
    corners.filter(|t| is_wide(*t)).map(|t| vec![t.to_vec()]).collect()
}

/// Rectangles along the axes, their coordinates small integers.
fn lattice_quads(random: &mut Random) -> Vec<Loops> {
    let count = random.between(3, 14);
    let mut quads = Vec::new();
    for _ in 0..count {
        let (corner, axis) = (lattice(random, 3), random.below(3));
        let [u, v] = [1, 2].map(|i| DVec3::AXES[(axis + i) % 3] * f64::from(random.between(1, 4)));
        quads.push(vec![turned(random, vec![corner, corner + u, corner + u + v, corner + v])]);
    }
    quads
}

/// A few lattice planes cut in squares and these in right triangles, some left out.
fn right_triangles(random: &mut Random) -> Vec<Loops> {
    let mut triangles = Vec::new();
    for _ in 0..random.between(3, 5) {
        let (corner, axis) = (lattice(random, 2), random.below(3));
        let [u, v] = [1, 2].map(|i| DVec3::AXES[(axis + i) % 3]);
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let a = corner + f64::from(i) * u + f64::from(j) * v;
            let halves = if random.one_in(2) {
                [[a, a + u, a + u + v], [a, a + u + v, a + v]]
            } else {
                [[a, a + u, a + v], [a + u, a + u + v, a + v]]
            };
            for half in halves {
                if !random.one_in(4) {
                    triangles.push(vec![turned(random, half.to_vec())]);
                }
            }
        }
    }
    triangles
}

/// Squares in squares in parallel planes, whose shadows from the axis are nested, touch or coincide.
fn nested_frames(random: &mut Random) -> Vec<Loops> {
    let centre = lattice(random, 1);
    let axis = random.below(3);
    let [w, u, v] = [0, 1, 2].map(|i| DVec3::AXES[(axis + i) % 3]);
    let square = |height: f64, half: f64| -> Vec<DVec3> {
        let at = |s: f64, t: f64| centre + w * height + half * (s * u + t * v);
        vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
    };
    let mut frames = Vec::new();
    for _ in 0..random.between(2, 6) {
        let height = f64::from(random.between(-3, 3));
        let half = f64::from(random.between(1, 4)) / 2.0 * height.abs().max(1.0);
        let depth = random.between(1, 4);
        let loops: Loops = (0..depth).map(|i| square(height, half * (1.0 - f64::from(i) / 4.0))).collect();
        let outer = turned(random, loops[0].clone());
        frames.push(std::iter::once(outer).chain(loops[1..].iter().cloned()).collect());
    }
    frames
}

/// Triangles of widths from 1e-2 to 1e-9 before and between a few wide ones.
fn slivers(random: &mut Random) -> Vec<Loops> {
    let mut triangles = tilted_triangles(random);
    for _ in 0..random.between(2, 8) {
        let (a, b) = (anywhere(random, 3.0), anywhere(random, 3.0));
        let width = 10.0_f64.powi(-random.between(2, 9));
        let corners = [a, b, a.midpoint(b) + anywhere(random, width)];
        if is_wide(corners) {
            triangles.push(vec![corners.to_vec()]);
        }
    }
    triangles
}

/// Parallelograms in a few slanting lattice planes, each the neighbour of others.
fn tilted_tiles(random: &mut Random) -> Vec<Loops> {
    let mut tiles = Vec::new();
    for _ in 0..random.between(3, 5) {
        let (corner, u, v) = (lattice(random, 2), lattice(random, 2), lattice(random, 2));
        if u.cross(v) == DVec3::ZERO {
            continue;
        }
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let a = corner + f64::from(i) * u + f64::from(j) * v;
            if !random.one_in(4) {
                tiles.push(vec![turned(random, vec![a, a + u, a + u + v, a + v])]);
            }
        }
    }
    tiles
}

/// Triangles that grow from a vertex, or a point of an edge, of one before: it is rounded to one side of that one's plane
/// or to the other.
fn touching_triangles(random: &mut Random) -> Vec<Loops> {
    let mut triangles = tilted_triangles(random);
    for _ in 0..random.between(2, 6) {
        let Some(ring) = triangles.get(random.below(triangles.len().max(1))).map(|loops| &loops[0]) else {
            break;
        };
        let (i, share) = (random.below(3), f64::from(random.between(0, 3)) / 4.0);
        let on_it = ring[i] + (ring[(i + 1) % 3] - ring[i]) * share;
        let corners = [on_it, anywhere(random, 3.0), anywhere(random, 3.0)];
        if is_wide(corners) {
            triangles.push(vec![corners.to_vec()]);
        }
    }
    triangles
}

/// Stars in slanting lattice planes, with reflex corners, straight ones, corners given twice, and holes of the same kind.
fn lattice_stars(random: &mut Random) -> Vec<Loops> {
    let mut stars = Vec::new();
    for _ in 0..random.between(2, 6) {
        let (middle, u, v) = (lattice(random, 3), lattice(random, 1), lattice(random, 1));
        if u.cross(v) == DVec3::ZERO {
            continue;
        }
        let mut loops = vec![star(random, middle, [u, v].map(|way| way / 2.0))];
        if random.one_in(2) {
            loops.push(star(random, middle, [u, v].map(|way| way / 8.0)));
        }
        let outer = turned(random, loops.remove(0));
        stars.push(std::iter::once(outer).chain(loops).collect());
    }
    stars
}

/// A ring around a point, in eight directions of a plane's lattice.
fn star(random: &mut Random, middle: DVec3, [u, v]: [DVec3; 2]) -> Vec<DVec3> {
    let ways = [u, u + v, v, v - u, -u, -u - v, -v, u - v];
    let twice = random.below(2 * ways.len());
    let mut ring = Vec::new();
    for (i, way) in ways.into_iter().enumerate() {
        let corner = middle + way * f64::from(random.between(1, 4));
        ring.extend(vec![corner; if i == twice { 2 } else { 1 }]);
    }
    ring
}

/// The ring or its reverse.
fn turned(random: &mut Random, mut ring: Vec<DVec3>) -> Vec<DVec3> {
    if random.one_in(2) {
        ring.reverse();
    }
    ring
}
