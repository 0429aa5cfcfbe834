//! A tree over the rings of a region, to see the region from a small window.
//!
//! ```text
//!        ___c___              A run of edges that lies on one side of the window winds around each of its points as often
//!   a___/       \___b         as the run's chord does, the straight way from a to b: run and chord together are a closed
//!   . . . . . . . . .         curve in a half-plane that does not contain the window. So the chord replaces the run, and
//!       +------+              what is left of a region of n edges are the few that are near the window, and O(log n)
//!       |window|              chords.
//!       +------+
//! ```
//!
//! A node is a run of one ring, with its box and a narrow band around it, which tells more of long edges side by side, or it is
//! several whole rings, that are passed over where the window lies outside of them. After Ballard, "Strip trees: a hierarchical representation
//! for curves", CACM 24, 1981.

use crate::base::id::{index, span};
use crate::predicates::{Band, Window};
use crate::region::rings::Rings;
use glam::DVec2;
use std::ops::{ControlFlow, Range};

/// A run of so many edges has no parts.
const FEW: u32 = 8;

/// A node. All nodes below it follow it.
#[derive(Clone, Copy, Debug)]
struct Run {
    low: DVec2,
    high: DVec2,
    band: Band,
    /// The slots of its points; empty for several rings.
    first: u32,
    last: u32,
    /// The node behind those below this one.
    next: u32,
    /// Whether it is no part of a ring, but a ring or more.
    whole: bool,
}

/// What a window sees of a ring.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Sight {
    /// A ring starts, by its first slot.
    Ring(u32),
    /// An edge that meets the window.
    Edge(u32),
    /// A run between two slots that does not, and the outer half-planes of the window's sides that all of it lies in.
    Chord([u32; 2], u8),
}

/// See the module's page. 80 bytes a node; a ring of m edges takes 2 ⌈m / 8⌉ nodes with those above it.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChordTree {
    /// Each node before those below it.
    runs: Vec<Run>,
}

impl ChordTree {
    /// O(n log n).
    pub(crate) fn build(rings: &Rings) -> ChordTree {
        let mut tree = ChordTree::default();
        let mut order: Vec<u32> = (0..index(rings.len())).collect();
        if !order.is_empty() {
            tree.add_rings(rings, &mut order, 0);
        }
        tree.runs.shrink_to_fit();
        tree
    }

    /// The box around everything.
    pub(crate) fn bounds(&self) -> Option<[DVec2; 2]> {
        self.runs.first().map(|run| [run.low, run.high])
    }

    /// Adds some rings, halved in turn by x and y.
    fn add_rings(&mut self, rings: &Rings, order: &mut [u32], axis: usize) {
        if let [ring] = *order {
            return self.add_run(rings.points(), span(rings.slots(ring as usize)), true);
        }
        let at = self.open();
        let place = |&ring: &u32| rings.ring(ring as usize)[0][axis];
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)).then(a.cmp(b)));
        let (these, those) = order.split_at_mut(middle);
        self.add_rings(rings, these, 1 - axis);
        let second = self.runs.len();
        self.add_rings(rings, those, 1 - axis);
        self.close(at, second);
    }

    /// Adds the run between the first and the last of some slots.
    fn add_run(&mut self, points: &[DVec2], slots: Range<u32>, whole: bool) {
        let (at, edges) = (self.open(), slots.end - slots.start - 1);
        if edges > FEW {
            let middle = slots.start + (edges / 2).next_multiple_of(FEW).min(edges - 1);
            self.add_run(points, slots.start..middle + 1, false);
            let second = self.runs.len();
            self.add_run(points, middle..slots.end, false);
            self.close(at, second);
        } else {
            let points = &points[slots.start as usize..slots.end as usize];
            self.runs[at].low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
            self.runs[at].high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
            self.runs[at].next = index(at + 1);
        }
        let points = &points[slots.start as usize..slots.end as usize];
        let run = &mut self.runs[at];
        (run.first, run.last, run.whole) = (slots.start, slots.end - 1, whole);
        run.band = band_around(points);
    }

    fn open(&mut self) -> usize {
        self.runs.push(Run {
            low: DVec2::ZERO,
            high: DVec2::ZERO,
            band: Band::PLANE,
            first: 0,
            last: 0,
            next: 0,
            whole: true,
        });
        self.runs.len() - 1
    }

    /// Ends a node whose two parts follow it.
    fn close(&mut self, at: usize, second: usize) {
        let (a, b) = (self.runs[at + 1], self.runs[second]);
        let next = index(self.runs.len());
        let run = &mut self.runs[at];
        (run.low, run.high, run.next) = (a.low.min(b.low), a.high.max(b.high), next);
    }

    /// Shows all rings as a window sees them, ring by ring, each from its first slot to its last one; those on one side of the
    /// window are left out. O(log n) steps for each edge near the window, and one for each node whose box and band are.
    pub(crate) fn view(
        &self,
        points: &[DVec2],
        window: &Window,
        mut show: impl FnMut(Sight) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut at = 0;
        while let Some(run) = self.runs.get(at) {
            let sides = window.outer_sides(run.low, run.high);
            if sides != 0 || run.band.misses(window) {
                if !run.whole {
                    show(Sight::Chord([run.first, run.last], sides))?;
                }
                at = run.next as usize;
                continue;
            }
            if run.whole && run.first != run.last {
                show(Sight::Ring(run.first))?;
            }
            at += 1;
            if at == run.next as usize {
                (run.first..run.last).try_for_each(|edge| show(seen(points, window, edge)))?;
            }
        }
        ControlFlow::Continue(())
    }
}

/// An edge as a window sees it.
fn seen(points: &[DVec2], window: &Window, edge: u32) -> Sight {
    let [a, b] = [points[edge as usize], points[edge as usize + 1]];
    let sides = window.outer_sides(a.min(b), a.max(b));
    if sides != 0 || window.is_beside([a, b]) {
        return Sight::Chord([edge, edge + 1], sides);
    }
    Sight::Edge(edge)
}

/// A band along the chord of a run or along its longest edge, whichever is narrower.
fn band_around(points: &[DVec2]) -> Band {
    let length = |d: &DVec2| d.x.abs() + d.y.abs();
    let edges = points.windows(2).map(|ends| ends[1] - ends[0]);
    let longest = edges.fold(DVec2::ZERO, |a, b| if length(&b) > length(&a) { b } else { a });
    let chord = points[points.len() - 1] - points[0];
    Band::along(chord, points).narrower(Band::along(longest, points))
}
