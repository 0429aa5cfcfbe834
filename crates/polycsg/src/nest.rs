//! Stage 9: which hole belongs to which outer ring, which polygon lies in which hole.
//!
//! Rings are taken by their leftmost point. A hole that was cut from the same cycle as an outer ring belongs to it;
//! for any other ring the edge right below its leftmost point tells the face that surrounds it:
//!
//! ```text
//!     the ring below    is an outer ring    is a hole
//!     a hole            of that ring        of that hole's polygon
//!     an outer ring     beside that ring    inside that hole
//! ```
//!
//! An edge below whose near side is on the wrong side of the boundary means that the rings are not nested.

use crate::below::nearest_segment_below;
use crate::link::{Cycles, Ring, by_angle};
use crate::outline::Outline;
use crate::region::{Region, RegionBuilder};
use crate::strips::Strips;
use crate::truth::index;
use std::cmp::Ordering;

/// The rings are no boundary: some lies on the wrong side of another, or edges around a point do not alternate.
#[derive(Debug)]
pub(crate) struct Misnested;

/// No polygon.
const NONE: u32 = u32::MAX;

/// An outer ring, the polygon around it, and its number of surrounding polygons.
#[derive(Clone, Copy, Debug)]
struct Shell {
    ring: u32,
    depth: u32,
}

struct Nest<'a> {
    outline: &'a Outline,
    cycles: &'a Cycles,
    strips: &'a Strips,
    /// Per ring the polygon that it bounds from outside or inside.
    polygon: Vec<u32>,
    /// Per ring that is outer: the polygon around it.
    around: Vec<u32>,
    shells: Vec<Shell>,
    /// Per cycle the leftmost point of all its rings.
    leftmost: Vec<u32>,
}

/// Builds the region; the outline's edges meet in shared points only.
pub(crate) fn nest(outline: &Outline, cycles: &Cycles, strips: &mut Strips) -> Result<Region, Misnested> {
    if !cycles.alternate {
        return Err(Misnested);
    }
    let rings = cycles.rings();
    let order = by_leftmost(outline, cycles);
    if rings.len() > 1 {
        strips.build((0..index(outline.edges().len())).map(|e| (e, outline.segment(e))));
    }
    let mut nest = Nest {
        outline,
        cycles,
        strips,
        polygon: vec![NONE; rings.len()],
        around: vec![NONE; rings.len()],
        shells: Vec::new(),
        leftmost: leftmost_of_cycle(cycles),
    };
    let outer_of_cycle = outer_of_cycle(rings)?;
    for &ring in &order {
        nest.place(ring, &outer_of_cycle)?;
    }
    Ok(nest.build(&order))
}

/// The rings by leftmost point; of those that start in one point the lower first.
fn by_leftmost(outline: &Outline, cycles: &Cycles) -> Vec<u32> {
    let mut order: Vec<u32> = (0..index(cycles.rings().len())).collect();
    // The leftmost point, and the neighbour on the lower of the two edges there.
    let corner = |ring: u32| {
        let ring = cycles.rings()[ring as usize];
        let ids = cycles.ids(ring);
        (ids[0], if ring.counter_clockwise { ids[1] } else { ids[ids.len() - 1] })
    };
    let point = |id: u32| outline.point(id);
    order.sort_unstable_by(|&a, &b| {
        let (a, b) = (corner(a), corner(b));
        a.0.cmp(&b.0).then_with(|| by_angle(point(a.0), point(a.1), point(b.1)))
    });
    order
}

/// The outer ring of each cycle, if it has one.
fn outer_of_cycle(rings: &[Ring]) -> Result<Vec<u32>, Misnested> {
    let count = rings.last().map_or(0, |ring| ring.cycle as usize + 1);
    let mut outer = vec![NONE; count];
    for (i, ring) in rings.iter().enumerate().filter(|(_, r)| r.counter_clockwise) {
        let place = &mut outer[ring.cycle as usize];
        if *place != NONE {
            return Err(Misnested);
        }
        *place = index(i);
    }
    Ok(outer)
}

fn leftmost_of_cycle(cycles: &Cycles) -> Vec<u32> {
    let count = cycles.rings().last().map_or(0, |ring| ring.cycle as usize + 1);
    let mut leftmost = vec![NONE; count];
    for &ring in cycles.rings() {
        let place = &mut leftmost[ring.cycle as usize];
        *place = cycles.ids(ring)[0].min(*place);
    }
    leftmost
}

