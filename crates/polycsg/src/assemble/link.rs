//! Stage 8: closed walks along the boundary, split into simple rings.
//!
//! ```text
//!        a     b             Coming in from u with the interior on its left, the walk turns clockwise from the
//!         \   /              way back to u, through that interior, and takes the first chain that leaves v: here a
//!     u ───>v                if it leaves, else b. So each cycle runs around one connected interior, and two parts
//!                            that touch in v become two cycles.
//! ```
//!
//! A cycle that visits a node twice (a hole that touches its outer ring, two holes that touch) is cut there.
//!
//! A boundary has as many chains that leave a node as arrive. Should an outline be none, what leads to no ring is left out,
//! and `alternate` says so: then the rings are arranged anew.

use crate::base::meter::{Meter, Refusal, Tally};
use crate::base::parts::Numbered;
use crate::base::{id::index, sort::sort};
use crate::boundary::outline::{BoundaryChain, Outline};
use crate::predicates::{Side, lexicographic, side};
use crate::region::rings::Rings;
use glam::DVec2;
use std::{cmp::Ordering, ops::Range};

/// No chain, no place, no ring.
const NONE: u32 = u32::MAX;

/// A simple ring, and the cycle that it was cut from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimpleRing {
    pub(crate) cycle: u32,
    pub(crate) counter_clockwise: bool,
    /// The slot of its lexicographically smallest point.
    pub(crate) leftmost: u32,
    /// The chain that starts in that point, if one does.
    pub(crate) chain: u32,
}

/// A half-edge at a node where several chains leave: the end of a chain, and whether the chain leaves there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IncidentHalfEdge {
    /// The point next to the node.
    pub(crate) end: DVec2,
    pub(crate) chain: u32,
    pub(crate) leaves: bool,
}

/// All rings of an outline.
#[derive(Debug, Default)]
pub(crate) struct Cycles {
    rings: Rings,
    about: Vec<SimpleRing>,
    /// The ring that each chain belongs to.
    ring_of_chain: Vec<u32>,
    /// Whether around each node chains arrive and leave in turn, as those of a boundary do.
    pub(crate) alternate: bool,
    /// Per node a chain that leaves it.
    leaving: Vec<u32>,
    /// The nodes where several leave, and per node its number among them; empty where there are none.
    crowded: Vec<u32>,
    crowd: Vec<u32>,
    /// The chains at those nodes, by node and angle, and where those of each start.
    half_edges: Vec<IncidentHalfEdge>,
    starts: Vec<u32>,
    /// Per chain the one behind it; none once it was walked.
    next: Vec<u32>,
    cut: Cut,
}

/// The walk so far: chains without a repeated node.
#[derive(Debug, Default)]
struct Cut {
    /// Per node its place in the path, or none.
    depth: Vec<u32>,
    path: Vec<u32>,
}

impl Cut {
    /// Appends a chain; where it comes back to a node of the path, what lies from that place on is a ring.
    fn visit(&mut self, outline: &Outline, chain: u32) -> Option<usize> {
        let about = outline.chains()[chain as usize];
        self.depth[about.start as usize] = index(self.path.len());
        self.path.push(chain);
        let depth = self.depth[about.end as usize];
        (depth != NONE).then_some(depth as usize)
    }

    /// Forgets a path that led to no ring.
    fn leave_out(&mut self, outline: &Outline) {
        for chain in self.path.drain(..) {
            self.depth[outline.chains()[chain as usize].start as usize] = NONE;
        }
    }
}

impl Cycles {
    /// The points of all rings.
    pub(crate) fn rings(&self) -> &Rings {
        &self.rings
    }

    pub(crate) fn about(&self) -> &[SimpleRing] {
        &self.about
    }

    pub(crate) fn ring_of_chain(&self, chain: u32) -> u32 {
        self.ring_of_chain[chain as usize]
    }

    /// The chains at the start of a chain, by angle; none where only one leaves.
    pub(crate) fn half_edges_at_start(&self, outline: &Outline, chain: u32) -> &[IncidentHalfEdge] {
        match self.crowd.get(outline.chains()[chain as usize].start as usize) {
            None | Some(&NONE) => &[],
            Some(&crowd) => &self.half_edges[self.span(crowd as usize)],
        }
    }

