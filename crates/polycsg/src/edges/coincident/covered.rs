//! Rings of a union that another one of it covers: they change nothing but for their vertices on its border. Inside of that one
//! nothing is on the border of the union. Where more than a union is asked for, vertices there count, and all rings are kept.
//!
//! ```text
//!      _____________          A union of things that stand on one another, or of buffers along a line, has far more
//!     |   ____ __   |         crossings inside than on its border. What one of the larger convex rings covers is gone
//!     |  |  __|  |  |         before any of these is looked for.
//!     |__|_|__|__|__|
//! ```

use super::{Fate, cells::Cells};
use crate::base::meter::{Meter, Refusal};
use crate::base::{corners::corners, sort::sort};
use crate::edges::{EdgeRing, Edges};
use crate::expression::{simple_ring::winds_once, winding::WindingNumbers};
use crate::predicates::{Side, is_inside, lexicographic, side};
use glam::DVec2;

/// Fewer rings are quickly arranged.
const FEW: usize = 64;

/// Where the rings' boxes cover the plane so often on the average, it pays to look.
const DEEP: f64 = 8.0;

/// So many rings tell how deep all lie.
const SAMPLE: usize = 512;

/// So many of the largest rings are kept in mind for each cell, and noted in so many cells for each edge.
const LARGEST: usize = 4;
const CELLS_PER_EDGE: usize = 16;

/// A ring may cover others if it has no more edges.
const LONGEST: u32 = 64;

/// No ring.
const NONE: u32 = u32::MAX;

/// A ring that covers others or is covered.
#[derive(Clone, Copy, Debug)]
struct Sheet {
    ring: EdgeRing,
    low: DVec2,
    high: DVec2,
    /// Where its inside is, seen along its edges.
    inside: Side,
}

impl Sheet {
    fn of(edges: &Edges, ring: EdgeRing) -> Sheet {
        let [low, high] = bounds(edges, ring);
        let by_place = |&v: &u32, &w: &u32| lexicographic(edges.point(v), edges.point(w));
        let leftmost = (ring.start..ring.end).min_by(by_place).unwrap_or(ring.start);
        let [a, b, c] = corner(edges, ring, leftmost);
        Sheet { ring, low, high, inside: side(a, b, c) }
    }

    /// Whether a convex ring covers another one.
    fn covers(&self, edges: &Edges, other: &Sheet) -> bool {
        let is_inside = |p: DVec2| {
            (self.ring.start..self.ring.end).all(|edge| {
                let [a, b] = edges.segment(edge);
                side(a, b, p) != self.inside.reversed()
            })
        };
        let in_box = self.low.cmple(other.low).all() && self.high.cmpge(other.high).all();
        in_box && (other.ring.start..other.ring.end).all(|vertex| is_inside(edges.point(vertex)))
    }

    /// Adds the vertices of another ring that lie inside of its edges, with these.
    fn add_touched(&self, edges: &Edges, other: &Sheet, touched: &mut Vec<(u32, DVec2)>) {
        for p in (other.ring.start..other.ring.end).map(|vertex| edges.point(vertex)) {
            let is_touched = |&edge: &u32| {
                let segment = edges.segment(edge);
                is_inside(segment, p) && side(segment[0], segment[1], p) == Side::On
            };
            touched.extend((self.ring.start..self.ring.end).find(is_touched).map(|edge| (edge, p)));
        }
    }

    /// Whether it runs once around a convex set: it turns to its inside only, and changes between left and right twice.
    fn is_convex(&self, edges: &Edges) -> bool {
        let EdgeRing { start, end, .. } = self.ring;
        let turns = (start..end).map(|vertex| corner(edges, self.ring, vertex));
        let turns_back = |&[a, b, c]: &[DVec2; 3]| lexicographic(a, b) != lexicographic(b, c);
        end - start <= LONGEST
            && self.inside != Side::On
            && turns.clone().all(|[a, b, c]| side(a, b, c) != self.inside.reversed())
            && turns.filter(turns_back).count() == 2
    }
}

/// The box of a ring.
fn bounds(edges: &Edges, ring: EdgeRing) -> [DVec2; 2] {
    corners(&edges.points()[ring.start as usize..ring.end as usize])
}

/// A quarter of the area of a box, so that it overflows less soon.
fn quarter(low: DVec2, high: DVec2) -> f64 {
    let half = high * 0.5 - low * 0.5;
    half.x * half.y
}

/// A vertex between its neighbours.
fn corner(edges: &Edges, ring: EdgeRing, vertex: u32) -> [DVec2; 3] {
    [ring.previous(vertex), vertex, ring.next(vertex)].map(|vertex| edges.point(vertex))
}

