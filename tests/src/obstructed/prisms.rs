//! Rectangles and prisms along y, whose outlines in the plane across are any convex polygons: boxes, plates that slope.
//!
//! Given the points of source and target in the plane across, a ray is inside of a prism for a known stretch of its way. It
//! gets past when it is above the prism, or below, at both ends of this stretch: gates along y as of parallel plates, with a
//! closed form of the integral over both y. What is left is an integral over two variables, taken by Gauss's and Kronrod's
//! rules, halved where they differ, between the places where a ray touches two corners.
use super::profile::{Bend, Gate, bends};
use glam::DVec2;
use std::f64::consts::PI;

/// A convex outline in the plane across, 2 points for a plate, from where to where in y.
#[derive(Clone, Debug, PartialEq)]
pub struct Prism {
    /// Counter-clockwise or clockwise.
    pub outline: Vec<DVec2>,
    /// Its ends.
    pub y: [f64; 2],
}

/// Two plates that face each other everywhere, and prisms between them that touch neither and one another not.
#[derive(Clone, Debug, PartialEq)]
pub struct Prisms {
    /// Of two points; its front is to the left on the way from the first to the second.
    pub source: Prism,
    /// The same.
    pub target: Prism,
    /// What hides.
    pub blockers: Vec<Prism>,
}

/// What two rules on a stretch may differ by, of the whole.
const AGREED: f64 = 1e-13;
const DEEPEST: u32 = 40;

impl Prisms {
    /// The form factor from the source to the target, within 1e-11 or so.
    pub fn form_factor(&self) -> f64 {
        let mut work = Work::default();
        let sum = integrate(&self.starts(), 10.0 * AGREED, &mut |s| {
            let from = along(&self.source, s);
            integrate(&self.ends(from), AGREED, &mut |t| self.seen(from, along(&self.target, t), &mut work))
        });
        let [from, to] = [&self.source, &self.target].map(|p| p.outline[0].distance(p.outline[1]));
        sum * from * to / (from * (self.source.y[1] - self.source.y[0]))
    }

    /// Shares of the source's side where a ray touches two corners.
    fn starts(&self) -> Vec<f64> {
        let groups: Vec<&[DVec2]> = self.blockers.iter().map(|b| &b.outline[..]).collect();
        let all = || groups.iter().flat_map(|g| g.iter()).chain(&self.target.outline);
        let pairs = all().flat_map(|a| all().map(move |b| (*a, *b))).filter(|(a, b)| a != b);
        shares(&self.source, pairs)
    }

    /// Shares of the target's side that are seen from a point past a corner.
    fn ends(&self, from: DVec2) -> Vec<f64> {
        let corners = self.blockers.iter().flat_map(|b| b.outline.iter());
        shares(&self.target, corners.map(|corner| (from, *corner)))
    }

    /// The integral over both y, given both points across.
    fn seen(&self, from: DVec2, to: DVec2, work: &mut Work) -> f64 {
        let way = to - from;
        let distance = way.length();
        let cosines = front(&self.source).dot(way) * -front(&self.target).dot(way);
        if cosines <= 0.0 {
            return 0.0;
        }
        work.gates.clear();
        work.gates.extend([(0.0, self.source.y), (1.0, self.target.y)].map(|(share, y)| gate(share, y)));
        work.met.clear();
        work.met.extend(self.blockers.iter().filter_map(|b| Some((stretch(b, from, way)?, b.y))));
        cosines / PI * work.passing(0, distance)
    }
}

/// What one ray across needs.
#[derive(Debug, Default)]
struct Work {
    gates: Vec<Gate>,
    met: Vec<([f64; 2], [f64; 2])>,
    bends: Vec<Bend>,
}

impl Work {
    /// What passes all gates and gets past the prisms from the given one on, each above or below.
    fn passing(&mut self, next: usize, distance: f64) -> f64 {
        let Some(&(stretch, [bottom, top])) = self.met.get(next) else {
            bends(&self.gates, &mut self.bends);
            return self.bends.iter().map(|(v, c)| c * antiderivative(*v, distance)).sum();
        };
        let ways = [[top, f64::INFINITY], [f64::NEG_INFINITY, bottom]];
        let past = ways.map(|y| {
            self.gates.extend(stretch.map(|share| gate(share, y)));
            let found = self.passing(next + 1, distance);
            self.gates.truncate(self.gates.len() - 2);
            found
        });
        past.iter().sum()
    }
}

