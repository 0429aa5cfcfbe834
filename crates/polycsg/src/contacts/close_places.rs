//! Where two things happen on an edge close together, all edges that meet there may do so once more when they are rounded.

use super::Contacts;
use super::close_pairs::{CloseGroups, ClosePairs, ClosePlaces, EdgePlace};
use super::contact::PartnerKind;
use crate::edges::Edges;

impl Contacts {
    /// Notes all pairs of edges that meet in one of two places close together.
    pub(super) fn find_at_close_places(&mut self, edges: &Edges, close_pairs: &mut ClosePairs) {
        let close = std::mem::take(&mut close_pairs.close);
        let mut meeting = std::mem::take(&mut self.close_groups);
        if self.degenerate && !close.is_empty() {
            self.gather(edges, &close, &mut meeting);
        }
        for ClosePlaces { edge, places } in &close {
            if close_pairs.all() {
                break; // by now so many meet in one place that each of its edges would gather them all
            }
            meeting.group.clear();
            meeting.group.push(*edge);
            places.iter().for_each(|&at| self.add_edges(edges, at, &mut meeting));
            meeting.group.sort_unstable();
            meeting.group.dedup();
            close_pairs.add_group(&meeting.group);
        }
        close_pairs.close = close;
        self.close_groups = meeting;
    }

    /// Gathers the edges that start, end or lie in the nodes of some places.
    fn gather(&self, edges: &Edges, close: &[ClosePlaces], meeting: &mut CloseGroups) {
        meeting.is_close.clear();
        meeting.is_close.resize(self.nodes.len(), false);
        for node in close.iter().flat_map(|close| close.places).filter_map(|at| self.node_of(at)) {
            meeting.is_close[node as usize] = true;
        }
        meeting.edges.clear();
        for contact in &self.found {
            let node = self.node(contact.node);
            if meeting.is_close[node as usize] {
                meeting.edges.push([node, contact.edge]);
                if contact.partner.kind() == PartnerKind::Start {
                    meeting.edges.push([node, edges.ring(contact.edge).previous(contact.edge)]);
                }
            }
        }
        meeting.edges.sort_unstable();
    }

    fn node_of(&self, at: EdgePlace) -> Option<u32> {
        match at {
            EdgePlace::Node(node) => Some(self.node(node)),
            EdgePlace::Vertex(vertex) => self.node_at(vertex),
        }
    }

    /// Adds the edges that meet in a place to the group.
    fn add_edges(&self, edges: &Edges, at: EdgePlace, meeting: &mut CloseGroups) {
        let CloseGroups { edges: gathered, group, .. } = meeting;
        match (self.node_of(at), at) {
            (Some(node), _) if self.degenerate => {
                let first = gathered.partition_point(|pair| pair[0] < node);
                let there = gathered[first..].iter().take_while(|pair| pair[0] == node);
                group.extend(there.map(|pair| pair[1]));
            }
            (_, EdgePlace::Node(node)) => group.extend(self.nodes[node as usize]),
            (_, EdgePlace::Vertex(vertex)) => group.extend([vertex, edges.ring(vertex).previous(vertex)]),
        }
    }
}
