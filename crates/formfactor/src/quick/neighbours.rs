//! Which cones may meet: a sweep over the rectangles of slopes around them.
use super::cone::Cones;

/// Pairs of cones whose rectangles meet.
#[derive(Debug, Default)]
pub(super) struct Neighbours {
    order: Vec<usize>,
    pairs: Vec<[usize; 2]>,
    /// The neighbours of each cone, one cone after the other (compressed rows), and where each cone's begin.
    rows: Vec<usize>,
    starts: Vec<usize>,
}

impl Neighbours {
    /// Takes O(n log n) for n cones, and more where many rectangles overlap in the first slope.
    pub(super) fn find(&mut self, cones: &Cones) {
        self.find_pairs(cones);
        self.fill_rows(cones.len());
    }

    /// The cones that may meet a cone.
    pub(super) fn of(&self, cone: usize) -> impl Iterator<Item = usize> + '_ {
        self.rows[self.starts[cone]..self.starts[cone + 1]].iter().copied()
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
        let Self { pairs, rows, starts, .. } = self;
        starts.clear();
        // Counts go two places further on, sums of counts one: filling the rows then moves each start to where it belongs.
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
