//! Stage 5: which sides of each arc lie inside the set.
//!
//! One walk over the arrangement with one state, the winding numbers of all operands (see [`Truth`]), which always
//! is that of the place just left of the arc being walked on:
//!
//! ```text
//!            |               Over a crossing the state changes by the edge that crosses, and whichever of the
//!     left   ^  g-           crossing ring's arcs has the same place on its left is walked next, if it is not known.
//!   of e     |               A walk around a ring comes back with the state that it left with.
//!   ---g---->+------         At a junction the walk goes around the node, over one bundle after the other, and
//!            |               walks each of its arcs on to their far ends and back.
//!            ^ e
//! ```
//!
//! A component that lies inside a face of another one hangs on an arc of that face.

use crate::arrangement::{Arrangement, Node};
use crate::below::Below;
use crate::chains::Chains;
use crate::contacts::{Contacts, Place};
use crate::edges::Edges;
use crate::membership::Membership;
use crate::predicates::{Side, crossing_x_order, lexicographic, side};
use crate::slabs::Slabs;
use crate::strips::Strips;
use crate::truth::{Truth, index};
use std::cmp::Ordering;

/// No vertex.
const NONE: u32 = u32::MAX;

/// A component, by its leftmost vertex, that lies in the face left or right of an arc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Hung {
    arc: u32,
    left: bool,
    vertex: u32,
}

/// What is known of an arc, in bits: the truth on its left and on its right, whether these are known, and whether
/// any component hangs on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Label(u8);

impl Label {
    const LEFT: u8 = 1;
    const RIGHT: u8 = 2;
    const KNOWN: u8 = 4;
    const HUNG: u8 = 8;

    #[inline]
    fn is(self, bit: u8) -> bool {
        self.0 & bit != 0
    }
}

/// What is left to do of a walk; each step leaves the state as it found it.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// Walk ahead from `arc`, which is labelled, until the ring closes at `first` or a junction ends it.
    Ahead { arc: u32, first: u32 },
    /// Go back to `first`.
    Back { arc: u32, first: u32 },
    /// Walk against the ring from `arc` until a junction.
    Behind { arc: u32, first: u32 },
    /// Go forward to `first` again.
    Return { arc: u32, first: u32 },
    /// Go around a junction: from the left of the group of half-edges before `place`, over so many half-edges.
    Around { junction: u32, place: u32, left: u32 },
    /// Cross a bundle from its right to its left.
    Cross { arc: u32 },
    /// Cross it from its left to its right.
    CrossBack { arc: u32 },
    /// Start with a component, outside of it.
    Component { vertex: u32 },
}

/// The membership of every arc that stands for itself; rings that nothing meets count behind the arcs.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    labels: Vec<Label>,
    /// Per arc its strand, a run of arcs of one ring between junctions, and of these which were walked.
    strand: Vec<u32>,
    walked: Vec<bool>,
    /// The junctions that were gone around.
    seen: Vec<bool>,
    steps: Vec<Step>,
    /// The lexicographically smallest vertex of each component.
    leftmost: Vec<u32>,
    below: Below,
    /// Sorted by arc.
    hung: Vec<Hung>,
    outermost: Vec<u32>,
}

/// The arrangement as the walk sees it.
#[derive(Clone, Copy)]
pub(crate) struct Map<'a> {
    pub(crate) edges: &'a Edges,
    pub(crate) chains: &'a Chains,
    pub(crate) strips: &'a Strips,
    pub(crate) contacts: &'a Contacts,
    pub(crate) arrangement: &'a Arrangement,
}

impl Map<'_> {
    /// The arc of a whole ring that nothing meets.
    fn of_whole_ring(self, ring: u32) -> u32 {
        index(self.arrangement.len()) + ring
    }

    /// An edge of the ring of an arc.
    #[inline]
    fn an_edge(self, arc: u32) -> u32 {
        match (arc as usize).checked_sub(self.arrangement.len()) {
            None => self.arrangement.edge(arc),
            Some(ring) => self.edges.rings()[ring].start,
        }
    }

    /// The arc that contains a vertex or starts there.
    fn arc_at(self, vertex: u32) -> u32 {
        let arc = self.arrangement.arc_at(self.edges, vertex);
        arc.unwrap_or_else(|| self.of_whole_ring(self.edges.ring_of(vertex)))
    }

    /// The arc of an edge that runs below a vertex there, and whether the vertex lies on its left.
    fn arc_of(self, edge: u32, vertex: u32) -> (u32, bool) {
        let x = self.edges.point(vertex).x;
        let [start, end] = self.edges.segment(edge);
        let rightward = start.x < end.x;
        let starts_behind = |arc: u32| {
            self.arrangement.edge(arc) > edge || {
                self.arrangement.edge(arc) == edge && self.is_left_of(arc, x) != rightward
            }
        };
        let arcs = self.arrangement.of_ring(self.edges.ring_of(edge));
        let Some(arc) = self.arrangement.last_before(arcs, starts_behind) else {
            return (self.of_whole_ring(self.edges.ring_of(edge)), rightward);
        };
        let stands = self.arrangement.stand_in(arc);
        let along = self.arrangement.is_along(self.edges, stands, arc);
        (stands, rightward == along)
    }

    /// Whether an arc starts at or left of an abscissa.
    fn is_left_of(self, arc: u32, x: f64) -> bool {
        match self.contacts.place(self.arrangement.node(arc)) {
            Place::Vertex(vertex) => self.edges.point(vertex).x <= x,
            Place::Crossing(e, f) => {
                crossing_x_order(self.edges.segment(e), self.edges.segment(f), x) != Ordering::Greater
            }
        }
    }
}

