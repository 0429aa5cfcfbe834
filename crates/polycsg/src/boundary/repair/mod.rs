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
//! This ends, and the result is right. Before rounding, pieces meet only in common vertices, so between two cuts at equal abscissae
//! two fragments keep one order; rounding each coordinate to nearest is monotone, so they keep it weakly at both
//! ends: they may share ends or coincide, never cross. When two fragments still conflict, some end of one lies
//! strictly inside the abscissae of the other, so a cut is added; there are finitely many (piece, vertex) pairs.
//! Only fragments that rounding made vertical escape this argument: they can overlap on their one abscissa, and are cut
//! at the points that lie on them, which moves nothing.

mod cut;
mod fragment;
pub(crate) mod fragments;
mod near;
mod sound;

use crate::boundary::outline::Outline;
use crate::contacts::close_pairs::ClosePairs;
use crate::spatial::slabs::SlabDecomposition;
use fragment::{Class, CutAt, Fragment, Part};
use fragments::Rounded;

/// The buffers of the stage.
#[derive(Debug, Default)]
pub(crate) struct Repair {
    parts: Vec<Part>,
    fragments: Vec<Fragment>,
    /// The fragments that are not empty, by their ends, and the spans of those with the same ends.
    alike: Vec<u32>,
    classes: Vec<Class>,
    /// Pairs of classes.
    conflicts: Vec<[u32; 2]>,
    /// The cuts to be made next, sorted.
    cuts: Vec<CutAt>,
    /// The edges of close pairs, sorted.
    edges: Vec<u32>,
    /// How many vertices were put into edges for the last region.
    pub(crate) vertices: usize,
}

impl Repair {
    /// Forgets what the last region needed.
    pub(crate) fn start(&mut self) {
        self.vertices = 0;
    }

    /// Puts the pieces into an outline: as they are if rounding left them sound, else repaired.
    pub(crate) fn outline<'o>(
        &mut self,
        rounded: Rounded<'_>,
        close_pairs: &ClosePairs,
        slabs: &mut SlabDecomposition,
        outline: &'o mut Outline,
    ) -> &'o Outline {
        if self.is_sound(rounded, close_pairs, slabs) {
            outline.take(rounded.edges, rounded.contacts, rounded.selection);
        } else {
            self.cut(rounded, close_pairs, slabs, outline);
        }
        outline
    }
}