    fn span(&self, crowd: usize) -> Range<usize> {
        self.starts[crowd] as usize..self.starts[crowd + 1] as usize
    }

    /// Walks all chains and cuts the walks into rings.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn link(&mut self, outline: &Outline, meter: &Meter<'_>) -> Result<&Cycles, Refusal> {
        self.rings.clear();
        self.about.clear();
        self.ring_of_chain.clear();
        self.ring_of_chain.resize(outline.chains().len(), NONE);
        self.find_successors(outline, meter)?;
        self.cut.path.clear();
        self.cut.depth.clear();
        self.cut.depth.resize(outline.node_count(), NONE);
        let (mut cycle, mut tally) = (0, meter.tally());
        for first in 0..outline.chains().len() {
            if self.next[first] == NONE {
                continue;
            }
            let mut chain = index(first);
            while self.next[chain as usize] != NONE {
                tally.add(1)?;
                if let Some(depth) = self.cut.visit(outline, chain) {
                    self.close_ring(outline, depth, cycle);
                }
                chain = std::mem::replace(&mut self.next[chain as usize], NONE);
            }
            if !self.cut.path.is_empty() {
                self.alternate = false;
                self.cut.leave_out(outline);
            }
            cycle += 1;
        }
        Ok(self)
    }

    /// Finds the chain that comes after each one by the turn rule.
    fn find_successors(&mut self, outline: &Outline, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.leaving.clear();
        self.leaving.resize(outline.node_count(), NONE);
        self.crowded.clear();
        meter.for_each(Numbered(outline.chains()), |(chain, about)| {
            if std::mem::replace(&mut self.leaving[about.start as usize], chain) != NONE {
                self.crowded.push(about.start);
            }
        })?;
        self.next.clear();
        let next = outline.chains().iter().map(|about| self.leaving[about.end as usize]);
        meter.extend(&mut self.next, next)?;
        self.crowd.clear();
        self.alternate = !self.next.contains(&NONE);
        if self.crowded.is_empty() { Ok(()) } else { self.gather_half_edges(outline, meter) }
    }

    /// Pairs the chains where several leave a node.
    fn gather_half_edges(&mut self, outline: &Outline, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.number_crowds(outline, meter)?;
        let ends = |about: &BoundaryChain| [(about.start, true), (about.end, false)];
        let empty = IncidentHalfEdge { end: DVec2::ZERO, chain: NONE, leaves: false };
        meter.fill(&mut self.half_edges, empty, self.starts.last().copied().unwrap_or(0) as usize)?;
        meter.for_each(Numbered(outline.chains()), |(chain, about)| {
            for (node, leaves) in ends(about) {
                let crowd = self.crowd[node as usize];
                if crowd != NONE {
                    let end = self.end(outline, chain, leaves);
                    let place = &mut self.starts[crowd as usize + 1];
                    self.half_edges[*place as usize] = IncidentHalfEdge { end, chain, leaves };
                    *place += 1;
                }
            }
        })?;
        let mut tally = meter.tally();
        let mut half_edges = std::mem::take(&mut self.half_edges);
        for crowd in 0..self.starts.len() - 2 {
            let pivot = outline.points(self.leaving[self.crowded[crowd] as usize])[0];
            self.alternate &= self.pair_by_angle(pivot, &mut half_edges[self.span(crowd)], &mut tally)?;
        }
        self.half_edges = half_edges;
        Ok(())
    }

    /// Numbers the nodes where several chains leave, and counts their half-edges: those of the one before end at
    /// `starts[crowd + 1]`, which moves on as they are listed.
    fn number_crowds(&mut self, outline: &Outline, meter: &Meter<'_>) -> Result<(), Refusal> {
        let (crowd, mut count) = (&mut self.crowd, 0);
        crowd.resize(outline.node_count(), NONE);
        self.crowded.retain(|&node| {
            let is_new = crowd[node as usize] == NONE;
            if is_new {
                crowd[node as usize] = count;
                count += 1;
            }
            is_new
        });
        self.starts.clear();
        self.starts.resize(count as usize + 2, 0);
        meter.for_each(outline.chains(), |about| {
            for node in [about.start, about.end] {
                let crowd = self.crowd[node as usize];
                if crowd != NONE {
                    self.starts[crowd as usize + 2] += 1;
                }
            }
        })?;
        for crowd in 2..self.starts.len() {
            self.starts[crowd] += self.starts[crowd - 1];
        }
        Ok(())
    }

    /// Follows each arriving chain by the first leaving one clockwise; false where two in a row arrive or leave.
    fn pair_by_angle(
        &mut self,
        pivot: DVec2,
        around: &mut [IncidentHalfEdge],
        tally: &mut Tally<'_>,
    ) -> Result<bool, Refusal> {
        tally.add(around.len())?;
        let order = |a: &IncidentHalfEdge, b: &IncidentHalfEdge| {
            by_angle(pivot, a.end, b.end).then((a.chain, a.leaves).cmp(&(b.chain, b.leaves)))
        };
        sort(around, order, tally.meter())?;
        let alternate = (0..around.len()).all(|i| {
            let (half_edge, before) = (around[i], around[if i == 0 { around.len() - 1 } else { i - 1 }]);
            if !half_edge.leaves {
                self.next[half_edge.chain as usize] = before.chain;
            }
            half_edge.leaves != before.leaves
        });
        if !alternate {
            let (leaving, arriving): (Vec<IncidentHalfEdge>, Vec<IncidentHalfEdge>) =
                around.iter().partition(|half_edge| half_edge.leaves);
            let leaving = leaving.iter().map(|half_edge| half_edge.chain).chain(std::iter::repeat(NONE));
            arriving
                .iter()
                .zip(leaving)
                .for_each(|(half_edge, next)| self.next[half_edge.chain as usize] = next);
        }
        Ok(alternate)
    }

    /// The point of a chain next to its start or to its end; any other where nothing leaves that.
    fn end(&self, outline: &Outline, chain: u32, at_start: bool) -> DVec2 {
        match (at_start, outline.points(chain)) {
            (true, &[_, next, ..]) => next,
            (true, points) => match self.next[chain as usize] {
                NONE if points[0] == DVec2::MAX => DVec2::MIN,
                NONE => DVec2::MAX,
                next => outline.points(next)[0],
            },
            (false, points) => points[points.len() - 1],
        }
    }

    /// Moves the path's chains from `depth` on to a ring of their own.
    fn close_ring(&mut self, outline: &Outline, depth: usize, cycle: u32) {
        for &chain in &self.cut.path[depth..] {
            self.cut.depth[outline.chains()[chain as usize].start as usize] = NONE;
            self.ring_of_chain[chain as usize] = index(self.about.len());
            self.rings.extend(outline.points(chain));
        }
        self.rings.close();
        let ring = self.rings.slots(self.about.len());
        let points = self.rings.points();
        let is_left_of = |a: usize, b: usize| lexicographic(points[a], points[b]) == Ordering::Less;
        let leftmost = (ring.start + 1..ring.end - 1)
            .fold(ring.start, |best, slot| if is_left_of(slot, best) { slot } else { best });
        let mut start = ring.start;
        let starts_leftmost = |chain: &u32| {
            let place = start;
            start += outline.points(*chain).len();
            place == leftmost
        };
        let chain = self.cut.path.drain(depth..).find(starts_leftmost).unwrap_or(NONE);
        // The turn at the lexicographically smallest point is that of the whole ring.
        let [before, after] = neighbours(&ring, leftmost).map(|slot| points[slot]);
        let counter_clockwise = side(before, points[leftmost], after) == Side::Left;
        self.about.push(SimpleRing { cycle, counter_clockwise, leftmost: index(leftmost), chain });
    }
}

/// The slots of the points before and behind one of a closed ring's.
pub(crate) fn neighbours(ring: &Range<usize>, slot: usize) -> [usize; 2] {
    [if slot == ring.start { ring.end - 2 } else { slot - 1 }, slot + 1]
}

/// The order of two directions by angle in (-90°, 270°].
pub(crate) fn by_angle(pivot: DVec2, a: DVec2, b: DVec2) -> Ordering {
    let leftward = |p: DVec2| lexicographic(pivot, p) == Ordering::Greater;
    leftward(a).cmp(&leftward(b)).then_with(|| match side(pivot, a, b) {
        Side::Left => Ordering::Less,
        Side::On => Ordering::Equal,
        Side::Right => Ordering::Greater,
    })
}
