//! The walk, step by step.

use super::label::{Label, NestedComponent};
use super::map::{Map, cross_overlapping, go_back, go_forward, holds_behind};
use super::{Labels, step::Step};
use crate::arrangement::Node;
use crate::base::parts::PART;
use crate::expression::winding::WindingNumbers;
use crate::predicates::{Side, side};

impl Labels {
    /// Takes a step; returns how many sub-edges it went along.
    pub(super) fn take(&mut self, step: Step, map: Map<'_>, winding: &mut WindingNumbers) -> usize {
        match step {
            Step::Ahead { sub_edge, first } => return self.walk_ahead(sub_edge, first, map, winding),
            Step::Back { sub_edge, first } => {
                let passed = go_back(sub_edge, first, map, winding);
                return passed + self.walk_behind(first, first, map, winding);
            }
            Step::Behind { sub_edge, first } => return self.walk_behind(sub_edge, first, map, winding),
            Step::Return { sub_edge, first } => return go_forward(sub_edge, first, map, winding),
            Step::Around { junction, place, left } => self.go_around(junction, place, left, map, winding),
            Step::Cross { sub_edge } => cross_overlapping(sub_edge, false, map, winding),
            Step::CrossBack { sub_edge } => cross_overlapping(sub_edge, true, map, winding),
            Step::Component { vertex } => self.enter_component(vertex, map, winding),
        }
        0
    }

    /// Walks over one crossing after the other until there is something else to do first.
    ///
    /// At a crossing the other ring is entered, too, at the sub-edge that has the walk's place on its left:
    ///
    /// ```text
    ///        ^ other             g comes from the right: `other`, which starts here, has the place left of e on its
    ///  left  |                   left. It is entered before the crossing is passed. Where g comes from the left, the
    ///  ──e──>+──next──>          sub-edge before `other`, which ends here, has the place left of `next` on its left. It
    ///        | g                 is entered after the crossing is passed.
    /// ```
    ///
    /// The step pushed last is done first and restores the state, so that the `Ahead` below it goes on from the same place.
    /// Where there is nothing to do first, the walk goes on without the stack, for a while.
    fn walk_ahead(
        &mut self,
        mut sub_edge: u32,
        first: u32,
        map: Map<'_>,
        winding: &mut WindingNumbers,
    ) -> usize {
        for passed in 1..=PART {
            let next = map.arrangement.following(map.edges, sub_edge);
            let other = match map.arrangement.met(next) {
                Node::Junction(junction) if self.seen[junction as usize] => {
                    let back = go_back(sub_edge, first, map, winding);
                    return passed + back + self.walk_behind(first, first, map, winding);
                }
                Node::Junction(junction) => {
                    self.steps.push(Step::Back { sub_edge, first });
                    self.enter_junction(junction, 2 * sub_edge + 1, map);
                    return passed;
                }
                Node::Crossing(other) => other,
            };
            let from_left = map.arrangement.crossed_from_left(next);
            if !from_left && !self.is_walked(other) {
                // It has the place left of `sub_edge` on its left, so it is entered before the crossing is passed.
                self.steps.push(Step::Ahead { sub_edge, first });
                self.enter(other, map, winding);
                return passed;
            }
            map.edges.cross(map.arrangement.edge(other), !from_left, winding);
            let closes = next == first;
            let has_nested = !closes && self.label(next, map, winding);
            let enters = !self.is_walked(other);
            if closes || has_nested || enters {
                self.steps.extend((!closes).then_some(Step::Ahead { sub_edge: next, first }));
                self.take_nested(next, has_nested);
                if enters {
                    self.enter(map.arrangement.previous(map.edges, other), map, winding);
                }
                return passed;
            }
            sub_edge = next;
        }
        self.steps.push(Step::Ahead { sub_edge, first });
        PART
    }

    /// The same against the ring, for what lies before the sub-edge where a walk started, back to a junction.
    fn walk_behind(
        &mut self,
        mut sub_edge: u32,
        first: u32,
        map: Map<'_>,
        winding: &mut WindingNumbers,
    ) -> usize {
        for passed in 1..=PART {
            let other = match map.arrangement.met(sub_edge) {
                Node::Junction(junction) if self.seen[junction as usize] => {
                    return passed + go_forward(sub_edge, first, map, winding);
                }
                Node::Junction(junction) => {
                    self.steps.push(Step::Return { sub_edge, first });
                    self.enter_junction(junction, 2 * sub_edge, map);
                    return passed;
                }
                Node::Crossing(other) => other,
            };
            let from_left = map.arrangement.crossed_from_left(sub_edge);
            if from_left && !self.is_walked(other) {
                self.steps.push(Step::Behind { sub_edge, first });
                self.enter(map.arrangement.previous(map.edges, other), map, winding);
                return passed;
            }
            map.edges.cross(map.arrangement.edge(other), from_left, winding);
            sub_edge = map.arrangement.previous(map.edges, sub_edge);
            let has_nested = self.label(sub_edge, map, winding);
            let enters = !self.is_walked(other);
            if has_nested || enters {
                self.steps.push(Step::Behind { sub_edge, first });
                self.take_nested(sub_edge, has_nested);
                if enters {
                    self.enter(other, map, winding);
                }
                return passed;
            }
        }
        self.steps.push(Step::Behind { sub_edge, first });
        PART
    }

