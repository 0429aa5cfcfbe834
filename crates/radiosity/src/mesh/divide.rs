//! Points over a patch: its boundary at a spacing, and a lattice inside.
use super::{Refusal, frame::Frame};
use formfactor::PlanarPolygon;
use glam::{DVec2, DVec3};
use polycsg::{FillRule, Region};
use std::collections::BTreeMap;

/// A piece of the patch's boundary between neighbouring points.
#[derive(Clone, Copy, Debug)]
pub(super) struct SubEdge {
    /// Start and end, the inside to the left.
    pub(super) ends: [usize; 2],
    /// The edge of the patch that it is a piece of.
    pub(super) edge: usize,
}

/// Points to be triangulated.
#[derive(Debug, Default)]
pub(super) struct Points {
    /// In the patch's frame; no two are equal.
    pub(super) flat: Vec<DVec2>,
    /// The same in space.
    pub(super) places: Vec<DVec3>,
    /// The boundary.
    pub(super) boundary: Vec<SubEdge>,
    /// The lattice that the interior points are from.
    pub(super) lattice: Lattice,
}

/// Equal rectangular cells over the patch's bounding rectangle.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lattice {
    pub(super) corner: DVec2,
    pub(super) step: DVec2,
    pub(super) cells: [usize; 2],
}

/// Finds the points of a patch for cells of side `spacing`.
pub(super) fn divide(polygon: &PlanarPolygon, frame: &Frame, spacing: f64) -> Result<Points, Refusal> {
    let corners: Corners =
        polygon.loops().flatten().map(|&place| (key(frame.flatten(place)), place)).collect();
    let loops = polygon.loops().map(|points| points.iter().map(|&p| frame.flatten(p)).collect::<Vec<_>>());
    let region = Region::from_rings(loops, FillRule::EvenOdd).map_err(|error| Refusal(error.to_string()))?;
    if region.is_empty() {
        return Err(Refusal("its area is zero".to_owned()));
    }
    let spacing = spacing / frame.unit();
    let mut points = Points { lattice: Lattice::over(&region, spacing), ..Points::default() };
    points.divide_boundary(&region, &corners, frame, spacing);
    points.fill_inside(&region, frame);
    Ok(points)
}

/// The patch's own vertices by their place in the frame: they keep their place in space bit for bit.
type Corners = BTreeMap<[u64; 2], DVec3>;

/// A point as a key of a map; −0.0 reads as 0.0.
fn key(flat: DVec2) -> [u64; 2] {
    [(flat.x + 0.0).to_bits(), (flat.y + 0.0).to_bits()]
}

impl Points {
    /// Appends every ring of the region, each edge in equal pieces.
    fn divide_boundary(&mut self, region: &Region, corners: &Corners, frame: &Frame, spacing: f64) {
        let mut known = BTreeMap::new();
        let mut edge = 0;
        for ring in region.rings() {
            for (&start, &end) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let place = |flat| corners.get(&key(flat)).copied().unwrap_or_else(|| frame.lift(flat));
                let ends = [(start, place(start)), (end, place(end))];
                let chain: Vec<_> = pieces(ends, parts(start.distance(end), spacing))
                    .map(|(flat, place)| *known.entry(key(flat)).or_insert_with(|| self.push(flat, place)))
                    .collect();
                self.boundary.extend(chain.windows(2).map(|ends| SubEdge { ends: [ends[0], ends[1]], edge }));
                edge += 1;
            }
        }
    }

    /// Appends the lattice points inside the region that keep half a step from its boundary.
    fn fill_inside(&mut self, region: &Region, frame: &Frame) {
        let lattice = self.lattice;
        let clearance = lattice.step.min_element() / 2.0;
        for j in 1..lattice.cells[1] {
            for i in 1..lattice.cells[0] {
                let point = lattice.point(i, j);
                if inside_and_clear(region, point, clearance) {
                    self.push(point, frame.lift(point));
                }
            }
        }
    }

    /// Appends one point.
    fn push(&mut self, flat: DVec2, place: DVec3) -> usize {
        self.flat.push(self.lattice.align(flat));
        self.places.push(place);
        self.flat.len() - 1
    }
}

impl Lattice {
    /// The lattice over a region's bounding rectangle whose steps are nearest to `spacing`.
    fn over(region: &Region, spacing: f64) -> Lattice {
        let points = || region.rings().flatten().copied();
        let corner = points().fold(DVec2::INFINITY, DVec2::min);
        let extent = points().fold(DVec2::NEG_INFINITY, DVec2::max) - corner;
        let cells = [parts(extent.x, spacing), parts(extent.y, spacing)];
        Lattice { corner, step: extent / DVec2::new(cells[0] as f64, cells[1] as f64), cells }
    }

    /// The lattice point in column `i` and row `j`.
    fn point(&self, i: usize, j: usize) -> DVec2 {
        self.corner + self.step * DVec2::new(i as f64, j as f64)
    }

    /// Puts a point that only rounding keeps from a line of the lattice on that line, so that the sides of a rectangle's
    /// cells are straight to the last bit. Lengths are in the frame's unit.
    fn align(&self, point: DVec2) -> DVec2 {
        let near = self.corner + self.step * ((point - self.corner) / self.step).round();
        let aligned = |axis: usize| (near[axis] - point[axis]).abs() <= 8.0 * f64::EPSILON;
        DVec2::from([0, 1].map(|axis| if aligned(axis) { near[axis] } else { point[axis] }))
    }

    /// Column and row of the cell that holds a point.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells are few, and clamped")]
    pub(super) fn cell(&self, point: DVec2) -> [usize; 2] {
        let cell = (point - self.corner) / self.step;
        [0, 1].map(|axis| (cell[axis].max(0.0) as usize).min(self.cells[axis] - 1))
    }
}

/// In how many parts to cut a length: at least one, and no more than a mesh can hold. The nudge makes equal
/// lengths give equal counts whatever their rounding.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a small positive range"
)]
fn parts(length: f64, spacing: f64) -> usize {
    ((length / spacing) * (1.0 - 1e-9)).round().clamp(1.0, 65536.0) as usize
}

/// The points of an edge cut in `parts` equal parts, both ends included, in the plane and in space. The points in
/// space depend on the edge alone, not on its direction, so that patches that share an edge share its points.
fn pieces(ends: [(DVec2, DVec3); 2], parts: usize) -> impl Iterator<Item = (DVec2, DVec3)> {
    let [(start, from), (end, to)] = ends;
    let forward = from.to_array() <= to.to_array();
    (0..=parts).map(move |k| match k {
        0 => (start, from),
        k if k == parts => (end, to),
        k => {
            let along = k as f64 / parts as f64;
            let back = (parts - k) as f64 / parts as f64;
            let place = if forward { from.lerp(to, along) } else { to.lerp(from, back) };
            (start.lerp(end, along), place)
        }
    })
}

/// Whether a point lies inside a region, at least `clearance` from its boundary. The distance is asked as well,
/// so the crossing parity needs no care near the boundary.
fn inside_and_clear(region: &Region, point: DVec2, clearance: f64) -> bool {
    let mut inside = false;
    for ring in region.rings() {
        for (&a, &b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            if point.distance_squared(a.lerp(b, along)) < clearance * clearance {
                return false;
            }
            if (a.y > point.y) != (b.y > point.y) && (b - a).perp_dot(point - a) * (b.y - a.y) > 0.0 {
                inside = !inside;
            }
        }
    }
    inside
}
