//! Stage 9: which hole belongs to which outer ring, and which polygon lies in which hole.
//!
//! Rings are placed in the order of their leftmost points. A hole that was cut from the same cycle as an outer ring belongs to it;
//! for any other ring the edge right below its leftmost point tells the face that surrounds it:
//!
//! ```text
//!     the ring below    is an outer ring    is a hole
//!     a hole            of that ring        of that hole's polygon
//!     an outer ring     beside that ring    inside that hole
//! ```
//!
//! An edge below whose near side is on the wrong side of the boundary means that the rings are not nested.

use super::link::{Cycles, IncidentHalfEdge, SimpleRing, by_angle, neighbours};
use crate::base::{id::index, id::span};
use crate::boundary::outline::Outline;
use crate::predicates::lexicographic;
use crate::region::{Region, RegionBuilder};
use crate::spatial::strips::Strips;
use crate::spatial::{chains::MonotoneChains, ray_shooting::VerticalRays, slabs::SlabDecomposition};
use glam::DVec2;
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
    /// Per cycle its outer ring, if it has one, and the one of its rings that starts furthest left.
    outer: Vec<u32>,
    leftmost: Vec<u32>,
    /// Per ring the polygon that it bounds from outside or inside.
    polygon: Vec<u32>,
    /// Per ring that is outer: the polygon around it.
    around: Vec<u32>,
    /// Per polygon the number of polygons around it.
    depth: Vec<u32>,
    /// The leftmost points, of which it matters what is below them, and per ring the place of its point there.
    asked: Vec<u32>,
    question: Vec<u32>,
    below: VerticalRays,
}

struct Nest<'a> {
    outline: &'a Outline,
    cycles: &'a Cycles,
    nesting: &'a mut Nesting,
}

/// Builds the region; the outline's chains meet in their nodes only.
pub(crate) fn nest(
    outline: &Outline,
    cycles: &Cycles,
    chains: &mut MonotoneChains,
    strips: &mut Strips,
    slabs: &mut SlabDecomposition,
    nesting: &mut Nesting,
) -> Result<Region, Misnested> {
    if !cycles.alternate {
        return Err(Misnested);
    }
    let rings = cycles.rings();
    nesting.start(cycles)?;
    let mut nest = Nest { outline, cycles, nesting };
    // What is below a single ring's leftmost point is known: nothing.
    if rings.len() > 1 {
        nest.ask();
        chains.build(rings.points(), (0..rings.len()).map(|ring| span(rings.slots(ring))));
        strips.build(chains.boxes());
        let Nesting { below, asked, .. } = &mut *nest.nesting;
        below.shoot(chains, strips, slabs, rings.points(), asked);
    }
    for i in 0..nest.nesting.order.len() {
        nest.place(nest.nesting.order[i])?;
    }
    Ok(nest.build())
}

impl Nesting {
    fn start(&mut self, cycles: &Cycles) -> Result<(), Misnested> {
        let rings = cycles.about();
        self.polygon.clear();
        self.polygon.resize(rings.len(), NONE);
        self.around.clear();
        self.around.resize(rings.len(), NONE);
        self.depth.clear();
        self.asked.clear();
        self.question.clear();
        self.question.resize(rings.len(), NONE);
        self.sort_rings(cycles);
        self.find_outer(rings)?;
        self.find_leftmost(cycles);
        Ok(())
    }

    fn sort_rings(&mut self, cycles: &Cycles) {
        self.order.clear();
        self.order.extend(0..index(cycles.about().len()));
        self.order.sort_unstable_by(|&a, &b| {
            let (a, b) = (LeftmostCorner::of(cycles, a), LeftmostCorner::of(cycles, b));
            lexicographic(a.point, b.point).then_with(|| by_angle(a.point, a.lower(), b.lower()))
        });
    }

    fn find_outer(&mut self, rings: &[SimpleRing]) -> Result<(), Misnested> {
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
        for &ring in self.order.iter().rev() {
            self.leftmost[cycles.about()[ring as usize].cycle as usize] = ring;
        }
    }
}

/// The leftmost point of a ring, and its neighbours.
struct LeftmostCorner {
    point: DVec2,
    before: DVec2,
    after: DVec2,
    counter_clockwise: bool,
}

impl LeftmostCorner {
    fn of(cycles: &Cycles, ring: u32) -> LeftmostCorner {
        let SimpleRing { leftmost, counter_clockwise, .. } = cycles.about()[ring as usize];
        let points = cycles.rings().points();
        let slots = cycles.rings().slots(ring as usize);
        let [before, after] = neighbours(&slots, leftmost as usize).map(|slot| points[slot]);
        LeftmostCorner { point: points[leftmost as usize], before, after, counter_clockwise }
    }

