//! From a differential area.
use crate::contours::{below_regular, by_corners, parallel_corner, standing_corner};
use crate::key::{Key, down, ring, turned, up, wall};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

const UP: [[f64; 3]; 2] = [[0.0; 3], [0.0, 0.0, 1.0]];
const LAMBERT: &str = "Lambert's sum over the sides";
const ALGEBRA: &str = "corner forms added";

pub(crate) fn keys() -> Vec<Key> {
    [parallel(), standing(), regular(), other(), hidden(), lighting()].into_iter().flatten().collect()
}

/// Howell's B-4 and what is made of it.
fn parallel() -> Vec<Key> {
    let offset = |x, y, z: f64| by_corners(x, y, |a, b| parallel_corner(a, b, z));
    let key =
        |name, derivation, x, y, z| Key::point(name, derivation, UP, vec![down(x, y, z)], offset(x, y, z));
    vec![
        key("dA under a corner of a parallel unit square at 1", LAMBERT, [0.0, 1.0], [0.0, 1.0], 1.0),
        key("dA under a corner of a parallel 2 × 3 at 0.5", LAMBERT, [0.0, 2.0], [0.0, 3.0], 0.5),
        key("dA under the middle of a parallel 2 × 2 at 2", ALGEBRA, [-1.0, 1.0], [-1.0, 1.0], 2.0),
        key("dA aside of a parallel 1 × 2 at 1", ALGEBRA, [-3.0, -2.0], [1.0, 3.0], 1.0),
        key("dA under a parallel strip 1 × 2000 at 1", ALGEBRA, [0.0, 1.0], [-1e3, 1e3], 1.0),
    ]
}

/// Howell's B-3 and what is made of it.
fn standing() -> Vec<Key> {
    let offset = |x: f64, y, z| by_corners(z, y, |a, b| standing_corner(a, b, x));
    let key = |name, derivation, x, y, z, exact| {
        Key::point(name, derivation, UP, vec![wall(x, y, z)], exact * offset(x, y, z))
    };
    vec![
        key("dA before the foot of a unit wall at 1", LAMBERT, 1.0, [0.0, 1.0], [0.0, 1.0], 1.0),
        key(
            "dA before the foot of a wall 2 wide, 1 high at 0.25",
            LAMBERT,
            0.25,
            [0.0, 2.0],
            [0.0, 1.0],
            1.0,
        ),
        key("dA before a window [-1, 2] × [0.5, 1.5] at 1", ALGEBRA, 1.0, [-1.0, 2.0], [0.5, 1.5], 1.0),
        Key::point(
            "dA before a wall [-1, 1] × [-1, 1] at 1, half of it below the horizon",
            "two corner forms of the upper half",
            UP,
            vec![wall(1.0, [-1.0, 1.0], [-1.0, 1.0])],
            2.0 * standing_corner(1.0, 1.0, 1.0),
        ),
    ]
}

fn regular() -> Vec<Key> {
    [3.0, 5.0, 6.0, 8.0]
        .into_iter()
        .map(|n| {
            let radius = 1.0 / (PI / n).cos();
            let corners = (0..8).map(f64::from).take_while(|i| *i < n).map(|i| i / n * 2.0 * PI);
            let corners: Vec<[f64; 3]> = corners.map(|t| [radius * t.cos(), radius * t.sin(), 0.5]).collect();
            let name = format!("dA under the middle of a regular {n}-gon of inradius 1 at 0.5");
            Key::point(name, LAMBERT, UP, vec![turned(ring(&corners))], below_regular(n, 0.5))
        })
        .collect()
}

