//! Close pairs: pairs of edges so near to one another, or at so flat an angle, that rounding may make their pieces meet.
//!
//! Rounded pieces stay in their edges' boxes, and all pairs of edges whose boxes meet are compared when contacts are found.
//! Pairs that are not clear of one another (see [`Margins`]) are noted here, by tests that err on the safe side. When no
//! pieces of theirs meet after rounding, nothing on the whole boundary does. The [`SlabDecomposition`] reports fewer pairs
//! than boxes do; what else comes near an edge is looked for there.

use super::contact::{Contact, PartnerKind};
use crate::base::meter::{Meter, Refusal};
use crate::base::threads::{Threads, ranges};
use crate::edges::{EdgeRing, Edges};
use crate::predicates::{Margins, Parameter, Segment, doubled_area, lexicographic};
use crate::spatial::{chains::LONGEST, slabs::SlabDecomposition};
use glam::{DVec2, Vec2Swizzles};

/// So many pairs for each edge are noted.
const PAIRS: usize = 64;

/// See the module's page.
#[derive(Debug, Default)]
pub(crate) struct ClosePairs {
    /// Whether all edges count as close.
    all: bool,
    /// Whether all edges whose boxes meet are compared, as each is a chain of its own.
    are_compared: bool,
    pairs: Vec<[u32; 2]>,
    /// More pairs take longer than all edges.
    most: usize,
    margins: Margins,
    /// The places close together on an edge.
    pub(crate) close: Vec<ClosePlaces>,
}

/// Two places close together on an edge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClosePlaces {
    pub(crate) edge: u32,
    pub(crate) places: [EdgePlace; 2],
}

/// Where something happens on an edge: at a node, or at a vertex that may be none.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EdgePlace {
    Node(u32),
    Vertex(u32),
}

/// The edges that meet in some nodes.
#[derive(Debug, Default)]
pub(super) struct CloseGroups {
    /// Per node that stands for all at its point whether it is one of these.
    pub(super) is_close: Vec<bool>,
    /// These nodes and the edges through them, sorted.
    pub(super) edges: Vec<[u32; 2]>,
    pub(super) group: Vec<u32>,
}

impl ClosePairs {
    /// Starts over for so many edges with coordinates up to a size; where pairs are not wanted, all edges count as close.
    pub(crate) fn start(&mut self, edges: usize, size: f64, wanted: bool, are_compared: bool) {
        self.all = !wanted;
        self.are_compared = are_compared;
        self.most = PAIRS * edges.max(PAIRS);
        self.pairs.clear();
        self.close.clear();
        self.margins = Margins::for_size(size);
    }

    /// Whether all edges count as close, not the listed pairs alone.
    pub(crate) fn all(&self) -> bool {
        self.all
    }

    pub(crate) fn margins(&self) -> Margins {
        self.margins
    }

