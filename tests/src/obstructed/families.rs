//! The eight families.
use super::{Pair, Plate, Plates, Prism, Prisms, Setting};
use crate::random::Random;
use glam::{DMat3, DQuat, DVec2, DVec3};

/// What is made between two plates.
type Maker = fn(&mut Random) -> Setting;

/// Names and makers.
const MAKERS: [(&str, Maker); 8] = [
    ("blockers", |r| plates(r, 0.1, blockers)),
    ("tiny blockers", |r| plates(r, 0.1, tiny_blockers)),
    ("slit", |r| plates(r, 0.1, slit)),
    ("grille", |r| plates(r, 0.1, grille)),
    ("pinhole", |r| plates(r, 0.1, pinhole)),
    ("two slits", |r| plates(r, 0.1, two_slits)),
    ("three baffles", |r| plates(r, 0.3, three_baffles)),
    ("boxes", boxes),
];

/// How many families there are.
pub const FAMILIES: usize = MAKERS.len();

/// The pair of a seed, all families in turn. Every second one of a family is turned and moved somewhere.
pub fn pair(seed: u64) -> Pair {
    let families = u64::try_from(FAMILIES).expect("a few");
    let (family, make) = MAKERS[usize::try_from(seed % families).expect("below a few")];
    let mut random = Random::new(seed);
    let setting = make(&mut random);
    let pose =
        if (seed / families).is_multiple_of(2) { (DMat3::IDENTITY, DVec3::ZERO) } else { pose(&mut random) };
    Pair { name: format!("{family}, seed {seed}"), family, setting, pose }
}

fn pose(random: &mut Random) -> (DMat3, DVec3) {
    let [axis, shift] = [1.0, 10.0].map(|size| DVec3::from([0; 3].map(|_| random.range(-size, size))));
    (DMat3::from_quat(DQuat::from_axis_angle(axis.normalize(), random.angle())), shift)
}

/// Half of all settings have their sides on a lattice, so that edges are seen one behind the other.
const LATTICE: f64 = 32.0;
/// Plates that reach beyond everything.
const WIDE: [f64; 2] = [-5.0, 5.0];

/// Where things go between two plates.
struct Room {
    source: Plate,
    target: Plate,
    is_on_lattice: bool,
}

fn plates(random: &mut Random, least: f64, fill: fn(&Room, &mut Random) -> Vec<Plate>) -> Setting {
    let room = Room::new(random, least);
    let blockers = fill(&room, random);
    Setting::Plates(Plates { source: room.source, target: room.target, blockers })
}

impl Room {
    fn new(random: &mut Random, least: f64) -> Room {
        let is_on_lattice = random.one_in(2);
        let snapped = |value: f64| if is_on_lattice { (value * LATTICE).round() / LATTICE } else { value };
        let height = snapped(random.range(least, 1.0) * random.range(1.0, 2.0)).max(4.0 / LATTICE);
        let mut span = |from: f64| [from, from + random.range(0.3, 2.0)].map(snapped);
        let source = Plate { x: span(0.0), y: span(0.0), height: 0.0 };
        let mut side = |size: f64| {
            let from = random.range(-1.0, size);
            [from, from + random.range(0.3, 2.0)].map(snapped)
        };
        let target = Plate { x: side(source.x[1]), y: side(source.y[1]), height };
        Room { source, target, is_on_lattice }
    }

    fn snapped(&self, value: f64) -> f64 {
        if self.is_on_lattice { (value * LATTICE).round() / LATTICE } else { value }
    }

    /// A height that is this share of the way up, or nearly.
    fn height(&self, random: &mut Random, share: f64) -> f64 {
        let height = self.target.height * (share + random.range(-0.08, 0.08));
        if self.is_on_lattice { (height * 64.0).round().max(1.0) / 64.0 } else { height }
    }

