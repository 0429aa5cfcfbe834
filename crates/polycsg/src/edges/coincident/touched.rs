//! Vertices of edges that are gone, where they touch edges that are left: they become vertices of one of these.

use super::{Fate, cells::Cells};
use crate::base::meter::{Meter, Refusal};
use crate::base::{corners::corners, id::index, sort::sort};
use crate::edges::Edges;
use crate::predicates::{Side, is_inside, lexicographic, side};
use glam::{BVec2, DVec2};
use std::{cmp::Ordering, ops::Range};

/// There are so many cells for each edge that is left, but no more than half as many as edges.
const CELLS_PER_LEFT: usize = 16;

/// Edges that are left may touch so many cells each, on the average, and some more.
const CELLS_PER_EDGE: usize = 4;
const MORE: usize = 1000;

/// So many pairs of a vertex and an edge in its cell are looked at for each edge: where one far point makes one cell of all
/// others, they would be too many.
const PAIRS_PER_EDGE: usize = 64;

/// Of so few pairs of an edge that is left and a vertex between gone ones all are looked at, without cells.
const FEW_PAIRS: usize = if cfg!(any(test, fuzzing)) { 64 } else { 1024 };

/// Of so few slots those between gone edges are listed first.
const FEW_SLOTS: usize = if cfg!(any(test, fuzzing)) { 64 } else { 4096 };

/// So many consecutive slots are passed over at once where no edge is left nearby.
const TOGETHER: usize = 32;

/// See the module's page.
#[derive(Debug, Default)]
pub(super) struct Touched {
    /// Edges that are left and points inside them, in order along each.
    inside: Vec<(u32, DVec2)>,
    left: Vec<u32>,
    /// The vertices between gone edges, where slots are few.
    between: Vec<DVec2>,
    /// Per cell where its edges start in `near`: those that are left and whose boxes touch it.
    starts: Vec<u32>,
    near: Vec<u32>,
    /// Of the cells in the columns and rows before each, how many the boxes of edges that are left touch.
    near_before: Vec<u32>,
}

