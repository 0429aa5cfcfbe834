//! The visible boundary: every edge cut at every other one, and each piece asked on both sides.
use super::fixed::Fixed;
use super::space::{Vector, above, cross, dot, plus, primitive, sign, times};
use num_bigint::BigInt;
use num_traits::Signed;

/// An edge of the target or of a shadow, as directions before the target's plane.
struct Edge {
    /// 0 for the target.
    polygon: usize,
    ends: [Vector; 2],
    /// The first end cross the second.
    line: Vector,
}

impl Edge {
    /// Whether a direction on the edge's line is on the edge.
    fn holds(&self, at: &Vector) -> bool {
        let [a, b] = &self.ends;
        sign(&dot(&cross(a, at), &self.line)) >= 0 && sign(&dot(&cross(at, b), &self.line)) >= 0
    }

    fn is_along(&self, other: &Edge) -> bool {
        other.ends.iter().all(|end| sign(&dot(&self.line, end)) == 0)
    }
}

/// A target, and the shadows of what hides it.
pub(super) struct Outline {
    edges: Vec<Edge>,
    count: usize,
    /// The product with it is positive before the target's plane.
    depth: Vector,
    /// Inward normals of four planes around the target, and directions outside of these planes on all sides.
    walls: Vec<Vector>,
    outside: Vec<Vector>,
}

/// An axis with the lowest and the highest coordinate on it, as numerators and denominators.
type AxisRange = (usize, (BigInt, BigInt), (BigInt, BigInt));

impl Outline {
    /// The outline of a target, and before which plane: at `depth` . p = `height`.
    pub(super) fn of(target: Vec<Vec<Vector>>, depth: &Vector, height: &BigInt) -> Outline {
        let dropped = (0..3).max_by_key(|i| depth[*i].abs()).expect("three axes");
        let mut walls = Vec::new();
        let mut ranges = Vec::new();
        for axis in [(dropped + 1) % 3, (dropped + 2) % 3] {
            // The coordinate of a direction on the plane is p[axis] height / (depth . p): low and high as fractions.
            let fraction = |p: &Vector| (&p[axis] * height, dot(depth, p));
            let less = |a: &(BigInt, BigInt), b: &(BigInt, BigInt)| (&a.0 * &b.1).cmp(&(&b.0 * &a.1));
            let all = || target.iter().flatten().map(fraction);
            let low = all().min_by(&less).expect("a vertex");
            let high = all().max_by(&less).expect("a vertex");
            let wall = |(top, bottom): &(BigInt, BigInt), is_upper: bool| {
                let mut normal = times(depth, &-top);
                normal[axis] += height * bottom;
                if is_upper { normal.map(|x| -x) } else { normal }
            };
            walls.extend([wall(&low, false), wall(&high, true)]);
            ranges.push((axis, low, high));
        }
        let mut outline =
            Outline { edges: Vec::new(), count: 0, depth: depth.clone(), outside: Vec::new(), walls };
        outline.outside = [(false, false), (false, true), (true, false), (true, true)]
            .map(|upper| outline.corner(&ranges, upper, dropped, height))
            .to_vec();
        outline.push(target);
        outline
    }

    /// A direction beyond a corner of the rectangle around the target, by three times its sides.
    fn corner(&self, ranges: &[AxisRange], upper: (bool, bool), dropped: usize, height: &BigInt) -> Vector {
        let beyond = |(_, low, high): &AxisRange, is_upper: bool| {
            let (low, high) = (&low.0 * &high.1, (&high.0 * &low.1, &low.1 * &high.1));
            let (high, bottom) = high;
            let size = &high - &low + BigInt::from(1);
            (if is_upper { high + size * 3 } else { low - size * 3 }, bottom)
        };
        let (first, second) = (beyond(&ranges[0], upper.0), beyond(&ranges[1], upper.1));
        let mut at = [(); 3].map(|()| BigInt::from(0));
        // Scaled by both denominators and by the dropped component of the depth.
        let scale = &first.1 * &second.1;
        let [p, q] = [&first.0 * &second.1, &second.0 * &first.1];
        let (u, v) = (ranges[0].0, ranges[1].0);
        at[dropped] = height * &scale - &self.depth[u] * &p - &self.depth[v] * &q;
        at[u] = p * &self.depth[dropped];
        at[v] = q * &self.depth[dropped];
        if self.depth[dropped].is_negative() { at.map(|x| -x) } else { at }
    }

