//! Edges that features of a union share in opposite directions: they lie in its interior, so they change no bit of it.
//!
//! ```text
//!     +-----+-----+         +-----+-----+       The winding numbers of valid areas, which run counter-clockwise around their
//!     |     |     |         |           |       interiors, add up to the winding number of all their edges. So the union is
//!     |  A  |  B  |   ->    |           |       where all edges together wind once or more, and an edge that is there in both
//!     |     |     |         |           |       directions may go. What stays is closed: rings again, that may wind twice
//!     +-----+-----+         +-----+-----+       where areas overlap.
//! ```
use super::state::{self, by_point, rings};
use crate::error::Error;
use datafusion_common::HashMap;
use polycsg::{Csg, DVec2, FillRule, Scratch};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;

/// Of states of more bytes a sample of the edges is looked at first, one in so many.
const LARGE: usize = 1 << 14;
const ONE_IN: u64 = 16;

/// The two points of an edge.
type EdgeEnds = [DVec2; 2];

/// The bits of the ends of an edge, the lower one from the left first.
type EdgeBits = [[u64; 2]; 2];

/// The state of a union without the edges that its features share in opposite directions; none, if less than half of the edges are shared:
/// to see on which side of their edges features lie takes as long as evaluating them.
///
/// Features without such edges stay as they are, and so do those whose edges cross: on which side of an edge they lie is not known.
/// Expected O(n log n) for n edges.
pub(crate) fn without_shared_edges<'s>(features: &[&'s [u8]]) -> Result<Option<Vec<u8>>, Error> {
    let read = |bytes: &&'s [u8]| Ok((*bytes, rings(bytes)?));
    let read: Vec<(&[u8], Vec<Vec<DVec2>>)> = features.iter().map(read).collect::<Result<_, Error>>()?;
    if !are_mostly_shared(&read) {
        return Ok(None);
    }
    let mut edges = Edges::default();
    let features: Vec<Numbered> =
        read.into_iter().map(|(bytes, rings)| edges.numbered(bytes, rings)).collect();
    let (mut winding, mut scratch) = (Winding::of(&edges), Scratch::default());
    let mut kept = Vec::new();
    for feature in &features {
        match feature.directed(&edges, &mut scratch)? {
            Some(directed) => winding.add(&directed, feature.members()?),
            None => kept.extend_from_slice(feature.bytes),
        }
    }
    let left = winding.edges();
    if left.len() == winding.added {
        return Ok(None);
    }
    state::append_outlines(&mut kept, winding.members, &closed(left));
    Ok(Some(kept))
}

/// Whether half of the edges stand in more than one place. The sample has all places of an edge or none.
fn are_mostly_shared(features: &[(&[u8], Vec<Vec<DVec2>>)]) -> bool {
    let is_large = features.iter().map(|(bytes, _)| bytes.len()).sum::<usize>() > LARGE;
    let mut uses: HashMap<EdgeBits, usize> = HashMap::new();
    for (_, rings) in features {
        let taken =
            edges(rings).map(|edge| bits(upwards(edge))).filter(|edge| !is_large || is_in_sample(edge));
        taken.for_each(|edge| *uses.entry(edge).or_default() += 1);
    }
    let shared: usize = uses.values().filter(|&&uses| uses > 1).sum();
    shared > 0 && 2 * shared >= uses.values().sum()
}

fn is_in_sample(edge: &EdgeBits) -> bool {
    let mut hasher = DefaultHasher::new();
    edge.hash(&mut hasher);
    hasher.finish().is_multiple_of(ONE_IN)
}

fn bits(edge: EdgeEnds) -> EdgeBits {
    edge.map(|p| p.to_array().map(f64::to_bits))
}

/// All edges of a state, each once, whichever way it runs.
#[derive(Default)]
struct Edges {
    number: HashMap<EdgeBits, u32>,
    /// Each with its lower end from the left first.
    edges: Vec<EdgeEnds>,
    /// In how many places it is.
    uses: Vec<u32>,
    /// The numbers of the edges of all features, one feature after another.
    of_features: Vec<u32>,
}

/// A feature, and which of `of_features` are its edges.
struct Numbered<'s> {
    bytes: &'s [u8],
    rings: Vec<Vec<DVec2>>,
    edges: Range<usize>,
}