/// The buffers of the search.
#[derive(Debug, Default)]
pub(super) struct CoveredRings {
    /// Per operand how many rings it has and, where these are several, whether not all are simple and run counter-clockwise, or
    /// clockwise.
    counts: Vec<u32>,
    ways: Vec<[bool; 2]>,
    /// From the largest box to the smallest.
    sheets: Vec<Sheet>,
    /// Per cell the largest convex rings that are near it and not covered.
    largest: Vec<[u32; LARGEST]>,
}

impl CoveredRings {
    /// Whether so many rings are united, and their boxes lie so deep, that looking for covered ones pays.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn pays(
        &mut self,
        edges: &Edges,
        winding: &WindingNumbers,
        meter: &Meter<'_>,
    ) -> Result<bool, Refusal> {
        if edges.rings().len() < FEW {
            return Ok(false);
        }
        let is_united = |ring: &&EdgeRing| ring.counter.is_some_and(|counter| winding.is_union(counter));
        let united = edges.rings().iter().filter(is_united);
        let step = edges.rings().len().div_ceil(SAMPLE);
        let (mut low, mut high, mut area) = (DVec2::MAX, DVec2::MIN, 0.0);
        for [ring_low, ring_high] in united.clone().step_by(step).map(|&ring| bounds(edges, ring)) {
            low = low.min(ring_low);
            high = high.max(ring_high);
            area += quarter(ring_low, ring_high);
        }
        let is_deep = area * step as f64 > DEEP * quarter(low, high);
        if is_deep {
            self.sheets.clear();
            meter.for_all(united, |&ring| self.sheets.push(Sheet::of(edges, ring)))?;
            self.keep_once_wound(edges, meter)?;
        }
        Ok(is_deep)
    }

    /// Finds the rings that others cover: these represent them, and take over the vertices that touch them. A vertex of
    /// a covered ring on the union's border is on that of the covering one. O(n log n).
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find(
        &mut self,
        edges: &Edges,
        fates: &mut [Fate],
        touched: &mut Vec<(u32, DVec2)>,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let cells = Cells::over(edges.points(), edges.rings().len());
        self.largest.clear();
        self.largest.resize(cells.len(), [NONE; LARGEST]);
        let from_largest = |a: &Sheet, b: &Sheet| {
            let by_size = quarter(b.low, b.high).total_cmp(&quarter(a.low, a.high));
            by_size.then(a.ring.start.cmp(&b.ring.start))
        };
        sort(&mut self.sheets, from_largest, meter)?;
        let mut room = CELLS_PER_EDGE * edges.len();
        let mut tally = meter.tally();
        for (i, sheet) in (0..).zip(&self.sheets) {
            tally.add((sheet.ring.end - sheet.ring.start) as usize)?;
            let near = self.largest[cells.at(sheet.low * 0.5 + sheet.high * 0.5) as usize];
            let same = |other: &&u32| self.sheets[**other as usize].ring.counter == sheet.ring.counter;
            let larger = near.iter().take_while(|&&other| other != NONE).filter(same);
            let mut larger = larger.map(|&other| &self.sheets[other as usize]);
            if let Some(other) = larger.find(|other| other.covers(edges, sheet)) {
                fates[sheet.ring.start as usize..sheet.ring.end as usize].fill(Fate::Represented);
                other.add_touched(edges, sheet, touched);
            } else if room > 0 && sheet.is_convex(edges) {
                for cell in cells.within(sheet.low, sheet.high).flatten().take(room) {
                    tally.add(1)?;
                    room -= 1;
                    let free = self.largest[cell as usize].iter_mut().find(|place| **place == NONE);
                    free.into_iter().for_each(|place| *place = i);
                }
            }
        }
        Ok(())
    }

    /// Keeps the rings of operands that have one alone, or several that are simple and all run one way: not those with holes.
    fn keep_once_wound(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        let operand = |ring: &EdgeRing| ring.origin.operand as usize;
        let count = edges.rings().iter().map(operand).max().map_or(0, |most| most + 1);
        self.counts.clear();
        self.counts.resize(count, 0);
        edges.rings().iter().for_each(|ring| self.counts[operand(ring)] += 1);
        self.ways.clear();
        self.ways.resize(count, [false; 2]);
        let mut tally = meter.tally();
        for ring in edges.rings().iter().filter(|ring| self.counts[operand(ring)] > 1) {
            tally.add((ring.end - ring.start) as usize)?;
            let winds = winds_once(&edges.points()[ring.start as usize..=ring.end as usize]);
            let way = &mut self.ways[operand(ring)];
            *way = [way[0] | (winds != Some(1)), way[1] | (winds != Some(-1))];
        }
        self.sheets.retain(|sheet| self.ways[operand(&sheet.ring)] != [true; 2]);
        Ok(())
    }
}
