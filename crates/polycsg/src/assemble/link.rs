//! Stage 8: closed walks along the boundary, split into simple rings.
//!
//! ```text
//!        a     b             Coming in from u with the interior on its left, the walk turns clockwise from the
//!         \   /              way back to u, through that interior, and takes the first stroke that leaves v: here a
//!     u ───>v                if it leaves, else b. So each cycle runs around one connected interior, and two parts
//!                            that touch in v become two cycles.
//! ```
//!
//! A cycle that visits a node twice (a hole that touches its outer ring, two holes that touch) is cut there.

use crate::base::id::index;
use crate::boundary::outline::Outline;
use crate::predicates::{Side, lexicographic, side};
use crate::region::rings::Rings;
use glam::DVec2;
use std::cmp::Ordering;
use std::ops::Range;

/// No stroke, no place, no ring.
const NONE: u32 = u32::MAX;

/// A simple ring, and the cycle that it was cut from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimpleRing {
    pub(crate) cycle: u32,
    pub(crate) counter_clockwise: bool,
    /// The slot of its lexicographically smallest point.
    pub(crate) leftmost: u32,
    /// The stroke that starts in that point, if one does.
    pub(crate) stroke: u32,
}

/// A stroke at a node where several leave: whether it leaves, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct IncidentHalfEdge {
    pub(crate) node: u32,
    pub(crate) stroke: u32,
    pub(crate) leaves: bool,
}

/// All rings of an outline.
#[derive(Debug, Default)]
pub(crate) struct Cycles {
    rings: Rings,
    about: Vec<SimpleRing>,
    /// The ring that each stroke belongs to.
    ring_of_stroke: Vec<u32>,
    /// Whether around each node strokes arrive and leave in turn, as those of a boundary do.
    pub(crate) alternate: bool,
    /// The strokes at nodes where several leave, by node and angle.
    spokes: Vec<IncidentHalfEdge>,
    /// Per node a stroke that leaves it.
    leaving: Vec<u32>,
    next: Vec<u32>,
    walked: Vec<bool>,
    cut: Cut,
}

/// The walk so far, as a chain of strokes without a repeated node.
#[derive(Debug, Default)]
struct Cut {
    /// Per node its place in the chain, or none.
    depth: Vec<u32>,
    chain: Vec<u32>,
}