    /// From where to where all rays are, in x or in y.
    fn reach(&self, axis: usize) -> [f64; 2] {
        let [a, b] = [&self.source, &self.target].map(|plate| [plate.x, plate.y][axis]);
        [a[0].min(b[0]), a[1].max(b[1])]
    }

    /// Where a ray from somewhere to somewhere passes a height.
    fn sight(&self, random: &mut Random) -> impl Fn(f64) -> [f64; 2] + use<> {
        let mut ends = |axis: usize| {
            [&self.source, &self.target].map(|plate| {
                let [low, high] = [plate.x, plate.y][axis];
                random.range(low, high)
            })
        };
        let (x, y, total) = (ends(0), ends(1), self.target.height);
        move |height| [x, y].map(|[from, to]| from + (to - from) * (height / total))
    }

    /// A width between powers of ten, at least one step of the lattice.
    fn width(&self, random: &mut Random, from: f64, to: f64) -> f64 {
        let width = 10.0_f64.powf(random.range(from, to));
        if self.is_on_lattice { self.snapped(width).max(1.0 / LATTICE) } else { width }
    }

    /// A stretch of this width around a place, or nearly around it.
    fn stretch(&self, random: &mut Random, place: f64, width: f64) -> [f64; 2] {
        let low = self.snapped(place - width * random.range(0.2, 0.8));
        [low, low + width]
    }
}

fn blockers(room: &Room, random: &mut Random) -> Vec<Plate> {
    let count = 1 + random.below(4);
    let mut within = |[low, high]: [f64; 2]| {
        let size = random.range(0.1, 0.7) * (high - low);
        let from = random.range(low, high - size);
        [from, from + size].map(|v| room.snapped(v))
    };
    let sides: Vec<_> = (0..count).map(|_| [0, 1].map(|axis| within(room.reach(axis)))).collect();
    let sides = sides.into_iter().filter(|[x, y]| x[0] < x[1] && y[0] < y[1]);
    sides
        .map(|[x, y]| {
            let share = random.range(0.15, 0.85);
            Plate { x, y, height: room.height(random, share) }
        })
        .collect()
}

fn tiny_blockers(room: &Room, random: &mut Random) -> Vec<Plate> {
    let count = 1 + random.below(3);
    (0..count)
        .map(|_| {
            let (share, sight) = (random.range(0.15, 0.85), room.sight(random));
            let height = room.height(random, share);
            let [x, y] = sight(height).map(|place| {
                let width = room.width(random, -2.5, -1.2);
                room.stretch(random, place, width)
            });
            Plate { x, y, height }
        })
        .collect()
}

/// A wide baffle with a slit across x, or across y.
fn baffle(height: f64, [low, high]: [f64; 2], is_across: bool) -> Vec<Plate> {
    let halves = [[WIDE[0], low], [high, WIDE[1]]];
    let plate = |half| if is_across { (WIDE, half) } else { (half, WIDE) };
    halves.map(plate).map(|(x, y)| Plate { x, y, height }).to_vec()
}

/// A wide baffle with a hole, in four plates.
fn pierced(height: f64, x: [f64; 2], y: [f64; 2]) -> Vec<Plate> {
    let above_and_below = baffle(height, y, true).into_iter().map(|plate| Plate { x, ..plate });
    baffle(height, x, false).into_iter().chain(above_and_below).collect()
}

fn slit(room: &Room, random: &mut Random) -> Vec<Plate> {
    slits(room, random, &[0.5])
}

fn two_slits(room: &Room, random: &mut Random) -> Vec<Plate> {
    slits(room, random, &[0.35, 0.65])
}

/// Baffles with a slit each that leave at least a ray between them, mostly all in one direction.
fn slits(room: &Room, random: &mut Random, shares: &[f64]) -> Vec<Plate> {
    let (sight, is_across) = (room.sight(random), random.one_in(2));
    let mut plates = Vec::new();
    for share in shares {
        let is_across = is_across != random.one_in(5);
        let height = room.height(random, *share);
        let (place, width) = (sight(height)[usize::from(is_across)], room.width(random, -2.2, -0.3));
        plates.extend(baffle(height, room.stretch(random, place, width), is_across));
    }
    plates
}

