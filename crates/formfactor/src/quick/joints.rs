//! Edges that lie along edges of other cones but for roundings, and count as one with them.
//!
//! Which of two such edges is kept goes by their order, whichever of them is truly outside. So all that lie along one edge must count as
//! one with each other: else each of three in a ring might be left out in favour of the next.
use super::cone::{Edge, OneCone};
use super::inside::{Inside, inside, is_along};
use super::interval::Interval;
use glam::DVec3;

/// Which edges lie along which, by their numbers: those of the target come first.
#[derive(Debug, Default)]
pub(super) struct Joints {
    pairs: Vec<[usize; 2]>,
    /// A bound on the form factor of what is between them.
    pub(super) between: f64,
}

impl Joints {
    pub(super) fn clear(&mut self) {
        self.pairs.clear();
        self.between = 0.0;
    }

    /// Notes which edges of another cone a part of an edge lies along. What the two cones make of them must be the same part, but for what
    /// counts as between.
    pub(super) fn add(
        &mut self,
        (first, one): (usize, OneCone<'_>),
        (second, other): (usize, OneCone<'_>),
        (index, part, error): (usize, Interval, f64),
    ) {
        self.between += error;
        let edge = &one.edges[index];
        let mut met: Vec<DVec3> = Vec::new();
        for (number, plane) in (second..).zip(other.edges) {
            if !is_along(edge, plane) {
                continue;
            }
            self.pairs.extend([[first + index, number], [number, first + index]]);
            match inside(plane, other, one.edges) {
                Inside::Along { part, .. } => met.extend(ends(plane, part)),
                Inside::Nothing => (),
                Inside::Part(_) | Inside::Open => self.between = f64::INFINITY,
            }
        }
        self.between += mismatch(ends(edge, part), &met);
    }

    /// Whether an edge lies along another one; asked after [`Self::agree`].
    pub(super) fn have(&self, number: usize) -> bool {
        let place = self.pairs.partition_point(|pair| pair[0] < number);
        self.pairs.get(place).is_some_and(|pair| pair[0] == number)
    }

    /// Whether edges that lie along a third one were taken to lie along each other.
    pub(super) fn agree(&mut self) -> bool {
        self.pairs.sort_unstable();
        self.pairs.dedup();
        let agree = |pair: [usize; 2]| self.pairs.binary_search(&pair).is_ok();
        self.pairs.chunk_by(|a, b| a[0] == b[0]).all(|group| {
            let all = |(place, pair): (usize, &[usize; 2])| {
                group[place + 1..].iter().all(|other| agree([pair[1], other[1]]))
            };
            group.iter().enumerate().all(all)
        })
    }
}

/// The directions to the ends of a part of an edge.
fn ends(edge: &Edge, part: Interval) -> [DVec3; 2] {
    [part.low, part.high].map(|mark| (edge.start + edge.along * mark.at.clamp(0.0, 1.0)).normalize())
}

/// How far the ends of a part are from those of the parts that it met, and the ends of those from each other: all, where it met none.
fn mismatch([start, end]: [DVec3; 2], met: &[DVec3]) -> f64 {
    if met.is_empty() {
        return start.distance(end);
    }
    let nearest = |point: DVec3, others: &mut dyn Iterator<Item = DVec3>| {
        others.map(|other| point.distance(other)).fold(f64::INFINITY, f64::min)
    };
    let own: f64 = [start, end].map(|point| nearest(point, &mut met.iter().copied())).iter().sum();
    let theirs = met.iter().enumerate().map(|(place, point)| {
        // The other end of the same part does not count.
        let apart =
            met.iter().enumerate().filter(|(other, _)| other / 2 != place / 2).map(|(_, point)| *point);
        nearest(*point, &mut apart.chain([start, end]))
    });
    own + theirs.sum::<f64>()
}
