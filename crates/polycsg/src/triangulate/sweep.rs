//! A triangulation by a sweep from left to right, for coordinates that no scale makes fit spade.
//!
//! Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983, with any number of edges in a vertex. Between two
//! edges that the sweep line crosses, and that have the interior between them, lies what is still open: it is bounded
//! on the left by a chain of vertices from the lower edge to the upper one, whose angles are reflex or straight.
//!
//! ```text
//!     upper edge  o────────       A new vertex is joined to the ends or, where it splits the open part, to the
//!                  \              rightmost vertex of the chain; every angle below 180° that this makes is cut off
//!                   o    · v      as a triangle. The only predicate is the side of a line.
//!                  /
//!     lower edge  o───────
//! ```

use super::indexed::IndexedRegion;
use crate::base::id::index;
use crate::predicates::{Side, side};
use std::{cmp::Ordering, collections::VecDeque, ops::Range};

/// Vertices from the lower edge to the upper one.
type OpenChain = VecDeque<u32>;

/// An edge that the sweep line crosses, from left to right.
#[derive(Debug)]
struct Crossed {
    ends: [u32; 2],
    /// What is open above the edge, if the interior lies there.
    above: Option<OpenChain>,
}

struct Sweep<'a> {
    outline: &'a IndexedRegion,
    /// From bottom to top.
    crossed: Vec<Crossed>,
    triangles: Vec<[u32; 3]>,
}

/// The triangles. O(n log n), and for each vertex a move of what lies above it on the sweep line.
pub(super) fn triangles(outline: &IndexedRegion) -> Vec<[u32; 3]> {
    let mut starting: Vec<(u32, u32, bool)> = outline
        .edges
        .iter()
        .map(|&[from, to]| if from < to { (from, to, true) } else { (to, from, false) })
        .collect();
    starting.sort_unstable();
    let mut starting = starting.as_slice();
    let mut sweep = Sweep { outline, crossed: Vec::new(), triangles: Vec::new() };
    for vertex in 0..index(outline.points.len()) {
        let (here, later) = starting.split_at(starting.partition_point(|edge| edge.0 == vertex));
        sweep.pass(vertex, here.iter().map(|&(_, right, above)| (right, above)).collect());
        starting = later;
    }
    sweep.triangles
}

impl Sweep<'_> {
    fn side(&self, a: u32, b: u32, c: u32) -> Side {
        let [a, b, c] = [a, b, c].map(|id| self.outline.points[id as usize]);
        side(a, b, c)
    }

    /// Passes a vertex: closes what its ending edges bound, and opens what its starting ones do.
    ///
    /// Of each starting edge its right end is given, and whether the interior lies above.
    fn pass(&mut self, vertex: u32, mut starting: Vec<(u32, bool)>) {
        starting.sort_unstable_by(|a, b| match self.side(vertex, a.0, b.0) {
            Side::Left => Ordering::Less,
            Side::On => Ordering::Equal,
            Side::Right => Ordering::Greater,
        });
        let ending = self.ending(vertex);
        let mut below = ending.start.checked_sub(1).and_then(|edge| self.crossed[edge].above.take());
        let mut above = match ending.clone().last() {
            None => below.as_mut().map(split_at_rightmost),
            Some(edge) => self.crossed[edge].above.take(),
        };
        for edge in ending.clone() {
            self.close(edge, vertex);
        }
        if let Some(chain) = &mut below {
            self.join_top(chain, vertex);
        }
        if let Some(chain) = &mut above {
            self.join_bottom(chain, vertex);
        }
        self.replace(vertex, ending, &starting, below, above);
    }

    /// The crossed edges that end in a vertex; where there is none, the place between edges where it lies.
    fn ending(&self, vertex: u32) -> Range<usize> {
        let is_below = |edge: &Crossed| self.side(edge.ends[0], edge.ends[1], vertex) == Side::Left;
        let start = self.crossed.partition_point(is_below);
        let count = self.crossed[start..].iter().take_while(|edge| edge.ends[1] == vertex).count();
        start..start + count
    }

    /// Cuts all that is open above an edge into triangles with the vertex in which its two edges end.
    fn close(&mut self, edge: usize, vertex: u32) {
        let chain = self.crossed[edge].above.take().unwrap_or_default();
        let pairs = chain.iter().zip(chain.iter().skip(1));
        self.triangles.extend(pairs.map(|(&low, &high)| [vertex, high, low]));
    }

    /// Adds a vertex of the upper edge, above all others.
    fn join_top(&mut self, chain: &mut OpenChain, vertex: u32) {
        while let [Some(&before), Some(&last)] =
            [2, 1].map(|back| chain.len().checked_sub(back).and_then(|i| chain.get(i)))
        {
            if self.side(vertex, last, before) != Side::Left {
                break;
            }
            self.triangles.push([vertex, last, before]);
            chain.pop_back();
        }
        chain.push_back(vertex);
    }

    /// Adds a vertex of the lower edge, below all others.
    fn join_bottom(&mut self, chain: &mut OpenChain, vertex: u32) {
        while let [Some(&first), Some(&after)] = [0, 1].map(|i| chain.get(i)) {
            if self.side(after, first, vertex) != Side::Left {
                break;
            }
            self.triangles.push([after, first, vertex]);
            chain.pop_front();
        }
        chain.push_front(vertex);
    }

    /// Puts the starting edges in the place of the ending ones, with what is open `below` all of them and `above`.
    fn replace(
        &mut self,
        vertex: u32,
        ending: Range<usize>,
        starting: &[(u32, bool)],
        below: Option<OpenChain>,
        mut above: Option<OpenChain>,
    ) {
        let below = if starting.is_empty() { merged(below, above.take()) } else { below };
        if let Some(edge) = ending.start.checked_sub(1) {
            self.crossed[edge].above = below;
        }
        let last = starting.len().saturating_sub(1);
        let edges = starting.iter().enumerate().map(|(i, &(right, opens))| {
            let chain = if i == last { above.take() } else { Some(OpenChain::from([vertex])) };
            Crossed { ends: [vertex, right], above: chain.filter(|_| opens) }
        });
        self.crossed.splice(ending, edges);
    }
}

/// Cuts a chain in two at its rightmost vertex, which both keep: the lower part stays, the upper one is returned.
fn split_at_rightmost(chain: &mut OpenChain) -> OpenChain {
    let rightmost = chain.iter().enumerate().max_by_key(|&(_, id)| id).map_or(0, |(i, _)| i);
    let upper = chain.split_off(rightmost);
    chain.extend(upper.front());
    upper
}

/// Two chains that meet in a vertex as one.
fn merged(below: Option<OpenChain>, above: Option<OpenChain>) -> Option<OpenChain> {
    let mut chain = below?;
    chain.extend(above?.iter().skip(1));
    Some(chain)
}
