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

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Nesting {
    /// The rings by leftmost point; of those that start in one point the lower first.
    order: Vec<u32>,
    /// Per cycle its outer ring, if it has one, and the leftmost point of all its rings.
    outer: Vec<u32>,
    leftmost: Vec<u32>,
    /// Per ring the polygon that it bounds from outside or inside.
    polygon: Vec<u32>,
    /// Per ring that is outer: the polygon around it.
    around: Vec<u32>,
    /// Per polygon the number of polygons around it.
    depth: Vec<u32>,
}

struct Nest<'a> {
    outline: &'a Outline,
    cycles: &'a Cycles,
    strips: &'a Strips,
    nesting: &'a mut Nesting,
}

/// Builds the region; the outline's edges meet in shared points only.
pub(crate) fn nest(
    outline: &Outline,
    cycles: &Cycles,
    strips: &mut Strips,
    nesting: &mut Nesting,
) -> Result<Region, Misnested> {
    if !cycles.alternate {
        return Err(Misnested);
    }
    if cycles.rings().len() > 1 {
        strips.build((0..index(outline.edges().len())).map(|e| (e, outline.segment(e))));
    }
    nesting.start(outline, cycles)?;
    let mut nest = Nest { outline, cycles, strips, nesting };
    for i in 0..nest.nesting.order.len() {
        nest.place(nest.nesting.order[i])?;
    }
    Ok(nest.build())
}

impl Nesting {
    fn start(&mut self, outline: &Outline, cycles: &Cycles) -> Result<(), Misnested> {
        let rings = cycles.rings();
        self.polygon.clear();
        self.polygon.resize(rings.len(), NONE);
        self.around.clear();
        self.around.resize(rings.len(), NONE);
        self.depth.clear();
        self.sort_rings(outline, cycles);
        self.find_outer(rings)?;
        self.find_leftmost(cycles);
        Ok(())
    }

    fn sort_rings(&mut self, outline: &Outline, cycles: &Cycles) {
        self.order.clear();
        self.order.extend(0..index(cycles.rings().len()));
        // The leftmost point, and the neighbour on the lower of the two edges there.
        let corner = |ring: u32| {
            let ring = cycles.rings()[ring as usize];
            let ids = cycles.ids(ring);
            (ids[0], if ring.counter_clockwise { ids[1] } else { ids[ids.len() - 1] })
        };
        let point = |id: u32| outline.point(id);
        self.order.sort_unstable_by(|&a, &b| {
            let (a, b) = (corner(a), corner(b));
            a.0.cmp(&b.0).then_with(|| by_angle(point(a.0), point(a.1), point(b.1)))
        });
    }

    fn find_outer(&mut self, rings: &[Ring]) -> Result<(), Misnested> {
        self.outer.clear();
        self.outer.resize(rings.last().map_or(0, |ring| ring.cycle as usize + 1), NONE);
        for (i, ring) in rings.iter().enumerate().filter(|(_, r)| r.counter_clockwise) {
            let place = &mut self.outer[ring.cycle as usize];
            if *place != NONE {
                return Err(Misnested);
            }
            *place = index(i);
        }
        Ok(())
    }

    fn find_leftmost(&mut self, cycles: &Cycles) {
        self.leftmost.clear();
        self.leftmost.resize(self.outer.len(), NONE);
        for &ring in cycles.rings() {
            let place = &mut self.leftmost[ring.cycle as usize];
            *place = cycles.ids(ring)[0].min(*place);
        }
    }
}

impl Nest<'_> {
    fn ring(&self, ring: u32) -> Ring {
        self.cycles.rings()[ring as usize]
    }

    fn place(&mut self, ring: u32) -> Result<(), Misnested> {
        if self.ring(ring).counter_clockwise {
            return self.place_outer(ring);
        }
        let outer = self.nesting.outer[self.ring(ring).cycle as usize];
        // The outer ring of a hole's own cycle starts further left, so it is placed already.
        let owner = if outer == NONE { self.ring_below_hole(ring)? } else { outer };
        self.nesting.polygon[ring as usize] = self.nesting.polygon[owner as usize];
        if self.nesting.polygon[ring as usize] == NONE { Err(Misnested) } else { Ok(()) }
    }

    fn place_outer(&mut self, ring: u32) -> Result<(), Misnested> {
        let around = match self.ring_beside_outer(ring)? {
            None => NONE,
            Some(other) if self.nesting.polygon[other as usize] == NONE => return Err(Misnested),
            Some(other) if self.ring(other).counter_clockwise => self.nesting.around[other as usize],
            Some(hole) => self.nesting.polygon[hole as usize],
        };
        let depth = if around == NONE { 0 } else { self.nesting.depth[around as usize] + 1 };
        self.nesting.polygon[ring as usize] = index(self.nesting.depth.len());
        self.nesting.around[ring as usize] = around;
        self.nesting.depth.push(depth);
        Ok(())
    }

    /// The ring that runs right below the leftmost point of a cycle of holes; its interior lies above.
    fn ring_below_hole(&self, ring: u32) -> Result<u32, Misnested> {
        let edge = self.edge_below(self.nesting.leftmost[self.ring(ring).cycle as usize]).ok_or(Misnested)?;
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

    /// The polygons, outermost first, then by leftmost point.
    fn build(&mut self) -> Region {
        let Nesting { order, polygon, depth, .. } = &mut *self.nesting;
        let rings = self.cycles.rings();
        let is_hole = |ring: u32| !rings[ring as usize].counter_clockwise;
        // Polygons are numbered by leftmost point, and `order` is too: what remains equal keeps its order.
        order.sort_by_key(|&ring| {
            let polygon = polygon[ring as usize];
            (depth[polygon as usize], polygon, is_hole(ring))
        });
        let mut builder = RegionBuilder::with_capacity(self.cycles.point_count(), rings.len());
        for &ring in order.iter() {
            if !is_hole(ring) {
                builder.polygon(depth[polygon[ring as usize] as usize]);
            }
            builder.ring(self.cycles.ids(rings[ring as usize]).iter().map(|&id| self.outline.point(id)));
        }
        builder.build()
    }
}
