//! Boxes in a packed tree: sorted by columns, and by rows within them; over each few of them one box.
use crate::column::features::{Bounds, meet};

/// How many boxes lie under one.
const FAN: usize = 16;

/// Boxes that do not change, and the numbers that they stand for.
pub(crate) struct Tree {
    numbers: Vec<usize>,
    /// The boxes of the numbers, the boxes over each few of these, and so on to the top.
    levels: Vec<Vec<Bounds>>,
}

impl Tree {
    /// A tree of finite boxes that are around something.
    pub(crate) fn new(mut boxes: Vec<(Bounds, usize)>) -> Tree {
        sort_by_place(&mut boxes);
        let numbers = boxes.iter().map(|(_, number)| *number).collect();
        let mut levels = vec![boxes.into_iter().map(|(bounds, _)| bounds).collect::<Vec<Bounds>>()];
        while let Some(level) = levels.last().filter(|level| level.len() > FAN) {
            levels.push(level.chunks(FAN).map(around).collect());
        }
        Tree { numbers, levels }
    }

    /// The memory that a tree of so many boxes takes, from above.
    pub(crate) fn size_of(count: usize) -> usize {
        2 * count * (size_of::<Bounds>() + size_of::<usize>())
    }

    /// Adds the numbers of all boxes that meet a box.
    pub(crate) fn find(&self, bounds: &Bounds, found: &mut Vec<usize>) {
        let top = self.levels.len() - 1;
        self.descend(top, 0..self.levels[top].len(), bounds, found);
    }

    /// As deep as the tree has levels, at most sixteen.
    fn descend(&self, level: usize, boxes: std::ops::Range<usize>, bounds: &Bounds, found: &mut Vec<usize>) {
        for i in boxes.filter(|&i| meet(&self.levels[level][i], bounds)) {
            match level.checked_sub(1) {
                None => found.push(self.numbers[i]),
                Some(below) => {
                    let end = self.levels[below].len().min((i + 1) * FAN);
                    self.descend(below, i * FAN..end, bounds, found);
                }
            }
        }
    }
}

fn around(boxes: &[Bounds]) -> Bounds {
    let joined = |one: Bounds, other: &Bounds| [one[0].min(other[0]), one[1].max(other[1])];
    boxes[1..].iter().fold(boxes[0], joined)
}

/// By columns of as many boxes as there are columns, each from below.
fn sort_by_place(boxes: &mut [(Bounds, usize)]) {
    boxes.sort_unstable_by(|(a, i), (b, j)| a[0].x.total_cmp(&b[0].x).then(i.cmp(j)));
    let column = FAN * boxes.len().div_ceil(FAN).isqrt().max(1);
    for boxes in boxes.chunks_mut(column) {
        boxes.sort_unstable_by(|(a, i), (b, j)| a[0].y.total_cmp(&b[0].y).then(i.cmp(j)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use polycsg::DVec2;

    /// The tree finds the boxes that a look at each of them finds, for counts around a level's end.
    #[test]
    fn finds_what_a_scan_finds() {
        let mut state = 7_u64;
        let mut number = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / 1e5
        };
        for count in [0, 1, 15, 16, 17, 255, 256, 257, 1000] {
            let mut random = || {
                let low = DVec2::new(number(), number());
                [low, low + DVec2::new(number(), number()) / 16.0]
            };
            let boxes: Vec<(Bounds, usize)> = (0..count).map(|i| (random(), i)).collect();
            let tree = Tree::new(boxes.clone());
            for query in (0..50).map(|_| random()) {
                let mut found = vec![];
                tree.find(&query, &mut found);
                found.sort_unstable();
                let scanned: Vec<usize> =
                    boxes.iter().filter(|(bounds, _)| meet(bounds, &query)).map(|(_, i)| *i).collect();
                assert_eq!(found, scanned);
            }
        }
    }
}