    /// The neighbour on the lower of the two edges.
    fn lower(&self) -> DVec2 {
        if self.counter_clockwise { self.after } else { self.before }
    }
}

impl Nest<'_> {
    fn ring(&self, ring: u32) -> SimpleRing {
        self.cycles.about()[ring as usize]
    }

    /// Lists the rings whose leftmost points look for a ring below.
    fn ask(&mut self) {
        for ring in 0..index(self.cycles.about().len()) {
            let SimpleRing { cycle, counter_clockwise, .. } = self.ring(ring);
            let asks = if counter_clockwise {
                self.clockwise_neighbour(ring).is_none()
            } else {
                self.nesting.outer[cycle as usize] == NONE && self.nesting.leftmost[cycle as usize] == ring
            };
            if asks {
                self.nesting.question[ring as usize] = index(self.nesting.asked.len());
                self.nesting.asked.push(self.ring(ring).leftmost);
            }
        }
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
        let leftmost = self.nesting.leftmost[self.ring(ring).cycle as usize];
        match self.ring_below(leftmost) {
            Some((ring, true)) => Ok(ring),
            _ => Err(Misnested),
        }
    }

    /// The ring that bounds the outside of an outer ring, right below its leftmost point.
    fn ring_beside_outer(&self, ring: u32) -> Result<Option<u32>, Misnested> {
        let (other, outside) = match self.clockwise_neighbour(ring) {
            // A chain of the point itself: the outside lies on its left seen from the point.
            Some(half_edge) => (self.cycles.ring_of_chain(half_edge.chain), !half_edge.leaves),
            None => match self.ring_below(ring) {
                None => return Ok(None),
                Some((other, interior_above)) => (other, !interior_above),
            },
        };
        if outside { Ok(Some(other)) } else { Err(Misnested) }
    }

    /// Of the chains at the leftmost point of a counter-clockwise ring, the first met turning clockwise from the one
    /// that leaves along the ring, to straight down and on to straight up.
    fn clockwise_neighbour(&self, ring: u32) -> Option<IncidentHalfEdge> {
        let chain = self.ring(ring).chain;
        if chain == NONE {
            return None; // inside a chain nothing meets it
        }
        let half_edges = self.cycles.half_edges_at_start(self.outline, chain);
        let point = LeftmostCorner::of(self.cycles, ring).point;
        let end = |half_edge: IncidentHalfEdge| self.cycles.half_edge_end(self.outline, half_edge);
        let own = end(IncidentHalfEdge { chain, leaves: true, ..*half_edges.first()? });
        let first =
            half_edges.partition_point(|&half_edge| by_angle(point, end(half_edge), own) == Ordering::Less);
        let is_own = |half_edge: &IncidentHalfEdge| half_edge.chain == chain && half_edge.leaves;
        let place = first + half_edges[first..].iter().position(is_own)?;
        match place.checked_sub(1) {
            Some(before) => Some(half_edges[before]),
            None => half_edges
                .last()
                .copied()
                .filter(|&half_edge| lexicographic(end(half_edge), point) == Ordering::Less),
        }
    }

    /// The ring that runs right below the leftmost point of a ring, and whether its interior lies above.
    fn ring_below(&self, ring: u32) -> Option<(u32, bool)> {
        let rings = self.cycles.rings();
        let question = self.nesting.question[ring as usize];
        let edge = if question == NONE { None } else { self.nesting.below.edge(question as usize) }?;
        let [start, end] = [edge, edge + 1].map(|slot| rings.points()[slot as usize]);
        Some((index(rings.ring_at(edge as usize)), lexicographic(start, end) == Ordering::Less))
    }

    /// The polygons, outermost first, then by leftmost point.
    fn build(&mut self) -> Region {
        let Nesting { order, polygon, depth, .. } = &mut *self.nesting;
        let about = self.cycles.about();
        let is_hole = |ring: u32| !about[ring as usize].counter_clockwise;
        // Polygons are numbered by leftmost point, and `order` is too: what remains equal keeps its order.
        order.sort_by_key(|&ring| {
            let polygon = polygon[ring as usize];
            (depth[polygon as usize], polygon, is_hole(ring))
        });
        let rings = self.cycles.rings();
        let mut builder = RegionBuilder::with_capacity(rings.point_count(), rings.len());
        for &ring in order.iter() {
            if !is_hole(ring) {
                builder.polygon(depth[polygon[ring as usize] as usize]);
            }
            let (slots, leftmost) = (rings.slots(ring as usize), about[ring as usize].leftmost as usize);
            builder.ring([leftmost..slots.end - 1, slots.start..leftmost].map(|part| &rings.points()[part]));
        }
        builder.build()
    }
}
