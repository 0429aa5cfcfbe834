//! Which cones may meet, and which lie behind another one.
use super::cone::{Cones, Place};

/// Pairs of cones whose rectangles meet.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    order: Vec<usize>,
    pairs: Vec<[usize; 2]>,
    /// The neighbours of each cone, one cone after the other, and where each one's begin.
    rows: Vec<usize>,
    starts: Vec<usize>,
    is_hidden: Vec<bool>,
}

impl Neighbours {
    /// Takes O(n log n), and more where many begin before one ends.
    pub(super) fn find(&mut self, cones: &Cones) {
        self.find_pairs(cones);
        self.is_hidden.clear();
        self.is_hidden.resize(cones.len(), false);
        for [a, b] in &self.pairs {
            for (inner, outer) in [(*a, *b), (*b, *a)] {
                self.is_hidden[inner] = self.is_hidden[inner] || lies_behind(cones, inner, outer);
            }
        }
        self.fill_rows(cones.len());
    }

    /// The cones that do not lie behind another one.
    pub(super) fn shown(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_hidden.len()).filter(|cone| !self.is_hidden[*cone])
    }

    /// Those of them that may meet a cone.
    pub(super) fn of(&self, cone: usize) -> impl Iterator<Item = usize> + '_ {
        self.rows[self.starts[cone]..self.starts[cone + 1]].iter().copied()
    }

    /// How many lie behind another one.
    pub(super) fn hidden(&self) -> u64 {
        self.is_hidden.iter().map(|is_hidden| u64::from(*is_hidden)).sum()
    }

    fn find_pairs(&mut self, cones: &Cones) {
        let Self { order, pairs, .. } = self;
        order.clear();
        order.extend(0..cones.len());
        order.sort_unstable_by(|a, b| cones.extent(*a).low.x.total_cmp(&cones.extent(*b).low.x));
        pairs.clear();
        for (place, &a) in order.iter().enumerate() {
            let extent = cones.extent(a);
            let begun = order[place + 1..].iter().take_while(|b| cones.extent(**b).low.x <= extent.high.x);
            pairs.extend(begun.filter(|b| cones.extent(**b).meets(extent)).map(|b| [a, *b]));
        }
    }

    fn fill_rows(&mut self, count: usize) {
        let Self { pairs, rows, starts, is_hidden, .. } = self;
        pairs.retain(|[a, b]| !is_hidden[*a] && !is_hidden[*b]);
        starts.clear();
        starts.resize(count + 2, 0);
        for cone in pairs.iter().flatten() {
            starts[cone + 2] += 1;
        }
        for cone in 2..starts.len() {
            starts[cone] += starts[cone - 1];
        }
        rows.clear();
        rows.resize(2 * pairs.len(), 0);
        for [a, b] in pairs.iter() {
            for (cone, other) in [(*a, *b), (*b, *a)] {
                rows[starts[cone + 1]] = other;
                starts[cone + 1] += 1;
            }
        }
    }
}

/// Whether a cone lies in another one for certain: all of its shadow is in the other's.
fn lies_behind(cones: &Cones, inner: usize, outer: usize) -> bool {
    let is_inside = |start| cones.edges(outer).iter().all(|plane| plane.place(start) == Place::Inside);
    cones.extent(outer).holds(cones.extent(inner))
        && cones.edges(inner).iter().all(|edge| is_inside(edge.start))
}
