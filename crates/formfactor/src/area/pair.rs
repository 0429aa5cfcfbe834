//! One pair of polygons.
use super::cell::{Cell, area, cells, cut, halves};
use super::contour::exchange;
use super::events::{Event, events};
use super::rule::{Integral, integrate};
use crate::scene::{enclosure::Enclosure, shaft::Shaft};
use crate::shapes::{differential_area::DifferentialArea, polygon::PlanarPolygon};
use glam::{DVec2, DVec3};
use std::{cmp::Ordering, collections::BinaryHeap, sync::Arc};

/// Evaluations after which an integral is given back as it is.
const MOST: u64 = 1 << 22;

/// A tolerance for which cells are cut at the events among occluders too.
const FINE: f64 = 1e-6;

/// A cell is cut at its events when they make at most so many cells of it, and halved otherwise: so often before anything
/// is evaluated, lest all nodes miss what is seen.
const MOST_CUTS: usize = 64;
const BLIND_HALVINGS: u32 = 4;

/// The integral over polygon `source` of the form factor to polygon `target`, which face each other, by the source's area; `None` when
/// `is_cancelled` says so.
pub(super) fn mean(
    enclosure: &Enclosure,
    [source, target]: [usize; 2],
    tolerance: f64,
    is_cancelled: &(impl Fn() -> bool + ?Sized),
) -> Option<Integral> {
    if is_cancelled() {
        return None;
    }
    let pair = Pair::new(enclosure, source, target);
    pair.by_contour(tolerance).or_else(|| pair.by_cells(tolerance, is_cancelled))
}

/// Whether some of a polygon is before another one's plane.
pub(super) fn is_before(polygon: &PlanarPolygon, other: &PlanarPolygon) -> bool {
    polygon.points().iter().any(|p| other.plane().side_of(*p) == Ordering::Greater)
}

/// Whether all of it is, the plane itself included.
fn is_wholly_before(polygon: &PlanarPolygon, other: &PlanarPolygon) -> bool {
    polygon.points().iter().all(|p| other.plane().side_of(*p) != Ordering::Less)
}

/// The error of a piece is taken as no less than this much of that of the cell it was part of, by area: should all nodes
/// agree by chance.
const FALL: f64 = 1e-2;

#[derive(Debug)]
struct Pair<'e> {
    enclosure: &'e Enclosure,
    source: usize,
    target: usize,
    from: &'e PlanarPolygon,
    to: &'e PlanarPolygon,
    /// What can stand in between.
    occluders: Vec<usize>,
}

/// A cell to be refined, the one with the largest error first.
#[derive(Debug)]
struct Open {
    cell: Cell,
    found: Integral,
    occluders: Arc<[usize]>,
    /// Whether no event passes through it.
    is_smooth: bool,
    number: usize,
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.found.error.total_cmp(&other.found.error).then(other.number.cmp(&self.number))
    }
}

impl<'e> Pair<'e> {
    fn new(enclosure: &'e Enclosure, source: usize, target: usize) -> Self {
        let (from, to) = (&enclosure.polygons()[source], &enclosure.polygons()[target]);
        let occluders = enclosure.between(source, target);
        Self { enclosure, source, target, from, to, occluders }
    }

    /// The closed form, where nothing stands in between and no edge is below the other's horizon; `None` also when it
    /// would lose too many digits.
    fn by_contour(&self, tolerance: f64) -> Option<Integral> {
        if !(self.occluders.is_empty()
            && is_wholly_before(self.from, self.to)
            && is_wholly_before(self.to, self.from))
        {
            return None;
        }
        let area = self.from.area();
        let [value, error] = exchange(self.from, self.to, tolerance * area / 2.0).map(|x| x / area);
        (error <= tolerance).then_some(Integral { value: value.max(0.0), error, evaluations: 0 })
    }