impl Edges {
    fn numbered<'s>(&mut self, bytes: &'s [u8], rings: Vec<Vec<DVec2>>) -> Numbered<'s> {
        let first = self.of_features.len();
        edges(&rings).for_each(|edge| self.add(upwards(edge)));
        Numbered { bytes, rings, edges: first..self.of_features.len() }
    }

    fn add(&mut self, edge: EdgeEnds) {
        let next = u32::try_from(self.edges.len()).unwrap_or(u32::MAX);
        let number = *self.number.entry(bits(edge)).or_insert(next);
        if number == next {
            self.edges.push(edge);
            self.uses.push(0);
        }
        self.uses[number as usize] += 1;
        self.of_features.push(number);
    }
}

/// An edge by its number, and whether it runs upwards or to the right.
type Directed = (u32, bool);

impl Numbered<'_> {
    /// How many features it stands for.
    fn members(&self) -> Result<u32, Error> {
        Ok(state::members(self.bytes)?.unwrap_or(1))
    }

    /// The edges with what they enclose to their left, if it is an outline, or shares an edge and its edges do not cross.
    fn directed(&self, all: &Edges, scratch: &mut Scratch) -> Result<Option<Vec<Directed>>, Error> {
        let numbers = &all.of_features[self.edges.clone()];
        let runs = |(edge, &number): (EdgeEnds, &u32)| (number, edge[0] == all.edges[number as usize][0]);
        if state::members(self.bytes)?.is_some() {
            return Ok(Some(edges(&self.rings).zip(numbers).map(runs).collect()));
        }
        if numbers.iter().all(|&number| all.uses[number as usize] < 2) {
            return Ok(None);
        }
        let Ok(read) = Csg::from_rings(&self.rings, FillRule::EvenOdd) else { return Ok(None) };
        let contacts = 16 * self.bytes.len(); // no more than what it takes to find that they cross
        let Ok(boundary) = read.try_boundary(scratch, contacts) else { return Ok(None) };
        let mut directed = Vec::with_capacity(numbers.len());
        for edge in boundary.edges() {
            let number = numbers[edge.edge];
            if upwards([edge.start, edge.end]) != all.edges[number as usize] {
                return Ok(None); // it is cut
            }
            directed.push(runs(([edge.start, edge.end], &number)));
        }
        let is_whole = directed.len() == edges(&self.rings).filter(|[start, end]| start != end).count();
        Ok(is_whole.then_some(directed))
    }
}

/// How often each edge stands in the boundary of features on top of one another.
struct Winding<'e> {
    all: &'e Edges,
    /// Counted upwards; downwards is below 0.
    sums: Vec<i32>,
    added: usize,
    members: u32,
}

impl Winding<'_> {
    fn of(all: &Edges) -> Winding<'_> {
        Winding { all, sums: vec![0; all.edges.len()], added: 0, members: 0 }
    }

    fn add(&mut self, edges: &[Directed], members: u32) {
        edges
            .iter()
            .for_each(|&(edge, is_upwards)| self.sums[edge as usize] += if is_upwards { 1 } else { -1 });
        self.added += edges.len();
        self.members = self.members.saturating_add(members);
    }

    /// The edges that do not cancel, as often as they are there.
    fn edges(&self) -> Vec<EdgeEnds> {
        let directed = |([low, high], sum): (&EdgeEnds, &i32)| {
            let edge = if *sum > 0 { [*low, *high] } else { [*high, *low] };
            std::iter::repeat_n(edge, sum.unsigned_abs() as usize)
        };
        self.all.edges.iter().zip(&self.sums).flat_map(|(edge, sum)| directed((edge, sum))).collect()
    }
}

