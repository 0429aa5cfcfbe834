//! Where an outline does not nest: the edges of it that separate winding number 0 from 1.
//!
//! Rounding may carry a tiny ring over an edge that it never touches, or lay edges onto one another. What is left then is read as
//! the set that is wound around a positive number of times. Edges meet in their ends only, so that all winding numbers of
//! a connected component follow from one by going around its nodes:
//!
//! ```text
//!          w + 1 \ w           Seen counter-clockwise around a node, the number grows by one where an edge leaves,
//!                 \            and falls by one where an edge arrives.
//!      w + 1 ──────o
//!            w
//! ```
//!
//! The leftmost node of a component lies in the face right above the edge below it, which is part of another component, further left.

use super::link::by_angle;
use crate::base::meter::{Meter, Refusal, Tally};
use crate::base::{id::index, id::span, sort::sort, union_find::UnionFind};
use crate::boundary::outline::{BoundaryChain, Outline};
use crate::region::rings::{Rings, ring_edges};
use crate::spatial::{
    chains::MonotoneChains, ray_shooting::VerticalRays, slabs::SlabDecomposition, strips::Strips,
};
use std::{cmp::Ordering, ops::Range};

/// Not known yet.
const UNKNOWN: i32 = i32::MIN;

/// One of the ends of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
struct EdgeEnd {
    edge: u32,
    leaves: bool,
}

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct PositiveEdges {
    /// By node, and by angle around it; and where those of each node start.
    ends: Vec<EdgeEnd>,
    starts: Vec<u32>,
    /// Per edge the winding number on its right.
    right: Vec<i32>,
    components: UnionFind,
    /// The leftmost node of each component, and a slot of its in the rings.
    leftmost: Vec<[u32; 2]>,
    below: VerticalRays,
    /// The nodes that were gone around, and the ends of edges through which others are reached.
    is_done: Vec<bool>,
    open: Vec<EdgeEnd>,
}

