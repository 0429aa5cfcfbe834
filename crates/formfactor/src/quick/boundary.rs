//! What is left of each edge: that of an occluder is clipped to the target, and each is hidden by the cones that it meets.
use super::cone::{Cones, OneCone};
use super::exact_side::Span;
use super::inside::{Inside, inside};
use super::interval::Interval;
use super::lanes::MOST;
use super::sides::{Sides, Standing};

/// What is left of every edge so far: those of the target, and then those of the cones.
#[derive(Debug, Default)]
pub(super) struct Boundary {
    rests: Vec<Rest>,
    /// How many edges the target has.
    sides: usize,
    /// Hidden parts of edges, each with the one before it of the same edge.
    parts: Vec<(Interval, u32)>,
    /// Which cones are known to be inside of others, which hide all that they hide: of none where cones are few.
    swallowed: Vec<bool>,
    /// The sides of the corners of a cone, and of those of another one.
    within: [Sides; 2],
}

/// No part.
const NONE: u32 = u32::MAX;

/// What is left of an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    /// The part that borders on the target.
    whole: Interval,
    /// The last of its hidden parts.
    last: u32,
    /// Whether nothing is left.
    is_lost: bool,
    /// Whether doubles leave open what is left.
    is_open: bool,
}

/// How two cones lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Relation {
    Apart,
    /// They touch along an edge that both have: its numbers.
    Beside([usize; 2]),
    FirstInside,
    SecondInside,
    /// All signs are certain.
    Crossing,
    Open,
}

/// Two cones that cross, and on which sides of the planes of each the corners of the other one are.
struct Meeting<'m> {
    cones: [&'m OneCone<'m>; 2],
    span: &'m Span<'m>,
    sides: [&'m Sides; 2],
    relation: Relation,
}

impl Meeting<'_> {
    fn reversed(&self) -> Self {
        let ([first, second], [there, back]) = (self.cones, self.sides);
        Self { cones: [second, first], sides: [back, there], ..*self }
    }

    /// Calls back with what of each edge of the first cone is inside the second, where anything is left of the edge.
    #[inline]
    fn for_each_part(&self, rests: &mut [Rest], mut found: impl FnMut(&mut Rest, Inside)) {
        let ([first, second], [there, back]) = (self.cones, self.sides);
        for (index, (edge, rest)) in first.edges.iter().zip(rests).enumerate() {
            if rest.is_lost {
                continue;
            }
            let part = match self.relation {
                Relation::Crossing => there.part(edge, index, second.edges, back),
                _ => inside(self.span, (first, index), second),
            };
            found(rest, part);
        }
    }
}

impl Rest {
    const WHOLE: Self = Self { whole: Interval::WHOLE, last: NONE, is_lost: false, is_open: false };

    /// Keeps only what is inside the target. An edge along one of the target is that edge's.
    fn clip(&mut self, inside: Inside) {
        match inside {
            Inside::Part(part) => self.whole = part,
            Inside::Nothing | Inside::Along { .. } => self.is_lost = true,
            Inside::Open => self.is_open = true,
        }
    }

    /// Hides what is inside a cone. `loses` says whether the edge is lost to one that the cone has along it, by whether that runs
    /// the same way.
    fn hide(&mut self, inside: Inside, loses: impl Fn(bool) -> bool, parts: &mut Vec<(Interval, u32)>) {
        let part = match inside {
            Inside::Part(part) => part,
            Inside::Along { part, is_same_way } if loses(is_same_way) => part,
            Inside::Along { .. } | Inside::Nothing => return,
            Inside::Open => {
                self.is_open = true;
                return;
            }
        };
        if part.covers(&self.whole) {
            self.is_lost = true;
        } else {
            parts.push((part, self.last));
            self.last = u32::try_from(parts.len() - 1).unwrap_or(NONE);
        }
    }
}

impl Boundary {
    pub(super) fn begin(&mut self, target: OneCone, cones: &Cones) {
        self.sides = target.edges.len();
        self.rests.clear();
        self.rests.resize(self.sides + cones.edges().len(), Rest::WHOLE);
        self.parts.clear();
        self.swallowed.clear();
    }

    /// Clips a cone's edges to the target, and hides the target's behind it. Returns whether they meet.
    pub(super) fn clip(&mut self, span: &Span, target: OneCone, cones: &Cones, index: usize) -> bool {
        let (cone, first) = (cones.cone(index), self.sides + cones.first(index));
        let relation = self.compare(&cone, &target, false);
        let is_apart = matches!(relation, Relation::Apart | Relation::Beside(_));
        match relation {
            Relation::Apart | Relation::Beside(_) => self.lose(first, cone),
            Relation::Crossing | Relation::Open => {
                let Self { rests, parts, within: [there, back], .. } = self;
                let (of_target, of_cones) = rests.split_at_mut(first);
                let crossing = Meeting { cones: [&cone, &target], span, sides: [there, back], relation };
                crossing.for_each_part(of_cones, Rest::clip);
                // The same way, both are on one side of the edge, and it is hidden.
                let hide = |rest: &mut Rest, part| rest.hide(part, |is_same_way| is_same_way, parts);
                crossing.reversed().for_each_part(of_target, hide);
            }
            Relation::FirstInside => (),
            Relation::SecondInside => {
                self.lose(0, target);
                self.lose(first, cone);
            }
        }
        !is_apart
    }