    /// Adds an occluder, as directions before the target's plane.
    pub(super) fn hide(&mut self, occluder: Vec<Vec<Vector>>) {
        let within = self.walls.iter().fold(occluder, |loops, wall| above(&loops, |p| dot(wall, p)));
        self.push(within);
    }

    fn push(&mut self, loops: Vec<Vec<Vector>>) {
        let polygon = self.count;
        self.count += 1;
        for points in loops {
            let count = points.len();
            let pairs = (0..count).map(|i| [points[i].clone(), points[(i + 1) % count].clone()]);
            let edges = pairs.map(|ends| Edge { polygon, line: primitive(cross(&ends[0], &ends[1])), ends });
            self.edges.extend(edges.filter(|edge| edge.line.iter().any(|x| sign(x) != 0)));
        }
    }

    /// The sum of angles times cosines over the visible boundary.
    pub(super) fn sum(&self, normal: &Vector) -> Fixed {
        let mut sum = Fixed::zero();
        for (index, edge) in self.edges.iter().enumerate() {
            let alike: Vec<bool> = self.edges.iter().map(|other| edge.is_along(other)).collect();
            for pair in self.cuts(edge, &alike).windows(2) {
                let middle = plus(&pair[0], &pair[1]);
                let over: Vec<usize> =
                    (0..self.edges.len()).filter(|i| alike[*i] && self.edges[*i].holds(&middle)).collect();
                if over[0] != index {
                    continue;
                }
                let [here, there] = self.sides(edge, &middle, &over, &alike);
                if here != there {
                    let term = Fixed::angle(&pair[0], &pair[1]).times(&Fixed::cosine(normal, &edge.line));
                    sum = if here { sum.plus(&term) } else { sum.minus(&term) };
                }
            }
        }
        sum
    }

    /// The distinct directions at which an edge meets others, its ends included, in order.
    fn cuts(&self, edge: &Edge, alike: &[bool]) -> Vec<Vector> {
        let mut cuts = edge.ends.to_vec();
        for (other, is_alike) in self.edges.iter().zip(alike) {
            if *is_alike {
                cuts.extend(other.ends.iter().filter(|end| edge.holds(end)).cloned());
            } else {
                let at = self.before(cross(&edge.line, &other.line));
                if edge.holds(&at) && other.holds(&at) {
                    cuts.push(at);
                }
            }
        }
        let order = |a: &Vector, b: &Vector| 0.cmp(&sign(&dot(&cross(a, b), &edge.line)));
        cuts.sort_by(order);
        cuts.dedup_by(|a, b| order(a, b).is_eq());
        cuts
    }

    /// The one of two opposite directions that leads to the target's plane.
    fn before(&self, at: Vector) -> Vector {
        let at = primitive(at);
        if dot(&self.depth, &at).is_negative() { at.map(|x| -x) } else { at }
    }

    /// Whether the target is seen beside `middle` on the side to which the edge's line points, and on the other.
    fn sides(&self, edge: &Edge, middle: &Vector, over: &[usize], alike: &[bool]) -> [bool; 2] {
        let is_inward = |p: &&Vector| sign(&dot(&edge.line, p)) > 0;
        let end = self.outside.iter().find(is_inward).expect("the corners surround the target");
        let ray = cross(middle, end);
        let mut inside = vec![[false; 2]; self.count];
        for (other, _) in self.edges.iter().zip(alike).filter(|(_, is_alike)| !**is_alike) {
            let [a, b] = other.ends.each_ref().map(|p| sign(&dot(&ray, p)) > 0);
            if a != b {
                let met = self.before(cross(&ray, &other.line));
                let is_ahead = sign(&dot(&cross(middle, &met), &ray)) > 0;
                inside[other.polygon].iter_mut().for_each(|side| *side ^= is_ahead);
            }
        }
        over.iter().for_each(|i| inside[self.edges[*i].polygon][1] ^= true);
        [0, 1].map(|side| inside[0][side] && !inside[1..].iter().any(|of| of[side]))
    }
}
