//! Stage 7: makes the rounded pieces meet in shared points only.
//!
//! Rounding moves crossings by half an ulp, which may carry a vertex over a piece, or a piece onto another. Where that
//! happened, both pieces are cut at the *exact* abscissae of each other's ends and the cut points are rounded:
//!
//! ```text
//!   exact              rounded: they cross       cut at a, b; rounded again
//!   ----__             -------                   ------+---+
//!     a   ---b           \/                            a   b     weakly ordered on each vertical, so no crossing
//!   --------             -/\----                 ------+---+
//! ```
//!
//! Fragments with the same rounded ends are one class. Of two classes in conflict, each member of one is cut at the ends of
//! the abscissae that all members of the other have in common.
//!
//! This ends, and the result is right. Before rounding, pieces meet only in common vertices, so between two cuts at equal
//! abscissae two fragments keep one order; rounding each coordinate to nearest is monotone, so they keep it weakly at both
//! ends: they may share ends or coincide, never cross. Where two classes conflict, any member of one overlaps any of the
//! other in more than an abscissa, and some two have different left ends or different right ends. Say a left end differs: one
//! of the two members starts further left, so further left than the common abscissae of the other's class, and these start
//! strictly inside it. So a cut is added, and there are finitely many (piece, vertex) pairs.
//! Only fragments that rounding made vertical escape this argument: they can overlap on their one abscissa, and are cut
//! at the points that lie on them, which moves nothing.
//!
//! The result is a function of the set of edges, whatever their order, their directions and the starts of their rings. A fragment
//! is a part of a line between two exact abscissae, and its rounded ends depend on nothing else: not on which of several
//! edges on that line was selected, nor on which two edges stand for a crossing. What is in conflict depends on the rounded
//! ends, the cuts on the abscissae in both classes; where two are equal, the points cut there are. So each round makes
//! of one set of fragments the next one. What is left out of a round as being far from all conflicts is in none.

mod cut;
mod fragment;
pub(crate) mod fragments;
mod index;
mod near;
mod sound;

use crate::base::meter::Refusal;
use crate::boundary::outline::Outline;
use crate::contacts::close_pairs::ClosePairs;
use crate::predicates::Segment;
use fragment::{Class, CutAt, Fragment, Part};
use fragments::Rounded;
pub(crate) use index::Index;

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Repair {
    parts: Vec<Part>,
    fragments: Vec<Fragment>,
    /// The fragments that are not empty with their ends from left to right, sorted by these, and the spans of those with the same.
    alike: Vec<(Segment, u32)>,
    classes: Vec<Class>,
    /// Pairs of classes.
    conflicts: Vec<[u32; 2]>,
    /// The cuts to be made next, sorted.
    cuts: Vec<CutAt>,
    /// Per fragment its class.
    class_of: Vec<u32>,
    /// The edges of close pairs, and the fragments by edge, sorted.
    edges: Vec<u32>,
    by_edge: Vec<[u32; 2]>,
    /// How many vertices were put into edges for the last region.
    pub(crate) vertices: usize,
}

impl Repair {
    /// Forgets what the last region needed.
    pub(crate) fn start(&mut self) {
        self.vertices = 0;
    }

    /// Puts the pieces into an outline: as they are if rounding left them sound, else repaired.
    ///
    /// # Errors
    /// Those of the limits of the index.
    pub(crate) fn outline(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        mut index: Index<'_>,
        outline: &mut Outline,
    ) -> Result<(), Refusal> {
        if self.is_sound(rounded, close_pairs, &mut index)? {
            outline.take(rounded.edges, rounded.contacts, rounded.selection, index.meter)
        } else {
            self.cut(rounded, &mut index, outline)
        }
    }
}