impl PositiveEdges {
    /// Reduces an outline, by the rings that it was linked to, to the boundary of what these wind around a positive number of times.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn reduce(
        &mut self,
        outline: &mut Outline,
        rings: &Rings,
        (chains, strips, slabs): (&mut MonotoneChains, &mut Strips, &mut SlabDecomposition),
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        // The i-th edge of the rings is the i-th chain, and nodes are numbered from left to right.
        outline.build(rings.iter().flat_map(ring_edges), false, meter)?;
        self.gather(outline, meter)?;
        self.find_leftmost(outline, rings, meter)?;
        chains.build(rings.points(), (0..rings.len()).map(|ring| span(rings.slots(ring))), meter)?;
        strips.build(chains.boxes(), meter)?;
        let slots: Vec<u32> = self.leftmost.iter().map(|&[_, slot]| slot).collect();
        self.below.shoot(chains, strips, slabs, rings.points(), &slots, meter)?;
        let mut tally = meter.tally();
        for component in 0..self.leftmost.len() {
            let outside = self
                .below
                .edge(component)
                .map_or(0, |slot| self.above(outline, slot - index(rings.ring_at(slot as usize))));
            self.label(outline, self.leftmost[component][0], outside, &mut tally)?;
        }
        outline.retain(|edge| self.right[edge as usize] == 0);
        Ok(())
    }

    /// Sorts the ends of edges around each node.
    fn gather(&mut self, outline: &Outline, meter: &Meter<'_>) -> Result<(), Refusal> {
        let ends = |edge: u32| [true, false].map(|leaves| EdgeEnd { edge, leaves });
        let all = (0..index(outline.chains().len())).flat_map(ends);
        self.starts.clear();
        self.starts.resize(outline.node_count() + 2, 0);
        meter.for_all(all.clone(), |end| {
            self.starts[outline.node(end.edge, end.leaves) as usize + 2] += 1;
        })?;
        for node in 2..self.starts.len() {
            self.starts[node] += self.starts[node - 1];
        }
        self.right.clear();
        self.right.resize(outline.chains().len(), UNKNOWN);
        self.is_done.clear();
        self.is_done.resize(outline.node_count(), false);
        meter.fill(&mut self.ends, EdgeEnd { edge: 0, leaves: false }, 2 * outline.chains().len())?;
        meter.for_all(all, |end| {
            let place = &mut self.starts[outline.node(end.edge, end.leaves) as usize + 1];
            self.ends[*place as usize] = end;
            *place += 1;
        })?;
        let mut tally = meter.tally();
        (0..index(outline.node_count())).try_for_each(|node| {
            let around = self.around(node);
            tally.add(around.len())?;
            sort(&mut self.ends[around], |a, b| by_angle_and_side(outline, node, *a, *b), meter)
        })
    }

    fn around(&self, node: u32) -> Range<usize> {
        self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize
    }

    fn find_leftmost(&mut self, outline: &Outline, rings: &Rings, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.components.reset(outline.node_count());
        meter.for_each(outline.chains(), |edge| self.components.join(edge.start, edge.end))?;
        let slots = (0..rings.len()).flat_map(|ring| span(rings.slots(ring)).take(rings.ring(ring).len()));
        let starts = outline.chains().iter().zip(slots).map(|(edge, slot)| [edge.start, slot]);
        self.leftmost.clear();
        meter.for_all(starts, |start| {
            self.leftmost.extend((self.components.find(start[0]) == start[0]).then_some(start));
        })?;
        sort(&mut self.leftmost, Ord::cmp, meter)?;
        self.leftmost.dedup_by_key(|pair| pair[0]);
        Ok(())
    }

    /// The winding number right above an edge, of those that coincide with it the last.
    fn above(&self, outline: &Outline, edge: u32) -> i32 {
        let BoundaryChain { start, end, .. } = outline.chains()[edge as usize];
        let (left, right) = (start.min(end), start.max(end));
        let mut around = self.ends[self.around(left)].iter().rev();
        let last = around.find(|end| outline.node(end.edge, !end.leaves) == right);
        last.map_or(0, |end| self.right[end.edge as usize] + i32::from(end.leaves))
    }

    /// Finds the winding numbers of a component from that to the left of its leftmost node.
    fn label(
        &mut self,
        outline: &Outline,
        leftmost: u32,
        outside: i32,
        tally: &mut Tally<'_>,
    ) -> Result<(), Refusal> {
        self.open.clear();
        self.go_around(leftmost, 0, outside);
        while let Some(end) = self.open.pop() {
            tally.add(1)?;
            let node = outline.node(end.edge, end.leaves);
            if !self.is_done[node as usize] {
                let place = self.ends[self.around(node)].iter().position(|&other| other == end);
                let before = self.right[end.edge as usize] + i32::from(!end.leaves);
                self.go_around(node, place.unwrap_or(0), before);
            }
        }
        Ok(())
    }

    /// Numbers the edges around a node, from one of them on, before which a winding number is known.
    fn go_around(&mut self, node: u32, first: usize, before: i32) {
        self.is_done[node as usize] = true;
        let around = self.around(node);
        let mut winding = before;
        for place in (around.start + first..around.end).chain(around.start..around.start + first) {
            let EdgeEnd { edge, leaves } = self.ends[place];
            let behind = if leaves { winding + 1 } else { winding - 1 };
            if self.right[edge as usize] == UNKNOWN {
                self.right[edge as usize] = winding.min(behind);
                self.open.push(EdgeEnd { edge, leaves: !leaves });
            }
            winding = behind;
        }
        debug_assert_eq!(winding, before, "walks are closed");
    }
}

/// By angle; of edges that coincide, those first that have the others on their left.
fn by_angle_and_side(outline: &Outline, node: u32, a: EdgeEnd, b: EdgeEnd) -> Ordering {
    let far = |end: EdgeEnd| outline.node_point(outline.node(end.edge, !end.leaves));
    by_angle(outline.node_point(node), far(a), far(b)).then_with(|| {
        let order = a.edge.cmp(&b.edge);
        if a.leaves { order } else { order.reverse() }
    })
}
