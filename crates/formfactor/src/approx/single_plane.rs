//! One plane above dA, cut finer where edges are.
use super::frame::{Rotation, along, frame};
use super::ray::{Item, items, seen};
use super::{delta, method::Method};
use crate::scene::enclosure::Enclosure;
use crate::shapes::differential_area::DifferentialArea;
use glam::DVec3;
use std::ops::Range;

/// Quarters a square above dA and parallel to it as Warnock does, while edges cross a cell, so that small polygons get small
/// cells. Each cell then counts, by its delta factor in closed form, for what its middle sees [Sillion & Puech 1989].
///
/// A cell that no edge crosses is exact, unless polygons pierce each other. The error is what the smallest cells get wrong: at
/// most their number times `smallest`, which is of the order of its square root. What passes below the rim of the square is not
/// seen: at most 1 / (1 + half_width^2) in all. Only a wider square makes that smaller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinglePlane {
    /// Half the square's side, at height 1 above dA; taken as at most 1e6.
    pub half_width: f64,
    /// A cell is not quartered when its delta factor is at most this, or at most 1e-9.
    pub smallest: f64,
}

impl Method for SinglePlane {
    fn name(&self) -> String {
        format!("single plane, half-width {}, cells to {:e}", self.half_width, self.smallest)
    }

    fn row(&self, enclosure: &Enclosure, from: &DifferentialArea, targets: &[usize]) -> Vec<f64> {
        let items = items(enclosure, from);
        let axes = frame(from, Rotation::Angle(0.0));
        let mut factors = vec![0.0; enclosure.polygons().len()];
        let half = self.half_width.abs().min(WIDEST);
        let whole = Square { x: -half..half, y: -half..half, items: items.iter().collect() };
        let mut open = vec![whole];
        while let Some(cell) = open.pop() {
            let weight = delta::top(&cell.x, &cell.y);
            let cone = cell.corners(&axes);
            if weight > self.smallest.max(LEAST) && cell.items.iter().any(|i| is_crossed(&cone, i)) {
                open.extend(cell.quarters(&axes));
                continue;
            }
            for item in seen(cell.items.iter().copied(), cell.middle(&axes)) {
                factors[item.id] += weight;
            }
        }
        targets.iter().map(|id| factors[*id]).collect()
    }
}

/// Beyond, all is below the rounding of the sum.
const WIDEST: f64 = 1e6;

/// Keeps the number of cells along an edge within some 10^5.
const LEAST: f64 = 1e-9;

/// A square cell, and what may be seen through it.
#[derive(Clone, Debug)]
struct Square<'i, 'a> {
    x: Range<f64>,
    y: Range<f64>,
    items: Vec<&'i Item<'a>>,
}

impl Square<'_, '_> {
    /// The directions to its corners, counter-clockwise about the normal.
    fn corners(&self, axes: &[DVec3; 3]) -> [DVec3; 4] {
        let Self { x, y, .. } = self;
        [[x.start, y.start], [x.end, y.start], [x.end, y.end], [x.start, y.end]]
            .map(|[x, y]| along(axes, [x, y, 1.0]))
    }

    fn middle(&self, axes: &[DVec3; 3]) -> DVec3 {
        let middle = |range: &Range<f64>| f64::midpoint(range.start, range.end);
        along(axes, [middle(&self.x), middle(&self.y), 1.0])
    }

    fn quarters(&self, axes: &[DVec3; 3]) -> impl Iterator<Item = Self> {
        let halves = |range: &Range<f64>| {
            let middle = f64::midpoint(range.start, range.end);
            [range.start..middle, middle..range.end]
        };
        let (columns, rows) = (halves(&self.x), halves(&self.y));
        let all = rows.into_iter().flat_map(move |y| columns.clone().map(|x| (x, y.clone())));
        all.map(|(x, y)| {
            let mut cell = Self { x, y, items: Vec::new() };
            let cone = cell.corners(axes);
            cell.items = self.items.iter().copied().filter(|item| !is_outside(&cone, item)).collect();
            cell
        })
    }
}

/// Whether an item lies wholly outside of one side of the cone through a cell's corners.
fn is_outside(cone: &[DVec3; 4], item: &Item) -> bool {
    sides(cone).any(|side| item.loops.iter().flatten().all(|p| side.dot(*p) < 0.0))
}

/// Whether an edge of the item may cross the cell: true for each that does, and for few that do not.
fn is_crossed(cone: &[DVec3; 4], item: &Item) -> bool {
    let crosses = |a: DVec3, b: DVec3| {
        let misses = sides(cone).any(|side| side.dot(a) < 0.0 && side.dot(b) < 0.0);
        let plane = a.cross(b);
        let turns = cone.map(|corner| plane.dot(corner));
        let splits = turns.iter().any(|t| *t >= 0.0) && turns.iter().any(|t| *t <= 0.0);
        !misses && splits
    };
    item.loops.iter().any(|l| l.iter().zip(l.iter().cycle().skip(1)).any(|(a, b)| crosses(*a, *b)))
}

/// The inward normals of a cone's sides.
fn sides(cone: &[DVec3; 4]) -> impl Iterator<Item = DVec3> {
    cone.iter().zip(cone.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b))
}