impl Cut {
    /// Appends a stroke; where it comes back to a node of the chain, what lies from that place on is a ring.
    fn visit(&mut self, outline: &Outline, stroke: u32) -> Option<usize> {
        let about = outline.strokes()[stroke as usize];
        self.depth[about.start as usize] = index(self.chain.len());
        self.chain.push(stroke);
        let depth = self.depth[about.end as usize];
        (depth != NONE).then_some(depth as usize)
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

    pub(crate) fn ring_of_stroke(&self, stroke: u32) -> u32 {
        self.ring_of_stroke[stroke as usize]
    }

    /// The strokes at the start of a stroke, by angle; none where only one leaves.
    pub(crate) fn spokes_at_start(&self, outline: &Outline, stroke: u32) -> &[IncidentHalfEdge] {
        let node = outline.strokes()[stroke as usize].start;
        let start = self.spokes.partition_point(|spoke| spoke.node < node);
        let count = self.spokes[start..].partition_point(|spoke| spoke.node == node);
        &self.spokes[start..start + count]
    }

    /// Walks all strokes and cuts the walks into rings.
    pub(crate) fn link(&mut self, outline: &Outline) -> &Cycles {
        self.reset(outline);
        self.find_successors(outline);
        let mut cycle = 0;
        for first in 0..index(outline.strokes().len()) {
            if self.walked[first as usize] {
                continue;
            }
            let mut stroke = first;
            while !self.walked[stroke as usize] {
                self.walked[stroke as usize] = true;
                if let Some(depth) = self.cut.visit(outline, stroke) {
                    self.close_ring(outline, depth, cycle);
                }
                stroke = self.next[stroke as usize];
            }
            cycle += 1;
        }
        self
    }

    fn reset(&mut self, outline: &Outline) {
        let (strokes, nodes) = (outline.strokes().len(), outline.node_count());
        self.rings.clear();
        self.about.clear();
        self.ring_of_stroke.clear();
        self.ring_of_stroke.resize(strokes, NONE);
        self.next.clear();
        self.next.resize(strokes, NONE);
        self.walked.clear();
        self.walked.resize(strokes, false);
        self.leaving.clear();
        self.leaving.resize(nodes, NONE);
        self.cut.chain.clear();
        self.cut.depth.clear();
        self.cut.depth.resize(nodes, NONE);
    }

    /// Finds the stroke that follows each stroke by the turn rule.
    fn find_successors(&mut self, outline: &Outline) {
        self.spokes.clear();
        for (stroke, about) in (0..).zip(outline.strokes()) {
            let leaving = &mut self.leaving[about.start as usize];
            if *leaving != NONE {
                self.spokes.push(IncidentHalfEdge { node: about.start, stroke, leaves: true });
            }
            *leaving = stroke;
        }
        self.alternate = true;
        if !self.spokes.is_empty() {
            self.gather_spokes(outline);
        }
        for (next, about) in self.next.iter_mut().zip(outline.strokes()).filter(|(next, _)| **next == NONE) {
            *next = self.leaving[about.end as usize];
        }
    }

    /// Pairs the strokes where several leave a node.
    fn gather_spokes(&mut self, outline: &Outline) {
        let mut crowded: Vec<u32> = self.spokes.iter().map(|spoke| spoke.node).collect();
        crowded.sort_unstable();
        crowded.dedup();
        self.spokes.clear();
        for (stroke, about) in (0..).zip(outline.strokes()) {
            for (node, leaves) in [(about.start, true), (about.end, false)] {
                if crowded.binary_search(&node).is_ok() {
                    self.spokes.push(IncidentHalfEdge { node, stroke, leaves });
                }
            }
        }
        self.spokes.sort_unstable_by_key(|spoke| spoke.node);
        let mut spokes = std::mem::take(&mut self.spokes);
        for around in spokes.chunk_by_mut(|a, b| a.node == b.node) {
            self.alternate &= self.pair_by_angle(outline, around);
        }
        self.spokes = spokes;
    }

    /// Follows each arriving stroke by the first leaving one clockwise; false where two in a row arrive or leave.
    fn pair_by_angle(&mut self, outline: &Outline, around: &mut [IncidentHalfEdge]) -> bool {
        let pivot = self.node_point(outline, around[0].node);
        around.sort_unstable_by(|&a, &b| {
            by_angle(pivot, self.spoke_end(outline, a), self.spoke_end(outline, b))
                .then((a.stroke, a.leaves).cmp(&(b.stroke, b.leaves)))
        });
        let alternate = (0..around.len()).all(|i| {
            let (spoke, before) = (around[i], around[if i == 0 { around.len() - 1 } else { i - 1 }]);
            if !spoke.leaves {
                self.next[spoke.stroke as usize] = before.stroke;
            }
            spoke.leaves != before.leaves
        });
        if !alternate {
            let (leaving, arriving): (Vec<IncidentHalfEdge>, Vec<IncidentHalfEdge>) =
                around.iter().partition(|spoke| spoke.leaves);
            arriving.iter().zip(leaving).for_each(|(a, l)| self.next[a.stroke as usize] = l.stroke);
        }
        alternate
    }

    fn node_point(&self, outline: &Outline, node: u32) -> DVec2 {
        outline.points(self.leaving[node as usize])[0]
    }

    /// The point next to the node on a stroke.
    pub(crate) fn spoke_end(&self, outline: &Outline, spoke: IncidentHalfEdge) -> DVec2 {
        let points = outline.points(spoke.stroke);
        match (spoke.leaves, points.len()) {
            (true, 1) => self.node_point(outline, outline.strokes()[spoke.stroke as usize].end),
            (true, _) => points[1],
            (false, count) => points[count - 1],
        }
    }

    /// Moves the chain's strokes from `depth` on to a ring of their own.
    fn close_ring(&mut self, outline: &Outline, depth: usize, cycle: u32) {
        let start = self.rings.points().len();
        let mut strokes = 0..0;
        let mut smallest = (DVec2::MAX, NONE, NONE);
        for stroke in self.cut.chain.drain(depth..) {
            self.cut.depth[outline.strokes()[stroke as usize].start as usize] = NONE;
            self.ring_of_stroke[stroke as usize] = index(self.about.len());
            let points = outline.points(stroke);
            strokes = strokes.end..strokes.end + points.len();
            for (i, &point) in points.iter().enumerate() {
                if lexicographic(point, smallest.0) == Ordering::Less || smallest.1 == NONE {
                    smallest = (point, index(start + strokes.start + i), if i == 0 { stroke } else { NONE });
                }
            }
            self.rings.extend(points);
        }
        self.rings.close();
        let ring = self.rings.slots(self.about.len());
        // The turn at the lexicographically smallest point is that of the whole ring.
        let [before, after] = neighbours(&ring, smallest.1 as usize).map(|slot| self.rings.points()[slot]);
        let counter_clockwise = side(before, smallest.0, after) == Side::Left;
        self.about.push(SimpleRing { cycle, counter_clockwise, leftmost: smallest.1, stroke: smallest.2 });
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