    /// Whether the chain of a sub-edge was walked, or is being walked.
    #[inline]
    fn is_walked(&self, sub_edge: u32) -> bool {
        self.walked[self.chain[sub_edge as usize] as usize]
    }

    /// Starts with a sub-edge that has the walk's place on its left.
    fn enter(&mut self, sub_edge: u32, map: Map<'_>, winding: &mut WindingNumbers) {
        self.walked[self.chain[sub_edge as usize] as usize] = true;
        self.steps.push(Step::Ahead { sub_edge, first: sub_edge });
        let has_nested = self.label(sub_edge, map, winding);
        self.take_nested(sub_edge, has_nested);
    }

    /// Starts to go around a junction, from the right of a half-edge that leads away along the walk's sub-edge against it,
    /// or from its left along it: both times the sub-edge's left.
    fn enter_junction(&mut self, junction: u32, half_edge: u32, map: Map<'_>) {
        self.seen[junction as usize] = true;
        let span = map.arrangement.span(junction);
        let Some(mut place) = span.clone().find(|&place| map.arrangement.around(place) == half_edge) else {
            return;
        };
        let left = span.end - span.start;
        let group = map.group(junction, place);
        place = if half_edge & 1 == 0 { group.end } else { group.start };
        self.steps.push(Step::Around { junction, place, left });
    }

    /// Crosses the groups of half-edges around a junction up to one whose sub-edge is not known, which is walked.
    fn go_around(
        &mut self,
        junction: u32,
        mut place: u32,
        mut left: u32,
        map: Map<'_>,
        winding: &mut WindingNumbers,
    ) {
        let span = map.arrangement.span(junction);
        while left > 0 {
            let group = map.group(junction, if place == span.end { span.start } else { place });
            let representative = map.arrangement.representative(map.arrangement.around(group.start) >> 1);
            let along = group.clone().any(|place| map.arrangement.around(place) == 2 * representative);
            cross_overlapping(representative, !along, map, winding);
            place = group.end;
            left -= group.end - group.start;
            if !self.is_walked(representative) {
                self.steps.push(Step::Around { junction, place, left });
                if !along {
                    cross_overlapping(representative, false, map, winding);
                    self.steps.push(Step::CrossBack { sub_edge: representative });
                }
                return self.enter(representative, map, winding);
            }
        }
    }

    /// Labels a sub-edge from the place on its left; returns whether anything is nested beside it.
    #[inline]
    fn label(&mut self, sub_edge: u32, map: Map<'_>, winding: &mut WindingNumbers) -> bool {
        if map.arrangement.representative(sub_edge) != sub_edge {
            return false;
        }
        let left = winding.holds();
        let right = holds_behind(sub_edge, map, winding);
        let known = Label::KNOWN | (u8::from(left) * Label::LEFT) | (u8::from(right) * Label::RIGHT);
        let label = &mut self.labels[sub_edge as usize];
        debug_assert!(!label.is(Label::KNOWN) || label.0 | Label::HAS_NESTED == known | Label::HAS_NESTED);
        label.0 |= known;
        label.is(Label::HAS_NESTED)
    }

    /// Takes up what is nested beside a sub-edge, if anything is.
    fn take_nested(&mut self, sub_edge: u32, has_nested: bool) {
        if !has_nested {
            return;
        }
        let first = self.nested.partition_point(|nested| nested.sub_edge < sub_edge);
        let nested = self.nested[first..].iter().take_while(|nested| nested.sub_edge == sub_edge);
        let component = |nested: &NestedComponent| Step::Component { vertex: nested.vertex };
        self.steps.extend(nested.clone().filter(|nested| nested.left).map(component));
        if nested.clone().any(|nested| !nested.left) {
            self.steps.push(Step::Cross { sub_edge });
            self.steps.extend(nested.filter(|nested| !nested.left).map(component));
            self.steps.push(Step::CrossBack { sub_edge });
        }
    }

    fn enter_component(&mut self, vertex: u32, map: Map<'_>, winding: &mut WindingNumbers) {
        if let Some(junction) =
            map.contacts.node_at(vertex).and_then(|node| map.arrangement.junction_at(node))
        {
            let span = map.arrangement.span(junction);
            self.seen[junction as usize] = true;
            self.steps.push(Step::Around { junction, place: span.start, left: span.end - span.start });
            return;
        }
        let sub_edge = map.sub_edge_at(vertex);
        let ring = map.edges.ring(vertex);
        let [before, at, after] =
            [ring.previous(vertex), vertex, ring.next(vertex)].map(|v| map.edges.point(v));
        if side(before, at, after) == Side::Left {
            cross_overlapping(sub_edge, false, map, winding);
            self.steps.push(Step::CrossBack { sub_edge });
        }
        if sub_edge as usize >= map.arrangement.len() {
            let has_nested = self.label(sub_edge, map, winding);
            self.take_nested(sub_edge, has_nested);
        } else {
            self.enter(sub_edge, map, winding);
        }
    }
}