impl Labels {
    /// Labels every arc with the sides of it on which `truth` holds.
    pub(crate) fn classify(&mut self, map: Map<'_>, slabs: &mut Slabs, truth: &mut Truth) {
        self.labels.clear();
        self.labels.resize(map.arrangement.len() + map.edges.rings().len(), Label::default());
        self.seen.clear();
        self.seen.resize(map.arrangement.junction_count(), false);
        self.find_strands(map);
        self.find_leftmost(map);
        self.hang(map, slabs);
        while let Some(vertex) = self.outermost.pop() {
            self.steps.push(Step::Component { vertex });
            while let Some(step) = self.steps.pop() {
                self.take(step, map, truth);
            }
            debug_assert!(truth.is_outside());
        }
    }

    /// The membership of an arc that stands for itself, in that arc's direction.
    #[inline]
    pub(crate) fn of(&self, arc: u32) -> Membership {
        let label = self.labels[arc as usize];
        Membership::from_sides(label.is(Label::LEFT), label.is(Label::RIGHT))
    }

    fn find_strands(&mut self, map: Map<'_>) {
        let mut count = 0;
        self.strand.clear();
        for ring in 0..index(map.edges.rings().len()) {
            let arcs = map.arrangement.of_ring(ring);
            for arc in arcs.clone() {
                let starts = arc == arcs.start || matches!(map.arrangement.met(arc), Node::Junction(_));
                count += u32::from(starts);
                self.strand.push(count - 1);
            }
            // What ends where the ring starts goes on there, unless that is a junction.
            if !arcs.is_empty() && matches!(map.arrangement.met(arcs.start), Node::Crossing(_)) {
                let (first, last) = (self.strand[arcs.start as usize], count - 1);
                let strands = &mut self.strand[arcs.start as usize..arcs.end as usize];
                strands
                    .iter_mut()
                    .rev()
                    .take_while(|strand| **strand == last)
                    .for_each(|strand| *strand = first);
            }
        }
        self.walked.clear();
        self.walked.resize(count as usize, false);
    }

    fn find_leftmost(&mut self, map: Map<'_>) {
        self.leftmost.clear();
        self.leftmost.resize(map.edges.rings().len(), NONE);
        for ring in 0..index(map.edges.rings().len()) {
            let vertex = map.chains.leftmost(ring);
            let best = &mut self.leftmost[map.contacts.component(ring) as usize];
            if *best == NONE
                || lexicographic(map.edges.point(vertex), map.edges.point(*best)) == Ordering::Less
            {
                *best = vertex;
            }
        }
        self.leftmost.retain(|&vertex| vertex != NONE);
    }

    /// Hangs each component on the arc below it, or finds that there is none.
    fn hang(&mut self, map: Map<'_>, slabs: &mut Slabs) {
        self.hung.clear();
        self.outermost.clear();
        if let [single] = self.leftmost[..] {
            return self.outermost.push(single);
        }
        self.below.look(map.chains, map.strips, slabs, map.edges.points(), &self.leftmost);
        for (i, &vertex) in self.leftmost.iter().enumerate() {
            match self.below.edge(i).map(|edge| map.arc_of(edge, vertex)) {
                None => self.outermost.push(vertex),
                Some((arc, left)) => {
                    self.labels[arc as usize].0 |= Label::HUNG;
                    self.hung.push(Hung { arc, left, vertex });
                }
            }
        }
        self.hung.sort_unstable();
    }

    fn take(&mut self, step: Step, map: Map<'_>, truth: &mut Truth) {
        match step {
            Step::Ahead { arc, first } => self.walk_ahead(arc, first, map, truth),
            Step::Back { arc, first } => {
                go_back(arc, first, map, truth);
                self.steps.push(Step::Behind { arc: first, first });
            }
            Step::Behind { arc, first } => self.walk_behind(arc, first, map, truth),
            Step::Return { arc, first } => go_forward(arc, first, map, truth),
            Step::Around { junction, place, left } => self.go_around(junction, place, left, map, truth),
            Step::Cross { arc } => cross_bundle(arc, false, map, truth),
            Step::CrossBack { arc } => cross_bundle(arc, true, map, truth),
            Step::Component { vertex } => self.enter_component(vertex, map, truth),
        }
    }

