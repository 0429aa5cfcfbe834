//! Features in parts that have nothing to do with one another, by their boxes.
use polycsg::DVec2;
use std::collections::BTreeMap;

/// Boxes that the sweep has seen and may still meet, as one interval of y.
struct Active {
    high: f64,
    /// Up to which x.
    until: f64,
    /// A box of it.
    member: usize,
}

/// The numbers of the boxes in groups, such that no box of one group touches a box of another, in O(n log n).
///
/// A sweep from left to right keeps disjoint intervals of y, each for all the boxes that were joined there, until the last of these
/// ends. So a group may have parts that do not touch; no two groups have boxes that do. Empty boxes are left out.
pub(crate) fn components(boxes: &[[DVec2; 2]]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..boxes.len()).filter(|&i| boxes[i][0].cmple(boxes[i][1]).all()).collect();
    order.sort_by(|&i, &j| boxes[i][0].x.total_cmp(&boxes[j][0].x));
    let (mut parents, mut active): (Vec<usize>, _) = ((0..boxes.len()).collect(), BTreeMap::new());
    for &i in &order {
        let [low, high] = boxes[i];
        let mut joined = (low.y, Active { high: high.y, until: high.x, member: i });
        for (bottom, met) in taken(&mut active, low.y, high.y) {
            if met.until < low.x {
                continue; // it ends before this one begins
            }
            let [a, b] = [root(&mut parents, met.member), root(&mut parents, i)];
            parents[a] = b;
            let (from, all) = joined;
            let (high, until) = (all.high.max(met.high), all.until.max(met.until));
            joined = (from.min(bottom), Active { high, until, member: i });
        }
        active.insert(Ordinate(joined.0), joined.1);
    }
    grouped(&order, &mut parents)
}

/// Takes out the intervals that touch one of y.
fn taken(active: &mut BTreeMap<Ordinate, Active>, low: f64, high: f64) -> Vec<(f64, Active)> {
    let below = active.range(..=Ordinate(high)).rev();
    let touching: Vec<f64> =
        below.take_while(|(_, met)| met.high >= low).map(|(bottom, _)| bottom.0).collect();
    touching.into_iter().filter_map(|bottom| Some((bottom, active.remove(&Ordinate(bottom))?))).collect()
}

fn root(parents: &mut [usize], mut i: usize) -> usize {
    while parents[i] != i {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    i
}

fn grouped(order: &[usize], parents: &mut [usize]) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &i in order {
        groups.entry(root(parents, i)).or_default().push(i);
    }
    groups.into_values().collect()
}

/// A finite y as a key.
struct Ordinate(f64);

impl Ord for Ordinate {
    fn cmp(&self, other: &Ordinate) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Ordinate {
    fn partial_cmp(&self, other: &Ordinate) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ordinate {
    fn eq(&self, other: &Ordinate) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ordinate {}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, size: f64) -> [DVec2; 2] {
        [DVec2::new(x, y), DVec2::new(x + size, y + size)]
    }

    fn touch([low, high]: [DVec2; 2], [other_low, other_high]: [DVec2; 2]) -> bool {
        low.max(other_low).cmple(high.min(other_high)).all()
    }

    #[test]
    fn boxes_of_two_groups_never_touch_and_each_is_in_one() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            f64::from((state >> 52) as u16) / 4.0 // so coarse that many boxes touch in a point or a side
        };
        for size in [0.0, 1.0, 10.0, 100.0] {
            let boxes: Vec<_> = (0..300).map(|_| square(random(), random(), size)).collect();
            let groups = components(&boxes);
            let mut group_of = vec![usize::MAX; boxes.len()];
            groups.iter().enumerate().for_each(|(g, group)| group.iter().for_each(|&i| group_of[i] = g));
            assert!(group_of.iter().all(|&group| group < groups.len()));
            assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), boxes.len());
            for (i, j) in (0..300).flat_map(|i| (0..i).map(move |j| (i, j))) {
                assert!(group_of[i] == group_of[j] || !touch(boxes[i], boxes[j]), "{i} {j}");
            }
        }
    }

    #[test]
    fn boxes_apart_are_groups_of_their_own() {
        let board: Vec<_> =
            (0..400).map(|i| square(f64::from(i % 20) * 2.0, f64::from(i / 20) * 2.0, 1.0)).collect();
        assert_eq!(components(&board).len(), 400);
        let touching: Vec<_> = board.iter().map(|&[low, _]| [low, low + 2.0]).collect();
        assert_eq!(components(&touching).len(), 1);
        assert!(components(&[[DVec2::INFINITY, DVec2::NEG_INFINITY]]).is_empty());
    }
}
