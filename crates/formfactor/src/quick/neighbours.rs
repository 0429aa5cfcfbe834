//! Which cones may meet: a sweep over the rectangles of slopes around them.
use super::slopes::Slopes;

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
