//! The walk, step by step.

use super::Labels;
use super::label::{Label, NestedComponent};
use super::map::{Map, cross_bundle, go_back, go_forward, holds_behind};
use super::step::Step;
use crate::arrangement::Node;
use crate::expression::winding::WindingNumbers;
use crate::predicates::{Side, side};

impl Labels {
    pub(super) fn take(&mut self, step: Step, map: Map<'_>, truth: &mut WindingNumbers) {
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
    fn walk_ahead(&mut self, mut arc: u32, first: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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

    fn walk_behind(&mut self, mut arc: u32, first: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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
    fn enter(&mut self, arc: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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
    fn go_around(&mut self, junction: u32, place: u32, left: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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
    fn label(&mut self, arc: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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
        let component = |hung: &NestedComponent| Step::Component { vertex: hung.vertex };
        self.steps.extend(hung.clone().filter(|hung| hung.left).map(component));
        if hung.clone().any(|hung| !hung.left) {
            self.steps.push(Step::Cross { arc });
            self.steps.extend(hung.filter(|hung| !hung.left).map(component));
            self.steps.push(Step::CrossBack { arc });
        }
    }

    fn enter_component(&mut self, vertex: u32, map: Map<'_>, truth: &mut WindingNumbers) {
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
