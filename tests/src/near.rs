//! Random views that ask for digits: dA close before a wall or beside its edges, map coordinates, extents of every size. Each is a
//! function of its seed alone, and vertices are exactly coplanar.
use crate::random::Random;
use crate::sweep::Loops;
use glam::DVec3;

/// A target with what stands before it, and the point that sees it.
#[derive(Clone, Debug)]
pub struct NearView {
    /// Family and seed.
    pub name: String,
    /// Where the differential area lies.
    pub position: DVec3,
    /// Where it looks: not a unit vector.
    pub normal: DVec3,
    /// The target, its front toward the position.
    pub target: Loops,
    /// What may hide it.
    pub occluders: Vec<Loops>,
}

/// What makes views of one family.
type Maker = fn(&mut Random) -> NearView;

const FAMILIES: [(&str, Maker); 9] = [
    ("before a wall", before_a_wall),
    ("before a wall on a map", before_a_wall_on_a_map),
    ("before a tilted triangle", before_a_triangle),
    ("before a tilted parallelogram", before_a_parallelogram),
    ("before a concave wall", before_a_concave_wall),
    ("beside an edge", beside_an_edge),
    ("far away on a map", far_on_a_map),
    ("a hair before a wall", a_hair_before),
    ("behind halves", behind_halves),
];

/// The view of a seed: all families in turn, and every third one of a size of its own.
pub fn near(seed: u64) -> NearView {
    let count = u64::try_from(FAMILIES.len()).expect("a few");
    let (family, make) = FAMILIES[usize::try_from(seed % count).expect("below a few")];
    let mut random = Random::new(seed);
    let mut view = make(&mut random);
    if seed / count % 3 == 2 {
        scale(&mut view, &mut random);
    }
    turn_to_face(&mut view);
    view.name = format!("{family}, seed {seed}");
    view
}

/// All coordinates times one power of two, so that the largest stay below 2^200 and the extents above 2^-200.
fn scale(view: &mut NearView, random: &mut Random) {
    let exponent = if random.one_in(2) { random.between(-160, -20) } else { random.between(20, 170) };
    let factor = f64::from(exponent).exp2();
    view.position *= factor;
    let polygons = std::iter::once(&mut view.target).chain(&mut view.occluders);
    polygons.flatten().flatten().for_each(|p| *p *= factor);
}

/// Turns the target's loops around where its front is on the other side.
fn turn_to_face(view: &mut NearView) {
    if crate::precise::turns_its_back(view.position, &view.target) {
        view.target.iter_mut().for_each(|points| points.reverse());
    }
}

fn vector(random: &mut Random, size: f64) -> DVec3 {
    DVec3::from([0; 3].map(|_| random.range(-size, size)))
}

/// A number whose logarithm is uniform.
fn log(random: &mut Random, low: i32, high: i32) -> f64 {
    10f64.powf(random.range(f64::from(low), f64::from(high)))
}

/// Two axes along a plane and one across, in a random order.
fn axes(random: &mut Random) -> [DVec3; 3] {
    let first = random.below(3);
    [0, 1, 2].map(|i| DVec3::AXES[(first + i) % 3])
}

/// A normal that sees the side `across` points away from: toward it, along it, away from it, or by hand.
fn normal(random: &mut Random, [u, v, across]: [DVec3; 3]) -> DVec3 {
    match random.below(5) {
        0 => across,
        1 => u + across * log(random, -12, -1),
        2 => -0.8 * u - 0.2 * v - 0.79 * across,
        3 => u,
        _ => vector(random, 1.0),
    }
}

/// Triangles before a plane, `height` from dA, which is at `position`: from as small as the gap to as large as the wall.
fn blockers(
    random: &mut Random,
    position: DVec3,
    [u, v, across]: [DVec3; 3],
    height: f64,
    wall: f64,
) -> Vec<Loops> {
    let count = random.below(4);
    let mut found = Vec::new();
    for _ in 0..count {
        let size = match random.below(3) {
            0 => height * log(random, -1, 2),
            1 => wall * log(random, -2, 0),
            _ => (height * wall).sqrt(),
        };
        let middle = random.range(-size, size) * u + random.range(-size, size) * v;
        let corner = |random: &mut Random| {
            let share = if random.one_in(6) { random.range(-2.0, 3.0) } else { random.range(0.05, 0.95) };
            position
                + middle
                + random.range(-size, size) * u
                + random.range(-size, size) * v
                + share * height * across
        };
        found.push(vec![vec![corner(random), corner(random), corner(random)]]);
    }
    found
}

