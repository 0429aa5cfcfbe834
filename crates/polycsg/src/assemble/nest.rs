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
use crate::base::meter::{Meter, Refusal};
use crate::base::{id::index, id::span, sort::sort};
use crate::boundary::outline::Outline;
use crate::predicates::lexicographic;
use crate::region::{Region, RegionBuilder, rings::Rings};
use crate::spatial::strips::Strips;
use crate::spatial::{chains::MonotoneChains, ray_shooting::VerticalRays, slabs::SlabDecomposition};
use glam::DVec2;
use std::cmp::Ordering;

/// Why there is no region.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unnested {
    /// The rings are no boundary: some lies on the wrong side of another, or edges around a point do not alternate.
    Misnested,
    /// By the limits of the call.
    Refused(Refusal),
}

impl From<Refusal> for Unnested {
    fn from(refusal: Refusal) -> Unnested {
        Unnested::Refused(refusal)
    }
}

/// No polygon.
const NONE: u32 = u32::MAX;

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Nesting {
    /// The rings by leftmost point; of those that start in one point the lower first.
    corners: Vec<LeftmostCorner>,
    /// Per cycle its outer ring, if it has one, and the one of its rings that starts furthest left.
    outer: Vec<u32>,
    leftmost: Vec<u32>,
    places: Vec<RingPlace>,
    /// Per polygon the number of polygons around it.
    depth: Vec<u32>,
    /// The leftmost points of which it matters what is below them.
    asked: Vec<u32>,
    below: VerticalRays,
}

/// Where a ring lies.
#[derive(Clone, Copy, Debug)]
struct RingPlace {
    /// The polygon that it bounds from outside or inside.
    polygon: u32,
    /// If it is outer: the polygon around it.
    around: u32,
    beside: Beside,
}

/// What the place of a ring depends on.
#[derive(Clone, Copy, Debug)]
enum Beside {
    /// Another ring of its cycle.
    Cycle,
    /// A ring through its leftmost point, and whether the outside is to that one's left.
    Ring(u32, bool),
    /// What is below its leftmost point, as the place of the question.
    Below(u32),
}

/// The leftmost point of a ring, and the neighbour on the lower of the two edges there.
#[derive(Clone, Copy, Debug)]
struct LeftmostCorner {
    point: DVec2,
    lower: DVec2,
    ring: u32,
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
    meter: &Meter<'_>,
) -> Result<Region, Unnested> {
    let rings = cycles.rings();
    if !cycles.alternate {
        return Err(Unnested::Misnested);
    }
    match cycles.about() {
        [] => return Ok(Region::default()),
        // A single ring has nothing around it and nothing in it.
        [single] => {
            return if single.counter_clockwise {
                Ok(nest_single(rings, single))
            } else {
                Err(Unnested::Misnested)
            };
        }
        _ => {}
    }
    nesting.start(cycles, meter)?;
    let mut nest = Nest { outline, cycles, nesting };
    nest.ask(meter)?;
    chains.cut_to_runs(rings.points(), (0..rings.len()).map(|ring| span(rings.slots(ring))), meter)?;
    strips.build(chains.boxes(), meter)?;
    let Nesting { below, asked, .. } = &mut *nest.nesting;
    below.shoot(chains, strips, slabs, rings.points(), asked, meter)?;
    let mut tally = meter.tally();
    for i in 0..nest.nesting.corners.len() {
        tally.add(1)?;
        nest.place(nest.nesting.corners[i].ring)?;
    }
    Ok(nest.build(meter)?)
}

fn nest_single(rings: &Rings, single: &SimpleRing) -> Region {
    let mut builder = RegionBuilder::with_capacity(rings.point_count(), 1);
    builder.ring(from_leftmost(rings, 0, single));
    builder.build()
}

impl Nesting {
    fn start(&mut self, cycles: &Cycles, meter: &Meter<'_>) -> Result<(), Unnested> {
        self.places.clear();
        self.depth.clear();
        self.asked.clear();
        self.corners.clear();
        let corners = (0..index(cycles.about().len())).map(|ring| LeftmostCorner::of(cycles, ring));
        meter.extend(&mut self.corners, corners)?;
        sort(&mut self.corners, LeftmostCorner::order, meter)?;
        self.find_outer(cycles.about())?;
        self.find_leftmost(cycles);
        Ok(())
    }

