//! What the walk has still to do. A stack of steps takes the place of recursion, which long input would carry too deep.

/// What is left to do of a walk; each step leaves the state as it found it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// Walk ahead from `sub_edge`, which is labelled, until the ring closes at `first` or a junction ends it.
    Ahead { sub_edge: u32, first: u32 },
    /// Go back to `first`.
    Back { sub_edge: u32, first: u32 },
    /// Walk against the ring from `sub_edge` until a junction.
    Behind { sub_edge: u32, first: u32 },
    /// Go forward to `first` again.
    Return { sub_edge: u32, first: u32 },
    /// Go around a junction: from the left of the group of half-edges before `place`, over so many half-edges.
    Around { junction: u32, place: u32, left: u32 },
    /// Cross a sub-edge and all that overlap it, from its right to its left.
    Cross { sub_edge: u32 },
    /// Cross them from its left to its right.
    CrossBack { sub_edge: u32 },
    /// Start with a component, outside of it.
    Component { vertex: u32 },
}