    /// Walks over one crossing after the other until there is something else to do first.
    fn walk_ahead(&mut self, mut arc: u32, first: u32, map: Map<'_>, truth: &mut Truth) {
        loop {
            let next = map.arrangement.following(map.edges, arc);
            let other = match map.arrangement.met(next) {
                Node::Junction(junction) => {
                    self.steps.push(Step::Back { arc, first });
                    return self.enter_junction(junction, 2 * arc + 1, map);
                }
                Node::Crossing(other) => other,
            };
            let from_left = map.arrangement.crossed_from_left(next);
            if !from_left && !self.is_walked(other) {
                // It has this side of the crossing on its left.
                self.steps.push(Step::Ahead { arc, first });
                return self.enter(other, map, truth);
            }
            map.edges.cross(map.arrangement.edge(other), !from_left, truth);
            let mut depth = self.steps.len();
            if next != first {
                self.steps.push(Step::Ahead { arc: next, first });
                self.label(next, map, truth);
                depth += 1;
            }
            if !self.is_walked(other) {
                self.enter(map.arrangement.previous(map.edges, other), map, truth);
            }
            if next == first || self.steps.len() > depth {
                return;
            }
            self.steps.pop();
            arc = next;
        }
    }

    fn walk_behind(&mut self, mut arc: u32, first: u32, map: Map<'_>, truth: &mut Truth) {
        loop {
            let other = match map.arrangement.met(arc) {
                Node::Junction(junction) => {
                    self.steps.push(Step::Return { arc, first });
                    return self.enter_junction(junction, 2 * arc, map);
                }
                Node::Crossing(other) => other,
            };
            let from_left = map.arrangement.crossed_from_left(arc);
            if from_left && !self.is_walked(other) {
                self.steps.push(Step::Behind { arc, first });
                return self.enter(map.arrangement.previous(map.edges, other), map, truth);
            }
            map.edges.cross(map.arrangement.edge(other), from_left, truth);
            arc = map.arrangement.previous(map.edges, arc);
            let depth = self.steps.len();
            self.steps.push(Step::Behind { arc, first });
            self.label(arc, map, truth);
            if !self.is_walked(other) {
                self.enter(other, map, truth);
            }
            if self.steps.len() > depth + 1 {
                return;
            }
            self.steps.pop();
        }
    }

    /// Whether the strand on which a crossing lies was walked, or is being walked.
    #[inline]
    fn is_walked(&self, arc: u32) -> bool {
        self.walked[self.strand[arc as usize] as usize]
    }

    /// Starts with an arc that has the walk's place on its left.
    fn enter(&mut self, arc: u32, map: Map<'_>, truth: &mut Truth) {
        self.walked[self.strand[arc as usize] as usize] = true;
        self.steps.push(Step::Ahead { arc, first: arc });
        self.label(arc, map, truth);
    }

    /// Starts to go around a junction, unless that was done, from the right of a half-edge that leads away along the
    /// walk's arc against it, or from its left along it: both times the arc's left.
    fn enter_junction(&mut self, junction: u32, half_edge: u32, map: Map<'_>) {
        if std::mem::replace(&mut self.seen[junction as usize], true) {
            return;
        }
        let span = map.arrangement.span(junction);
        let Some(mut place) = span.clone().find(|&place| map.arrangement.around(place) == half_edge) else {
            return;
        };
        let left = span.end - span.start;
        let group = map.group(junction, place);
        place = if half_edge & 1 == 0 { group.end } else { group.start };
        self.steps.push(Step::Around { junction, place, left });
    }

    /// Crosses the next group of half-edges around a junction and walks its arc, unless it is known.
    fn go_around(&mut self, junction: u32, place: u32, left: u32, map: Map<'_>, truth: &mut Truth) {
        if left == 0 {
            return;
        }
        let span = map.arrangement.span(junction);
        let place = if place == span.end { span.start } else { place };
        let group = map.group(junction, place);
        let stands = map.arrangement.stand_in(map.arrangement.around(place) >> 1);
        let along = group.clone().any(|place| map.arrangement.around(place) == 2 * stands);
        cross_bundle(stands, !along, map, truth);
        self.steps.push(Step::Around { junction, place: group.end, left: left - (group.end - group.start) });
        if !self.is_walked(stands) {
            if !along {
                cross_bundle(stands, false, map, truth);
                self.steps.push(Step::CrossBack { arc: stands });
            }
            self.enter(stands, map, truth);
        }
    }

