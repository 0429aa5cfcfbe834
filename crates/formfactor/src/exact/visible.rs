//! The visible part of a target: the target less the union of the shadows, by polycsg.
use super::{lambert::ContourSum, project::Shadow, view::View};
use crate::shapes::loops::leaf;
use polycsg::{Csg, Scratch};

/// Lambert's sum over the visible part's directed boundary: no rings are built.
pub(crate) fn sum(view: &View, shadows: &[Shadow], scratch: &mut Scratch) -> ContourSum {
    view.sum_over(&(leaf(&view.flat) - union(shadows)), scratch)
}

/// All that the shadows cover.
pub(crate) fn union(shadows: &[Shadow]) -> Csg<'_> {
    Csg::union(shadows.iter().map(|s| leaf(&s.loops)))
}

/// How many edges the target and the shadows have.
pub(crate) fn edge_count(view: &View, shadows: &[Shadow]) -> u64 {
    let loops = view.flat.iter().chain(shadows.iter().flat_map(|s| &s.loops));
    loops.flatten().map(|_| 1).sum()
}
