//! Which cones may meet: a sweep over the rectangles of slopes around them.
use super::slopes::Slopes;

/// From so many cones on it pays to look for those inside of others.
const MANY: usize = 12;
/// So many of the largest are looked into.
const LARGE: usize = 4;

/// Cones, and the rectangles around them.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    found: Vec<(Slopes, usize)>,
}

impl Neighbours {
    pub(super) fn clear(&mut self) {
        self.found.clear();
    }

    pub(super) fn push(&mut self, around: Slopes, cone: usize) {
        self.found.push((around, cone));
    }

    /// The cones that may be inside of another one, whose rectangle is given, as theirs are inside of it.
    pub(super) fn inside(&self, outer: Slopes) -> impl Iterator<Item = usize> + '_ {
        self.found.iter().filter(move |(around, _)| outer.contains(around)).map(|(_, cone)| *cone)
    }

    pub(super) fn retain(&mut self, is_kept: impl Fn(usize) -> bool) {
        self.found.retain(|(_, cone)| is_kept(*cone));
    }

    pub(super) fn cones(&self) -> impl Iterator<Item = usize> + '_ {
        self.found.iter().map(|(_, cone)| *cone)
    }

    /// Whether there are so many that it pays to look for those inside of others.
    pub(super) fn are_many(&self) -> bool {
        self.found.len() >= MANY
    }

    /// A few of the largest cones, as others may be inside of them.
    pub(super) fn largest(&self) -> impl Iterator<Item = (Slopes, usize)> + use<> {
        let mut largest: [Option<(Slopes, usize)>; LARGE] = [None; LARGE];
        let area = |one: &Option<(Slopes, usize)>| one.map_or(0.0, |(around, _)| around.area());
        for found in &self.found {
            let mut next = Some(*found);
            for place in &mut largest {
                if area(&next) > area(place) {
                    std::mem::swap(place, &mut next);
                }
            }
        }
        largest.into_iter().flatten()
    }

    /// Calls back with every two cones whose rectangles meet.
    ///
    /// Takes O(n log n) for n cones, and more where many rectangles overlap in the first slope.
    pub(super) fn for_each_pair(&mut self, mut found: impl FnMut([usize; 2])) {
        self.found.sort_unstable_by(|(a, i), (b, j)| a.low.x.total_cmp(&b.low.x).then(i.cmp(j)));
        for (place, (around, cone)) in self.found.iter().enumerate() {
            for (other_around, other) in &self.found[place + 1..] {
                if other_around.low.x > around.high.x {
                    break;
                }
                if around.meets_beside(other_around) {
                    found([*cone, *other]);
                }
            }
        }
    }
}