    fn find_outer(&mut self, rings: &[SimpleRing]) -> Result<(), Unnested> {
        self.outer.clear();
        self.outer.resize(rings.last().map_or(0, |ring| ring.cycle as usize + 1), NONE);
        for (i, ring) in rings.iter().enumerate().filter(|(_, r)| r.counter_clockwise) {
            let place = &mut self.outer[ring.cycle as usize];
            if *place != NONE {
                return Err(Unnested::Misnested);
            }
            *place = index(i);
        }
        Ok(())
    }

    fn find_leftmost(&mut self, cycles: &Cycles) {
        self.leftmost.clear();
        self.leftmost.resize(self.outer.len(), NONE);
        for corner in self.corners.iter().rev() {
            self.leftmost[cycles.about()[corner.ring as usize].cycle as usize] = corner.ring;
        }
    }
}

impl LeftmostCorner {
    fn of(cycles: &Cycles, ring: u32) -> LeftmostCorner {
        let SimpleRing { leftmost, counter_clockwise, .. } = cycles.about()[ring as usize];
        let points = cycles.rings().points();
        let [before, after] = neighbours(&cycles.rings().slots(ring as usize), leftmost as usize);
        let lower = points[if counter_clockwise { after } else { before }];
        LeftmostCorner { point: points[leftmost as usize], lower, ring }
    }

    /// The order by leftmost point; of those with one point the lower first.
    fn order(&self, other: &LeftmostCorner) -> Ordering {
        let by_place = lexicographic(self.point, other.point);
        by_place.then_with(|| by_angle(self.point, self.lower, other.lower))
    }
}

/// The points of a ring from its leftmost one on, in two parts.
fn from_leftmost<'r>(rings: &'r Rings, ring: usize, about: &SimpleRing) -> [&'r [DVec2]; 2] {
    let (slots, leftmost) = (rings.slots(ring), about.leftmost as usize);
    [leftmost..slots.end - 1, slots.start..leftmost].map(|part| &rings.points()[part])
}

