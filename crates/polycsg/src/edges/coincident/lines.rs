//! Edges that overlap in part: those on one line whose insides meet, directly or by others between them.
//!
//! Edges are brought together by rounded slopes and rounded distances from the origin, and whether they lie on one line is
//! decided exactly. What rounding keeps apart is not found, which costs time only.

use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::edges::Edges;
use crate::predicates::{Side, lexicographic, side};
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};

/// Slopes of one line differ by less, and distances by less for each unit of the largest coordinate: both are quotients and
/// differences of doubles, right to a few 2^-53.
const SLOPE: f64 = 1.0 / (1_u64 << 48) as f64;
const DISTANCE: f64 = 1.0 / (1_u64 << 46) as f64;

/// So many lines are told apart among edges that rounded slopes and distances bring together.
const LINES: usize = 8;

/// An edge, with its line as far as rounded numbers tell it.
#[derive(Clone, Copy, Debug)]
struct EdgeLine {
    edge: u32,
    low: DVec2,
    high: DVec2,
    is_steep: bool,
    slope: f64,
    distance: f64,
}

impl EdgeLine {
    fn of(edges: &Edges, edge: u32) -> EdgeLine {
        let [a, b] = edges.segment(edge);
        let (low, high) = if lexicographic(a, b) == Ordering::Less { (a, b) } else { (b, a) };
        // Halves, so that no difference overflows.
        let way = high * 0.5 - low * 0.5;
        let is_steep = way.y.abs() > way.x;
        let slope = if is_steep { way.x / way.y } else { way.y / way.x };
        EdgeLine { edge, low, high, is_steep, slope, distance: 0.0 }
    }

    /// Half the distance at which a line of some slope through its lower end meets an axis.
    fn distance(&self, slope: f64) -> f64 {
        let half = self.low * 0.5;
        if self.is_steep { half.x - slope * half.y } else { half.y - slope * half.x }
    }

    fn is_on(&self, line: [DVec2; 2]) -> bool {
        [self.low, self.high].iter().all(|&p| side(line[0], line[1], p) == Side::On)
    }
}

/// The buffers of the search.
#[derive(Debug, Default)]
pub(super) struct Lines {
    lines: Vec<EdgeLine>,
    /// The edges that overlap, component by component, and where each of these ends.
    members: Vec<u32>,
    ends: Vec<usize>,
}

impl Lines {
    /// Finds the edges that overlap. O(n log n).
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.members.clear();
        self.ends.clear();
        let mut all = std::mem::take(&mut self.lines);
        all.clear();
        let spans = edges.rings().iter().filter(|ring| ring.counter.is_some());
        let lines = spans.flat_map(|ring| ring.start..ring.end).map(|edge| EdgeLine::of(edges, edge));
        meter.extend(&mut all, lines)?;
        sort(&mut all, |a, b| a.is_steep.cmp(&b.is_steep).then(a.slope.total_cmp(&b.slope)), meter)?;
        let size = edges.points().iter().fold(0.0, |size: f64, p| size.max(p.abs().max_element()));
        let parallel = |a: &EdgeLine, b: &EdgeLine| a.is_steep == b.is_steep && b.slope - a.slope <= SLOPE;
        for parallel in all.chunk_by_mut(parallel) {
            let slope = parallel[0].slope;
            parallel.iter_mut().for_each(|edge| edge.distance = edge.distance(slope));
            sort(parallel, |a, b| a.distance.total_cmp(&b.distance), meter)?;
            let near = |a: &EdgeLine, b: &EdgeLine| b.distance - a.distance <= DISTANCE * size;
            parallel.chunk_by_mut(near).try_for_each(|near| self.add_lines(near, meter))?;
        }
        self.lines = all;
        Ok(())
    }

    /// The edges of each component.
    pub(super) fn components(&self) -> impl Iterator<Item = &[u32]> {
        let spans = (0..self.ends.len()).map(|i| i.checked_sub(1).map_or(0, |i| self.ends[i])..self.ends[i]);
        spans.map(|span: Range<usize>| &self.members[span])
    }

    /// Adds the components of edges that are about on one line.
    fn add_lines(&mut self, mut near: &mut [EdgeLine], meter: &Meter<'_>) -> Result<(), Refusal> {
        for _ in 0..LINES {
            let [first, _, ..] = near else { return Ok(()) };
            let line = [first.low, first.high];
            near.sort_by_key(|edge| !edge.is_on(line));
            let count = near.partition_point(|edge| edge.is_on(line));
            let (on_line, others) = near.split_at_mut(count);
            sort(on_line, |a, b| lexicographic(a.low, b.low).then(a.edge.cmp(&b.edge)), meter)?;
            self.add_components(on_line);
            near = others;
        }
        Ok(())
    }

    /// Adds the components of edges of one line, in the order of their lower ends.
    fn add_components(&mut self, on_line: &[EdgeLine]) {
        let mut rest = on_line;
        while let [first, others @ ..] = rest {
            let mut high = first.high;
            let overlaps = |edge: &&EdgeLine| {
                let overlaps = lexicographic(edge.low, high) == Ordering::Less;
                if overlaps && lexicographic(high, edge.high) == Ordering::Less {
                    high = edge.high;
                }
                overlaps
            };
            let count = 1 + others.iter().take_while(overlaps).count();
            if count > 1 {
                self.members.extend(rest[..count].iter().map(|edge| edge.edge));
                self.ends.push(self.members.len());
            }
            rest = &rest[count..];
        }
    }
}
