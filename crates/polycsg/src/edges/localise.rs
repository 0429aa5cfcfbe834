//! Reads what a window sees of a prepared region: the edges that meet it, and chords in place of all others.
//!
//! Within the window all winding numbers are those of the whole region, and outside of it nothing matters: the expression
//! holds nowhere there, whatever this operand is.

use super::{Edges, Origin};
use crate::base::id::index;
use crate::predicates::Window;
use crate::region::prepared::{PreparedRegion, surrounds};
use crate::spatial::chord_tree::Sight;
use std::ops::ControlFlow;

/// What is known of a ring under way.
#[derive(Clone, Copy, Debug, Default)]
struct LocalRing {
    /// What its slots are ahead of the numbers of its edges.
    ahead: u32,
    /// Whether any edge of it meets the window.
    near: bool,
    /// The outer half-planes of the window's sides that all its chords since the last point lie in.
    sides: u8,
}

impl Edges {
    /// Adds the rings that a window sees, or is surrounded by. Chords that follow one another on one side are one.
    pub(super) fn add_prepared(
        &mut self,
        prepared: &PreparedRegion,
        operand: u32,
        counter: Option<u32>,
        window: &Window,
    ) {
        self.store_origins();
        let points = prepared.rings().points();
        let mut ring = LocalRing::default();
        let add = |edges: &mut Edges, ring: LocalRing, slot: u32| {
            edges.add_edge(points[slot as usize], Origin { operand, edge: slot - ring.ahead });
        };
        let _ = prepared.view(window, |sight| {
            match sight {
                Sight::Ring(slot) => {
                    self.end_local_ring(ring, counter, window);
                    let ahead = prepared.rings().ring_at(slot as usize);
                    ring = LocalRing { ahead: index(ahead), ..LocalRing::default() };
                }
                Sight::Edge(edge) => {
                    add(self, ring, edge);
                    ring = LocalRing { near: true, sides: 0, ..ring };
                }
                Sight::Chord([first, _], sides) => {
                    if ring.sides & sides == 0 {
                        add(self, ring, first);
                        ring.sides = sides;
                    }
                    ring.sides &= sides;
                }
            }
            ControlFlow::Continue(())
        });
        self.end_local_ring(ring, counter, window);
    }

    /// Closes the ring whose points were added, or removes it.
    fn end_local_ring(&mut self, ring: LocalRing, counter: Option<u32>, window: &Window) {
        let start = self.ring.len();
        if ring.near || surrounds(&self.points[start..], window.low) {
            self.close(counter);
        } else {
            self.points.truncate(start);
            self.origins.truncate(start);
        }
    }
}
