//! Targets in parts: triangles and parallelograms, which divide into congruent ones.
use crate::shapes::{loops::leaf, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::fmt;

/// How a target is divided.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Division {
    /// Each triangle and parallelogram that the target consists of into n x n congruent parts; 0 is taken as 1. The n^2 parts
    /// of a target that is itself a triangle or a parallelogram are thus equal.
    Uniform(u32),
    /// Into quarters, again and again, while a part's diameter is more than `size` times its distance, at most `depth` times
    /// [Tampieri 1992].
    Adaptive {
        /// The largest diameter of a part, as a multiple of its distance from dA.
        size: f64,
        /// How often a part may be quartered.
        depth: u32,
    },
}

impl fmt::Display for Division {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Division::Uniform(n) => write!(f, "{n} x {n} parts"),
            Division::Adaptive { size, depth } => write!(f, "parts to {size}, depth {depth}"),
        }
    }
}

/// A triangle or a parallelogram, by a corner and its two sides; counter-clockwise seen from the front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    corner: DVec3,
    sides: [DVec3; 2],
    is_triangle: bool,
}

impl Tile {
    fn triangle([a, b, c]: [DVec3; 3]) -> Self {
        Self { corner: a, sides: [b - a, c - a], is_triangle: true }
    }

    pub(super) fn corners(&self) -> Vec<DVec3> {
        let [s, t] = self.sides;
        let c = self.corner;
        if self.is_triangle { vec![c, c + s, c + t] } else { vec![c, c + s, c + s + t, c + t] }
    }

    pub(super) fn centre(&self) -> DVec3 {
        let share = if self.is_triangle { 3.0 } else { 2.0 };
        self.corner + (self.sides[0] + self.sides[1]) / share
    }

    pub(super) fn area(&self) -> f64 {
        let area = self.sides[0].cross(self.sides[1]).length();
        if self.is_triangle { area / 2.0 } else { area }
    }

    /// The longest way across.
    fn diameter(&self) -> f64 {
        let [s, t] = self.sides;
        let across = (s - t).length().max(if self.is_triangle { 0.0 } else { (s + t).length() });
        across.max(s.length()).max(t.length())
    }

    /// Whether it is more than `size` times as large as it is far from `position`.
    pub(super) fn is_large(&self, position: DVec3, size: f64) -> bool {
        self.diameter() > size * self.centre().distance(position)
    }

    /// n x n congruent parts.
    pub(super) fn grid(&self, n: u32) -> Vec<Tile> {
        let n = n.max(1);
        let [s, t] = self.sides.map(|side| side / f64::from(n));
        let at = |i: u32, j: u32| self.corner + f64::from(i) * s + f64::from(j) * t;
        let mut parts = Vec::new();
        for i in 0..n {
            let end = if self.is_triangle { n - i } else { n };
            for j in 0..end {
                parts.push(Tile { corner: at(i, j), sides: [s, t], ..*self });
                if self.is_triangle && j + 1 < end {
                    parts.push(Tile { corner: at(i + 1, j + 1), sides: [-s, -t], ..*self });
                }
            }
        }
        parts
    }
}

/// The parts of a target as seen from `position`, in an order that is always the same.
pub(super) fn divide(target: &PlanarPolygon, position: DVec3, division: Division) -> Vec<Tile> {
    match division {
        Division::Uniform(n) => pieces(target).iter().flat_map(|piece| piece.grid(n)).collect(),
        Division::Adaptive { size, depth } => {
            let mut parts = Vec::new();
            let mut open: Vec<(Tile, u32)> = pieces(target).into_iter().map(|piece| (piece, depth)).collect();
            while let Some((part, left)) = open.pop() {
                if left > 0 && part.is_large(position, size) {
                    open.extend(part.grid(2).into_iter().map(|quarter| (quarter, left - 1)));
                } else {
                    parts.push(part);
                }
            }
            parts
        }
    }
}