    /// Adaptive cubature: the cell with the largest error is refined until the errors add to less than the tolerance.
    fn by_cells(&self, tolerance: f64, is_cancelled: &(impl Fn() -> bool + ?Sized)) -> Option<Integral> {
        let whole: Vec<Cell> = cells(self.from);
        let size: f64 = whole.iter().map(area).sum();
        let occluders: Vec<&PlanarPolygon> =
            self.occluders.iter().map(|i| &self.enclosure.polygons()[*i]).collect();
        let events = events(self.from, self.to, &occluders, tolerance < FINE);
        let all: Arc<[usize]> = self.occluders.clone().into();
        let mut sum =
            Refinement { pair: self, size, tolerance, open: BinaryHeap::new(), evaluations: 0, count: 0 };
        let mut coarse: Vec<(Cell, u32)> = whole.into_iter().map(|cell| (cell, BLIND_HALVINGS)).collect();
        while let Some((cell, halvings)) = coarse.pop() {
            match cut_at(cell, &events, size) {
                Some(pieces) => pieces.into_iter().for_each(|piece| sum.add(piece, &all, true, 0.0)),
                None if halvings > 0 => coarse.extend(halves(cell).map(|half| (half, halvings - 1))),
                None => sum.add(cell, &all, false, 0.0),
            }
        }
        sum.refine(&events, is_cancelled)
    }

    /// The occluders that can stand between a cell and the target.
    fn between(&self, cell: &Cell, occluders: &Arc<[usize]>) -> Arc<[usize]> {
        let corners = cell.map(|p| self.from.raise(p));
        let shaft = Shaft::between(&corners, self.to);
        let left: Vec<usize> =
            occluders.iter().copied().filter(|i| !shaft.misses(&self.enclosure.polygons()[*i])).collect();
        if left.len() == occluders.len() { Arc::clone(occluders) } else { left.into() }
    }

    fn point_factor(&self, flat: DVec2, occluders: &[usize]) -> f64 {
        let position: DVec3 = self.from.raise(flat);
        let Ok(from) = DifferentialArea::new(position, self.from.normal()) else { return 0.0 };
        self.enclosure.past(&from.owned_by(self.source), self.target, occluders).value
    }
}

#[derive(Debug)]
struct Refinement<'p, 'e> {
    pair: &'p Pair<'e>,
    /// The source's area in its kept coordinates.
    size: f64,
    tolerance: f64,
    open: BinaryHeap<Open>,
    evaluations: u64,
    count: usize,
}

impl Refinement<'_, '_> {
    /// Integrates over a cell whose error is at least `least`.
    fn add(&mut self, cell: Cell, occluders: &Arc<[usize]>, is_smooth: bool, least: f64) {
        let occluders = self.pair.between(&cell, occluders);
        let share = self.tolerance * area(&cell).abs() / 2.0;
        let mut found = integrate(&cell, share, is_smooth, |point| self.pair.point_factor(point, &occluders));
        found.value /= self.size;
        found.error = (found.error / self.size).max(least);
        self.evaluations += found.evaluations;
        self.count += 1;
        self.open.push(Open { cell, found, occluders, is_smooth, number: self.count });
    }

    fn refine(mut self, events: &[Event], is_cancelled: &(impl Fn() -> bool + ?Sized)) -> Option<Integral> {
        while self.error() > self.tolerance && self.evaluations < MOST {
            if is_cancelled() {
                return None;
            }
            let Some(worst) = self.open.pop() else { break };
            let Open { cell, found, occluders, is_smooth, .. } = worst;
            for half in halves(cell) {
                let pieces = cut_at(half, events, self.size).filter(|_| !is_smooth);
                let is_smooth = is_smooth || pieces.is_some();
                for piece in pieces.unwrap_or_else(|| vec![half]) {
                    let share = area(&piece).abs() / area(&cell).abs();
                    self.add(piece, &occluders, is_smooth, FALL * share * found.error);
                }
            }
        }
        let (error, evaluations) = (self.error(), self.evaluations);
        Some(Integral { value: self.value(), error, evaluations })
    }

    fn error(&self) -> f64 {
        self.open.iter().map(|open| open.found.error).sum()
    }

    /// The cells in the order in which they came about, which threads do not change.
    fn value(&self) -> f64 {
        let mut parts: Vec<(usize, f64)> =
            self.open.iter().map(|open| (open.number, open.found.value)).collect();
        parts.sort_unstable_by_key(|part| part.0);
        parts.iter().map(|part| part.1).sum()
    }
}

/// A cell cut at all events that pass through it; `None` when they are too many.
fn cut_at(cell: Cell, events: &[Event], whole: f64) -> Option<Vec<Cell>> {
    let mut pieces = vec![cell];
    for event in events {
        pieces = pieces
            .into_iter()
            .flat_map(|piece| cut(&piece, *event, whole).unwrap_or_else(|| vec![piece]))
            .collect();
        if pieces.len() > MOST_CUTS {
            return None;
        }
    }
    Some(pieces)
}