/// A rectangle through `corner` along two axes; coplanar as the third coordinate is one double.
fn rectangle(corner: DVec3, u: DVec3, v: DVec3) -> Loops {
    vec![vec![corner, corner + u, corner + u + v, corner + v]]
}

fn wall_at(random: &mut Random, base: DVec3, height: f64) -> NearView {
    let axes @ [u, v, across] = axes(random);
    let side = if random.one_in(2) { 10.0 } else { log(random, -1, 2) };
    let position = base + vector(random, side);
    let (left, low) = (random.range(0.01, 0.99) * side, random.range(0.01, 0.99) * side);
    let across = if random.one_in(2) { across } else { -across };
    let corner = position - left * u - low * v + height * across;
    let axes = [axes[0], axes[1], across];
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: rectangle(corner, side * u, side * v),
        occluders: blockers(random, position, axes, height, side),
    }
}

/// The wall's coordinate is 0, so that the gap keeps its digits.
fn before_a_wall(random: &mut Random) -> NearView {
    let height = log(random, -12, -1);
    let mut view = wall_at(random, DVec3::ZERO, height);
    let corners = view.target[0].clone();
    let is_level = |axis: &usize| corners.iter().all(|p| p[*axis] == corners[0][*axis]);
    let axis = (0..3).find(is_level).expect("a wall along two axes");
    let off = DVec3::AXES[axis] * corners[0][axis];
    let polygons = std::iter::once(&mut view.target).chain(&mut view.occluders);
    polygons.flatten().flatten().for_each(|p| *p -= off);
    // The difference of two roundings may have come out 0.
    let gap = (view.position - off)[axis];
    view.position[axis] = if gap == 0.0 { height } else { gap };
    view
}

fn before_a_wall_on_a_map(random: &mut Random) -> NearView {
    let base = if random.one_in(2) { DVec3::new(5e5, 5e5, 0.0) } else { DVec3::new(5e5, 5e6, 200.0) };
    let height = log(random, -3, 0);
    wall_at(random, base, height)
}

fn triangle(random: &mut Random, size: f64) -> [DVec3; 3] {
    loop {
        let corners = [0; 3].map(|_| vector(random, size));
        let [a, b, c] = corners;
        if (b - a).cross(c - a).length() > 0.1 * size * size {
            return corners;
        }
    }
}

fn frame(along: DVec3, across: DVec3) -> [DVec3; 3] {
    let (across, u) = (across.normalize(), along.normalize());
    [u, across.cross(u), across]
}

fn before_a_triangle(random: &mut Random) -> NearView {
    let side = log(random, -1, 2);
    let base = if random.one_in(3) { DVec3::new(5e5, 5e6, 200.0) } else { DVec3::ZERO };
    let [a, b, c] = triangle(random, side).map(|p| p + base);
    let height = log(random, if base == DVec3::ZERO { -12 } else { -3 }, -1);
    let axes = frame(b - a, (b - a).cross(c - a));
    let (s, t) = (random.range(0.05, 0.45), random.range(0.05, 0.45));
    let position = a + s * (b - a) + t * (c - a) - height * axes[2];
    let occluders = blockers(random, position, axes, height, side);
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: vec![vec![a, b, c]],
        occluders,
    }
}

/// Rounded to a multiple of 2^-20, so that sums of a few are exact.
fn coarse(p: DVec3) -> DVec3 {
    (p * f64::from(1 << 20)).round() / f64::from(1 << 20)
}

fn before_a_parallelogram(random: &mut Random) -> NearView {
    let base = if random.one_in(2) { DVec3::new(5e5, 5e6, 200.0) } else { DVec3::ZERO };
    let [a, b, c] = triangle(random, 10.0).map(|p| coarse(p + base));
    let (u, v) = (b - a, c - a);
    let axes = frame(u, u.cross(v));
    let height = log(random, if base == DVec3::ZERO { -10 } else { -3 }, 1);
    let position = a + random.range(0.01, 0.99) * u + random.range(0.01, 0.99) * v - height * axes[2];
    let occluders = blockers(random, position, axes, height, 10.0);
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: rectangle(a, u, v),
        occluders,
    }
}

