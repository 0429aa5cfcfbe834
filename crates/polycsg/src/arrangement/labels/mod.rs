//! Stage 5: the membership of each sub-edge.
//!
//! One walk over the arrangement keeps one state: the winding numbers of all operands (see [`WindingNumbers`]) just left of
//! the sub-edge that it is on.
//!
//! ```text
//!            |               At a crossing the winding numbers change by the edge that crosses. Of the crossing ring,
//!     left   ^  g-           the sub-edge that has the same place on its left is walked next, if it is not known yet.
//!   of e     |               A walk all around a ring comes back with the state that it left with.
//!   ---g---->+------         At a junction the walk goes around the node, over one group of overlapping sub-edges
//!            |               after the other, and walks each of them on to its far end and back.
//!            ^ e
//! ```
//!
//! A component that lies inside a face of another one is nested in it: it is walked from the sub-edge right below its leftmost
//! vertex.

mod label;
pub(crate) mod map;
mod step;
mod walk;

use crate::arrangement::{Arrangement, Node};
use crate::base::meter::{Meter, Refusal};
use crate::base::parts::Numbered;
use crate::base::{id::index, sort::sort};
use crate::contacts::{Contacts, close_pairs::ClosePairs};
use crate::edges::Edges;
use crate::expression::winding::WindingNumbers;
use crate::predicates::lexicographic;
use crate::region::membership::Membership;
use crate::spatial::{ray_shooting::VerticalRays, slabs::SlabDecomposition};
use label::{Label, NestedComponent};
use map::Map;
use std::cmp::Ordering;
use step::Step;

/// No vertex.
const NONE: u32 = u32::MAX;

/// The membership of every sub-edge that represents itself; rings that nothing meets count behind the sub-edges.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    labels: Vec<Label>,
    /// Per sub-edge its chain, a run of sub-edges of one ring between junctions, and of these which were walked.
    chain: Vec<u32>,
    walked: Vec<bool>,
    /// The junctions that were gone around.
    seen: Vec<bool>,
    steps: Vec<Step>,
    /// The lexicographically smallest vertex of each component.
    leftmost: Vec<u32>,
    below: VerticalRays,
    /// Sorted by sub-edge.
    nested: Vec<NestedComponent>,
    outermost: Vec<u32>,
}

/// What the stages up to here hand on: all edges with the memberships of their sub-edges.
#[derive(Clone, Copy)]
pub(crate) struct LabelledArrangement<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) contacts: &'a Contacts,
    pub(crate) close_pairs: &'a ClosePairs,
    pub(crate) arrangement: &'a Arrangement,
    pub(crate) labels: &'a Labels,
}

impl Labels {
    /// Labels every sub-edge with the sides of it on which the expression holds.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn classify(
        &mut self,
        map: Map<'_>,
        slabs: &mut SlabDecomposition,
        winding: &mut WindingNumbers,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.steps.clear();
        self.labels.clear();
        self.labels.resize(map.arrangement.len() + map.edges.rings().len(), Label::default());
        self.seen.clear();
        self.seen.resize(map.arrangement.junction_count(), false);
        self.find_chains(map, meter)?;
        self.find_leftmost(map, meter)?;
        self.find_nested(map, slabs, meter)?;
        let mut tally = meter.tally();
        while let Some(vertex) = self.outermost.pop() {
            self.steps.push(Step::Component { vertex });
            while let Some(step) = self.steps.pop() {
                tally.add(1 + self.take(step, map, winding))?;
            }
            debug_assert!(winding.is_outside());
        }
        Ok(())
    }

    /// The membership of a sub-edge that represents itself, in that sub-edge's direction.
    #[inline]
    pub(crate) fn of(&self, sub_edge: u32) -> Membership {
        let label = self.labels[sub_edge as usize];
        Membership::from_sides(label.is(Label::LEFT), label.is(Label::RIGHT))
    }

    fn find_chains(&mut self, map: Map<'_>, meter: &Meter<'_>) -> Result<(), Refusal> {
        let (mut count, mut tally) = (0, meter.tally());
        self.chain.clear();
        for ring in 0..index(map.edges.rings().len()) {
            let sub_edges = map.arrangement.of_ring(ring);
            tally.add(1 + sub_edges.len())?;
            if map.arrangement.junction_count() == 0 {
                count += 1;
                self.chain.resize(sub_edges.end as usize, ring);
                continue;
            }
            for sub_edge in sub_edges.clone() {
                let starts =
                    sub_edge == sub_edges.start || matches!(map.arrangement.met(sub_edge), Node::Junction(_));
                count += u32::from(starts);
                self.chain.push(count - 1);
            }
            // What ends where the ring starts goes on there, unless that is a junction.
            if !sub_edges.is_empty() && matches!(map.arrangement.met(sub_edges.start), Node::Crossing(_)) {
                let (first, last) = (self.chain[sub_edges.start as usize], count - 1);
                let chains = &mut self.chain[sub_edges.start as usize..sub_edges.end as usize];
                chains.iter_mut().rev().take_while(|chain| **chain == last).for_each(|chain| *chain = first);
            }
        }
        self.walked.clear();
        self.walked.resize(count as usize, false);
        Ok(())
    }

    fn find_leftmost(&mut self, map: Map<'_>, meter: &Meter<'_>) -> Result<(), Refusal> {
        self.leftmost.clear();
        self.leftmost.resize(map.edges.rings().len(), NONE);
        meter.for_each(0..index(map.edges.rings().len()), |ring| {
            let vertex = map.chains.leftmost(ring);
            let best = &mut self.leftmost[map.contacts.component(ring) as usize];
            if *best == NONE
                || lexicographic(map.edges.point(vertex), map.edges.point(*best)) == Ordering::Less
            {
                *best = vertex;
            }
        })?;
        self.leftmost.retain(|&vertex| vertex != NONE);
        Ok(())
    }

    /// Finds the sub-edge right below each component, or that there is none.
    fn find_nested(
        &mut self,
        map: Map<'_>,
        slabs: &mut SlabDecomposition,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        self.nested.clear();
        self.outermost.clear();
        if let [single] = self.leftmost[..] {
            self.outermost.push(single);
            return Ok(());
        }
        self.below.shoot(map.chains, map.strips, slabs, map.edges.points(), &self.leftmost, meter)?;
        meter.for_each(Numbered(&self.leftmost), |(i, &vertex)| {
            match self.below.edge(i as usize).map(|edge| map.sub_edge_of(edge, vertex)) {
                None => self.outermost.push(vertex),
                Some((sub_edge, left)) => {
                    self.labels[sub_edge as usize].0 |= Label::HAS_NESTED;
                    self.nested.push(NestedComponent { sub_edge, left, vertex });
                }
            }
        })?;
        sort(&mut self.nested, Ord::cmp, meter)
    }
}