impl Nest<'_> {
    fn ring(&self, ring: u32) -> Ring {
        self.cycles.rings()[ring as usize]
    }

    fn place(&mut self, ring: u32, outer_of_cycle: &[u32]) -> Result<(), Misnested> {
        if self.ring(ring).counter_clockwise {
            return self.place_outer(ring);
        }
        let outer = outer_of_cycle[self.ring(ring).cycle as usize];
        // The outer ring of a hole's own cycle starts further left, so it is placed already.
        let owner = if outer == NONE { self.ring_below_hole(ring)? } else { outer };
        self.polygon[ring as usize] = self.polygon[owner as usize];
        if self.polygon[ring as usize] == NONE { Err(Misnested) } else { Ok(()) }
    }

    fn place_outer(&mut self, ring: u32) -> Result<(), Misnested> {
        let around = match self.ring_beside_outer(ring)? {
            None => NONE,
            Some(other) if self.polygon[other as usize] == NONE => return Err(Misnested),
            Some(other) if self.ring(other).counter_clockwise => self.around[other as usize],
            Some(hole) => self.polygon[hole as usize],
        };
        let depth = if around == NONE { 0 } else { self.shells[around as usize].depth + 1 };
        self.polygon[ring as usize] = index(self.shells.len());
        self.around[ring as usize] = around;
        self.shells.push(Shell { ring, depth });
        Ok(())
    }

    /// The ring that runs right below the leftmost point of a cycle of holes; its interior lies above.
    fn ring_below_hole(&self, ring: u32) -> Result<u32, Misnested> {
        let edge = self.edge_below(self.leftmost[self.ring(ring).cycle as usize]).ok_or(Misnested)?;
        if self.is_rightward(edge) { Ok(self.cycles.ring_of_edge(edge)) } else { Err(Misnested) }
    }

    /// The ring that bounds the outside of an outer ring, right below its leftmost point.
    fn ring_beside_outer(&self, ring: u32) -> Result<Option<u32>, Misnested> {
        let ids = self.cycles.ids(self.ring(ring));
        let (start, next) = (ids[0], ids[1]);
        let (edge, outside) = match self.clockwise_neighbour(start, next) {
            // An edge of the point itself: the outside lies on its left seen from the point.
            Some((edge, leaves)) => (edge, !leaves),
            None => match self.edge_below(start) {
                None => return Ok(None),
                Some(edge) => (edge, !self.is_rightward(edge)),
            },
        };
        if outside { Ok(Some(self.cycles.ring_of_edge(edge))) } else { Err(Misnested) }
    }

    /// Of the edges at `point`, the first met turning clockwise from `next` to straight down and on to straight up:
    /// that edge, and whether it leaves the point.
    fn clockwise_neighbour(&self, point: u32, next: u32) -> Option<(u32, bool)> {
        let p = |id: u32| self.outline.point(id);
        let angle = |a: u32, b: u32| by_angle(p(point), p(a), p(b));
        let edge_end = |edge: u32, end: usize| self.outline.edges()[edge as usize][end];
        let leaving = self.outline.leaving(point).map(|edge| (edge, edge_end(edge, 1), true));
        let arriving = self.outline.arriving(point).iter().map(|&edge| (edge, edge_end(edge, 0), false));
        let others = leaving.chain(arriving).filter(|&(_, end, _)| end != next);
        // Smaller angles than next's come first, the largest of them; then the left half, again the largest.
        let below = |end: u32| angle(end, next) == Ordering::Less;
        let candidates = others.filter(|&(_, end, _)| below(end) || end < point);
        let nearest = candidates.max_by(|a, b| below(a.1).cmp(&below(b.1)).then_with(|| angle(a.1, b.1)));
        nearest.map(|(edge, _, leaves)| (edge, leaves))
    }

    fn edge_below(&self, point: u32) -> Option<u32> {
        if self.cycles.rings().len() == 1 {
            return None; // nothing is indexed
        }
        nearest_segment_below(self.strips, self.outline.point(point), |e| self.outline.segment(e))
    }

    /// Whether the interior lies above the edge.
    fn is_rightward(&self, edge: u32) -> bool {
        let [from, to] = self.outline.edges()[edge as usize];
        from < to
    }

    /// The polygons, outermost first, then by leftmost point; `order` is that of the rings by leftmost point.
    fn build(&self, order: &[u32]) -> Region {
        let mut holes: Vec<Vec<u32>> = vec![Vec::new(); self.shells.len()];
        for &ring in order.iter().filter(|&&ring| !self.ring(ring).counter_clockwise) {
            holes[self.polygon[ring as usize] as usize].push(ring);
        }
        let mut polygons: Vec<u32> = (0..index(self.shells.len())).collect();
        polygons.sort_by_key(|&polygon| self.shells[polygon as usize].depth);
        let mut builder = RegionBuilder::default();
        for &polygon in &polygons {
            let shell = self.shells[polygon as usize];
            builder.polygon(shell.depth);
            for &ring in std::iter::once(&shell.ring).chain(&holes[polygon as usize]) {
                builder.ring(self.cycles.ids(self.ring(ring)).iter().map(|&id| self.outline.point(id)));
            }
        }
        builder.build()
    }
}