fn gate(share: f64, [low, high]: [f64; 2]) -> Gate {
    Gate { share, low, high }
}

/// Of 1 / (d² + v²)², twice by v.
fn antiderivative(v: f64, d: f64) -> f64 {
    v * (v / d).atan() / (2.0 * d * d * d)
}

fn along(plate: &Prism, share: f64) -> DVec2 {
    plate.outline[0].lerp(plate.outline[1], share)
}

fn front(plate: &Prism) -> DVec2 {
    (plate.outline[1] - plate.outline[0]).perp().normalize()
}

/// The stretch of a ray inside of an outline, in shares of its way.
fn stretch(prism: &Prism, from: DVec2, way: DVec2) -> Option<[f64; 2]> {
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    let count = prism.outline.len();
    for (i, a) in prism.outline.iter().enumerate() {
        let b = prism.outline[(i + 1) % count];
        let sides = [way.perp_dot(*a - from), way.perp_dot(b - from)];
        if (sides[0] > 0.0) != (sides[1] > 0.0) {
            let met = a.lerp(b, sides[0] / (sides[0] - sides[1]));
            let share = way.dot(met - from) / way.length_squared();
            (first, last) = (first.min(share), last.max(share));
        }
    }
    (first <= last).then_some([first, last])
}

/// Where lines through two points meet a plate's side, in shares of it, with its ends, in order.
fn shares(plate: &Prism, lines: impl Iterator<Item = (DVec2, DVec2)>) -> Vec<f64> {
    let side = plate.outline[1] - plate.outline[0];
    let met = lines.map(|(a, b)| {
        let way = b - a;
        way.perp_dot(plate.outline[0] - a) / side.perp_dot(way)
    });
    let mut found: Vec<f64> = met.filter(|share| *share > 0.0 && *share < 1.0).chain([0.0, 1.0]).collect();
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| *a - *b < 1e-14);
    found
}

/// Nodes on [0, 1), Gauss's weights (7 points) and Kronrod's (15): Piessens et al., QUADPACK 1983.
const RULE: [[f64; 3]; 8] = [
    [0.0, 0.417_959_183_673_469_4, 0.209_482_141_084_727_82],
    [0.207_784_955_007_898_47, 0.0, 0.204_432_940_075_298_89],
    [0.405_845_151_377_397_2, 0.381_830_050_505_118_9, 0.190_350_578_064_785_4],
    [0.586_087_235_467_691_1, 0.0, 0.169_004_726_639_267_9],
    [0.741_531_185_599_394_4, 0.279_705_391_489_276_67, 0.140_653_259_715_525_92],
    [0.864_864_423_359_769_1, 0.0, 0.104_790_010_322_250_18],
    [0.949_107_912_342_758_5, 0.129_484_966_168_869_7, 0.063_092_092_629_978_55],
    [0.991_455_371_120_812_6, 0.0, 0.022_935_322_010_529_225],
];

/// The integral over [0, 1] between breaks.
fn integrate(breaks: &[f64], agreed: f64, f: &mut impl FnMut(f64) -> f64) -> f64 {
    breaks.windows(2).map(|pair| adaptive(pair[0], pair[1], agreed, DEEPEST, f)).sum()
}

fn adaptive(start: f64, end: f64, agreed: f64, depth: u32, f: &mut impl FnMut(f64) -> f64) -> f64 {
    let (middle, half) = (f64::midpoint(start, end), (end - start) / 2.0);
    let (mut gauss, mut kronrod) = (0.0, 0.0);
    for [node, few, many] in RULE {
        let both = if node == 0.0 { f(middle) } else { f(middle - half * node) + f(middle + half * node) };
        (gauss, kronrod) = (gauss + few * both, kronrod + many * both);
    }
    let (gauss, kronrod) = (gauss * half, kronrod * half);
    if (gauss - kronrod).abs() <= agreed || depth == 0 {
        return kronrod;
    }
    adaptive(start, middle, agreed, depth - 1, f) + adaptive(middle, end, agreed, depth - 1, f)
}