/// The target as few triangles and parallelograms.
pub(super) fn pieces(target: &PlanarPolygon) -> Vec<Tile> {
    if !target.is_convex() {
        return trapezoids(target).into_iter().flat_map(fan).collect();
    }
    let points = target.points();
    match *points {
        [a, b, c, d] if a + c == b + d => {
            vec![Tile { corner: a, sides: [b - a, d - a], is_triangle: false }]
        }
        _ => fan(points),
    }
}

/// The triangles of a convex loop that have an area.
fn fan(points: impl AsRef<[DVec3]>) -> Vec<Tile> {
    let points = points.as_ref();
    let triangles = points[1..].windows(2).map(|pair| Tile::triangle([points[0], pair[0], pair[1]]));
    triangles.filter(|part| part.area() > 0.0).collect()
}

/// A polygon with holes in slabs between its vertices' first kept coordinates: in each, edges and inside take turns.
fn trapezoids(target: &PlanarPolygon) -> Vec<[DVec3; 4]> {
    let flat = target.flat_loops();
    let region = leaf(&flat).evaluate();
    let edges: Vec<[DVec2; 2]> = region.rings().flat_map(edges).filter(|[a, b]| a.x < b.x).collect();
    let mut stops: Vec<f64> = region.rings().flatten().map(|p| p.x).collect();
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    let slabs = stops.windows(2).flat_map(|pair| slab(&edges, pair[0], pair[1]));
    slabs.map(|corners| corners.map(|p| target.raise(p))).collect()
}

/// A ring's edges, each from its left end to its right.
fn edges(ring: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| if a.x < b.x { [*a, *b] } else { [*b, *a] })
}

/// The trapezoids between two neighbouring stops, counter-clockwise.
fn slab(edges: &[[DVec2; 2]], left: f64, right: f64) -> Vec<[DVec2; 4]> {
    let at = |[a, b]: &[DVec2; 2], x: f64| {
        if x == b.x { *b } else { DVec2::new(x, a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x))) }
    };
    let spanning = edges.iter().filter(|[a, b]| a.x <= left && b.x >= right);
    let mut spans: Vec<[DVec2; 2]> = spanning.map(|edge| [at(edge, left), at(edge, right)]).collect();
    spans.sort_by(|[a, b], [c, d]| (a.y + b.y).total_cmp(&(c.y + d.y)));
    spans.chunks_exact(2).map(|pair| [pair[0][0], pair[0][1], pair[1][1], pair[1][0]]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(low: f64, high: f64) -> [DVec3; 4] {
        [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| DVec3::new(x, y, x + 2.0 * y))
    }

    #[test]
    fn parts_have_the_area_and_the_front_of_the_whole() {
        let star = [[0.0, 0.0], [4.0, 1.0], [1.0, 1.0], [2.0, 5.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
        let wholes = [
            PlanarPolygon::new([square(0.0, 2.0)]),
            PlanarPolygon::new([square(0.0, 4.0), square(1.0, 2.0)]),
            PlanarPolygon::new([star]),
            PlanarPolygon::new([&star[..3]]),
        ];
        for whole in wholes {
            let whole = whole.expect("planar");
            for n in [1, 2, 5] {
                let parts = divide(&whole, DVec3::ZERO, Division::Uniform(n));
                let area: f64 = parts.iter().map(Tile::area).sum();
                assert!((area - whole.area()).abs() < 1e-13 * area);
                let facing = |p: &Tile| p.sides[0].cross(p.sides[1]).dot(whole.normal()) > 0.0;
                assert!(parts.iter().all(facing));
            }
        }
    }

    #[test]
    fn adaptive_parts_are_small_or_deep() {
        let whole = PlanarPolygon::new([square(-4.0, 4.0)]).expect("planar");
        let position = DVec3::new(0.1, 0.2, 3.0);
        let parts = divide(&whole, position, Division::Adaptive { size: 0.5, depth: 9 });
        assert!(parts.iter().all(|part| !part.is_large(position, 0.5)));
        assert!(parts.iter().map(Tile::area).fold(0.0, f64::max) > parts[0].area().min(1.0));
    }
}