fn before_a_concave_wall(random: &mut Random) -> NearView {
    let height = log(random, -12, -1);
    let axes = axes(random);
    let [u, v, across] = axes;
    let point = |x: f64, y: f64| x * u + y * v;
    let outer = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [2.0, -1.0], [0.0, -1.0]];
    let mut target: Loops = vec![outer.map(|[x, y]| point(x, y)).to_vec()];
    if random.one_in(2) {
        target.push([[1.25, -0.75], [1.75, -0.75], [1.5, 0.5]].map(|[x, y]| point(x, y)).to_vec());
    }
    let near_an_edge = random.one_in(2);
    let [x, y] = if near_an_edge {
        [1.0 + log(random, -12, -1), log(random, -12, -1)]
    } else {
        [random.range(-0.2, 2.2), random.range(-1.2, 1.2)]
    };
    let position = point(x, y) - height * across;
    let occluders = blockers(random, position, axes, height, 2.0);
    NearView { name: String::new(), position, normal: normal(random, axes), target, occluders }
}

fn beside_an_edge(random: &mut Random) -> NearView {
    let axes = axes(random);
    let [u, v, across] = axes;
    let (height, beside) = (log(random, -12, 0), log(random, -12, 0));
    let beside = if random.one_in(2) { beside } else { -beside };
    let position = random.range(0.0, 10.0) * u + beside * v - height * across;
    let occluders = blockers(random, position, axes, height.max(beside.abs()), 10.0);
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: rectangle(DVec3::ZERO, 10.0 * u, 6.0 * v),
        occluders,
    }
}

fn far_on_a_map(random: &mut Random) -> NearView {
    let base = if random.one_in(2) { DVec3::new(5e5, 5e5, 30.0) } else { DVec3::new(5e5, 5e6, 200.0) };
    let position = base + vector(random, 1000.0);
    let distance = log(random, -3, 3);
    let size = distance * log(random, -2, 2);
    let middle = position + distance * vector(random, 1.0).normalize();
    let target = if random.one_in(2) {
        vec![triangle(random, size).map(|p| middle + p).to_vec()]
    } else {
        let [u, v, _] = axes(random);
        rectangle(middle - size * (random.unit() * u + random.unit() * v), size * u, size * v)
    };
    let between = |random: &mut Random| position + random.range(0.1, 0.9) * (middle - position);
    let occluders = (0..random.below(4)).map(|_| {
        let (at, size) = (between(random), distance * log(random, -2, 1));
        vec![triangle(random, size).map(|p| at + p).to_vec()]
    });
    let occluders = occluders.collect();
    NearView { name: String::new(), position, normal: vector(random, 1.0), target, occluders }
}

/// Gaps and blockers of all decades, down to 1e-14.
fn a_hair_before(random: &mut Random) -> NearView {
    let axes = axes(random);
    let [u, v, across] = axes;
    let (height, side) = (log(random, -14, -3), log(random, 0, 2));
    let position = -height * across;
    let mut occluders = Vec::new();
    for _ in 0..random.below(5) {
        let size = log(random, -16, 3);
        let mut corner = || {
            position
                + random.range(-size, size) * u
                + random.range(-size, size) * v
                + random.range(0.02, 0.98) * height * across
        };
        occluders.push(vec![vec![corner(), corner(), corner()]]);
    }
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: rectangle(-side * (u + v), 2.0 * side * u, 2.0 * side * v),
        occluders,
    }
}

/// A wall behind boards that share edges: halves, quarters and fans that leave nothing or a gap.
fn behind_halves(random: &mut Random) -> NearView {
    let axes @ [u, v, across] = axes(random);
    let height = log(random, -12, 0);
    let base = if random.one_in(3) { 5e5 * u + 5e6 * v } else { DVec3::ZERO };
    let position = base + random.range(-1.0, 1.0) * u + random.range(-1.0, 1.0) * v - height * across;
    let size = log(random, -12, 1).max(height);
    let at = |x: f64, y: f64, share: f64| position + size * x * u + size * y * v + share * height * across;
    let middle = at(random.range(-0.5, 0.5), random.range(-0.5, 0.5), random.range(0.1, 0.9));
    let rim =
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| at(x, y, random.range(0.1, 0.9)));
    let mut fan: Vec<Loops> = (0..4).map(|i| vec![vec![middle, rim[i], rim[(i + 1) % 4]]]).collect();
    fan.truncate(random.below(5));
    NearView {
        name: String::new(),
        position,
        normal: normal(random, axes),
        target: rectangle(base - 5.0 * (u + v), 10.0 * u, 10.0 * v),
        occluders: fan,
    }
}