    pub(crate) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }

    pub(crate) fn add(&mut self, e: u32, f: u32) {
        self.add_group(&[f, e]);
    }

    /// Notes what comes near an edge where the [`SlabDecomposition`] takes the place of boxes, and lets it report the rest. Where
    /// these are too many, all edges count as close.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(crate) fn find_beside(
        &mut self,
        edges: &Edges,
        slabs: &mut SlabDecomposition,
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let margins = self.margins;
        self.all = self.all
            || slabs.duplicates().next().is_some()
            || !self.find_at_places(edges, slabs, meter)?
            || !slabs.ends_beside_ends(margins.close, meter, |p, q| {
                edges.at(p).into_iter().for_each(|e| edges.at(q).into_iter().for_each(|f| self.add(e, f)));
            })?
            || !slabs.ends_beside_steep_edges(margins, meter, |e, p| {
                edges.at(p).into_iter().for_each(|f| self.add(e, f));
            })?
            || !slabs.widen(margins.close);
        Ok(())
    }

    /// Notes edges that leave one point in nearly the same direction, at all points; false when they are too many for that.
    fn find_at_places(
        &mut self,
        edges: &Edges,
        slabs: &SlabDecomposition,
        meter: &Meter<'_>,
    ) -> Result<bool, Refusal> {
        let mut tally = meter.tally();
        for place in slabs.places() {
            tally.add(1)?;
            if !self.find_at_place(edges, place) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Counts all edges as close, and lets the slab decomposition report only what meets; false if it does so already.
    pub(crate) fn give_up(&mut self, slabs: &mut SlabDecomposition) -> bool {
        self.all = true;
        slabs.narrow()
    }

    /// Notes edges of several rings that leave one point in nearly the same direction; false when they are too many for
    /// that. Those of one ring are looked at by [`find_along`](ClosePairs::find_along).
    fn find_at_place(&mut self, edges: &Edges, mut place: impl Iterator<Item = u32>) -> bool {
        const MOST: usize = 32;
        let Some(first) = place.next() else { return true };
        let [a, b] = edges.at(first);
        let mut leaving = [a; MOST];
        leaving[1] = b;
        for (count, edge) in (2..).zip(place.flat_map(|point| edges.at(point))) {
            if count == MOST {
                return false;
            }
            leaving[count] = edge;
            for &other in leaving[..count].iter().filter(|&&other| other != edge) {
                if self.are_flat(edges, edges.point(first), [edge, other]) {
                    self.add(edge, other);
                }
            }
        }
        true
    }

    /// Whether two edges leave a common end in nearly the same direction.
    fn are_flat(&self, edges: &Edges, shared: DVec2, pair: [u32; 2]) -> bool {
        let [s, t] = pair.map(|edge| edges.segment(edge));
        let [p, q] = [s, t].map(|[a, b]| if a == shared { b } else { a });
        self.are_flat_at(shared, p, q)
    }

    /// The same by the common end and the two others.
    #[inline]
    fn are_flat_at(&self, shared: DVec2, p: DVec2, q: DVec2) -> bool {
        (p - shared).dot(q - shared) > 0.0
            && !self.margins.are_steep([[shared, p], [shared, q]], doubled_area(shared, p, q))
    }

    /// Looks at the contacts of all edges.
    ///
    /// # Errors
    /// Those of the meter's limits.
    pub(super) fn find_along_all(
        &mut self,
        edges: &Edges,
        contacts: &[Contact],
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let threads = Threads::for_edges(edges.len());
        if !threads.are_many() {
            return self.find_along_each(edges, contacts, meter);
        }
        // A part goes on to the end of its last edge.
        let next_edge = |at: usize| {
            let last = contacts[..at].last().map(|contact| contact.edge);
            at + contacts[at..].iter().take_while(|contact| Some(contact.edge) == last).count()
        };
        let parts = threads.map(ranges(contacts.len()), |part| {
            let mut own = ClosePairs { pairs: Vec::new(), close: Vec::new(), ..*self };
            let contacts = &contacts[next_edge(part.start)..next_edge(part.end)];
            own.find_along_each(edges, contacts, meter).map(|()| own)
        });
        for part in parts {
            let part = part?;
            self.pairs.extend(part.pairs);
            self.close.extend(part.close);
            self.all |= part.all || self.pairs.len().max(self.close.len()) > self.most;
        }
        Ok(())
    }

    /// The same for the contacts of some edges.
    fn find_along_each(
        &mut self,
        edges: &Edges,
        contacts: &[Contact],
        meter: &Meter<'_>,
    ) -> Result<(), Refusal> {
        let mut tally = meter.tally();
        for contacts in contacts.chunk_by(|a, b| a.edge == b.edge) {
            self.find_along(edges, contacts);
            tally.add(contacts.len())?;
        }
        Ok(())
    }

    /// Looks at the contacts of one edge: at the gaps between them, and at what else of its ring is close to it.
    fn find_along(&mut self, edges: &Edges, contacts: &[Contact]) {
        let is_crossing = |contact: &Contact| {
            matches!(contact.partner.kind(), PartnerKind::FromLeft(_) | PartnerKind::FromRight(_))
        };
        self.all |= self.close.len() > self.most;
        if self.all || !contacts.iter().any(is_crossing) {
            return;
        }
        let edge = contacts[0].edge;
        let ring = edges.ring(edge);
        let segment = edges.segment(edge);
        let least = self.margins.gap / (segment[1] - segment[0]).abs().max_element();
        let far = |a: Parameter, b: Parameter| b.distance_from(a) > least;
        let node = |contact: Contact| EdgePlace::Node(contact.node);
        for pair in contacts.windows(2).filter(|pair| !far(pair[0].at(), pair[1].at())) {
            self.close.push(ClosePlaces { edge, places: [node(pair[0]), node(pair[1])] });
        }
        let (first, last) = (contacts[0], contacts[contacts.len() - 1]);
        if !far(Parameter::START, first.at()) && !first.partner.is_end() {
            self.close.push(ClosePlaces { edge, places: [node(first), EdgePlace::Vertex(edge)] });
        }
        if !far(last.at(), Parameter::END) {
            self.close.push(ClosePlaces { edge, places: [node(last), EdgePlace::Vertex(edges.head(edge))] });
        }
        self.find_around(edges, ring, edge);
    }

    /// Notes all pairs of edges that meet close together; where they are many, all edges count as close.
    pub(crate) fn add_group(&mut self, group: &[u32]) {
        const MOST: usize = 64;
        self.all |= group.len() > MOST || self.pairs.len() > self.most;
        for (i, &e) in group.iter().enumerate().take_while(|_| !self.all) {
            self.pairs.extend(group[..i].iter().filter(|&&f| f != e).map(|&f| [e, f]));
        }
    }

    /// Notes what is close to an edge on both sides along its ring: its neighbours where they turn back sharply, and those
    /// beyond, where the neighbour is too narrow to keep them away.
    fn find_around(&mut self, edges: &Edges, ring: EdgeRing, edge: u32) {
        let [a, b] = edges.segment(edge);
        if let Some(before) = ring.edge_before(edge) {
            let start = edges.point(before);
            if self.are_flat_at(a, b, start) {
                self.add(edge, before);
            }
            self.find_beyond(edges, edge, before, start - a, |other| ring.edge_before(other));
        }
        if let Some(after) = ring.edge_after(edge) {
            let end = edges.point(after + 1);
            if self.are_flat_at(b, a, end) {
                self.add(edge, after);
            }
            self.find_beyond(edges, edge, after, end - b, |other| ring.edge_after(other));
        }
    }

    /// Notes those of the edges beyond a neighbour that may be in one chain with an edge, to the side or upward, and were not
    /// compared with it, and are not apart from it, where the neighbour's extent keeps them less than a margin away.
    #[inline]
    fn find_beyond(
        &mut self,
        edges: &Edges,
        edge: u32,
        neighbour: u32,
        extent: DVec2,
        step: impl Fn(u32) -> Option<u32>,
    ) {
        if self.are_compared {
            return;
        }
        if extent.x.abs() <= self.margins.close {
            self.find_along_chain(edges, edge, neighbour, |p| p, &step);
        }
        if extent.y.abs() <= self.margins.close {
            self.find_along_chain(edges, edge, neighbour, DVec2::yx, &step);
        }
    }

    /// The same for chains to the side, or for others that are so as seen.
    fn find_along_chain(
        &mut self,
        edges: &Edges,
        edge: u32,
        neighbour: u32,
        seen: impl Fn(DVec2) -> DVec2,
        step: impl Fn(u32) -> Option<u32>,
    ) {
        let segment = |edge: u32| edges.segment(edge).map(&seen);
        let s = segment(edge);
        let leads_on = |t: Segment| lexicographic(t[0], t[1]) == lexicographic(s[0], s[1]);
        if !leads_on(segment(neighbour)) {
            return; // another chain, whose boxes were looked at
        }
        let others = std::iter::successors(step(neighbour), |&other| step(other));
        for other in others.take(LONGEST as usize) {
            let t = segment(other);
            let gap = (t[0].x.min(t[1].x) - s[0].x.max(s[1].x)).max(s[0].x.min(s[1].x) - t[0].x.max(t[1].x));
            if gap > self.margins.close || !leads_on(t) {
                break;
            }
            let areas = |line: Segment, ends: Segment| ends.map(|p| doubled_area(line[0], line[1], p));
            if !self.margins.are_apart(s, areas(s, t)) && !self.margins.are_apart(t, areas(t, s)) {
                self.add(edge, other);
            }
        }
    }
}