impl Nest<'_> {
    fn ring(&self, ring: u32) -> SimpleRing {
        self.cycles.about()[ring as usize]
    }

    /// Finds what the place of each ring depends on.
    fn ask(&mut self, meter: &Meter<'_>) -> Result<(), Refusal> {
        meter.for_each(0..index(self.cycles.about().len()), |ring| {
            let beside = self.beside(ring);
            if let Beside::Below(_) = beside {
                self.nesting.asked.push(self.ring(ring).leftmost);
            }
            self.nesting.places.push(RingPlace { polygon: NONE, around: NONE, beside });
        })
    }

    fn beside(&self, ring: u32) -> Beside {
        let SimpleRing { cycle, counter_clockwise, .. } = self.ring(ring);
        let below = Beside::Below(index(self.nesting.asked.len()));
        if counter_clockwise {
            // A chain of the leftmost point itself: the outside lies on its left seen from the point.
            return self.clockwise_neighbour(ring).map_or(below, |half_edge| {
                Beside::Ring(self.cycles.ring_of_chain(half_edge.chain), !half_edge.leaves)
            });
        }
        let has_outer = self.nesting.outer[cycle as usize] != NONE;
        if has_outer || self.nesting.leftmost[cycle as usize] != ring { Beside::Cycle } else { below }
    }

    fn place(&mut self, ring: u32) -> Result<(), Unnested> {
        if self.ring(ring).counter_clockwise {
            return self.place_outer(ring);
        }
        let outer = self.nesting.outer[self.ring(ring).cycle as usize];
        // The outer ring of a hole's own cycle starts further left, so it is placed already.
        let owner = if outer == NONE { self.ring_below_hole(ring)? } else { outer };
        let polygon = self.nesting.places[owner as usize].polygon;
        self.nesting.places[ring as usize].polygon = polygon;
        if polygon == NONE { Err(Unnested::Misnested) } else { Ok(()) }
    }

    fn place_outer(&mut self, ring: u32) -> Result<(), Unnested> {
        let around = match self.ring_beside_outer(ring)? {
            None => NONE,
            Some(other) => match self.nesting.places[other as usize] {
                RingPlace { polygon: NONE, .. } => return Err(Unnested::Misnested),
                RingPlace { around, .. } if self.ring(other).counter_clockwise => around,
                RingPlace { polygon, .. } => polygon,
            },
        };
        let depth = if around == NONE { 0 } else { self.nesting.depth[around as usize] + 1 };
        let place = &mut self.nesting.places[ring as usize];
        (place.polygon, place.around) = (index(self.nesting.depth.len()), around);
        self.nesting.depth.push(depth);
        Ok(())
    }

    /// The ring that runs right below the leftmost point of a cycle of holes; its interior lies above.
    fn ring_below_hole(&self, ring: u32) -> Result<u32, Unnested> {
        let leftmost = self.nesting.leftmost[self.ring(ring).cycle as usize];
        match self.ring_below(leftmost) {
            Some((ring, true)) => Ok(ring),
            _ => Err(Unnested::Misnested),
        }
    }

    /// The ring that bounds the outside of an outer ring, right below its leftmost point.
    fn ring_beside_outer(&self, ring: u32) -> Result<Option<u32>, Unnested> {
        let (other, outside) = match self.nesting.places[ring as usize].beside {
            Beside::Ring(other, outside) => (other, outside),
            _ => match self.ring_below(ring) {
                None => return Ok(None),
                Some((other, interior_above)) => (other, !interior_above),
            },
        };
        if outside { Ok(Some(other)) } else { Err(Unnested::Misnested) }
    }

    /// Of the chains at the leftmost point of a counter-clockwise ring, the first met turning clockwise from the one
    /// that leaves along the ring, to straight down and on to straight up.
    fn clockwise_neighbour(&self, ring: u32) -> Option<IncidentHalfEdge> {
        let chain = self.ring(ring).chain;
        if chain == NONE {
            return None; // inside a chain nothing meets it
        }
        let half_edges = self.cycles.half_edges_at_start(self.outline, chain);
        let SimpleRing { leftmost, .. } = self.ring(ring);
        let points = self.cycles.rings().points();
        let (point, own) = (points[leftmost as usize], points[leftmost as usize + 1]);
        let first = half_edges.partition_point(|other| by_angle(point, other.end, own) == Ordering::Less);
        let is_own = |half_edge: &IncidentHalfEdge| half_edge.chain == chain && half_edge.leaves;
        let place = first + half_edges[first..].iter().position(is_own)?;
        match place.checked_sub(1) {
            Some(before) => Some(half_edges[before]),
            None => {
                half_edges.last().copied().filter(|other| lexicographic(other.end, point) == Ordering::Less)
            }
        }
    }

    /// The ring that runs right below the leftmost point of a ring, and whether its interior lies above.
    fn ring_below(&self, ring: u32) -> Option<(u32, bool)> {
        let Beside::Below(question) = self.nesting.places[ring as usize].beside else { return None };
        let rings = self.cycles.rings();
        let edge = self.nesting.below.edge(question as usize)?;
        let [start, end] = [edge, edge + 1].map(|slot| rings.points()[slot as usize]);
        Some((index(rings.ring_at(edge as usize)), lexicographic(start, end) == Ordering::Less))
    }

    /// The polygons, outermost first, then by leftmost point.
    fn build(&mut self, meter: &Meter<'_>) -> Result<Region, Refusal> {
        let Nesting { corners, places, depth, .. } = &mut *self.nesting;
        let about = self.cycles.about();
        let is_hole = |ring: u32| !about[ring as usize].counter_clockwise;
        // Polygons are numbered by leftmost point, and so are the holes of each.
        let place = |&LeftmostCorner { ring, .. }: &LeftmostCorner| {
            let polygon = places[ring as usize].polygon;
            (depth[polygon as usize], polygon, is_hole(ring))
        };
        sort(corners, |a, b| place(a).cmp(&place(b)).then_with(|| a.order(b)), meter)?;
        let rings = self.cycles.rings();
        let mut builder = RegionBuilder::with_capacity(rings.point_count(), rings.len());
        let mut tally = meter.tally();
        for &LeftmostCorner { ring, .. } in corners.iter() {
            if !is_hole(ring) {
                builder.polygon(depth[places[ring as usize].polygon as usize]);
            }
            let parts = from_leftmost(rings, ring as usize, &about[ring as usize]);
            tally.add(1 + parts[0].len() + parts[1].len())?;
            builder.ring(parts);
        }
        Ok(builder.build())
    }
}