fn other() -> Vec<Key> {
    let (wide, tilted) = ([1.0, 2.0], [FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2]);
    let lying = by_corners(wide, [-1.0, 1.0], |a, b| parallel_corner(a, b, 1.0));
    // Seen by a dA that looks along x the ceiling stands, its height along x.
    let across = by_corners(wide, [-1.0, 1.0], |a, b| standing_corner(a, b, 1.0));
    let frame =
        vec![down([-2.0, 2.0], [-2.0, 2.0], 1.0)[0].clone(), up([-1.0, 1.0], [-1.0, 1.0], 1.0)[0].clone()];
    let corner = |x, y| by_corners(x, y, |a, b| parallel_corner(a, b, 1.0));
    let bend = [
        [0.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [2.0, 1.0, 1.0],
        [1.0, 1.0, 1.0],
        [1.0, 2.0, 1.0],
        [0.0, 2.0, 1.0],
    ];
    vec![
        Key::point(
            "dA under the right angle of a parallel triangle of legs 1 at 1",
            "Lambert's sum has one term: 1/(6√3)",
            UP,
            vec![turned(ring(&[[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]))],
            1.0 / (6.0 * 3.0_f64.sqrt()),
        ),
        Key::point(
            "dA at 45° to a rectangle 1 × 2 at 1",
            "linear in the normal: both corner forms by 1/√2",
            [[0.0; 3], tilted],
            vec![down(wide, [-1.0, 1.0], 1.0)],
            FRAC_1_SQRT_2 * (lying + across),
        ),
        Key::point(
            "dA under a square frame, 4 and 2 wide, at 1",
            "a square less another",
            UP,
            vec![frame],
            corner([-2.0, 2.0], [-2.0, 2.0]) - corner([-1.0, 1.0], [-1.0, 1.0]),
        ),
        Key::point(
            "dA under the corner of an L of three unit squares at 1",
            ALGEBRA,
            UP,
            vec![turned(ring(&bend))],
            corner([0.0, 2.0], [0.0, 1.0]) + corner([0.0, 1.0], [1.0, 2.0]),
        ),
    ]
}

fn hidden() -> Vec<Key> {
    let corner = |x, y| by_corners(x, y, |a, b| parallel_corner(a, b, 1.0));
    let ceiling = || down([-1.0, 1.0], [-1.0, 1.0], 1.0);
    let wide = [-4.0, 4.0];
    vec![
        Key::point(
            "dA under a 2 × 2 at 1 past a 0.5 × 0.5 at 0.5",
            "the ceiling less the shadow",
            UP,
            vec![ceiling(), up([-0.25, 0.25], [-0.25, 0.25], 0.5)],
            corner([-1.0, 1.0], [-1.0, 1.0]) - corner([-0.5, 0.5], [-0.5, 0.5]),
        ),
        Key::point(
            "dA under a 2 × 2 at 1 past a slit of 0.125 at 0.5",
            "what the slit leaves",
            UP,
            vec![ceiling(), up([-4.0, 0.125], wide, 0.5), up([0.25, 4.0], wide, 0.5)],
            corner([0.25, 0.5], [-1.0, 1.0]),
        ),
        Key::point(
            "dA under a 2 × 2 at 1 past crossed slits of 0.125 at 0.25 and 0.5",
            "what both slits leave",
            UP,
            vec![
                ceiling(),
                up([-4.0, 0.125], wide, 0.5),
                up([0.25, 4.0], wide, 0.5),
                up(wide, [-4.0, -0.125], 0.25),
                up(wide, [0.0, 4.0], 0.25),
            ],
            corner([0.25, 0.5], [-0.5, 0.0]),
        ),
    ]
}

const RECOMPUTED: &str = "recomputed apart";
const TABLE_19: &str = "recomputed apart; the standard's Table 19 is wrong, as errata say";

/// CIE 171:2006: in a room of 4 × 4 × 3 at x = 2, on the wall y = 0 and on floor or ceiling.
fn lighting() -> Vec<Key> {
    let room = [0.0, 4.0];
    let on_wall = |z: f64| [[2.0, 0.0, z], [0.0, 1.0, 0.0]];
    let on_floor = |y: f64| [[2.0, y, 0.0], [0.0, 0.0, 1.0]];
    let on_ceiling = |y: f64| [[2.0, y, 3.0], [0.0, 0.0, -1.0]];
    let mut keys = Vec::new();
    let lamp = [1.5, 2.5];
    let lux = 1000.0 * PI;
    let walls = [2.75, 2.25, 1.75, 1.25, 0.75, 0.25];
    for (z, text) in walls.into_iter().zip(["32.6769", "75.1939", "81.3232", "69.0606", "53.4035", "40.0019"])
    {
        let exact = by_corners([1.5, 2.5], [-0.5, 0.5], |a, b| standing_corner(a, b, 3.0 - z));
        let key = Key::point(
            format!("CIE 171 case 5.3, wall, z = {z}"),
            ALGEBRA,
            on_wall(z),
            vec![down(lamp, lamp, 3.0)],
            exact,
        );
        keys.push(key.unit(lux, "lx").published(text, RECOMPUTED));
    }
    let floor = [0.25, 0.75, 1.25, 1.75];
    for (y, text) in floor.into_iter().zip(["61.4241", "79.2552", "95.6673", "105.7782"]) {
        let exact = by_corners([-0.5, 0.5], [1.5 - y, 2.5 - y], |a, b| parallel_corner(a, b, 3.0));
        let key = Key::point(
            format!("CIE 171 case 5.3, floor, y = {y}"),
            ALGEBRA,
            on_floor(y),
            vec![down(lamp, lamp, 3.0)],
            exact,
        );
        keys.push(key.unit(lux, "lx").published(text, RECOMPUTED));
    }
    let heights = [0.75, 1.25, 1.75, 2.25, 2.75];
    for (z, text) in heights.into_iter().zip(["35.9005", "27.9916", "21.6385", "16.7163", "12.9674"]) {
        let exact = 2.0 * standing_corner(4.0, 2.0, z);
        let key = Key::point(
            format!("CIE 171 case 5.6, wall, z = {z}"),
            ALGEBRA,
            on_wall(z),
            vec![up(room, room, 0.0)],
            exact,
        );
        keys.push(key.unit(100.0, "%").published(text, RECOMPUTED));
    }
    for (y, text) in floor.into_iter().zip(["26.7952", "30.9387", "33.9757", "35.5666"]) {
        let exact = by_corners([-2.0, 2.0], [-y, 4.0 - y], |a, b| parallel_corner(a, b, 3.0));
        let key = Key::point(
            format!("CIE 171 case 5.6, ceiling, y = {y}"),
            ALGEBRA,
            on_ceiling(y),
            vec![up(room, room, 0.0)],
            exact,
        );
        keys.push(key.unit(100.0, "%").published(text, RECOMPUTED));
    }
    keys.extend(obstructed_room(on_wall, on_floor));
    keys
}

/// Case 5.7: the wall y = 4 lights the room past a black box that spans it, 1 high, 0.2 thick.
fn obstructed_room(
    on_wall: impl Fn(f64) -> [[f64; 3]; 2],
    on_floor: impl Fn(f64) -> [[f64; 3]; 2],
) -> Vec<Key> {
    let (room, thick, high) = ([0.0, 4.0], [2.5, 2.7], [0.0, 1.0]);
    let lit = || ring(&[[0.0, 4.0, 0.0], [4.0, 4.0, 0.0], [4.0, 4.0, 3.0], [0.0, 4.0, 3.0]]);
    let side = |y: f64| ring(&[[0.0, y, 0.0], [4.0, y, 0.0], [4.0, y, 1.0], [0.0, y, 1.0]]);
    let body = || {
        vec![
            up(room, thick, 1.0),
            side(thick[0]),
            side(thick[1]),
            wall(0.0, thick, high),
            wall(4.0, thick, high),
        ]
    };
    let polygons = || std::iter::once(lit()).chain(body()).collect::<Vec<_>>();
    // The lowest height of the lit wall that is seen past the nearer or the farther upper edge.
    let lowest = |[from, z]: [f64; 2]| {
        let past = |y: f64| z + (1.0 - z) * (4.0 - from) / (y - from);
        if z < 1.0 { past(thick[0]) } else { past(thick[1]) }.clamp(0.0, 3.0)
    };
    let mut keys = Vec::new();
    let exact = [
        "16.070642244599",
        "16.329676572832",
        "15.398809916935",
        "13.322017848868",
        "10.316924360396",
        "7.078968990492",
    ];
    for (z, text) in [2.75, 2.25, 1.75, 1.25, 0.75, 0.25].into_iter().zip(exact) {
        let seen =
            by_corners([-2.0, 2.0], [lowest([0.0, z]) - z, 3.0 - z], |a, b| parallel_corner(a, b, 4.0));
        keys.push((format!("CIE 171 case 5.7, wall, z = {z}"), on_wall(z), text, seen));
    }
    for (y, text) in
        [0.25, 0.75, 1.25, 1.75].into_iter().zip(["3.382335192983", "3.628985635526", "3.012951244961", "0"])
    {
        let low = lowest([y, 0.0]);
        let seen = by_corners([low, 3.0], [-2.0, 2.0], |a, b| standing_corner(a, b, 4.0 - y));
        keys.push((
            format!("CIE 171 case 5.7, floor, y = {y}"),
            on_floor(y),
            text,
            if low < 3.0 { seen } else { 0.0 },
        ));
    }
    keys.push(("CIE 171 case 5.7, floor, y = 2.25".to_owned(), on_floor(2.25), "0", 0.0));
    let key = |(name, from, text, seen)| {
        Key::point(name, "what is seen over the box, by corner forms", from, polygons(), seen)
            .unit(100.0, "%")
            .published(text, TABLE_19)
    };
    keys.into_iter().map(key).collect()
}