    /// Notes from now on which of so many cones are inside of others.
    pub(super) fn watch(&mut self, cones: usize) {
        self.swallowed.resize(cones, false);
    }

    /// Whether a cone is known to be inside of another one.
    pub(super) fn is_swallowed(&self, cone: usize) -> bool {
        self.swallowed.get(cone).is_some_and(|is_swallowed| *is_swallowed)
    }

    /// Loses a cone that is inside of another one for certain: nothing of it is visible, and it hides nothing more.
    pub(super) fn swallow(&mut self, cones: &Cones, [inner, outer]: [usize; 2]) {
        let [small, large] = [inner, outer].map(|index| cones.cone(index));
        let is_known = inner == outer || self.is_swallowed(inner) || self.is_swallowed(outer);
        if is_known || small.edges.len().max(large.edges.len()) > MOST {
            return;
        }
        if self.within[0].find(&large, &small, inner > outer) == Standing::Contained {
            self.lose_all(cones, inner);
        }
    }

    /// Loses an edge of the cones, by its number among theirs.
    pub(super) fn lose_edge(&mut self, edge: usize) {
        self.rests[self.sides + edge].is_lost = true;
    }

    /// Whether nothing is left of any edge of a cone.
    fn is_all_lost(&self, cones: &Cones, index: usize) -> bool {
        let count = cones.cone(index).edges.len();
        self.rests[self.sides + cones.first(index)..][..count].iter().all(|rest| rest.is_lost)
    }

    /// Hides the edges of two cones behind each other.
    pub(super) fn hide(&mut self, span: &Span, cones: &Cones, [a, b]: [usize; 2]) {
        if self.is_swallowed(a) || self.is_swallowed(b) {
            return;
        }
        if self.is_all_lost(cones, a) && self.is_all_lost(cones, b) {
            return;
        }
        let [first, second] = [a, b].map(|index| cones.cone(index));
        let [at_first, at_second] = [a, b].map(|index| self.sides + cones.first(index));
        let relation = self.compare(&first, &second, a > b);
        match relation {
            Relation::Apart => (),
            Relation::Beside([one, other]) => {
                self.rests[at_first + one].is_lost = true;
                self.rests[at_second + other].is_lost = true;
            }
            Relation::FirstInside => self.lose_all(cones, a),
            Relation::SecondInside => self.lose_all(cones, b),
            Relation::Crossing | Relation::Open => {
                let Self { rests, parts, within: [there, back], .. } = self;
                let meeting = Meeting { cones: [&first, &second], span, sides: [there, back], relation };
                // Edges that both have the same way are on the boundary of their union: the first of the two keeps it. The other
                // way, the cones are on either side: the edge is inside the union, and both lose it.
                meeting.for_each_part(&mut rests[at_first..], |rest, part| {
                    rest.hide(part, |is_same_way| !is_same_way || b < a, parts);
                });
                meeting.reversed().for_each_part(&mut rests[at_second..], |rest, part| {
                    rest.hide(part, |is_same_way| !is_same_way || a < b, parts);
                });
            }
        }
    }

    /// Nothing is left of a cone that is inside of another one.
    fn lose_all(&mut self, cones: &Cones, index: usize) {
        self.lose(self.sides + cones.first(index), cones.cone(index));
        if let Some(is_swallowed) = self.swallowed.get_mut(index) {
            *is_swallowed = true;
        }
    }

    /// Nothing is left of a cone's edges, the first of which is at `first`.
    fn lose(&mut self, first: usize, cone: OneCone) {
        self.rests[first..][..cone.edges.len()].iter_mut().for_each(|rest| rest.is_lost = true);
    }

    /// How two cones lie. Where they cross, on which sides of their planes the corners of the other one are. Where they share corners, the
    /// first counts as the smaller one if it is said to be, else the second.
    #[inline]
    fn compare(&mut self, first: &OneCone, second: &OneCone, is_first_smaller: bool) -> Relation {
        let [there, back] = &mut self.within;
        if first.edges.len().max(second.edges.len()) > MOST {
            return Relation::Open;
        }
        let standing = there.find(second, first, is_first_smaller);
        match standing {
            Standing::Apart => return Relation::Apart,
            Standing::Beside(edges) => return Relation::Beside(edges),
            Standing::Contained => return Relation::FirstInside,
            Standing::Certain | Standing::Open => (),
        }
        match (standing, back.find(first, second, !is_first_smaller)) {
            (_, Standing::Apart) => Relation::Apart,
            (_, Standing::Beside([other, one])) => Relation::Beside([one, other]),
            (_, Standing::Contained) => Relation::SecondInside,
            (Standing::Certain, Standing::Certain) => Relation::Crossing,
            _ => Relation::Open,
        }
    }

    /// What is left of the target's edges, and of the cones'.
    pub(super) fn rests(&self) -> (&[Rest], &[Rest]) {
        self.rests.split_at(self.sides)
    }

    /// The part of an edge that borders on the target, if any of it is left, and its hidden parts; `None` where doubles leave that
    /// open.
    pub(super) fn left(&self, rest: &Rest, hidden: &mut Vec<Interval>) -> Option<Option<Interval>> {
        if rest.is_lost {
            return Some(None);
        }
        hidden.clear();
        let mut last = rest.last;
        while let Some((part, before)) = self.parts.get(last as usize) {
            hidden.push(*part);
            last = *before;
        }
        (!rest.is_open).then_some(Some(rest.whole))
    }
}