/// Bars side by side.
fn grille(room: &Room, random: &mut Random) -> Vec<Plate> {
    let (count, is_across, height) = (3 + random.below(7), random.one_in(2), room.height(random, 0.5));
    let [low, high] = room.reach(usize::from(is_across));
    let pitch = (high - low) / f64::from(u32::try_from(count).expect("a few"));
    let pitch = if room.is_on_lattice { room.snapped(pitch).max(2.0 / LATTICE) } else { pitch };
    let width = if room.is_on_lattice { pitch / 2.0 } else { pitch * random.range(0.2, 0.9) };
    let start = room.snapped(low + random.range(0.0, pitch));
    let bars = (0..count).map(|i| start + pitch * f64::from(u32::try_from(i).expect("a few")));
    bars.map(|from| [from, from + width])
        .map(|bar| if is_across { (WIDE, bar) } else { (bar, WIDE) })
        .map(|(x, y)| Plate { x, y, height })
        .collect()
}

fn pinhole(room: &Room, random: &mut Random) -> Vec<Plate> {
    let (sight, height) = (room.sight(random), room.height(random, 0.5));
    let [x, y] = sight(height).map(|place| {
        let width = room.width(random, -2.2, -0.6);
        room.stretch(random, place, width)
    });
    pierced(height, x, y)
}

/// Three baffles, each with a slit or a hole, that leave at least a ray between them.
fn three_baffles(room: &Room, random: &mut Random) -> Vec<Plate> {
    let sight = room.sight(random);
    let mut plates = Vec::new();
    for share in [0.22, 0.5, 0.78] {
        let height = room.height(random, share);
        let [x, y] = sight(height).map(|place| {
            let width = room.width(random, -1.6, 0.0);
            room.stretch(random, place, width)
        });
        plates.extend(match random.below(3) {
            0 => pierced(height, x, y),
            1 => baffle(height, x, false),
            _ => baffle(height, y, true),
        });
    }
    plates
}

/// Boxes and sloping plates below a plate that may slope.
fn boxes(random: &mut Random) -> Setting {
    let room = Room::new(random, 0.4);
    let (plain, slope) = (Prisms::from(&Plates::from(&room)), random.range(-0.3, 0.3));
    let mut target = plain.target;
    if random.one_in(2) {
        target.outline[0].y *= 1.0 + slope;
    }
    let count = 1 + random.below(2);
    let blockers = (0..count).map(|_| solid(&room, random)).collect();
    Setting::Prisms(Prisms { source: plain.source, target, blockers })
}

impl From<&Room> for Plates {
    fn from(room: &Room) -> Plates {
        Plates { source: room.source, target: room.target, blockers: Vec::new() }
    }
}

/// A box, upright or turned, or a plate that slopes: between a twentieth and 0.65 of the height.
fn solid(room: &Room, random: &mut Random) -> Prism {
    let (middle, half) = (0.35 * room.target.height, 0.3 * room.target.height);
    let [x, y] = room.sight(random)(middle);
    let centre = DVec2::new(x, middle);
    let [width, rise] = [0; 2].map(|_| random.range(0.1, 0.7) * half);
    let corners = match random.below(3) {
        0 => vec![DVec2::new(-width, rise), DVec2::new(width, -rise)],
        _ => [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .map(|(x, z)| DVec2::new(x * width, z * rise))
            .to_vec(),
    };
    let turn = if random.one_in(2) { DVec2::from_angle(random.angle()) } else { DVec2::X };
    let [from, to] = room.reach(1);
    let size = random.range(0.1, 0.7) * (to - from);
    let near = room.snapped(y - size * random.range(0.2, 0.8));
    Prism { outline: corners.into_iter().map(|c| centre + turn.rotate(c)).collect(), y: [near, near + size] }
}