impl Touched {
    /// Finds them; false where the edges that are left are too long, or all too close together, for that.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find(&mut self, edges: &Edges, fates: &[Fate], meter: &Meter<'_>) -> Result<bool, Refusal> {
        self.left.clear();
        self.left.extend((0..).zip(fates).filter(|(_, fate)| fate.is_kept()).map(|(edge, _)| edge));
        if fates.len() <= FEW_SLOTS {
            self.list_between(edges, fates);
            if self.left.len() * self.between.len() <= FEW_PAIRS {
                self.look_at_all(edges, meter)?;
                return Ok(true);
            }
        }
        let cells = Cells::over(edges.points(), (CELLS_PER_LEFT * self.left.len()).min(fates.len() / 2));
        if !self.list(edges, cells, meter)? {
            return Ok(false);
        }
        self.count(cells.columns());
        self.look(edges, cells, fates, meter)
    }

    /// No points.
    pub(super) fn clear(&mut self) {
        self.inside.clear();
    }

    /// The points inside edges, to be listed from elsewhere and sorted.
    pub(super) fn inside_mut(&mut self) -> &mut Vec<(u32, DVec2)> {
        &mut self.inside
    }

    /// The points inside some edges, by edge and in order along each.
    pub(super) fn inside(&self, span: Range<u32>) -> &[(u32, DVec2)] {
        if self.inside.is_empty() {
            return &[];
        }
        let first = self.inside.partition_point(|(edge, _)| *edge < span.start);
        let count = self.inside[first..].partition_point(|(edge, _)| *edge < span.end);
        &self.inside[first..first + count]
    }

    /// Lists the edges that are left cell by cell.
    fn list(&mut self, edges: &Edges, cells: Cells, meter: &Meter<'_>) -> Result<bool, Refusal> {
        let touched = |edge: u32| {
            let [a, b] = edges.segment(edge);
            cells.within(a.min(b), a.max(b)).flatten().map(|cell| cell as usize)
        };
        self.starts.clear();
        self.starts.resize(cells.len() + 2, 0);
        let mut room = MORE + CELLS_PER_EDGE * edges.len();
        let mut tally = meter.tally();
        for &edge in &self.left {
            for cell in touched(edge) {
                if room == 0 {
                    return Ok(false);
                }
                room -= 1;
                tally.add(1)?;
                self.starts[cell + 2] += 1;
            }
        }
        for cell in 2..self.starts.len() {
            self.starts[cell] += self.starts[cell - 1];
        }
        self.near.clear();
        self.near.resize(self.starts.last().copied().unwrap_or(0) as usize, 0);
        for &edge in &self.left {
            for cell in touched(edge) {
                tally.add(1)?;
                self.near[self.starts[cell + 1] as usize] = edge;
                self.starts[cell + 1] += 1;
            }
        }
        Ok(true)
    }

    /// Counts the cells that edges which are left touch.
    fn count(&mut self, columns: usize) {
        let Touched { starts, near_before, .. } = self;
        near_before.clear();
        near_before.resize((columns + 1).pow(2), 0);
        for (row, starts) in (1..).zip(starts[..=columns.pow(2)].windows(columns + 1).step_by(columns)) {
            let (below, here) = near_before[(row - 1) * (columns + 1)..].split_at_mut(columns + 1);
            let mut count = 0;
            for column in 0..columns {
                count += u32::from(starts[column] < starts[column + 1]);
                here[column + 1] = below[column + 1] + count;
            }
        }
    }

    /// Lists the vertices between gone edges, and keeps the edges that are left whose boxes meet that of these: along a common
    /// border few do.
    fn list_between(&mut self, edges: &Edges, fates: &[Fate]) {
        let Touched { left, between, .. } = self;
        between.clear();
        let slots = (0..index(fates.len())).filter(|&slot| is_between_gone(edges, fates, slot));
        between.extend(slots.map(|slot| edges.point(slot)));
        let [low, high] = corners(between);
        left.retain(|&edge| {
            let [a, b] = edges.segment(edge);
            a.min(b).cmple(high) & a.max(b).cmpge(low) == BVec2::TRUE
        });
    }

    /// Looks at all edges that are left, for each vertex between gone edges.
    fn look_at_all(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.inside.clear();
        let (left, between) = (std::mem::take(&mut self.left), std::mem::take(&mut self.between));
        between.iter().for_each(|&p| self.look_at(edges, &left, p));
        (self.left, self.between) = (left, between);
        self.sort(edges, meter)
    }

    /// Looks at those in the cells of these vertices.
    fn look(
        &mut self,
        edges: &Edges,
        cells: Cells,
        fates: &[Fate],
        meter: &Meter<'_>,
    ) -> Result<bool, Refusal> {
        self.inside.clear();
        let mut room = MORE + PAIRS_PER_EDGE * fates.len();
        let near = std::mem::take(&mut self.near);
        let mut tally = meter.tally();
        for (start, points) in (0..).step_by(TOGETHER).zip(edges.points().chunks(TOGETHER)) {
            tally.add(1)?;
            if !self.are_near(cells, points) {
                continue;
            }
            for (_, &p) in (start..).zip(points).filter(|(slot, _)| is_between_gone(edges, fates, *slot)) {
                let cell = cells.at(p) as usize;
                let near = &near[self.starts[cell] as usize..self.starts[cell + 1] as usize];
                let Some(left) = room.checked_sub(near.len()) else { return Ok(false) };
                tally.add(1 + near.len())?;
                self.look_at(edges, near, p);
                room = left;
            }
        }
        self.near = near;
        self.sort(edges, meter)?;
        Ok(true)
    }

    /// Whether the points' box touches cells with edges that are left.
    #[inline]
    fn are_near(&self, cells: Cells, points: &[DVec2]) -> bool {
        let [low, high] = corners(points);
        let ([left, bottom], [right, top]) = (cells.place(low), cells.place(high));
        let before = |column, row| self.near_before[row as usize * (cells.columns() + 1) + column as usize];
        before(right + 1, top + 1) + before(left, bottom) != before(left, top + 1) + before(right + 1, bottom)
    }

    /// Sorts the points inside edges by edge and along each.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn sort(&mut self, edges: &Edges, meter: &Meter<'_>) -> Result<(), Refusal> {
        let by_place = |(e, p): &(u32, DVec2), (f, q): &(u32, DVec2)| {
            let along = || if rises(edges, *e) { lexicographic(*p, *q) } else { lexicographic(*q, *p) };
            e.cmp(f).then_with(along)
        };
        sort(&mut self.inside, by_place, meter)?;
        self.inside.dedup();
        Ok(())
    }

    /// Notes one of some edges that a point lies in: from there the others meet it.
    #[inline]
    fn look_at(&mut self, edges: &Edges, near: &[u32], p: DVec2) {
        for &edge in near {
            let [a, b] = edges.segment(edge);
            // Most are neither: one comparison of all four sides is quicker than one after the other.
            let is_in_box = a.min(b).cmple(p) & a.max(b).cmpge(p) == BVec2::TRUE;
            if is_in_box && is_inside([a, b], p) && side(a, b, p) == Side::On {
                self.inside.push((edge, p));
                break;
            }
        }
    }
}

