//! Where two contacts lie close together on an edge, all edges that meet there may meet once more when they are rounded.

use super::Contacts;
use super::close_pairs::{CloseGroups, ClosePairs, ClosePlaces, EdgePlace};
use crate::base::meter::{Meter, Refusal};
use crate::base::sort::sort;
use crate::edges::Edges;

impl Contacts {
    /// Notes all pairs of edges that meet in one of two places close together.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find_at_close_places(
        &mut self,
        edges: &Edges,
        close_pairs: &mut ClosePairs,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let close = std::mem::take(&mut close_pairs.close);
        let mut groups = std::mem::take(&mut self.close_groups);
        if self.degenerate && !close.is_empty() {
            self.gather(edges, &close, &mut groups, meter)?;
        }
        let mut tally = meter.tally();
        for ClosePlaces { edge, places } in &close {
            if close_pairs.all() {
                break; // by now so many meet in one place that each of its edges would gather them all
            }
            groups.group.clear();
            groups.group.push(*edge);
            places.iter().for_each(|&at| self.add_edges(edges, at, &mut groups));
            groups.group.sort_unstable();
            groups.group.dedup();
            close_pairs.add_group(&groups.group);
            tally.add(groups.group.len())?;
        }
        close_pairs.close = close;
        self.close_groups = groups;
        Ok(())
    }

    /// Gathers the edges that start, end or lie in the nodes of some places.
    fn gather(
        &self,
        edges: &Edges,
        close: &[ClosePlaces],
        groups: &mut CloseGroups,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        groups.is_close.clear();
        groups.is_close.resize(self.nodes.len(), false);
        for node in close.iter().flat_map(|close| close.places).filter_map(|at| self.node_of(at)) {
            groups.is_close[node as usize] = true;
        }
        groups.edges.clear();
        meter.for_each(&self.found[..], |contact| {
            let node = self.node(contact.node);
            if groups.is_close[node as usize] {
                let ends = contact.partner.is_end();
                let there = if ends { edges.at(contact.edge) } else { [contact.edge; 2] };
                groups.edges.extend(there.map(|edge| [node, edge]));
            }
        })?;
        sort(&mut groups.edges, Ord::cmp, meter)
    }

    fn node_of(&self, at: EdgePlace) -> Option<u32> {
        match at {
            EdgePlace::Node(node) => Some(self.node(node)),
            EdgePlace::Vertex(vertex) => self.node_at(vertex),
        }
    }

    /// Adds the edges that meet in a place to the group.
    fn add_edges(&self, edges: &Edges, at: EdgePlace, groups: &mut CloseGroups) {
        let CloseGroups { edges: gathered, group, .. } = groups;
        match (self.node_of(at), at) {
            (Some(node), _) if self.degenerate => {
                let first = gathered.partition_point(|pair| pair[0] < node);
                let there = gathered[first..].iter().take_while(|pair| pair[0] == node);
                group.extend(there.map(|pair| pair[1]));
            }
            (_, EdgePlace::Node(node)) => group.extend(self.nodes[node as usize]),
            (_, EdgePlace::Vertex(vertex)) => group.extend(edges.at(vertex)),
        }
    }
}
