//! Reads what a window, the result's bounds, sees of a ring: the edges near it, and chords in place of the runs that lie
//! on one side of it; see [`ChordTree`](crate::spatial::chord_tree::ChordTree).
//!
//! Within the window all winding numbers are those of the whole ring, and outside of it nothing matters: the expression holds
//! nowhere there, whatever this ring is.

use super::{Change, Edges, Origin};
use crate::base::id::index;
use crate::predicates::Window;
use crate::region::prepared::{PreparedRegion, surrounds};
use crate::spatial::chord_tree::Sight;
use glam::DVec2;
use std::ops::ControlFlow;

/// A ring under way.
#[derive(Clone, Copy, Debug)]
struct LocalRing {
    /// The first of its slots.
    start: usize,
    operand: u32,
    /// Whether any of its edges is near the window.
    near: bool,
    /// The outer half-planes of the window's sides that all its chords since the last point lie in.
    sides: u8,
}

impl LocalRing {
    fn new(edges: &Edges, operand: u32) -> LocalRing {
        LocalRing { start: edges.len(), operand, near: false, sides: 0 }
    }

    /// Adds the starts of edges near the window.
    fn add_edges(&mut self, edges: &mut Edges, starts: &[DVec2], edge: u32) {
        self.add(edges, starts, edge);
        (self.near, self.sides) = (true, 0);
    }

    /// Adds the start of a chord that lies in some outer half-planes, if the chord before it cannot run on.
    fn add_chord(&mut self, edges: &mut Edges, start: DVec2, edge: u32, sides: u8) {
        if self.sides & sides == 0 {
            self.add(edges, &[start], edge);
            self.sides = sides;
        }
        self.sides &= sides;
    }

    fn add(self, edges: &mut Edges, starts: &[DVec2], edge: u32) {
        self.drop_last_if(edges, starts[0]);
        edges.points.extend_from_slice(starts);
        let numbers = edge..edge + index(starts.len());
        edges.origins.extend(numbers.map(|edge| Origin { operand: self.operand, edge }));
    }

    /// Drops the last point, if it is also the next one: the chord from there leads nowhere.
    fn drop_last_if(self, edges: &mut Edges, next: DVec2) {
        if edges.points[self.start..].last() == Some(&next) {
            edges.points.pop();
            edges.origins.pop();
        }
    }

    fn drop(self, edges: &mut Edges) {
        edges.points.truncate(self.start);
        edges.origins.truncate(self.start);
    }
}

impl Edges {
    /// Adds the rings of a region that a window sees, or lies in.
    pub(super) fn add_prepared(
        &mut self,
        prepared: &PreparedRegion,
        operand: u32,
        counter: Option<u32>,
        window: &Window,
    ) {
        self.store_origins();
        let points = prepared.rings().points();
        let (mut ring, mut before) = (LocalRing::new(self, operand), 0);
        let _ = prepared.view(window, |sight| {
            match sight {
                Sight::Ring(slot) => {
                    self.end_simple(ring, counter, window);
                    ring = LocalRing::new(self, operand);
                    before = index(prepared.rings().ring_at(slot as usize));
                }
                Sight::Edge(slot) => ring.add_edges(self, &[points[slot as usize]], slot - before),
                Sight::Chord([slot, _], sides) => {
                    ring.add_chord(self, points[slot as usize], slot - before, sides);
                }
            }
            ControlFlow::Continue(())
        });
        self.end_simple(ring, counter, window);
    }

    /// Closes a simple ring, or drops it where the window does not lie in it.
    fn end_simple(&mut self, ring: LocalRing, counter: Option<u32>, window: &Window) {
        if ring.near || surrounds(&self.points[ring.start..], window.low) {
            self.end_local(counter);
        } else {
            ring.drop(self);
        }
    }

    fn end_local(&mut self, counter: Option<u32>) {
        let change = counter.map(|counter| Change { counter, winds: 1 });
        self.end_ring(None, change.as_slice());
    }

    /// Adds any ring as a window sees it; no point of it, the last one like the first, is the next one. False, if edges near the
    /// window are all that is left, and no ring.
    pub(super) fn add_seen(
        &mut self,
        points: &[DVec2],
        Origin { operand, edge }: Origin,
        counter: Option<u32>,
        window: &Window,
    ) -> bool {
        self.store_origins();
        let mut ring = LocalRing::new(self, operand);
        let mut first = 0;
        while first + 1 < points.len() {
            let (end, sides) = run(points, first, window);
            match sides {
                0 => ring.add_edges(self, &points[first..end], edge + index(first)),
                sides => ring.add_chord(self, points[first], edge + index(first), sides),
            }
            first = end;
        }
        if self.len() > ring.start + 1 {
            ring.drop_last_if(self, points[0]);
        }
        let is_ring = self.len() > ring.start + 2;
        if is_ring {
            self.end_local(counter);
        } else {
            ring.drop(self);
        }
        is_ring || !ring.near
    }
}

/// Where a run of edges ends that starts in a point, and the outer half-planes of a window's sides that it lies in: the longest
/// in the same ones, or of edges that each lie in none.
fn run(points: &[DVec2], first: usize, window: &Window) -> (usize, u8) {
    let outer = |i: usize| window.outer_sides(points[i], points[i]);
    let mut at_end = outer(first + 1);
    let mut sides = outer(first) & at_end;
    let is_near = sides == 0;
    let mut end = first + 1;
    while end + 1 < points.len() {
        let before = if is_near { at_end } else { sides };
        at_end = outer(end + 1);
        if (before & at_end == 0) != is_near {
            break;
        }
        sides = before & at_end;
        end += 1;
    }
    (end, sides)
}