/// Whether a slot is a vertex between edges that are gone; one of them stands for itself, so that few are named twice.
#[inline]
fn is_between_gone(edges: &Edges, fates: &[Fate], slot: u32) -> bool {
    !fates[slot as usize].is_kept() && edges.is_vertex(slot) && {
        let [a, b] = edges.at(slot).map(|edge| fates[edge as usize]);
        (a == Fate::Gone || b == Fate::Gone) && !a.is_kept() && !b.is_kept()
    }
}

/// Whether an edge starts in its smaller end.
#[inline]
fn rises(edges: &Edges, edge: u32) -> bool {
    let [start, end] = edges.segment(edge);
    lexicographic(start, end) == Ordering::Less
}

#[cfg(test)]
mod tests {
    use super::{Fate, Touched};
    use crate::base::meter::Meter;
    use crate::edges::coincident::table::Table;
    use crate::edges::{Change, Edges, Origin};
    use glam::DVec2;

    fn add_square(edges: &mut Edges, low: DVec2) {
        for corner in [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y] {
            edges.add_edge(low + corner, Origin { operand: 0, edge: 0 });
        }
        edges.end_ring(None, &[Change { counter: 0, winds: 1 }]);
    }

    /// What is found in a grid of squares and something else.
    fn found(columns: u16, add: impl Fn(&mut Edges)) -> Option<Vec<(u32, DVec2)>> {
        let (mut edges, mut table, mut fates, mut touched) =
            (Edges::default(), Table::default(), Vec::new(), Touched::default());
        add(&mut edges);
        for cell in 0..columns * columns {
            add_square(&mut edges, DVec2::new(f64::from(cell % columns), f64::from(cell / columns)));
        }
        let meter = Meter::default();
        table.group(&edges, &mut fates, &meter).expect("no limit was given");
        (0..)
            .zip(&mut fates)
            .filter(|(edge, _)| !table.is_alone(*edge))
            .for_each(|(_, fate)| *fate = Fate::Gone);
        touched.find(&edges, &fates, &meter).expect("no limit was given").then_some(touched.inside)
    }

    #[test]
    fn a_grid_has_none() {
        assert_eq!(found(40, |_| ()), Some(Vec::new()));
    }

    /// A triangle stands with two of its sides in corners of squares that have cancelled.
    #[test]
    fn in_order_along_both_directions() {
        let triangle = [DVec2::new(2.0, 0.5), DVec2::new(8.0, 9.5), DVec2::new(8.0, 0.5)];
        let slanted = [[3.0, 2.0], [5.0, 5.0], [7.0, 8.0]].map(DVec2::from);
        let upright = (1..10).map(|y| DVec2::new(8.0, f64::from(y)));
        let forward: Vec<(u32, DVec2)> =
            slanted.into_iter().map(|p| (0, p)).chain(upright.clone().rev().map(|p| (1, p))).collect();
        let backward: Vec<(u32, DVec2)> =
            upright.map(|p| (0, p)).chain(slanted.into_iter().rev().map(|p| (1, p))).collect();
        let with = |ring: [DVec2; 3]| {
            found(10, |edges| {
                ring.iter().for_each(|&p| edges.add_edge(p, Origin { operand: 0, edge: 0 }));
                edges.end_ring(None, &[Change { counter: 0, winds: 1 }]);
            })
        };
        assert_eq!(with(triangle), Some(forward));
        assert_eq!(with([triangle[2], triangle[1], triangle[0]]), Some(backward));
    }

    /// One far square makes one cell of all others: every vertex would be looked at beside every edge of the outline.
    #[test]
    fn gives_up_where_all_are_in_one_cell() {
        assert_eq!(found(100, |edges| add_square(edges, DVec2::splat(1e9))), None);
    }
}
