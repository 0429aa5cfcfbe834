//! From area to area, nothing in between.
use crate::contours::{Loops, exchange, strings, unhidden};
use crate::key::{Key, down, ring, turned, up, wall};
use std::f64::consts::{FRAC_PI_3, PI, SQRT_2};

const CLOSED: &str = "contours, closed: sides parallel or perpendicular";
const CONTOURS: &str = "contours, one of two integrals by tanh-sinh";
const NARAYANASWAMY: &str = "Narayanaswamy 2015, as a public test suite quotes it";
const EES: &str = "EES, help of its view factor library";
const UNIT: [f64; 2] = [0.0, 1.0];

pub(crate) fn keys() -> Vec<Key> {
    [parallel(), perpendicular(), inclined(), polygons(), strips(), enclosures()]
        .into_iter()
        .flatten()
        .collect()
}

fn unhidden_key(name: impl Into<String>, derivation: &'static str, source: Loops, target: Loops) -> Key {
    let exact = unhidden(&source, &target);
    Key::area(name, derivation, vec![source, target], exact)
}

/// Howell's C-11 and C-13.
fn parallel() -> Vec<Key> {
    let key = |name: &str, x, y, z| unhidden_key(name, CLOSED, up(UNIT, UNIT, 0.0), down(x, y, z));
    let squares = |side: f64| {
        let side = [0.0, side];
        let name = format!("parallel squares of side {} at 1", side[1]);
        unhidden_key(name, CLOSED, up(side, side, 0.0), down(side, side, 1.0))
    };
    let mut keys = vec![
        key("parallel unit squares at 1", UNIT, UNIT, 1.0).published("0.199825", NARAYANASWAMY),
        key("parallel unit squares at 10", UNIT, UNIT, 10.0).published("0.00316206", NARAYANASWAMY),
        key("parallel unit squares at 0.5", UNIT, UNIT, 0.5).published("0.4153", EES),
        key("parallel unit square and [2, 3] × [1, 3] at 1", [2.0, 3.0], [1.0, 3.0], 1.0),
        key(
            "parallel unit square and a square inside of its outline, 0.5 wide, at 0.25",
            [0.25, 0.75],
            [0.25, 0.75],
            0.25,
        ),
        unhidden_key(
            "parallel 2 × 3 rectangles at 1",
            CLOSED,
            up([0.0, 2.0], [0.0, 3.0], 0.0),
            down([0.0, 2.0], [0.0, 3.0], 1.0),
        ),
    ];
    keys.extend([0.2, 0.4, 0.6, 2.0, 4.0, 10.0].map(squares));
    keys
}

/// Howell's C-14 and what follows from it.
fn perpendicular() -> Vec<Key> {
    // As wide as 1 along y, the source from x = offset back, the wall from z = rise up.
    let key = |name: String, [depth, offset]: [f64; 2], [height, rise]: [f64; 2]| {
        let source = up([-offset - depth, -offset], UNIT, 0.0);
        unhidden_key(name, CLOSED, source, wall(0.0, UNIT, [rise, rise + height]))
    };
    let mut keys = vec![
        key("perpendicular unit squares with a common side".into(), [1.0, 0.0], [1.0, 0.0])
            .published("0.200044", NARAYANASWAMY),
        unhidden_key(
            "perpendicular unit squares with a common corner",
            CLOSED,
            up([-1.0, 0.0], UNIT, 0.0),
            wall(0.0, [1.0, 2.0], UNIT),
        ),
        unhidden_key(
            "perpendicular squares apart along and across",
            CLOSED,
            up([-1.5, -0.5], UNIT, 0.0),
            wall(0.0, [1.5, 2.5], [0.25, 1.25]),
        ),
    ];
    let sharing = [0.1, 0.2, 0.4, 0.6, 2.0, 4.0, 10.0];
    keys.extend(sharing.map(|size| {
        key(format!("perpendicular 1 × {size} rectangles with a common side of 1"), [size, 0.0], [size, 0.0])
    }));
    let apart =
        [[0.1, 0.1], [0.5, 0.1], [0.1, 1.0], [1.0, 1.0], [2.0, 2.0], [4.0, 4.0], [10.0, 1.0], [10.0, 10.0]];
    keys.extend(apart.map(|[depth, height]| {
        let name =
            format!("perpendicular rectangles, 1 wide, {depth} and {height} long, 0.1 from their line");
        key(name, [depth, 0.1], [height, 0.1])
    }));
    keys
}