/// Rings of edges of which as many leave each point as arrive.
fn closed(mut edges: Vec<EdgeEnds>) -> Vec<Vec<DVec2>> {
    edges.sort_unstable_by(|a, b| by_point(&a[0], &b[0]).then(by_point(&a[1], &b[1])));
    // How many of the edges that leave a point are taken, where the first of them stands.
    let mut taken = vec![0; edges.len()];
    let mut take = |from: DVec2| {
        let first = edges.partition_point(|edge| by_point(&edge[0], &from).is_lt());
        let next = edges.get(first + taken.get(first)?).filter(|edge| edge[0] == from)?;
        taken[first] += 1;
        Some(next[1])
    };
    let mut rings = Vec::new();
    for &[start, _] in &edges {
        let mut ring = Vec::new();
        while let Some(next) = take(ring.last().copied().unwrap_or(start)) {
            ring.push(next);
            if next == start {
                break;
            }
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    rings
}

/// The edges of rings, in their directions.
fn edges(rings: &[Vec<DVec2>]) -> impl Iterator<Item = EdgeEnds> {
    rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)).map(|(&a, &b)| [a, b]))
}

fn upwards([a, b]: EdgeEnds) -> EdgeEnds {
    if by_point(&a, &b).is_gt() { [b, a] } else { [a, b] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn feature(rings: &[&[[f64; 2]]]) -> Vec<u8> {
        let (mut state, rings) = (vec![], rings.iter().map(|ring| ring.iter().map(|&p| p.into()).collect()));
        let rings: Vec<Vec<DVec2>> = rings.collect();
        state::append(&mut state, rings.iter().map(Vec::as_slice));
        state
    }

    fn square([x, y]: [f64; 2], size: f64) -> [[f64; 2]; 4] {
        [[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
    }

    /// What stays of features: members and points of each ring, and how many features are as they were.
    fn outline(features: &[Vec<u8>]) -> Option<(Vec<(u32, usize)>, usize)> {
        let features: Vec<&[u8]> = features.iter().map(Vec::as_slice).collect();
        let state = without_shared_edges(&features).expect("whole")?;
        let (mut outlines, mut kept) = (vec![], 0);
        for feature in state::split(&state).expect("whole") {
            match state::members(feature).expect("whole") {
                Some(members) => outlines.push((members, rings(feature).expect("whole")[0].len())),
                None => kept += 1,
            }
        }
        Some((outlines, kept))
    }

    #[test]
    fn of_a_grid_the_outer_edges_stay() {
        let cells: Vec<_> =
            (0..400).map(|i| feature(&[&square([f64::from(i % 20), f64::from(i / 20)], 1.0)])).collect();
        assert_eq!(outline(&cells), Some((vec![(400, 80)], 0)));
        // In parts, and the parts again.
        let (mut parts, mut split) = (vec![], vec![]);
        for part in cells.chunks(90) {
            let part: Vec<&[u8]> = part.iter().map(Vec::as_slice).collect();
            parts.push(without_shared_edges(&part).expect("whole").expect("smaller"));
        }
        parts.iter().for_each(|part| split.extend(state::split(part).expect("whole")));
        let split: Vec<Vec<u8>> = split.into_iter().map(<[u8]>::to_vec).collect();
        assert_eq!(outline(&split), Some((vec![(400, 80)], 0)));
    }

    #[test]
    fn a_hole_and_what_fills_it_leave_the_outer_ring() {
        let inner = square([1.0, 1.0], 1.0);
        let frame = feature(&[&square([0.0, 0.0], 3.0), &inner]);
        assert_eq!(outline(&[frame.clone(), feature(&[&inner])]), Some((vec![(2, 4)], 0)));
        // Twice the filling: one of them stays, as an edge that was counted away may not come back.
        let twice = [frame.clone(), feature(&[&inner]), feature(&[&inner])];
        assert_eq!(outline(&twice), Some((vec![(3, 4), (0, 4)], 0)));
    }

    #[test]
    fn what_is_not_known_stays() {
        let cells = |columns: u32| -> Vec<Vec<u8>> {
            (0..3 * columns).map(|i| feature(&[&square([f64::from(i / 3), f64::from(i % 3)], 1.0)])).collect()
        };
        let bow_tie = feature(&[&[[0.0, 0.0], [1.0, 0.0], [0.0, -1.0], [1.0, -1.0]]]);
        let with_bow_tie = [cells(3), vec![bow_tie.clone()]].concat();
        assert_eq!(outline(&with_bow_tie), Some((vec![(9, 12)], 1)));
        assert_eq!(outline(&[cells(1)[0].clone(), bow_tie]), None);
        // 2 of 8 edges.
        assert_eq!(outline(&cells(1)[..2]), None);
    }
}