    /// Labels an arc from the place on its left, and takes up what hangs on it.
    #[inline]
    fn label(&mut self, arc: u32, map: Map<'_>, truth: &mut Truth) {
        if map.arrangement.stand_in(arc) != arc {
            return;
        }
        let left = truth.holds();
        let right = holds_behind(arc, map, truth);
        let known = Label::KNOWN | (u8::from(left) * Label::LEFT) | (u8::from(right) * Label::RIGHT);
        let label = &mut self.labels[arc as usize];
        debug_assert!(!label.is(Label::KNOWN) || label.0 | Label::HUNG == known | Label::HUNG);
        label.0 |= known;
        if label.is(Label::HUNG) {
            self.take_hung(arc);
        }
    }

    #[cold]
    fn take_hung(&mut self, arc: u32) {
        let first = self.hung.partition_point(|hung| hung.arc < arc);
        let hung = self.hung[first..].iter().take_while(|hung| hung.arc == arc);
        let component = |hung: &Hung| Step::Component { vertex: hung.vertex };
        self.steps.extend(hung.clone().filter(|hung| hung.left).map(component));
        if hung.clone().any(|hung| !hung.left) {
            self.steps.push(Step::Cross { arc });
            self.steps.extend(hung.filter(|hung| !hung.left).map(component));
            self.steps.push(Step::CrossBack { arc });
        }
    }

    fn enter_component(&mut self, vertex: u32, map: Map<'_>, truth: &mut Truth) {
        if let Some(junction) =
            map.contacts.node_at(vertex).and_then(|node| map.arrangement.junction_at(node))
        {
            let span = map.arrangement.span(junction);
            self.seen[junction as usize] = true;
            self.steps.push(Step::Around { junction, place: span.start, left: span.end - span.start });
            return;
        }
        let arc = map.arc_at(vertex);
        let ring = map.edges.ring(vertex);
        let [before, at, after] =
            [ring.previous(vertex), vertex, ring.next(vertex)].map(|v| map.edges.point(v));
        if side(before, at, after) == Side::Left {
            cross_bundle(arc, false, map, truth);
            self.steps.push(Step::CrossBack { arc });
        }
        if arc as usize >= map.arrangement.len() {
            self.label(arc, map, truth);
        } else {
            self.enter(arc, map, truth);
        }
    }
}

impl Map<'_> {
    /// The places of the half-edges that leave a junction together with the one at a place.
    fn group(self, junction: u32, place: u32) -> std::ops::Range<u32> {
        let span = self.arrangement.span(junction);
        let arc = |place: u32| self.arrangement.around(place) >> 1;
        let stands = |place: u32| self.arrangement.stand_in(arc(place));
        // An arc that leaves and comes back has two half-edges here, alone each.
        let same = |&p: &u32| p == place || (stands(p) == stands(place) && arc(p) != arc(place));
        let start = (span.start..place).rev().take_while(same).last().unwrap_or(place);
        let end = (place..span.end).take_while(same).last().unwrap_or(place) + 1;
        start..end
    }
}

/// Moves over a bundle from its right to its left, or `back`.
#[inline]
fn cross_bundle(arc: u32, back: bool, map: Map<'_>, truth: &mut Truth) {
    for other in map.arrangement.bundle(arc) {
        let along = map.arrangement.is_along(map.edges, arc, other);
        map.edges.cross(map.an_edge(other), back == along, truth);
    }
}

/// Whether the expression holds to the right of a bundle, from the left of which the walk looks.
#[inline]
fn holds_behind(arc: u32, map: Map<'_>, truth: &mut Truth) -> bool {
    if map.arrangement.bundle(arc).nth(1).is_none() {
        return map.edges.holds_behind(map.an_edge(arc), truth);
    }
    cross_bundle(arc, true, map, truth);
    let holds = truth.holds();
    cross_bundle(arc, false, map, truth);
    holds
}

/// Moves over all crossings from `arc` back to `first`.
fn go_back(mut arc: u32, first: u32, map: Map<'_>, truth: &mut Truth) {
    while arc != first {
        if let Node::Crossing(other) = map.arrangement.met(arc) {
            map.edges.cross(map.arrangement.edge(other), map.arrangement.crossed_from_left(arc), truth);
        }
        arc = map.arrangement.previous(map.edges, arc);
    }
}

/// Moves over all crossings from `arc` forward to `first`.
fn go_forward(mut arc: u32, first: u32, map: Map<'_>, truth: &mut Truth) {
    while arc != first {
        arc = map.arrangement.following(map.edges, arc);
        if let Node::Crossing(other) = map.arrangement.met(arc) {
            map.edges.cross(map.arrangement.edge(other), !map.arrangement.crossed_from_left(arc), truth);
        }
    }
}