/// Howell's C-16: a rectangle that leans at an angle over another one.
fn inclined() -> Vec<Key> {
    let leaning = |angle: f64, [from, to]: [f64; 2]| {
        let at = |along: f64, y: f64| [along * angle.cos(), y, along * angle.sin()];
        turned(ring(&[at(from, 0.0), at(to, 0.0), at(to, 1.0), at(from, 1.0)]))
    };
    let key = |name: &str, degrees: f64, along| {
        unhidden_key(name, CONTOURS, up(UNIT, UNIT, 0.0), leaning(degrees * PI / 180.0, along))
    };
    vec![
        key("unit squares at 30° with a common side", 30.0, UNIT),
        key("unit squares at 60° with a common side", 60.0, UNIT),
        key("unit squares at 135° with a common side", 135.0, UNIT),
        key("unit squares at 45°, one 1 from the common line", 45.0, [1.0, 2.0]).published("0.0728", EES),
    ]
}

/// Narayanaswamy's pairs of polygons, and others.
fn polygons() -> Vec<Key> {
    let rectangle = || up(UNIT, UNIT, 0.0);
    let leaning = || ring(&[[2.0, 0.5, 0.0], [3.0, 0.0, 0.5], [3.0, 2.0, 0.5], [2.0, 1.5, 0.0]]);
    let cut = ring(&[[0.0, 0.5, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let trapezoid = ring(&[[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let half = ring(&[[0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let far = ring(&[[2.0, 2.0, 2.0], [4.0, 4.0, 4.0], [2.0, 3.0, 3.0]]);
    let frame = vec![down([-1.0, 2.0], [-1.0, 2.0], 1.0)[0].clone(), up(UNIT, UNIT, 1.0)[0].clone()];
    let bend =
        [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
    vec![
        unhidden_key(
            "half of a square to the other half at 1",
            CONTOURS,
            half,
            turned(ring(&[[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]])),
        )
        .published("0.099912", NARAYANASWAMY),
        unhidden_key("a quadrilateral to one that leans (5a)", CONTOURS, cut, leaning())
            .published("0.00444228", NARAYANASWAMY),
        unhidden_key("a trapezoid to one that leans (5b)", CONTOURS, trapezoid, leaning())
            .published("0.00363699", NARAYANASWAMY),
        unhidden_key(
            "a triangle to one above it, aslant",
            CONTOURS,
            ring(&[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]),
            turned(far),
        )
        .published("0.00106866", NARAYANASWAMY),
        unhidden_key("a unit square to a square frame, 3 and 1 wide, at 1", CLOSED, rectangle(), frame),
        unhidden_key(
            "an L of three unit squares to a unit square at 1",
            CLOSED,
            ring(&bend),
            down([1.0, 2.0], [1.0, 2.0], 1.0),
        ),
    ]
}

/// Strips of length 2 000, nearly infinite: within their width over their length of what crossed strings say.
fn strips() -> Vec<Key> {
    const LENGTH: [f64; 2] = [0.0, 2000.0];
    let floor = || up(UNIT, LENGTH, 0.0);
    let wedge = |angle: f64| {
        let (x, z) = (angle.cos(), angle.sin());
        turned(ring(&[[0.0; 3], [x, 0.0, z], [x, LENGTH[1], z], [0.0, LENGTH[1], 0.0]]))
    };
    let key = |name: &str, derivation, target: Loops, strings: f64| {
        let key = unhidden_key(name, derivation, floor(), target);
        assert!(
            (key.exact - strings).abs() < 1.0 / LENGTH[1],
            "{name}: {} by contours, {strings} by strings",
            key.exact
        );
        key
    };
    vec![
        key(
            "long strips, 1 wide, opposed at 1 (strings: √2 − 1)",
            CLOSED,
            down(UNIT, LENGTH, 1.0),
            strings([SQRT_2; 2], [1.0; 2], 1.0),
        ),
        key(
            "long strips, 1 wide, opposed at 1, one moved by 1 (strings: (√5 + 1)/2 − √2)",
            CLOSED,
            down([1.0, 2.0], LENGTH, 1.0),
            strings([5.0_f64.sqrt(), 1.0], [SQRT_2; 2], 1.0),
        ),
        key(
            "long strips, 1 wide, at 90° (strings: 1 − √½)",
            CLOSED,
            turned(wall(0.0, LENGTH, UNIT)),
            strings([1.0; 2], [SQRT_2, 0.0], 1.0),
        ),
        key(
            "long strips, 1 wide, at 60° (strings: ½)",
            CONTOURS,
            wedge(FRAC_PI_3),
            strings([1.0; 2], [1.0, 0.0], 1.0),
        ),
    ]
}

/// Faces of closed bodies: where symmetry says what each one sees, or each row must add to 1.
fn enclosures() -> Vec<Key> {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let face = |i: [usize; 3]| ring(&i.map(|i| corners[i]));
    let tetrahedron = Key::area(
        "faces of a regular tetrahedron",
        "three alike that add to 1",
        vec![face([0, 2, 1]), face([0, 1, 3])],
        1.0 / 3.0,
    );
    let hexagon = |z: f64| {
        let corner = |i: u32| [(f64::from(i) * FRAC_PI_3).cos(), (f64::from(i) * FRAC_PI_3).sin(), z];
        (0..6).map(corner).collect::<Vec<_>>()
    };
    let (bottom, top) = (hexagon(0.0), hexagon(1.0));
    let side = |i: usize| {
        let j = (i + 1) % 6;
        ring(&[bottom[j], bottom[i], top[i], top[j]])
    };
    let (floor, lid) = (ring(&bottom), turned(ring(&top)));
    let mut keys: Vec<Key> = [("next", 1), ("next but one", 2), ("opposite", 3)]
        .map(|(name, i)| {
            unhidden_key(
                format!("sides of a regular hexagonal prism, edges of 1: {name}"),
                CONTOURS,
                side(0),
                side(i),
            )
        })
        .into();
    keys.push(unhidden_key(
        "ends of a regular hexagonal prism, edges of 1",
        CONTOURS,
        floor.clone(),
        lid.clone(),
    ));
    keys.push(unhidden_key(
        "end of a regular hexagonal prism to a side, edges of 1",
        CONTOURS,
        floor.clone(),
        side(0),
    ));
    let faces: Vec<Loops> = (0..6).map(side).chain([floor, lid]).collect();
    let sums =
        [0, 6].map(|i| faces.iter().filter(|f| **f != faces[i]).map(|f| unhidden(&faces[i], f)).sum::<f64>());
    assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-13), "a hexagonal prism adds to {sums:?}");
    let (length, width, height) = ([0.0, 2.0], [0.0, 3.0], UNIT);
    let floor = up(length, width, 0.0);
    let walls = [wall(2.0, width, height), turned(wall(0.0, width, height))];
    let ends = 1.0
        - (exchange(&floor, &down(length, width, 1.0))
            + walls.iter().map(|w| exchange(&floor, w)).sum::<f64>())
            / 6.0;
    keys.push(Key::area(
        "floor of a box 2 × 3 × 1 to a wall 2 wide",
        "half of what all others leave",
        vec![floor, ring(&[[0.0, 3.0, 0.0], [2.0, 3.0, 0.0], [2.0, 3.0, 1.0], [0.0, 3.0, 1.0]])],
        ends / 2.0,
    ));
    keys.push(tetrahedron);
    keys
}
